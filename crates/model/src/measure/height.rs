//! Heights of walls.

use nalgebra::{Point2, Vector2};

use super::MeasureError;
use crate::located::Located;
use crate::sensed::Sensed;
use crate::source::{PerSource, Source};
use crate::view::View;

/// The height of a wall by the paper's Eq. (14), H = tan(pitch) H', where H' is the length along Y, on Z = 0, from the wall's
/// foot to the rim above it. This takes the depression of the optical axis for that of every ray.
///
/// # Errors
/// [`MeasureError`] when an end has no place on the table, when the rim end lies nearer than the foot, or when the wall would
/// reach above the camera.
pub fn height_by_paper_mm(view: &View, foot_px: Point2<f64>, rim_px: Point2<f64>) -> Result<f64, MeasureError> {
    let (foot, rim) = (view.on_plane(foot_px, 0.0)?, view.on_plane(rim_px, 0.0)?);
    let projected_mm = rim.y - foot.y; // H'
    possible_height(view, view.pose().pitch_rad().tan() * projected_mm) // Eq. (14)
}

/// The height of a wall by the ray of its own rim point, which is exact for a vertical wall: H = c (1 - |foot| / |rim|), where
/// c is the height of the camera, and foot and rim are distances on Z = 0 from the point under the camera.
///
/// # Errors
/// As of [`height_by_paper_mm`].
pub fn height_by_ray_mm(view: &View, foot_px: Point2<f64>, rim_px: Point2<f64>) -> Result<f64, MeasureError> {
    let (foot, rim) = (view.on_plane(foot_px, 0.0)?, view.on_plane(rim_px, 0.0)?);
    possible_height(view, view.pose().camera_height_mm() * (1.0 - foot.coords.norm() / rim.coords.norm()))
}

/// `height_mm`, if it lies above the table and below the camera.
pub(crate) fn possible_height(view: &View, height_mm: f64) -> Result<f64, MeasureError> {
    let camera_height_mm = view.pose().camera_height_mm();
    if height_mm >= camera_height_mm {
        Err(MeasureError::RimAboveCamera { height_mm, camera_height_mm })
    } else if height_mm > 0.0 {
        Ok(height_mm)
    } else {
        Err(MeasureError::RimBelowFoot)
    }
}

/// The ends of a height line, each with the number of its point.
pub(crate) struct HeightLine {
    pub foot: (usize, Point2<f64>),
    pub rim: (usize, Point2<f64>),
}

impl HeightLine {
    /// The height of [`height_by_paper_mm`] with its derivatives.
    pub(super) fn by_paper(&self, view: &View, points: usize) -> Result<Sensed, MeasureError> {
        let height_mm = height_by_paper_mm(view, self.foot.1, self.rim.1)?;
        let (foot, rim) = (Located::on_plane(view, self.foot.1, 0.0)?, Located::on_plane(view, self.rim.1, 0.0)?);
        let (tan_pitch, along) = (view.pose().pitch_rad().tan(), Vector2::y());
        let ends = [(self.foot.0, &foot, along * -tan_pitch), (self.rim.0, &rim, along * tan_pitch)];
        let mut height = Sensed::of_places(height_mm, ends, &Sensed::exact(0.0, points));
        // d tan(pitch) = (1 + tan^2(pitch)) d pitch, and d pitch = cos(roll) d mount.
        let by_pitch = (1.0 + tan_pitch * tan_pitch) * (rim.point_mm.y - foot.point_mm.y);
        height.by_source[Source::Pitch.index()] += by_pitch;
        height.by_source[Source::Mount.index()] += by_pitch * view.pose().roll_rad().cos();
        Ok(height)
    }

    /// The height of [`height_by_ray_mm`] with its derivatives.
    pub(super) fn by_ray(&self, view: &View, points: usize) -> Result<Sensed, MeasureError> {
        let [foot, rim] = self.distances(view, points)?;
        height_from_distances(view, &foot, &rim)
    }

    /// The distances of foot and rim, on Z = 0, from the point under the camera, with their derivatives.
    pub(crate) fn distances(&self, view: &View, points: usize) -> Result<[Sensed; 2], MeasureError> {
        let distance = |(mark, pixel): (usize, Point2<f64>)| {
            let place = Located::on_plane(view, pixel, 0.0)?;
            let length_mm = place.point_mm.coords.norm();
            let along = place.point_mm.coords.try_normalize(0.0).unwrap_or_else(Vector2::zeros);
            Ok::<_, MeasureError>(Sensed::of_places(length_mm, [(mark, &place, along)], &Sensed::exact(0.0, points)))
        };
        Ok([distance(self.foot)?, distance(self.rim)?])
    }
}

/// Height lines on opposite sides of a wall that leans differ by up to this share of the larger height.
const LEANING: f64 = 0.5;

/// By how much, in mm, two heights of one wall may differ for how the wall leans. Lines at one place see the same side of it, and must
/// give the same height; those whose feet are as far apart as the wall is high may see opposite sides.
pub(super) fn leaning_mm(view: &View, lines: &[HeightLine], heights: &[Sensed], [a, b]: [usize; 2]) -> f64 {
    let foot = |i: usize| view.on_plane(lines[i].foot.1, 0.0);
    let (Ok(foot_a), Ok(foot_b)) = (foot(a), foot(b)) else { return 0.0 };
    LEANING * (foot_a - foot_b).norm().min(heights[a].value.max(heights[b].value))
}

/// The height H = c (1 - foot / rim) with its derivatives, from distances on Z = 0 from the point under the camera. About that
/// point the rim is seen on Z = 0 scaled by c / (c - H), where c is the height of the camera.
pub(super) fn height_from_distances(view: &View, foot: &Sensed, rim: &Sensed) -> Result<Sensed, MeasureError> {
    let above = camera_height(view, foot.points());
    let ratio = foot.value / rim.value;
    let height_mm = possible_height(view, above.value * (1.0 - ratio))?;
    let terms = [(1.0 - ratio, &above), (-above.value / rim.value, foot), (above.value * ratio / rim.value, rim)];
    Ok(Sensed::of_numbers(height_mm, terms, foot.points()))
}

/// The height of the camera above the table, c = range sin(pitch), with its derivatives.
pub(crate) fn camera_height(view: &View, points: usize) -> Sensed {
    let pose = view.pose();
    let by_pitch = pose.range_mm() * pose.pitch_rad().cos();
    let mut by_source = PerSource::zeros();
    by_source[Source::Pitch.index()] = by_pitch;
    by_source[Source::Mount.index()] = by_pitch * pose.roll_rad().cos();
    by_source[Source::RangeScale.index()] = pose.camera_height_mm();
    by_source[Source::RangeOffset.index()] = pose.pitch_rad().sin();
    Sensed::of_sources(pose.camera_height_mm(), by_source, points)
}
