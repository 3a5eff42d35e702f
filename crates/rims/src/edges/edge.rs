//! Edges with sub-pixel places: where brightness or colour changes fastest along its gradient.

use wide::{CmpGt, f32x4};

use super::scaled::Scaled;

/// One edge pixel, in pixels of the scaled picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub x: f32,
    pub y: f32,
    /// Gradient towards brighter, of the colour that changes most, in levels per pixel.
    pub gx: f32,
    pub gy: f32,
}

/// The edges of a picture, and the index of the edge in each pixel.
pub(super) struct Edges {
    pub width: usize,
    pub height: usize,
    pub edges: Vec<Edge>,
    /// Index into `edges` per pixel; [`NONE`] where there is none.
    pub at: Vec<u32>,
}

/// No edge in this pixel.
pub(super) const NONE: u32 = u32::MAX;

/// The gradient of an edge is at least so many standard deviations of the gradient in the quiet parts of the picture.
const OUT_OF_NOISE: f32 = 3.0;
/// A quarter of a Rayleigh distribution lies below this multiple of its scale.
const RAYLEIGH_QUARTILE: f32 = 0.758_5;
/// Rounding to 8 bits alone leaves gradients of this size, in levels per pixel.
const ROUNDING: f32 = 0.35;

impl Edges {
    pub(super) fn from_scaled(scaled: &Scaled) -> Self {
        let (width, height) = (scaled.width, scaled.height);
        let mut found = Self { width, height, edges: Vec::new(), at: vec![NONE; width * height] };
        if width < 8 || height < 8 {
            return found;
        }
        let gradient = Gradient::from_scaled(scaled);
        let least = OUT_OF_NOISE * gradient.noise().max(ROUNDING);
        for y in 3..height - 3 {
            for x in 3..width - 3 {
                let at = y * width + x;
                if gradient.size[at] > least
                    && let Some(edge) = gradient.crest(width, x, y)
                {
                    #[expect(clippy::cast_possible_truncation, reason = "fewer than the pixels of a scaled picture")]
                    let index = found.edges.len() as u32;
                    found.at[at] = index;
                    found.edges.push(edge);
                }
            }
        }
        found
    }
}

/// Gradient of the colour that changes most.
struct Gradient {
    x: Vec<f32>,
    y: Vec<f32>,
    size: Vec<f32>,
}

impl Gradient {
    fn from_scaled(scaled: &Scaled) -> Self {
        let (width, height) = (scaled.width, scaled.height);
        let empty = || vec![0.0_f32; width * height];
        let mut found = Self { x: empty(), y: empty(), size: empty() };
        let mut planes = [(); 3].map(|()| Smoothed::new(width));
        for y in 0..height + 2 {
            for (smoothed, plane) in planes.iter_mut().zip(&scaled.planes) {
                smoothed.take(plane, y, height);
            }
            // The row before the one that became smooth last has both neighbours.
            if y >= 4 {
                found.set_row(&planes, y - 3, width);
            }
        }
        found
    }

    /// The gradient of one row, of the plane that changes most at each place.
    fn set_row(&mut self, planes: &[Smoothed; 3], y: usize, width: usize) {
        let row = y * width..(y + 1) * width;
        let (gx, gy, sizes) = (&mut self.x[row.clone()], &mut self.y[row.clone()], &mut self.size[row]);
        let lines = planes.each_ref().map(|plane| [plane.line(y - 1), plane.line(y), plane.line(y + 1)]);
        // Four at a time; the last four may be in part the same as those before.
        for x in (1..width - LANES).step_by(LANES).chain([width - 1 - LANES]) {
            let (mut most_x, mut most_y, mut size) = (f32x4::ZERO, f32x4::ZERO, f32x4::ZERO);
            for [above, here, below] in lines {
                let (dx, dy) = (four(here, x + 1) - four(here, x - 1), four(below, x) - four(above, x));
                let squared = dx * dx + dy * dy;
                let larger = squared.cmp_gt(size);
                (most_x, most_y) = (larger.blend(dx, most_x), larger.blend(dy, most_y));
                size = larger.blend(squared, size);
            }
            set(gx, x, most_x * f32x4::HALF);
            set(gy, x, most_y * f32x4::HALF);
            set(sizes, x, size.sqrt() * f32x4::HALF);
        }
    }

