//! Marks, made small enough for a page that has thousands of them.

use std::fmt::Write as _;

use model::GalleryMark;
use serde::Serialize;

/// A point that is nearer than this to the line between its neighbours cannot be seen. In pixels of the picture as shown.
const UNSEEN_PX: f64 = 0.3;

/// A mark in the page's index.
#[derive(Debug, Clone, Serialize)]
pub(super) struct MarkEntry {
    object: String,
    rater: String,
    feature: &'static str,
    closed: bool,
    /// The points as the attribute `points` of an SVG polyline, in pixels, rounded to a tenth.
    points: String,
}

impl MarkEntry {
    pub(super) fn from_mark(mark: &GalleryMark) -> Self {
        let finite = |point: &&[f64; 2]| point.iter().all(|coordinate| coordinate.is_finite());
        let points: Vec<[f64; 2]> = mark.points_px.iter().filter(finite).copied().collect();
        Self {
            object: mark.object.clone(),
            rater: mark.rater.clone(),
            feature: mark.feature.code(),
            closed: mark.closed,
            points: attribute(&thinned(&points)),
        }
    }
}

fn attribute(points: &[[f64; 2]]) -> String {
    let mut text = String::new();
    for [x, y] in points {
        let space = if text.is_empty() { "" } else { " " };
        let _ = write!(text, "{space}{},{}", tenth(*x), tenth(*y));
    }
    text
}

fn tenth(coordinate: f64) -> f64 {
    let tenth = (coordinate * 10.0).round() / 10.0;
    if tenth == 0.0 { 0.0 } else { tenth }
}

/// The line without the points that cannot be seen (Douglas and Peucker, 1973). It has a stack of its own in place of
/// recursion.
fn thinned(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    if points.len() < 3 {
        return points.to_vec();
    }
    let mut kept = vec![false; points.len()];
    let last = points.len() - 1;
    (kept[0], kept[last]) = (true, true);
    let mut spans = vec![(0, last)];
    while let Some((from, to)) = spans.pop() {
        let far = |at: &usize| from_line(points[*at], points[from], points[to]);
        let Some(farthest) = (from + 1..to).max_by(|a, b| far(a).total_cmp(&far(b))) else { continue };
        if far(&farthest) > UNSEEN_PX {
            kept[farthest] = true;
            spans.extend([(from, farthest), (farthest, to)]);
        }
    }
    points.iter().zip(kept).filter(|(_, kept)| *kept).map(|(point, _)| *point).collect()
}

/// The distance of a point from the segment between two others.
fn from_line([x, y]: [f64; 2], [ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    let (dx, dy) = (bx - ax, by - ay);
    let squared = dx * dx + dy * dy;
    let along = if squared > 0.0 { (((x - ax) * dx + (y - ay) * dy) / squared).clamp(0.0, 1.0) } else { 0.0 };
    (x - ax - along * dx).hypot(y - ay - along * dy)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn a_rim_keeps_its_shape_and_loses_most_of_its_points() {
        let rim = |i: i32| {
            [300.0 + 200.0 * (TAU * f64::from(i) / 500.0).cos(), 200.0 + 90.0 * (TAU * f64::from(i) / 500.0).sin()]
        };
        let points: Vec<[f64; 2]> = (0..500).map(rim).collect();
        let thin = thinned(&points);
        assert!(thin.len() < 80, "{}", thin.len());
        for point in &points {
            let near = thin.windows(2).map(|ends| from_line(*point, ends[0], ends[1])).fold(f64::INFINITY, f64::min);
            assert!(near <= UNSEEN_PX, "{point:?} lies {near} px off");
        }
    }

    #[test]
    fn lines_and_points_stay() {
        assert_eq!(thinned(&[[0.0, 0.0], [5.0, 5.0]]).len(), 2);
        assert_eq!(thinned(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]).len(), 2);
        assert_eq!(thinned(&[[1.0, 1.0]; 4]).len(), 2);
        assert_eq!(attribute(&[[1.26, -0.04], [3.0, 4.449]]), "1.3,0 3,4.4");
    }
}
