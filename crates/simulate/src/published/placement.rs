//! The places of marks and of containers from which the paper's equations give the published sizes.

use model::{Quantity, View, ViewError};
use nalgebra::{Point2, Point3};

use crate::scene::Bowl;
use crate::study::LabeledLine;

/// Free space at the lower border of the picture.
const BORDER_PX: f64 = 40.0;

/// Y of the point of the table on the optical axis, in mm.
pub(super) fn axis_point_y_mm(view: &View) -> f64 {
    view.pose().camera_height_mm() / view.pose().pitch_rad().tan()
}

/// The ends of a line of a given length along X, on the plane Z = `z_mm`, around a centre.
pub(super) fn span_line(
    view: &View,
    (object, quantity): (&str, Quantity),
    center_mm: Point3<f64>,
    length_mm: f64,
) -> Result<LabeledLine, ViewError> {
    let end = |side: f64| view.pixel_of(Point3::new(center_mm.x + side * 0.5 * length_mm, center_mm.y, center_mm.z));
    Ok(LabeledLine { object: object.to_owned(), quantity, ends_px: [end(-1.0)?, end(1.0)?] })
}

/// The ends of the line from a wall's foot on the table to a point of the rim that Eq. (14) makes `height_mm` high: the point is
/// seen on Z = 0 at H' = H / tan w behind the foot. In X it stays above the foot.
pub(super) fn height_line(
    view: &View,
    object: &str,
    foot_mm: Point2<f64>,
    height_mm: f64,
) -> Result<LabeledLine, ViewError> {
    let camera_height_mm = view.pose().camera_height_mm();
    let rim_on_table_mm = Point3::new(
        foot_mm.x * camera_height_mm / (camera_height_mm - height_mm),
        foot_mm.y + projected_height_mm(view, height_mm),
        0.0,
    );
    let ends_px = [view.pixel_of(Point3::new(foot_mm.x, foot_mm.y, 0.0))?, view.pixel_of(rim_on_table_mm)?];
    Ok(LabeledLine { object: object.to_owned(), quantity: Quantity::Height, ends_px })
}

/// H' of Eq. (14).
fn projected_height_mm(view: &View, height_mm: f64) -> f64 {
    height_mm / view.pose().pitch_rad().tan()
}

/// A bowl that stands so that its drawn far inner wall agrees with its marks, and the Y of the foot of its far wall.
///
/// Eq. (14) uses the depression of the axis for every ray, so the inset of a wall (rim radius - foot radius) and its place
/// determine each other: with the foot at Y = f, the point of the rim at H is at (f + H') (c - H) / c, and the inset is the
/// excess of that over f. An inset s puts the foot s c/H + H' nearer than the axis point. A third of the radius is wanted, but
/// with a low wall the bowl would then stand out of the picture, so the inset shrinks until the near rim is inside.
pub(super) fn standing_bowl(
    view: &View,
    center_x_mm: f64,
    height_mm: f64,
    diameter_mm: f64,
) -> Result<(Bowl, f64), ViewError> {
    let camera_height_mm = view.pose().camera_height_mm();
    let radius_mm = 0.5 * diameter_mm;
    let lowest_row = f64::from(view.camera().size_px()[1]) - BORDER_PX;
    let mut inset_mm = radius_mm / 3.0;
    loop {
        let nearer_mm = inset_mm * camera_height_mm / height_mm + projected_height_mm(view, height_mm);
        let foot_y_mm = axis_point_y_mm(view) - nearer_mm;
        let center_mm = Point2::new(center_x_mm, foot_y_mm + inset_mm - radius_mm);
        let bowl = Bowl { center_mm, foot_radius_mm: radius_mm - inset_mm, rim_radius_mm: radius_mm, height_mm };
        let near_rim = Point3::new(center_mm.x, center_mm.y - radius_mm, height_mm);
        // A point that the lens does not show at all is outside the picture as well.
        let inside = view.pixel_of(near_rim).is_ok_and(|pixel| pixel.y < lowest_row);
        if inside || inset_mm < 0.01 {
            return Ok((bowl, foot_y_mm));
        }
        inset_mm *= 0.9;
    }
}
