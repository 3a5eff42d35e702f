//! The marks and the view behind the sizes of each picture, for commands that show pictures. They are kept with the sizes,
//! so that they fit them whatever becomes of marks and settings. Marks are given as they lie in the recorded picture.

use std::collections::BTreeMap;

use model::{Camera, CameraSpec, Feature, Mark, Method, Pose, Quantity, View};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};

use super::marked::Marked;
use crate::calibration::corrected_view;

/// The pictures of a session in which something was measured.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Shown {
    /// The camera of the recorded pictures after calibration; none where nothing is shown.
    pub camera: Option<CameraSpec>,
    /// The pictures by image (file on the card).
    pub images: BTreeMap<String, ShownImage>,
}

/// A picture in which something was measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct ShownImage {
    pitch_rad: f64,
    roll_rad: f64,
    range_mm: f64,
    /// The objects that were marked in it.
    pub objects: Vec<ShownObject>,
}

/// The marks of one rater on one object in one picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct ShownObject {
    pub object: String,
    pub rater: String,
    pub marks: Vec<ShownMark>,
}

/// A marked line or curve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct ShownMark {
    /// The quantity that the length of a line is; none for a curve.
    pub quantity: Option<Quantity>,
    /// The feature that a curve follows, or on which the ends of a line lie (for a height, its first end).
    pub feature: Feature,
    /// Whether the last point is joined to the first.
    pub closed: bool,
    /// The points, in pixels of the recorded picture.
    pub points_px: Vec<[f64; 2]>,
}

/// A curve is shown by at most this many points; the chords between them are nowhere far from it.
const MOST_POINTS: usize = 72;
/// Where something hides a found rim, its points are more than this many median gaps apart.
const HIDDEN: f64 = 4.0;

