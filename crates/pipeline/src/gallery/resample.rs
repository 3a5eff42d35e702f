//! Makes pictures from pictures, pixel by pixel.

use ingest::Picture;
use model::View;
use nalgebra::Point2;

/// The longer side of the picture from which others are made. More would be lost again in those, and take time.
const SOURCE_SIDE_PX: u32 = 1600;
/// The colour of a place that no pixel of the source shows.
const NOTHING: [u8; 3] = [96, 96, 96];

/// The picture and its view, reduced; none where nothing is left of a side.
pub(super) fn source(picture: Picture, view: &View) -> Option<(Picture, View)> {
    let reduced = picture.reduced(SOURCE_SIDE_PX);
    let camera = view.camera().resampled([reduced.width_px, reduced.height_px]).ok()?;
    Some((reduced, View::new(camera, *view.pose())))
}

/// A picture whose pixel (x, y) shows what the source has at `at(x, y)`, bilinear between pixels.
pub(super) fn resample(source: &Picture, size_px: [u32; 2], at: impl Fn(f64, f64) -> Option<Point2<f64>>) -> Picture {
    let [width_px, height_px] = size_px;
    let mut rgb = Vec::with_capacity(3 * width_px as usize * height_px as usize);
    for y in 0..height_px {
        for x in 0..width_px {
            let shown = at(f64::from(x), f64::from(y)).and_then(|place| sample(source, place));
            rgb.extend(shown.unwrap_or(NOTHING));
        }
    }
    Picture { width_px, height_px, rgb }
}

/// The colour at a place, bilinear; none outside the picture, beyond half a pixel from the centres of its outermost pixels.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the picture, and 0 to 255")]
fn sample(source: &Picture, place: Point2<f64>) -> Option<[u8; 3]> {
    let last = [source.width_px, source.height_px].map(|side| f64::from(side) - 1.0);
    if !(-0.5..=last[0] + 0.5).contains(&place.x) || !(-0.5..=last[1] + 0.5).contains(&place.y) {
        return None;
    }
    let (x, y) = (place.x.clamp(0.0, last[0]), place.y.clamp(0.0, last[1]));
    let (left, top) = (x.floor(), y.floor());
    let (to_right, to_bottom) = (x - left, y - top);
    let columns = [left as usize, (left + 1.0).min(last[0]) as usize];
    let rows = [top as usize, (top + 1.0).min(last[1]) as usize];
    let pixel = |row: usize, column: usize, channel: usize| -> f64 {
        source.rgb.get(3 * (row * source.width_px as usize + column) + channel).copied().unwrap_or_default().into()
    };
    Some([0, 1, 2].map(|channel| {
        let along = |row: usize| {
            pixel(row, columns[0], channel) * (1.0 - to_right) + pixel(row, columns[1], channel) * to_right
        };
        (along(rows[0]) * (1.0 - to_bottom) + along(rows[1]) * to_bottom).round() as u8
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_pixels_is_between_their_values_and_outside_is_nothing() {
        let source =
            Picture { width_px: 2, height_px: 2, rgb: [0, 100, 200, 40].into_iter().flat_map(|g| [g; 3]).collect() };
        assert_eq!(sample(&source, Point2::new(0.0, 1.0)), Some([200; 3]));
        assert_eq!(sample(&source, Point2::new(0.5, 0.0)), Some([50; 3]));
        assert_eq!(sample(&source, Point2::new(0.5, 0.5)), Some([85; 3]));
        assert_eq!(sample(&source, Point2::new(1.4, 1.4)), Some([40; 3]));
        assert_eq!(sample(&source, Point2::new(1.6, 0.0)), None);
        assert_eq!(sample(&source, Point2::new(f64::NAN, 0.0)), None);
        let twice = resample(&source, [4, 1], |x, y| Some(Point2::new(x - 1.0, y)));
        assert_eq!(twice.rgb.chunks(3).map(|p| p[0]).collect::<Vec<_>>(), [96, 0, 100, 96]);
    }
}
