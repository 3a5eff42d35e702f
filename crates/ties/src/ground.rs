//! The table from above.

use ingest::Picture;
use model::View;
use nalgebra::{Point2, Point3};

/// The picture is reduced to about this longer side: on a table half a metre away, a pixel is then half a millimetre.
const SIDE_PX: u32 = 1296;
/// The part of the table that is looked at, from the point under the camera, in mm: left and right, near and far.
const SIDEWAYS_MM: f64 = 350.0;
const NEAR_MM: f64 = -100.0;
const FAR_MM: f64 = 600.0;
/// The places of the picture are worked out at points of the table this far apart, and between them by interpolation.
const STEP_MM: f64 = 10.0;
/// Where a pixel covers more of the table than this, there is nothing to be seen, in mm.
const COARSEST_MM: f64 = 3.5;

/// A part of the table that is left out: a circle on Z = 0, within which something stands up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// Its centre: world X and Y, in mm.
    pub center_mm: Point2<f64>,
    /// Its radius, in mm.
    pub radius_mm: f64,
}

/// Brightness of a picture at a reduced scale.
pub(crate) struct Luma {
    factor: usize,
    width: usize,
    height: usize,
    values: Vec<f32>,
}

impl Luma {
    /// Each value is the mean of a block of pixels.
    #[expect(clippy::cast_precision_loss, reason = "a sum of bytes over a few pixels")]
    pub fn from_picture(picture: &Picture) -> Self {
        let factor =
            (f64::from(picture.width_px.max(picture.height_px)) / f64::from(SIDE_PX)).round().max(1.0) as usize;
        let full_width = picture.width_px as usize;
        let (width, height) = (full_width / factor, picture.height_px as usize / factor);
        let mut values = vec![0.0; width * height];
        let scale = 1.0 / (4 * factor * factor) as f32;
        for (row, line) in values.chunks_exact_mut(width.max(1)).enumerate() {
            for y in row * factor..(row + 1) * factor {
                let bytes = &picture.rgb[3 * full_width * y..][..3 * full_width];
                for (value, block) in line.iter_mut().zip(bytes.chunks_exact(3 * factor)) {
                    let sum: u32 = block
                        .as_chunks::<3>()
                        .0
                        .iter()
                        .map(|[r, g, b]| u32::from(*r) + 2 * u32::from(*g) + u32::from(*b))
                        .sum();
                    *value += sum as f32 * scale;
                }
            }
        }
        Self { factor, width, height, values }
    }

    /// The brightness at a pixel of the full picture, between pixels by interpolation; none beyond the border.
    #[expect(clippy::cast_precision_loss, reason = "pictures are small")]
    #[expect(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "within the picture")]
    fn at(&self, pixel: Point2<f64>) -> Option<f32> {
        let place = |full: f64| (full + 0.5) / self.factor as f64 - 0.5;
        let (x, y) = (place(pixel.x), place(pixel.y));
        if !(x >= 0.0 && y >= 0.0 && x < (self.width - 1) as f64 && y < (self.height - 1) as f64) {
            return None;
        }
        let (column, row) = (x as usize, y as usize);
        let (u, v) = ((x - column as f64) as f32, (y - row as f64) as f32);
        let upper = &self.values[row * self.width + column..][..2];
        let lower = &self.values[(row + 1) * self.width + column..][..2];
        Some((upper[0] * (1.0 - u) + upper[1] * u) * (1.0 - v) + (lower[0] * (1.0 - u) + lower[1] * u) * v)
    }
}

/// The table from above, at one scale. Rows go from far to near, columns from left to right.
pub(crate) struct Ground {
    pub mm_per_px: f64,
    pub width: usize,
    pub height: usize,
    /// Brightness with its contrast made even, 0 to 255.
    pub luma: Vec<u8>,
    /// Sums of what is not seen, of everything above and left of a pixel; one more column and row than pixels.
    hidden: Vec<f64>,
    /// What is left out.
    left_out: Vec<Disc>,
}

impl Ground {
    /// The table as a view shows it, without what lies in `left_out`.
    pub fn new(luma: &Luma, grid: &Grid, left_out: &[Disc], mm_per_px: f64) -> Self {
        let [width, height] = [2.0 * SIDEWAYS_MM, FAR_MM - NEAR_MM].map(|side| count(side / mm_per_px));
        let mut ground =
            Self { mm_per_px, width, height, luma: Vec::new(), hidden: Vec::new(), left_out: left_out.to_vec() };
        let mut values = vec![f32::NAN; width * height];
        let mut is_hidden = vec![true; width * height];
        for row in 0..height {
            for column in 0..width {
                let at_mm = ground.place_mm([to_f64(column), to_f64(row)]);
                if let Some(value) = grid.pixel(at_mm).and_then(|pixel| luma.at(pixel)) {
                    values[row * width + column] = value;
                    is_hidden[row * width + column] = false;
                }
            }
        }
        ground.hidden = sums(is_hidden.iter().map(|hidden| f64::from(u8::from(*hidden))), width);
        ground.luma = evened(&values, width);
        ground
    }

    /// World X and Y, in mm, of a place of the raster.
    pub fn place_mm(&self, [column, row]: [f64; 2]) -> Point2<f64> {
        Point2::new(column * self.mm_per_px - SIDEWAYS_MM, FAR_MM - row * self.mm_per_px)
    }

    /// Whether a pixel is not left out and everything within `margin` pixels is seen.
    pub fn is_clear(&self, column: usize, row: usize, margin: usize) -> bool {
        let at_mm = self.place_mm([to_f64(column), to_f64(row)]);
        let is_in = |disc: &Disc| (at_mm - disc.center_mm).norm_squared() < disc.radius_mm * disc.radius_mm;
        if self.left_out.iter().any(is_in) {
            return false;
        }
        if column < margin || row < margin || column + margin >= self.width || row + margin >= self.height {
            return false;
        }
        let sides = [column - margin, row - margin, column + margin + 1, row + margin + 1];
        sum_within(&self.hidden, self.width, sides) < 0.5
    }
}

