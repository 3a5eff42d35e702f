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

/// Edges, and which one lies in which pixel.
pub(super) struct Edges {
    pub width: usize,
    pub height: usize,
    pub edges: Vec<Edge>,
    /// Index into `edges` per pixel; [`NONE`] where there is none.
    pub at: Vec<u32>,
}

/// No edge in this pixel.
pub(super) const NONE: u32 = u32::MAX;

/// An edge stands out by as many standard deviations of the gradient in the quiet parts of the picture.
const OUT_OF_NOISE: f32 = 3.0;
/// A quarter of a Rayleigh distribution lies below this multiple of its scale.
const RAYLEIGH_QUARTILE: f32 = 0.758_5;
/// Rounding to 8 bits alone leaves gradients of this size, in levels per pixel.
const ROUNDING: f32 = 0.35;

impl Edges {
    pub(super) fn of(scaled: &Scaled) -> Self {
        let (width, height) = (scaled.width, scaled.height);
        let mut found = Self { width, height, edges: Vec::new(), at: vec![NONE; width * height] };
        if width < 8 || height < 8 {
            return found;
        }
        let gradient = Gradient::of(scaled);
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
    fn of(scaled: &Scaled) -> Self {
        let (width, height) = (scaled.width, scaled.height);
        let empty = || vec![0.0_f32; width * height];
        let mut rows = empty();
        let smooth = [0, 1, 2].map(|plane: usize| {
            let mut both = empty();
            smooth(&scaled.planes[plane], width, &mut rows, &mut both);
            both
        });
        let mut found = Self { x: empty(), y: empty(), size: empty() };
        for y in 1..height - 1 {
            let line = y * width;
            // Four at a time; the last four may be in part the same as those before.
            for x in (1..width - LANES).step_by(LANES).chain([width - 1 - LANES]) {
                let at = line + x;
                let (mut gx, mut gy, mut size) = (f32x4::ZERO, f32x4::ZERO, f32x4::ZERO);
                for plane in &smooth {
                    let (beside, above, below) = (&plane[at - 1..], &plane[at - width..], &plane[at + width..]);
                    let (dx, dy) = (four(&beside[2..]) - four(beside), four(below) - four(above));
                    let squared = dx * dx + dy * dy;
                    let larger = squared.cmp_gt(size);
                    (gx, gy, size) = (larger.blend(dx, gx), larger.blend(dy, gy), larger.blend(squared, size));
                }
                let half = f32x4::HALF;
                set(&mut found.x[at..], gx * half);
                set(&mut found.y[at..], gy * half);
                set(&mut found.size[at..], size.sqrt() * half);
            }
        }
        found
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

fn four(numbers: &[f32]) -> f32x4 {
    f32x4::from(numbers.first_chunk().copied().unwrap_or_default())
}

fn set(numbers: &mut [f32], four: f32x4) {
    if let Some(chunk) = numbers.first_chunk_mut() {
        *chunk = four.to_array();
    }
}

/// A plane smoothed by the binomial filter 1-4-6-4-1 (about a Gaussian of one pixel) along rows, and then along columns too.
/// A border of two pixels stays as it is.
fn smooth(plane: &[f32], width: usize, rows: &mut [f32], both: &mut [f32]) {
    for (row, out) in plane.chunks_exact(width).zip(rows.chunks_exact_mut(width)) {
        for border in [0, 1, width - 2, width - 1] {
            out[border] = row[border];
        }
        for (w, o) in row.windows(5).zip(&mut out[2..]) {
            *o = (w[0] + w[4] + 4.0 * (w[1] + w[3]) + 6.0 * w[2]) * (1.0 / 16.0);
        }
    }
    let height = plane.len() / width;
    for border in [0, 1, height - 2, height - 1] {
        let line = border * width..(border + 1) * width;
        both[line.clone()].copy_from_slice(&rows[line]);
    }
    for y in 2..height - 2 {
        let line = |dy: usize| &rows[(y + dy - 2) * width..(y + dy - 1) * width];
        let (a, b, c, d, e) = (line(0), line(1), line(2), line(3), line(4));
        for (x, o) in both[y * width..(y + 1) * width].iter_mut().enumerate() {
            *o = (a[x] + e[x] + 4.0 * (b[x] + d[x]) + 6.0 * c[x]) * (1.0 / 16.0);
        }
    }
}
