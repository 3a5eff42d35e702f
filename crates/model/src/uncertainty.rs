//! What the uncertainty of the inputs does to a size: first-order propagation.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Vector2;

use crate::camera::Camera;
use crate::container::{Kind, Method, Quantity};
use crate::marks::ObjectMarks;
use crate::measure::{
    Container, MeasureError, Measured, height_sigma_per_px, measure_as_seen, spans_sigma_per_px, view_of_method,
};
use crate::pose::Pose;
use crate::view::View;

/// Standard uncertainties (k = 1) of what goes into a size. The errors of pitch, roll, range and camera are taken as
/// independent of each other, those of the marks' coordinates as independent of everything.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InputSigma {
    /// Pitch: accelerometer (17 mg per degree; ADXL362 data sheet: zero-g offset of tens of mg) and mount offset.
    pub pitch_rad: f64,
    /// Sideways tilt of gravity, from the same sources. Turning about the optical axis moves 'down' by only cos(pitch) per
    /// radian, so the roll is uncertain by this over cos(pitch).
    pub tilt_rad: f64,
    /// Range, relative (VL53L0X data sheet: about 3 % uncalibrated).
    pub range_relative: f64,
    /// One coordinate of one marked point.
    pub mark_px: f64,
    /// Focal length, relative; both axes together.
    pub focal_relative: f64,
    /// Each coordinate of the principal point.
    pub principal_px: f64,
}

/// Standard uncertainty of a size, by source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SizeSigma {
    /// From the pitch.
    pub pitch_mm: f64,
    /// From the roll; for [`Method::Paper`] about its assumption of zero roll.
    pub roll_mm: f64,
    /// From the range.
    pub range_mm: f64,
    /// From the marks.
    pub marks_mm: f64,
    /// From focal length and principal point.
    pub camera_mm: f64,
}

impl SizeSigma {
    /// The parts in quadrature.
    #[must_use]
    pub fn total_mm(&self) -> f64 {
        [self.pitch_mm, self.roll_mm, self.range_mm, self.marks_mm, self.camera_mm]
            .iter()
            .map(|s| s * s)
            .sum::<f64>()
            .sqrt()
    }
}

/// A size with its uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The size.
    pub measured: Measured,
    /// Its uncertainty; none where an input cannot be varied by its uncertainty (a ray then misses the table).
    pub sigma: Option<SizeSigma>,
}

/// [`measure`](crate::measure()) with uncertainties. Pose and camera: by central differences of one standard uncertainty
/// through the whole chain, so that a rim plane's own uncertainty reaches the diameter measured on it. Marks: by the
/// derivatives of the point on the plane by the pixel, for a circle through the normal matrix of its fit.
#[must_use]
pub fn estimate(
    view: &View,
    method: Method,
    container: &Container,
    marks: &ObjectMarks,
    inputs: &InputSigma,
) -> Vec<(Quantity, Result<Estimate, MeasureError>)> {
    let chain = Chain { view: view_of_method(view, method), method, container, marks };
    chain
        .sizes(&chain.view, marks)
        .into_iter()
        .map(|(quantity, size)| {
            (quantity, size.map(|measured| Estimate { measured, sigma: chain.sigma(&measured, inputs) }))
        })
        .collect()
}

struct Chain<'a> {
    view: View,
    method: Method,
    container: &'a Container,
    marks: &'a ObjectMarks,
}

