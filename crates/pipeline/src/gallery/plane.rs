//! The picture projected on the table, with a grid in mm (Fig. 10 of the paper).

use ingest::Picture;
use model::View;
use nalgebra::{Point2, Point3, Vector2};

use super::carried_marks::{MarkedPicture, carried};
use super::ink::{dashed_horizontal, dashed_vertical, letters};
use super::resample::resample;
use super::small::SIDE_PX;
use crate::session::ShownImage;

/// The room around the marks, as a share of their extent, and at least in mm.
const MARGIN: f64 = 0.15;
const LEAST_MARGIN_MM: f64 = 40.0;
/// No table is larger; a mark near the horizon is further away than that.
const MOST_MM: f64 = 1500.0;
/// The distances between lines that are used, and the greatest number of lines.
const SPACINGS_MM: [f64; 6] = [10.0, 20.0, 50.0, 100.0, 200.0, 500.0];
const MOST_LINES: f64 = 11.0;

/// A level rectangle on the table, with the size of its picture.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sheet {
    /// World X of the left border, and Y of the upper border, which is further away.
    left_mm: f64,
    far_mm: f64,
    mm_per_px: f64,
    size_px: [u32; 2],
}

/// The projected picture with its marks; none where no mark lies on the table in front of the camera.
pub(super) fn project(source: &Picture, view: &View, shown: &ShownImage) -> Option<MarkedPicture> {
    let on_table = |[x, y]: [f64; 2]| view.on_plane(Point2::new(x, y), 0.0).ok();
    let marks = shown.objects.iter().flat_map(|object| &object.marks);
    let of_marks = marks.map(|mark| mark.points_px.iter().filter_map(|point| on_table(*point)).collect::<Vec<_>>());
    let sheet = Sheet::around(of_marks.flat_map(with_object))?;
    let mut picture = resample(source, sheet.size_px, |x, y| {
        let at_mm = sheet.at_mm(x, y);
        view.pixel_of(Point3::new(at_mm.x, at_mm.y, 0.0)).ok()
    });
    sheet.draw_grid(&mut picture);
    let marks = carried(shown, |point| on_table(point).map(|at_mm| sheet.pixel_of(at_mm)));
    Some(MarkedPicture { picture, marks })
}

/// The points of a mark; for a line also the circle whose diameter it is, since the object is as long as it is wide.
fn with_object(mut points_mm: Vec<Point2<f64>>) -> Vec<Point2<f64>> {
    if let &[a, b] = points_mm.as_slice() {
        let (center, radius) = (nalgebra::center(&a, &b), 0.5 * (b - a).norm());
        points_mm.extend(
            [[radius, 0.0], [-radius, 0.0], [0.0, radius], [0.0, -radius]].map(|to| center + Vector2::from(to)),
        );
    }
    points_mm
}

impl Sheet {
    fn around(points_mm: impl Iterator<Item = Point2<f64>>) -> Option<Self> {
        let (mut low, mut high) =
            (Point2::new(f64::INFINITY, f64::INFINITY), Point2::new(-f64::INFINITY, -f64::INFINITY));
        for point in points_mm {
            (low, high) = (low.inf(&point), high.sup(&point));
        }
        let extent = high - low;
        if !(extent.x.is_finite() && extent.y.is_finite()) {
            return None;
        }
        let margin = (MARGIN * extent.max().min(MOST_MM)).max(LEAST_MARGIN_MM);
        let sides_mm = extent.map(|side| (side + 2.0 * margin).min(MOST_MM));
        // What lies furthest away is cut off; to the sides, both are cut alike.
        let left_mm = 0.5 * (low.x + high.x) - 0.5 * sides_mm.x;
        let far_mm = low.y - margin + sides_mm.y;
        let mm_per_px = sides_mm.max() / f64::from(SIDE_PX);
        Some(Self { left_mm, far_mm, mm_per_px, size_px: [sides_mm.x, sides_mm.y].map(|mm| whole(mm / mm_per_px)) })
    }

    fn at_mm(&self, x: f64, y: f64) -> Point2<f64> {
        Point2::new(self.left_mm + (x + 0.5) * self.mm_per_px, self.far_mm - (y + 0.5) * self.mm_per_px)
    }

    fn pixel_of(&self, at_mm: Point2<f64>) -> [f64; 2] {
        [(at_mm.x - self.left_mm) / self.mm_per_px - 0.5, (self.far_mm - at_mm.y) / self.mm_per_px - 0.5]
    }

    fn spacing_mm(&self) -> f64 {
        let longest_mm = f64::from(self.size_px[0].max(self.size_px[1])) * self.mm_per_px;
        let wide_enough = |spacing: &f64| longest_mm / spacing <= MOST_LINES;
        SPACINGS_MM.into_iter().find(wide_enough).unwrap_or(SPACINGS_MM[SPACINGS_MM.len() - 1])
    }