/// The pixels of the picture that show points of a grid on the table.
pub(crate) struct Grid {
    columns: usize,
    rows: usize,
    /// None where the table is not seen, or too coarsely.
    pixels: Vec<Option<Point2<f64>>>,
}

impl Grid {
    pub fn new(view: &View) -> Self {
        let [columns, rows] = [2.0 * SIDEWAYS_MM, FAR_MM - NEAR_MM].map(|side| count(side / STEP_MM) + 1);
        let place = |column: usize, row: usize| {
            Point3::new(to_f64(column) * STEP_MM - SIDEWAYS_MM, FAR_MM - to_f64(row) * STEP_MM, 0.0)
        };
        let seen = |point: Point3<f64>| view.pixel_of(point).ok().filter(|pixel| is_shown(view, point, *pixel));
        let pixels = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        Self { columns, rows, pixels: pixels.map(|(column, row)| seen(place(column, row))).collect() }
    }

    /// The pixel that shows a point of the table.
    #[expect(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "within the grid")]
    fn pixel(&self, at_mm: Point2<f64>) -> Option<Point2<f64>> {
        let (x, y) = ((at_mm.x + SIDEWAYS_MM) / STEP_MM, (FAR_MM - at_mm.y) / STEP_MM);
        let (column, row) = (x as usize, y as usize);
        if x < 0.0 || y < 0.0 || column + 1 >= self.columns || row + 1 >= self.rows {
            return None;
        }
        let (u, v) = (x - to_f64(column), y - to_f64(row));
        let at = |column: usize, row: usize| self.pixels[row * self.columns + column].map(|pixel| pixel.coords);
        let upper = at(column, row)? * (1.0 - u) + at(column + 1, row)? * u;
        let lower = at(column, row + 1)? * (1.0 - u) + at(column + 1, row + 1)? * u;
        Some(Point2::from(upper * (1.0 - v) + lower * v))
    }
}

/// Whether a point of the table lies before the camera and is seen finely enough.
fn is_shown(view: &View, point: Point3<f64>, pixel: Point2<f64>) -> bool {
    let beyond = Point3::new(point.x, point.y + STEP_MM, 0.0);
    let is_fine = view.pixel_of(beyond).is_ok_and(|next| (next - pixel).norm() * COARSEST_MM > STEP_MM);
    // A point behind the camera has a pixel as well.
    is_fine && view.on_plane(pixel, 0.0).is_ok_and(|back| (back - point.xy()).norm() < 1.0)
}

/// Brightness with the mean and the contrast of its surroundings made even, so that faint grain counts as much as print; 0 to 255, 128
/// where nothing is seen.
fn evened(values: &[f32], width: usize) -> Vec<u8> {
    let height = values.len() / width;
    let seen =
        |of: fn(f64) -> f64| values.iter().map(move |value| if value.is_nan() { 0.0 } else { of(f64::from(*value)) });
    let [count, sum, squares] = [sums(seen(|_| 1.0), width), sums(seen(|v| v), width), sums(seen(|v| v * v), width)];
    let mut bytes = vec![128; values.len()];
    for (i, value) in values.iter().enumerate().filter(|(_, value)| !value.is_nan()) {
        let (column, row) = (i % width, i / width);
        let (right, bottom) = ((column + AROUND_PX + 1).min(width), (row + AROUND_PX + 1).min(height));
        let sides = [column.saturating_sub(AROUND_PX), row.saturating_sub(AROUND_PX), right, bottom];
        let [count, sum, squares] = [&count, &sum, &squares].map(|sums| sum_within(sums, width, sides));
        let mean = sum / count;
        let contrast = (squares / count - mean * mean).max(0.0).sqrt().max(LEAST_CONTRAST);
        bytes[i] = to_byte((128.0 + EVEN_CONTRAST * (f64::from(*value) - mean) / contrast).clamp(0.0, 255.0));
    }
    bytes
}

/// The surroundings: so many pixels to each side.
const AROUND_PX: usize = 20;
/// The contrast (standard deviation) that they are brought to.
const EVEN_CONTRAST: f64 = 32.0;
/// Noise and compression make about as much contrast on a surface without any: it is not made larger than that of true grain.
const LEAST_CONTRAST: f64 = 8.0;

/// Sums of everything above and left of a pixel; one more column and row than pixels.
fn sums(values: impl Iterator<Item = f64>, width: usize) -> Vec<f64> {
    let mut sums = vec![0.0; width + 1];
    let mut of_row = 0.0;
    for (i, value) in values.enumerate() {
        if i % width == 0 {
            sums.push(0.0);
            of_row = 0.0;
        }
        of_row += value;
        sums.push(sums[sums.len() - width - 1] + of_row);
    }
    sums
}

/// The sum from a column and row up to others, which do not count.
fn sum_within(sums: &[f64], width: usize, [left, top, right, bottom]: [usize; 4]) -> f64 {
    let at = |x: usize, y: usize| sums[y * (width + 1) + x];
    at(right, bottom) + at(left, top) - at(left, bottom) - at(right, top)
}

#[expect(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "a positive number of some hundreds")]
fn count(number: f64) -> usize {
    number.round() as usize
}

#[expect(clippy::cast_precision_loss, reason = "some hundreds")]
fn to_f64(number: usize) -> f64 {
    number as f64
}

#[expect(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "brightness is 0 to 255")]
fn to_byte(value: f64) -> u8 {
    (value + 0.5) as u8
}