impl Shown {
    /// The marked pictures of a session; `camera` is that of the recorded pictures.
    pub(super) fn from_marked(camera: &Camera, marked: &[Marked<'_>]) -> Self {
        let mut shown = Self::default();
        for marked in marked {
            let Some(view) = view_of(camera, marked) else { continue };
            shown.camera.get_or_insert_with(|| CameraSpec::from_camera("recorded", view.camera()));
            let marks_camera = &marked.session.marks_camera;
            let marks = marked.marks.marks.iter().filter_map(|mark| {
                ShownMark::from_mark(mark, marked.found.is_some(), |point| recorded(camera, marks_camera, point))
            });
            let object = ShownObject {
                object: marked.marks.object.clone(),
                rater: marked.rater.to_owned(),
                marks: marks.collect(),
            };
            let pose = view.pose();
            let image = shown.images.entry(marked.frame.image.file.clone()).or_insert_with(|| ShownImage {
                pitch_rad: pose.pitch_rad(),
                roll_rad: pose.roll_rad(),
                range_mm: pose.range_mm(),
                objects: Vec::new(),
            });
            image.objects.push(object);
        }
        shown
    }

    /// The view with which method `ray` measured a picture, for the recorded picture.
    pub fn view(&self, image: &ShownImage) -> Option<View> {
        let camera = self.camera.as_ref()?.camera().ok()?;
        Some(View::new(camera, Pose::new(image.pitch_rad, image.roll_rad, image.range_mm).ok()?))
    }
}

fn view_of(camera: &Camera, marked: &Marked<'_>) -> Option<View> {
    let view = View::new(*camera, marked.frame.signals.pose_for(Method::Ray)?);
    corrected_view(marked.session.study.calibration.as_ref(), Method::Ray, view)
}

/// The point of the recorded picture that shows the same as a point of the marked one.
fn recorded(camera: &Camera, marks_camera: &Camera, point: Point2<f64>) -> Option<Point2<f64>> {
    if camera == marks_camera { Some(point) } else { camera.pixel_of(&marks_camera.ray_through(point).ok()?).ok() }
}

impl ShownMark {
    /// The mark in the recorded picture; none where that picture does not show it.
    fn from_mark(mark: &Mark, is_found: bool, recorded: impl Fn(Point2<f64>) -> Option<Point2<f64>>) -> Option<Self> {
        let points = mark.points_px();
        let kept = points.iter().step_by(points.len().div_ceil(MOST_POINTS).max(1));
        let tenths = |point: Point2<f64>| [point.x, point.y].map(|c| (c * 10.0).round() / 10.0);
        let mut points_px = kept.map(|point| recorded(*point).map(tenths)).collect::<Option<Vec<_>>>()?;
        let (quantity, feature, closed) = match mark {
            Mark::Line { quantity: Quantity::Height, .. } => (Some(Quantity::Height), Feature::Base, false),
            Mark::Line { quantity, .. } => (Some(*quantity), Feature::Rim, false),
            Mark::Outline { feature, .. } => (None, *feature, !is_found || is_whole(&mut points_px)),
        };
        Some(Self { quantity, feature, closed, points_px })
    }
}

/// Whether the points of a found rim go all the way round. Where they do not, they are turned so as to begin after the
/// widest gap.
fn is_whole(points_px: &mut [[f64; 2]]) -> bool {
    let count = points_px.len();
    let gap = |i: usize| -> f64 {
        let ([x, y], [next_x, next_y]) = (points_px[i], points_px[(i + 1) % count]);
        (next_x - x).hypot(next_y - y)
    };
    let mut gaps: Vec<(f64, usize)> = (0..count).map(|i| (gap(i), i)).collect();
    gaps.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (Some(&(widest, at)), Some(&(median, _))) = (gaps.last(), gaps.get(count / 2)) else { return true };
    if widest <= HIDDEN * median {
        return true;
    }
    points_px.rotate_left((at + 1) % count);
    false
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    fn ring(from: u32, to: u32) -> Vec<Point2<f64>> {
        let sin_cos = |i: u32| f64::from(i).to_radians().sin_cos();
        (from..to).map(|i| Point2::new(300.0 + 200.0 * sin_cos(i).1, 250.0 + 100.0 * sin_cos(i).0)).collect()
    }

    fn shown(points_px: Vec<Point2<f64>>, is_found: bool) -> ShownMark {
        ShownMark::from_mark(&Mark::Outline { feature: Feature::Rim, points_px }, is_found, Some).unwrap()
    }

    #[test]
    fn curves_are_thinned_and_stay_where_they_are() {
        let mark = shown(ring(0, 360), true);
        assert_eq!((mark.points_px.len(), mark.closed), (72, true));
        let off = |[x, y]: [f64; 2]| (((x - 300.0) / 200.0).hypot((y - 250.0) / 100.0) - 1.0).abs();
        assert!(mark.points_px.into_iter().all(|point| off(point) < 0.001));
    }

    #[test]
    fn no_chord_runs_over_what_hides_a_rim() {
        let mut points = ring(90, 360);
        points.extend(ring(0, 30)); // 30 to 90 degrees are hidden
        let mark = shown(points.clone(), true);
        assert!(!mark.closed);
        let [x, y] = mark.points_px[0];
        assert!((x - 300.0).hypot(y - 350.0) < 0.1, "it begins after the gap: {x} {y}");
        assert!(shown(points, false).closed, "a person's polygon is closed as it was drawn");
    }

    #[test]
    fn what_the_recorded_picture_does_not_show_is_left_out() {
        let line = Mark::Line { quantity: Quantity::Diameter, ends_px: [Point2::new(1.0, 2.0), Point2::new(3.0, 4.0)] };
        assert!(ShownMark::from_mark(&line, false, |point| (point.x < 2.0).then_some(point)).is_none());
        let mark = ShownMark::from_mark(&line, false, Some).unwrap();
        assert_eq!((mark.quantity, mark.closed), (Some(Quantity::Diameter), false));
    }
}