    /// Draws lines at whole multiples of the spacing, labelled with their distance from the point under the camera: sideways
    /// along the lower border, ahead along the left one.
    fn draw_grid(&self, picture: &mut Picture) {
        let spacing_mm = self.spacing_mm();
        let [width, height] = self.size_px.map(f64::from);
        let near_mm = self.far_mm - height * self.mm_per_px;
        let right_mm = self.left_mm + width * self.mm_per_px;
        let columns = multiples(spacing_mm, self.left_mm, right_mm);
        let columns: Vec<_> = columns.map(|mm| (mm, self.pixel_of(Point2::new(mm, near_mm))[0])).collect();
        let rows = multiples(spacing_mm, near_mm, self.far_mm);
        let rows: Vec<_> = rows.map(|mm| (mm, self.pixel_of(Point2::new(self.left_mm, mm))[1])).collect();
        columns.iter().for_each(|(_, x)| dashed_vertical(picture, *x));
        rows.iter().for_each(|(_, y)| dashed_horizontal(picture, *y));
        columns.iter().for_each(|(mm, x)| letters(picture, [x + 2.0, height - 4.0], &format!("{mm:.0}")));
        rows.iter().for_each(|(mm, y)| letters(picture, [2.0, y - 3.0], &format!("{mm:.0}")));
        let title = format!("Z = 0, grid {spacing_mm:.0} mm; across: right of the camera, up: ahead of it, in mm");
        letters(picture, [2.0, 11.0], &title);
    }
}

/// The whole multiples of `step` between two numbers.
fn multiples(step: f64, from: f64, to: f64) -> impl Iterator<Item = f64> {
    let first = (from / step).ceil();
    (0..).map(move |i: u32| (first + f64::from(i)) * step).take_while(move |multiple| *multiple <= to)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a side of at most 640 pixels")]
fn whole(side: f64) -> u32 {
    side.round().clamp(1.0, f64::from(SIDE_PX)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(points: &[[f64; 2]]) -> Option<Sheet> {
        Sheet::around(points.iter().copied().map(Point2::from))
    }

    #[test]
    fn it_holds_what_was_marked_at_its_scale() {
        let drawn_on = sheet(&[[-50.0, 300.0], [150.0, 500.0]]).unwrap_or_else(|| panic!("a sheet"));
        assert_eq!(drawn_on.size_px, [640, 640]);
        assert!((drawn_on.mm_per_px - 280.0 / 640.0).abs() < 1e-12, "40 mm around it");
        let [a, b] = [[-50.0, 300.0], [150.0, 500.0]].map(|at| drawn_on.pixel_of(Point2::from(at)));
        assert!((b[0] - a[0] - 200.0 / drawn_on.mm_per_px).abs() < 1e-9 && b[1] < a[1], "further away is higher");
        let there = drawn_on.at_mm(a[0], a[1]);
        assert!((there - Point2::new(-50.0, 300.0)).norm() < 1e-9);
        assert!((drawn_on.spacing_mm() - 50.0).abs() < 1e-12);
    }

    #[test]
    fn a_diameter_stands_for_its_circle() {
        let line = with_object([[-100.0, 300.0], [100.0, 300.0]].map(Point2::from).to_vec());
        let drawn_on = Sheet::around(line.into_iter()).unwrap_or_else(|| panic!("a sheet"));
        assert_eq!(drawn_on.size_px, [640, 640]);
        let rim = [[-50.0, 300.0], [50.0, 300.0], [0.0, 350.0]].map(Point2::from).to_vec();
        assert_eq!(with_object(rim.clone()), rim);
    }

    #[test]
    fn a_mark_near_the_horizon_does_not_make_the_rest_tiny() {
        let drawn_on = sheet(&[[0.0, 300.0], [100.0, 400.0], [0.0, 90_000.0]]).unwrap_or_else(|| panic!("a sheet"));
        assert!(drawn_on.size_px == [235, 640] && drawn_on.mm_per_px < 2.4, "{drawn_on:?}");
        let [_, y] = drawn_on.pixel_of(Point2::new(0.0, 300.0));
        assert!((0.0..640.0).contains(&y), "what is near is in it");
        assert_eq!(sheet(&[]), None);
    }

    #[test]
    fn lines_are_at_whole_multiples() {
        assert_eq!(multiples(50.0, -60.0, 101.0).collect::<Vec<_>>(), [-50.0, 0.0, 50.0, 100.0]);
        assert_eq!(multiples(50.0, 60.0, 90.0).count(), 0);
    }
}
