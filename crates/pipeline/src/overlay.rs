//! Draws rims, axes and sizes on a picture, for people to look at.

use embedded_graphics::Drawable;
use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Dimensions as _, OriginDimensions, Point, Size};
use embedded_graphics::mono_font::{MonoTextStyle, MonoTextStyleBuilder, ascii};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::primitives::{Line, Primitive, PrimitiveStyle};
use embedded_graphics::text::Text;
use ingest::Picture;
use model::{Feature, Mark, ObjectMarks, Shape, View, fit_circle};
use nalgebra::{Point2, Point3, Vector2};

/// An object to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// The marks of the object.
    pub marks: ObjectMarks,
    /// The outline of the object, which is drawn through the points along its rim.
    pub shape: Shape,
    /// The height of its rim above the table, at which circles and rectangles are drawn.
    pub plane_z_mm: f64,
    /// The text beside it, line by line (ASCII).
    pub text: Vec<String>,
}

/// A line is one pixel wide for pictures of up to this many pixels across.
const LINE_SIDE_PX: u32 = 800;
/// The number of places along a drawn circle, and along a side.
const PLACES: u32 = 180;
const SIDE_PLACES: u32 = 24;
const RIM: Rgb888 = Rgb888::GREEN;
const AXES: Rgb888 = Rgb888::YELLOW;
const POINTS: Rgb888 = Rgb888::RED;

/// Draws objects on a picture taken from `view`. What lies outside it is cut off.
pub fn draw(picture: &mut Picture, view: &View, objects: &[Drawn]) {
    let side = picture.width_px.max(picture.height_px);
    let width = side.div_ceil(LINE_SIDE_PX);
    let mut canvas = Canvas(picture);
    for object in objects {
        let corner = draw_marks(&mut canvas, view, object, width);
        let font = if side > 3 * LINE_SIDE_PX / 2 { &ascii::FONT_10X20 } else { &ascii::FONT_6X12 };
        let style: MonoTextStyle<'_, Rgb888> =
            MonoTextStyleBuilder::new().font(font).text_color(Rgb888::WHITE).background_color(Rgb888::BLACK).build();
        if let Some(corner) = corner {
            let text = object.text.join("\n");
            let extent = Text::new(&text, corner, style).bounding_box();
            // The text is moved back where it would run over the right border or the bottom.
            let over =
                |end: Option<i32>, most: u32| end.map_or(0, |end| (end - i32::try_from(most).unwrap_or(end)).max(0));
            let end = extent.bottom_right();
            let back =
                Point::new(over(end.map(|e| e.x), canvas.0.width_px), over(end.map(|e| e.y), canvas.0.height_px));
            infallible(Text::new(&text, corner - back, style).draw(&mut canvas));
        }
    }
}

/// Draws the marks and the circles through them, and returns the place where text belongs.
fn draw_marks(canvas: &mut Canvas<'_>, view: &View, object: &Drawn, width: u32) -> Option<Point> {
    let mut corner = None;
    for mark in &object.marks.marks {
        match mark {
            Mark::Line { ends_px: [a, b], .. } => line(canvas, *a, *b, AXES, width),
            Mark::Outline { feature, points_px } => {
                let z_mm = if *feature == Feature::Rim { object.plane_z_mm } else { 0.0 };
                match points_px.as_slice() {
                    &[a, b, c, d] if object.shape != Shape::Circle => {
                        corners(canvas, view, [a, b, c, d], z_mm, width);
                    }
                    _ => circle(canvas, view, points_px, z_mm, width),
                }
                for p in points_px {
                    let step = Vector2::new(f64::from(width), 0.0);
                    line(canvas, p - step, p + step, POINTS, width);
                }
            }
        }
        for p in mark.points_px() {
            let p = pixel(*p);
            let best = corner.get_or_insert(p);
            // The right end, where text seldom hides the object itself.
            if p.x > best.x {
                *best = p;
            }
        }
    }
    corner
}