    /// Standard deviation of a component where the picture is quiet: from the lower quartile of the sizes.
    fn noise(&self) -> f32 {
        let mut some: Vec<f32> = self.size.iter().step_by(7).copied().collect();
        let quarter = some.len() / 4;
        let (_, size, _) = some.select_nth_unstable_by(quarter, f32::total_cmp);
        *size / RAYLEIGH_QUARTILE
    }

    /// The edge in a pixel whose gradient is the largest along its own direction.
    fn crest(&self, width: usize, x: usize, y: usize) -> Option<Edge> {
        let at = y * width + x;
        let (gx, gy, size) = (self.x[at], self.y[at], self.size[at]);
        // Step to the neighbouring rows or columns along the gradient, between two pixels each time.
        let steep = gy.abs() > gx.abs();
        let slope = if steep { gx / gy } else { gy / gx };
        let (along, across) = if steep { (width, 1) } else { (1, width) };
        let toward = |base: usize, slope: f32| {
            let next = if slope >= 0.0 { base + across } else { base - across };
            self.size[base] + (self.size[next] - self.size[base]) * slope.abs()
        };
        let (after, before) = (toward(at + along, slope), toward(at - along, -slope));
        if !(size > before && size >= after) {
            return None;
        }
        let offset = 0.5 * (before - after) / (before - 2.0 * size + after);
        let (dx, dy) = if steep { (offset * slope, offset) } else { (offset, offset * slope) };
        #[expect(clippy::cast_precision_loss, reason = "pixels of a scaled picture")]
        Some(Edge { x: x as f32 + dx, y: y as f32 + dy, gx, gy })
    }
}

/// Numbers worked on together.
const LANES: usize = 4;

fn four(numbers: &[f32], at: usize) -> f32x4 {
    f32x4::from(numbers.get(at..).and_then(|some| some.first_chunk()).copied().unwrap_or_default())
}

fn set(numbers: &mut [f32], at: usize, four: f32x4) {
    if let Some(chunk) = numbers.get_mut(at..).and_then(|some| some.first_chunk_mut()) {
        *chunk = four.to_array();
    }
}

/// The last rows of a plane, smoothed by the binomial filter 1-4-6-4-1 (about a Gaussian of one pixel): no more than these are
/// asked for at a time, and so few stay near to the processor.
struct Smoothed {
    /// Smoothed along the row; by the row's number modulo five.
    rows: [Vec<f32>; 5],
    /// Smoothed along the columns too; modulo three.
    both: [Vec<f32>; 3],
}

impl Smoothed {
    fn new(width: usize) -> Self {
        Self { rows: [(); 5].map(|()| vec![0.0; width]), both: [(); 3].map(|()| vec![0.0; width]) }
    }

    /// Takes row `y`, if there is one: then the row two before it is smoothed. A border of two pixels stays as it is.
    fn take(&mut self, plane: &[f32], y: usize, height: usize) {
        if y < height {
            let out = &mut self.rows[y % 5];
            let width = out.len();
            let row = &plane[y * width..(y + 1) * width];
            for border in [0, 1, width - 2, width - 1] {
                out[border] = row[border];
            }
            for (w, o) in row.windows(5).zip(&mut out[2..]) {
                *o = (w[0] + w[4] + 4.0 * (w[1] + w[3]) + 6.0 * w[2]) * (1.0 / 16.0);
            }
        }
        let Some(middle) = y.checked_sub(2) else { return };
        let out = &mut self.both[middle % 3];
        let width = out.len();
        let row = |y: usize| &self.rows[y % 5][..width];
        if middle < 2 || middle + 2 >= height {
            out.copy_from_slice(row(middle));
            return;
        }
        let (a, b, c, d, e) = (row(middle - 2), row(middle - 1), row(middle), row(middle + 1), row(middle + 2));
        for (x, o) in out.iter_mut().enumerate() {
            *o = (a[x] + e[x] + 4.0 * (b[x] + d[x]) + 6.0 * c[x]) * (1.0 / 16.0);
        }
    }

    /// One of the last three smooth rows.
    fn line(&self, y: usize) -> &[f32] {
        &self.both[y % 3]
    }
}
