//! Edges with sub-pixel places: where brightness or colour changes fastest along its gradient.

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
        let mut found = Self { x: empty(), y: empty(), size: empty() };
        for plane in &scaled.planes {
            let smooth = smoothed(plane, width);
            for y in 1..height - 1 {
                let above = &smooth[(y - 1) * width..y * width];
                let here = &smooth[y * width..(y + 1) * width];
                let below = &smooth[(y + 1) * width..(y + 2) * width];
                let inner = y * width + 1..(y + 1) * width - 1;
                let out =
                    found.x[inner.clone()].iter_mut().zip(&mut found.y[inner.clone()]).zip(&mut found.size[inner]);
                let sides = here.windows(3).zip(above[1..].iter().zip(&below[1..]));
                for (((x, y), size), (beside, (above, below))) in out.zip(sides) {
                    let (gx, gy) = (0.5 * (beside[2] - beside[0]), 0.5 * (below - above));
                    let squared = gx * gx + gy * gy;
                    let larger = squared > *size;
                    *x = if larger { gx } else { *x };
                    *y = if larger { gy } else { *y };
                    *size = if larger { squared } else { *size };
                }
            }
        }
        for size in &mut found.size {
            *size = size.sqrt();
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

/// A plane smoothed by the binomial filter 1-4-6-4-1 (about a Gaussian of one pixel) along rows and columns. A border of two
/// pixels stays as it is.
fn smoothed(plane: &[f32], width: usize) -> Vec<f32> {
    let mut rows = plane.to_vec();
    for (row, out) in plane.chunks_exact(width).zip(rows.chunks_exact_mut(width)) {
        for (w, o) in row.windows(5).zip(&mut out[2..]) {
            *o = (w[0] + w[4] + 4.0 * (w[1] + w[3]) + 6.0 * w[2]) / 16.0;
        }
    }
    let mut both = rows.clone();
    let height = plane.len() / width;
    for y in 2..height - 2 {
        let line = |dy: usize| &rows[(y + dy - 2) * width..(y + dy - 1) * width];
        let (a, b, c, d, e) = (line(0), line(1), line(2), line(3), line(4));
        for (x, o) in both[y * width..(y + 1) * width].iter_mut().enumerate() {
            *o = (a[x] + e[x] + 4.0 * (b[x] + d[x]) + 6.0 * c[x]) / 16.0;
        }
    }
    both
}
