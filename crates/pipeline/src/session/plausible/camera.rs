//! Cameras that can hardly be.

use model::{Camera, LensModel, ProblemCode, Severity};
use nalgebra::Point2;

use super::SetupDoubt;
use super::limits::{FIELD_OF_VIEW_DEG, MOST_FOCAL_RATIO, MOST_OFF_CENTRE, MOST_RECTILINEAR_DEG};

/// The doubts about a camera.
pub(super) fn doubts(camera: &Camera) -> Vec<SetupDoubt> {
    let doubt =
        |(fact, cause)| SetupDoubt { severity: Severity::Loss, code: ProblemCode::ImplausibleCamera, fact, cause };
    [field_of_view(camera), focal_ratio(camera), principal_point(camera), lens(camera)]
        .into_iter()
        .flatten()
        .map(doubt)
        .collect()
}

fn size(camera: &Camera) -> [f64; 2] {
    camera.size_px().map(f64::from)
}

/// The field of view across the picture's width and height as the lens model alone would have it, degrees.
fn fields_of_view_deg(camera: &Camera) -> [f64; 2] {
    let (size, focal) = (size(camera), camera.focal_px());
    [0, 1].map(|i| {
        let across = size[i] / focal[i];
        match camera.lens() {
            LensModel::Fisheye(_) => across.to_degrees(),
            _ => 2.0 * (across / 2.0).atan().to_degrees(),
        }
    })
}

fn field_of_view(camera: &Camera) -> Option<(String, String)> {
    let most_deg = match camera.lens() {
        LensModel::Fisheye(_) => *FIELD_OF_VIEW_DEG.end(),
        _ => MOST_RECTILINEAR_DEG,
    };
    let [across, down] = fields_of_view_deg(camera);
    let is_plausible = across >= *FIELD_OF_VIEW_DEG.start() && across.max(down) <= most_deg;
    let ([fx, fy], [width, height]) = (camera.focal_px(), camera.size_px());
    (!is_plausible).then(|| {
        let least = FIELD_OF_VIEW_DEG.start();
        (
            format!(
                "a focal length of {fx:.1}, {fy:.1} px in a picture of {width} x {height} px is a field of view of {across:.0} x {down:.0} \
                 degrees; expected {least:.0} to {most_deg:.0}"
            ),
            "give the focal length in pixels of this picture: one in mm, or of a calibration at another picture size, is the usual cause"
                .to_owned(),
        )
    })
}

fn focal_ratio(camera: &Camera) -> Option<(String, String)> {
    let [fx, fy] = camera.focal_px();
    let ratio = fx.max(fy) / fx.min(fy);
    (ratio > MOST_FOCAL_RATIO).then(|| {
        (
            format!("the focal lengths {fx:.1} and {fy:.1} px differ by a factor of {ratio:.2}; expected at most {MOST_FOCAL_RATIO}"),
            "pixels are square: correct the one that is wrong; where pictures were stretched, calibrate as they are".to_owned(),
        )
    })
}

fn principal_point(camera: &Camera) -> Option<(String, String)> {
    let ([width, height], [cx, cy]) = (size(camera), camera.principal_px());
    let off = |x: f64, y: f64| ((x / width - 0.5).abs()).max((y / height - 0.5).abs());
    (off(cx, cy) > MOST_OFF_CENTRE).then(|| {
        let cause = if off(cy, cx) < off(cx, cy) && off(cy, cx) <= MOST_OFF_CENTRE {
            format!("x and y are swapped: principal_px = [{cy}, {cx}] would be near the middle")
        } else {
            "give the principal point in pixels of this picture: a calibration at another picture size, or of a cut-out, is the usual cause"
                .to_owned()
        };
        (
            format!(
                "the principal point {cx:.1}, {cy:.1} is {:.0} % of the picture of {width} x {height} px away from its middle; expected at \
                 most {:.0} %",
                100.0 * off(cx, cy),
                100.0 * MOST_OFF_CENTRE
            ),
            cause,
        )
    })
}

/// A lens of another model or unit bends the picture so far that there is no ray at the middle of its edges.
fn lens(camera: &Camera) -> Option<(String, String)> {
    let [width, height] = size(camera);
    let [cx, cy] = camera.principal_px();
    let edges = [(0.0, cy), (width - 1.0, cy), (cx, 0.0), (cx, height - 1.0)];
    let blind = edges.into_iter().find(|(x, y)| camera.ray_through(Point2::new(*x, *y)).is_err())?;
    Some((
        format!("the lens model gives no ray at the picture's edge, pixel {:.0}, {:.0}", blind.0, blind.1),
        "check the model and the unit of its coefficients: those of another model, or for radii in pixels or mm, are the usual cause".to_owned(),
    ))
}
