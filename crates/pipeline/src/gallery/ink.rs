//! Draws lines and letters on a small picture.

use embedded_graphics::Drawable as _;
use embedded_graphics::mono_font::{MonoTextStyle, MonoTextStyleBuilder, ascii};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor as _};
use embedded_graphics::text::Text;
use ingest::Picture;

use crate::overlay::{Canvas, pixel};

/// The colours of the dashes, in turns: blue shows on white plates, yellow on dark tables.
const DASHES: [[u8; 3]; 2] = [[0, 90, 180], [250, 230, 60]];
const DASH_PX: usize = 4;
/// The share of the line's own colour, in per cent.
const WEIGHT: u32 = 60;

/// Draws a dashed line down the picture at `x`, through which the picture shows.
pub(super) fn dashed_vertical(picture: &mut Picture, x: f64) {
    for y in 0..picture.height_px as usize {
        blend(picture, whole(x), Some(y), y);
    }
}

/// Draws a dashed line across the picture at `y`.
pub(super) fn dashed_horizontal(picture: &mut Picture, y: f64) {
    for x in 0..picture.width_px as usize {
        blend(picture, Some(x), whole(y), x);
    }
}

/// Draws a line of text (ASCII) that begins at `place`, on its base line. What lies outside is cut off.
pub(super) fn letters(picture: &mut Picture, [x, y]: [f64; 2], text: &str) {
    let style: MonoTextStyle<'_, Rgb888> = MonoTextStyleBuilder::new()
        .font(&ascii::FONT_6X10)
        .text_color(Rgb888::WHITE)
        .background_color(Rgb888::BLACK)
        .build();
    let Ok(_) = Text::new(text, pixel([x, y].into()), style).draw(&mut Canvas(picture));
}

fn blend(picture: &mut Picture, x: Option<usize>, y: Option<usize>, along: usize) {
    let (Some(x), Some(y)) = (x, y) else { return };
    let (width, height) = (picture.width_px as usize, picture.height_px as usize);
    if x >= width || y >= height {
        return;
    }
    let colour = DASHES[along / DASH_PX % DASHES.len()];
    let start = 3 * (y * width + x);
    for (under, over) in picture.rgb[start..start + 3].iter_mut().zip(colour) {
        let mixed = (u32::from(*under) * (100 - WEIGHT) + u32::from(over) * WEIGHT) / 100;
        *under = u8::try_from(mixed).unwrap_or(u8::MAX);
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not negative, and saturating")]
fn whole(place: f64) -> Option<usize> {
    (place >= -0.5).then(|| place.round().max(0.0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_outside_is_cut_off() {
        let mut picture = Picture { width_px: 20, height_px: 10, rgb: vec![200; 600] };
        for place in [-3.0, 400.0, f64::NAN] {
            dashed_vertical(&mut picture, place);
            dashed_horizontal(&mut picture, place);
        }
        assert_eq!(picture.rgb, vec![200; 600]);
        dashed_vertical(&mut picture, 3.2);
        let changed: Vec<usize> = (0..200).filter(|at| picture.rgb[3 * at] != 200).map(|at| at % 20).collect();
        assert_eq!(changed, vec![3; 10]);
        letters(&mut picture, [15.0, 12.0], "outside");
        assert_eq!(picture.rgb.len(), 600);
    }
}
