//! A picture at the scale in which rims are looked for.

use ingest::Picture;

/// The search looks at pictures whose longer side has about as many pixels: a rim of a third of the picture is then some
/// 500 pixels long, and noise and fine texture are averaged away.
const SEARCH_SIDE_PX: u32 = 700;
/// A radian at the centre of the reduced picture has at least so many pixels: in the picture of a wide lens a plate is small.
const SEARCH_FOCAL_PX: f64 = 300.0;

/// Three planes of brightness (0-255), each pixel the mean of `factor` x `factor` pixels of the picture.
pub(crate) struct Scaled {
    pub factor: usize,
    pub width: usize,
    pub height: usize,
    /// Red, green, blue.
    pub planes: [Vec<f32>; 3],
}

impl Scaled {
    /// `focal_px` is the camera's, in pixels of the picture.
    pub(crate) fn from_picture(picture: &Picture, focal_px: f64) -> Self {
        let factor = factor(picture.width_px.max(picture.height_px), focal_px);
        let full_width = picture.width_px as usize;
        let (width, height) = (full_width / factor, picture.height_px as usize / factor);
        let mut planes = [(); 3].map(|()| vec![0.0_f32; width * height]);
        #[expect(clippy::cast_precision_loss, reason = "a few pixels")]
        let mean = 1.0 / (factor * factor) as f32;
        // Columns first: bytes added to sums side by side, which a processor does many at a time.
        let mut columns = vec![0_u16; 3 * full_width];
        let [red, green, blue] = &mut planes;
        let lines = red.chunks_exact_mut(width).zip(green.chunks_exact_mut(width)).zip(blue.chunks_exact_mut(width));
        for (rows, ((red, green), blue)) in picture.rgb.chunks_exact(3 * full_width * factor).zip(lines) {
            columns.fill(0);
            add_rows(&mut columns, rows);
            let means = red.iter_mut().zip(green.iter_mut()).zip(blue.iter_mut());
            for (block, ((red, green), blue)) in columns.chunks_exact(3 * factor).zip(means) {
                let mut sums = [0_u32; 3];
                for pixel in block.as_chunks::<3>().0 {
                    for (sum, column) in sums.iter_mut().zip(pixel) {
                        *sum += u32::from(*column);
                    }
                }
                #[expect(clippy::cast_precision_loss, reason = "a sum of a few bytes")]
                let [r, g, b] = sums.map(|sum| sum as f32 * mean);
                (*red, *green, *blue) = (r, g, b);
            }
        }
        Self { factor, width, height, planes }
    }

    /// Pixel of the full picture that lies under a place of this one.
    #[expect(clippy::cast_precision_loss, reason = "a small factor")]
    pub(crate) fn in_full(&self, place: f64) -> f64 {
        (place + 0.5) * self.factor as f64 - 0.5
    }
}

/// Adds each row to the sums: four at a time, which reads and writes the sums seldom.
fn add_rows(sums: &mut [u16], rows: &[u8]) {
    let width = sums.len();
    let mut fours = rows.chunks_exact(4 * width);
    for four in &mut fours {
        let ((a, b), (c, d)) = (four[..2 * width].split_at(width), four[2 * width..].split_at(width));
        for ((((sum, a), b), c), d) in sums.iter_mut().zip(a).zip(b).zip(c).zip(d) {
            *sum += u16::from(*a) + u16::from(*b) + u16::from(*c) + u16::from(*d);
        }
    }
    for row in fours.remainder().chunks_exact(width) {
        for (sum, byte) in sums.iter_mut().zip(row) {
            *sum += u16::from(*byte);
        }
    }
}

/// The number of pixels of the picture, each way, that make one pixel of the search.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
fn factor(longer_px: u32, focal_px: f64) -> usize {
    let by_side = (longer_px + SEARCH_SIDE_PX / 2) / SEARCH_SIDE_PX;
    let by_focal = (focal_px / SEARCH_FOCAL_PX) as u32;
    by_side.min(by_focal).max(1) as usize
}

#[cfg(test)]
mod tests {
    use super::factor;

    #[test]
    fn a_wide_lens_is_searched_at_a_finer_scale() {
        // AIM-2; a webcam; a phone; cameras of glasses with 98 and 120 degrees.
        let cases = [(2592, 1700.0, 4), (640, 600.0, 1), (4032, 3000.0, 6), (1408, 610.0, 2), (1000, 433.0, 1)];
        for (longer_px, focal_px, expected) in cases {
            assert_eq!(factor(longer_px, focal_px), expected, "{longer_px} px, {focal_px} px");
        }
    }
}