impl Chain<'_> {
    fn sizes(&self, view: &View, marks: &ObjectMarks) -> Vec<(Quantity, Result<Measured, MeasureError>)> {
        measure_as_seen(view, self.method, self.container, marks)
    }

    fn size_mm(&self, view: &View, marks: &ObjectMarks, wanted: Quantity) -> Option<f64> {
        let (_, size) = self.sizes(view, marks).into_iter().find(|(quantity, _)| *quantity == wanted)?;
        Some(size.ok()?.predicted_mm)
    }

    fn sigma(&self, measured: &Measured, inputs: &InputSigma) -> Option<SizeSigma> {
        let quantity = measured.quantity;
        let (pose, camera) = (*self.view.pose(), *self.view.camera());
        let by_pose = |pitch_rad: f64, roll_rad: f64, range_mm: f64| {
            self.half_difference(quantity, |sign| {
                let (pitch_rad, roll_rad) =
                    across_the_zenith(pose.pitch_rad() + sign * pitch_rad, pose.roll_rad() + sign * roll_rad);
                Some(View::new(camera, Pose::new(pitch_rad, roll_rad, pose.range_mm() + sign * range_mm).ok()?))
            })
        };
        let by_camera = |focal: f64, x_px: f64, y_px: f64| {
            self.half_difference(quantity, |sign| {
                Some(View::new(moved_camera(&camera, sign * focal, Vector2::new(x_px, y_px) * sign)?, pose))
            })
        };
        let camera_parts = [
            by_camera(inputs.focal_relative, 0.0, 0.0)?,
            by_camera(0.0, inputs.principal_px, 0.0)?,
            by_camera(0.0, 0.0, inputs.principal_px)?,
        ];
        Some(SizeSigma {
            pitch_mm: by_pose(inputs.pitch_rad, 0.0, 0.0)?.abs(),
            roll_mm: by_pose(0.0, inputs.tilt_rad / pose.pitch_rad().cos().max(STEEPEST_COS), 0.0)?.abs(),
            range_mm: by_pose(0.0, 0.0, inputs.range_relative * pose.range_mm())?.abs(),
            marks_mm: self.marks_sigma_mm(measured, inputs.mark_px)?,
            camera_mm: camera_parts.iter().map(|p| p * p).sum::<f64>().sqrt(),
        })
    }

    fn half_difference(&self, quantity: Quantity, view: impl Fn(f64) -> Option<View>) -> Option<f64> {
        let plus = self.size_mm(&view(1.0)?, self.marks, quantity)?;
        let minus = self.size_mm(&view(-1.0)?, self.marks, quantity)?;
        Some(0.5 * (plus - minus))
    }

    /// From the marks: of the span itself, and of the height line through the rim plane.
    fn marks_sigma_mm(&self, measured: &Measured, mark_px: f64) -> Option<f64> {
        let (quantity, z_mm) = (measured.quantity, measured.plane_z_mm);
        let height_sigma_mm = || Some(mark_px * height_sigma_per_px(&self.view, self.method, self.marks).ok()?);
        if quantity == Quantity::Height {
            return height_sigma_mm();
        }
        let shape = self.container.shape;
        let of_span_mm = mark_px * spans_sigma_per_px(&self.view, shape, quantity, self.marks, z_mm).ok()?;
        if self.container.rim_height_mm.is_some() || self.container.kind == Kind::Plate {
            return Some(of_span_mm);
        }
        let height_sigma_mm = height_sigma_mm()?;
        let on_plane = |z_mm: f64| {
            let known = Container { rim_height_mm: Some(z_mm), ..*self.container };
            let chain = Chain { container: &known, ..*self };
            chain.size_mm(&chain.view, self.marks, quantity)
        };
        let by_height_mm = 0.5 * (on_plane(z_mm + height_sigma_mm)? - on_plane(z_mm - height_sigma_mm)?);
        Some(of_span_mm.hypot(by_height_mm))
    }
}

/// Looking straight down, roll is a turn of the world, which changes no size: its uncertainty is not followed further.
const STEEPEST_COS: f64 = 0.02;

/// The same pose with the pitch at most 90 degrees (beyond it, the camera has turned about) and the roll within a turn.
fn across_the_zenith(pitch_rad: f64, roll_rad: f64) -> (f64, f64) {
    let (pitch_rad, roll_rad) =
        if pitch_rad > FRAC_PI_2 { (PI - pitch_rad, roll_rad + PI) } else { (pitch_rad, roll_rad) };
    (pitch_rad, (roll_rad + PI).rem_euclid(TAU) - PI)
}

fn moved_camera(camera: &Camera, focal_relative: f64, principal_px: Vector2<f64>) -> Option<Camera> {
    let [cx, cy] = camera.principal_px();
    let focal_px = camera.focal_px().map(|f| f * (1.0 + focal_relative));
    let principal_px = [cx + principal_px.x, cy + principal_px.y];
    Camera::new(camera.size_px(), focal_px, principal_px, camera.skew_px(), *camera.lens()).ok()
}