/// Draws the sides between corners on a plane, straight there, and the lines from side to side.
fn corners(canvas: &mut Canvas<'_>, view: &View, corners_px: [Point2<f64>; 4], z_mm: f64, width: u32) {
    let [Ok(a), Ok(b), Ok(c), Ok(d)] = corners_px.map(|p| view.on_plane(p, z_mm)) else { return };
    let mut straight = |from: Point2<f64>, to: Point2<f64>, colour: Rgb888| {
        let pixel_at = |i: u32| {
            let place = from + (to - from) * (f64::from(i) / f64::from(SIDE_PLACES));
            view.pixel_of(Point3::new(place.x, place.y, z_mm)).ok()
        };
        for i in 0..SIDE_PLACES {
            if let (Some(one), Some(other)) = (pixel_at(i), pixel_at(i + 1)) {
                line(canvas, one, other, colour, width);
            }
        }
    };
    for (from, to) in [(a, b), (b, c), (c, d), (d, a)] {
        straight(from, to, RIM);
    }
    for [from, to] in [[(a, b), (c, d)], [(b, c), (d, a)]] {
        straight(nalgebra::center(&from.0, &from.1), nalgebra::center(&to.0, &to.1), AXES);
    }
}

/// Draws the circle through points on a plane, with its axes along world X and Y.
fn circle(canvas: &mut Canvas<'_>, view: &View, points_px: &[Point2<f64>], z_mm: f64, width: u32) {
    let on_plane: Result<Vec<_>, _> = points_px.iter().map(|p| view.on_plane(*p, z_mm)).collect();
    let Some(fitted) = on_plane.ok().and_then(|points| fit_circle(&points, |_, _| 1.0).ok()) else { return };
    let pixel_at = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let (x, y) = (
            fitted.circle.center_mm.x + fitted.circle.radius_mm * cos,
            fitted.circle.center_mm.y + fitted.circle.radius_mm * sin,
        );
        view.pixel_of(Point3::new(x, y, z_mm)).ok()
    };
    let turn = |i: u32| f64::from(i) / f64::from(PLACES) * std::f64::consts::TAU;
    for i in 0..PLACES {
        if let (Some(a), Some(b)) = (pixel_at(turn(i)), pixel_at(turn(i + 1))) {
            line(canvas, a, b, RIM, width);
        }
    }
    for i in [0, PLACES / 4] {
        if let (Some(a), Some(b)) = (pixel_at(turn(i)), pixel_at(turn(i + PLACES / 2))) {
            line(canvas, a, b, AXES, width);
        }
    }
}

fn line(canvas: &mut Canvas<'_>, a: Point2<f64>, b: Point2<f64>, colour: Rgb888, width: u32) {
    let Some([a, b]) = clipped(a, b, [canvas.0.width_px, canvas.0.height_px].map(f64::from)) else { return };
    let style = PrimitiveStyle::with_stroke(colour, width);
    infallible(Line::new(pixel(a), pixel(b)).into_styled(style).draw(canvas));
}

/// The part of a line within a picture of this size (Liang and Barsky 1984); none where it misses it.
fn clipped(a: Point2<f64>, b: Point2<f64>, size: [f64; 2]) -> Option<[Point2<f64>; 2]> {
    let along = b - a;
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let (to_low, to_high) = (-a[axis] / along[axis], (size[axis] - a[axis]) / along[axis]);
        if along[axis].abs() > f64::MIN_POSITIVE {
            first = first.max(to_low.min(to_high));
            last = last.min(to_low.max(to_high));
        } else if !(0.0..=size[axis]).contains(&a[axis]) {
            return None;
        }
    }
    (first <= last).then(|| [a + along * first, a + along * last])
}

/// The pixel at a place in or near a picture.
#[expect(clippy::cast_possible_truncation, reason = "clamped")]
pub(crate) fn pixel(place: Point2<f64>) -> Point {
    let whole = |v: f64| v.clamp(-100.0, 1e5).round() as i32;
    Point::new(whole(place.x), whole(place.y))
}

fn infallible(drawn: Result<impl Sized, core::convert::Infallible>) {
    let Ok(_) = drawn;
}

/// A picture as something to draw on.
pub(crate) struct Canvas<'a>(pub &'a mut Picture);

impl OriginDimensions for Canvas<'_> {
    fn size(&self) -> Size {
        Size::new(self.0.width_px, self.0.height_px)
    }
}

impl DrawTarget for Canvas<'_> {
    type Color = Rgb888;
    type Error = core::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(&mut self, pixels: I) -> Result<(), Self::Error> {
        for Pixel(at, colour) in pixels {
            let (Ok(x), Ok(y)) = (usize::try_from(at.x), usize::try_from(at.y)) else { continue };
            if x < self.0.width_px as usize && y < self.0.height_px as usize {
                let start = 3 * (y * self.0.width_px as usize + x);
                self.0.rgb[start..start + 3].copy_from_slice(&[colour.r(), colour.g(), colour.b()]);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use model::{Camera, LensModel, Pose};

    use super::*;

    fn view() -> View {
        let camera = Camera::new([320, 240], [250.0, 250.0], [160.0, 120.0], 0.0, LensModel::None).unwrap();
        View::new(camera, Pose::new(1.0, 0.0, 400.0).unwrap())
    }

    #[test]
    fn rims_axes_and_points_are_drawn_where_they_are_and_nothing_outside() {
        let view = view();
        let center = view.on_plane(Point2::new(160.0, 120.0), 0.0).unwrap();
        let on_rim = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            view.pixel_of(Point3::new(center.x + 60.0 * cos, center.y + 60.0 * sin, 0.0)).unwrap()
        };
        let points_px: Vec<_> = (0..6).map(|i| on_rim(f64::from(i))).collect();
        let marks = ObjectMarks {
            object: "o".to_owned(),
            marks: vec![Mark::Outline { feature: Feature::Rim, points_px: points_px.clone() }],
        };
        let mut picture = Picture { width_px: 320, height_px: 240, rgb: vec![7; 3 * 320 * 240] };
        draw(
            &mut picture,
            &view,
            &[Drawn { marks, shape: Shape::Circle, plane_z_mm: 0.0, text: vec!["o 1.0".to_owned()] }],
        );
        let colour = |place: Point2<f64>| {
            let at = pixel(place);
            let start = 3 * (at.y as usize * 320 + at.x as usize);
            [picture.rgb[start], picture.rgb[start + 1], picture.rgb[start + 2]]
        };
        assert_eq!(colour(points_px[2]), [255, 0, 0]);
        assert_eq!(colour(on_rim(3.5)), [0, 255, 0]);
        assert_eq!(colour(Point2::new(160.0, 120.0)), [255, 255, 0], "the axes meet in the centre");
        assert_eq!(colour(Point2::new(5.0, 5.0)), [7; 3]);
    }

    #[test]
    fn rectangles_are_drawn_along_their_sides_and_not_as_the_circle_through_their_corners() {
        let view = view();
        let center = view.on_plane(Point2::new(160.0, 120.0), 0.0).unwrap();
        let place = |x: f64, y: f64| view.pixel_of(Point3::new(center.x + x, center.y + y, 0.0)).unwrap();
        let points_px = vec![place(-60.0, -40.0), place(60.0, -40.0), place(60.0, 40.0), place(-60.0, 40.0)];
        let marks =
            ObjectMarks { object: "o".to_owned(), marks: vec![Mark::Outline { feature: Feature::Rim, points_px }] };
        let mut picture = Picture { width_px: 320, height_px: 240, rgb: vec![7; 3 * 320 * 240] };
        draw(&mut picture, &view, &[Drawn { marks, shape: Shape::Rectangle, plane_z_mm: 0.0, text: Vec::new() }]);
        let colour = |place: Point2<f64>| {
            let at = pixel(place);
            let start = 3 * (at.y as usize * 320 + at.x as usize);
            [picture.rgb[start], picture.rgb[start + 1], picture.rgb[start + 2]]
        };
        assert_eq!(colour(place(60.0, 20.0)), [0, 255, 0]);
        assert_eq!(colour(place(0.0, 0.0)), [255, 255, 0], "the axes meet in the middle");
        assert_eq!(colour(place(0.0, 72.0)), [7; 3], "no circle");
    }

    #[test]
    fn marks_far_outside_the_picture_do_no_harm() {
        let far = Point2::new(-1e12, 1e12);
        let line = Mark::Line { quantity: model::Quantity::Height, ends_px: [far, Point2::new(10.0, 10.0)] };
        let marks = ObjectMarks { object: "o".to_owned(), marks: vec![line] };
        let mut picture = Picture { width_px: 320, height_px: 240, rgb: vec![7; 3 * 320 * 240] };
        draw(
            &mut picture,
            &view(),
            &[Drawn { marks, shape: Shape::Circle, plane_z_mm: 0.0, text: vec!["too long for its place".repeat(9)] }],
        );
        assert_eq!(picture.rgb.len(), 3 * 320 * 240);
    }
}
