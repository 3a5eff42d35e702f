//! Textures of surfaces: colours as shares of red, green and blue light that they send back.

use nalgebra::Point3;

use super::Rgb;
use super::chance::{noise, share};

/// A pattern on a surface, in mm of the body's own frame (for a table, of the world frame).
#[derive(Debug, Clone, PartialEq)]
pub enum Texture {
    /// A single colour.
    Plain(Rgb),
    /// Boards along X with grain.
    Wood {
        /// The colours between the grain and in it.
        colours: [Rgb; 2],
        /// Width of a board.
        board_mm: f64,
        /// Seed of its random pattern.
        seed: u64,
    },
    /// A woven cloth with stripes along X, or along both axes.
    Cloth {
        /// The colours of the ground and of the stripes.
        colours: [Rgb; 2],
        /// Distance from one stripe to the next.
        stripe_mm: f64,
        /// Whether there are stripes along both axes (checks).
        checks: bool,
        /// Seed of its random pattern.
        seed: u64,
    },
    /// Stone or glazed clay with speckles.
    Speckled {
        /// The colours of the ground and of the speckles.
        colours: [Rgb; 2],
        /// Size of a speckle.
        grain_mm: f64,
        /// Share of the surface that speckles cover, about.
        share: f64,
        /// Seed of its random pattern.
        seed: u64,
    },
    /// Glazed ware with rings and motifs printed about its axis.
    Printed {
        /// The colours of the ground and of the print.
        colours: [Rgb; 2],
        /// Inner and outer radius of each ring, in mm.
        rings_mm: [[f64; 2]; 2],
        /// Number of motifs around the axis, their distance from it and radius in mm.
        motifs: (u32, f64, f64),
    },
    /// A lit screen with lines of text.
    Screen {
        /// Seed of its random text.
        seed: u64,
    },
    /// Food: patches of two colours.
    Food {
        /// The colours of the patches.
        colours: [Rgb; 2],
        /// Size of a patch.
        grain_mm: f64,
        /// Seed of its random pattern.
        seed: u64,
    },
}

impl Texture {
    /// The colour at a point.
    pub(super) fn colour_at(&self, p: Point3<f64>) -> Rgb {
        match *self {
            Self::Plain(colour) => colour,
            Self::Wood { colours, board_mm, seed } => wood(p, colours, board_mm, seed),
            Self::Cloth { colours, stripe_mm, checks, seed } => cloth(p, colours, stripe_mm, checks, seed),
            Self::Speckled { colours, grain_mm, share, seed } => {
                let spot = noise([p.x / grain_mm, p.y / grain_mm + 0.7 * p.z / grain_mm], seed);
                let drift = 0.06 * (noise([p.x / 60.0, p.y / 60.0], seed ^ 1) - 0.5);
                let ground = mix(colours[0], colours[1], step(1.0 - share, 0.06, spot));
                ground.map(|c| c * (1.0 + drift))
            }
            Self::Printed { colours, rings_mm, motifs } => printed(p, colours, rings_mm, motifs),
            Self::Screen { seed } => screen(p, seed),
            Self::Food { colours, grain_mm, seed } => {
                let at = [p.x / grain_mm, p.y / grain_mm];
                let patch = noise(at, seed) + 0.5 * noise(at.map(|c| 2.7 * c), seed ^ 3);
                mix(colours[0], colours[1], step(0.75, 0.35, patch))
            }
        }
    }
}

/// A mixture of two colours, with a share of `b` from 0 to 1.
pub(super) fn mix(a: Rgb, b: Rgb, share: f64) -> Rgb {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * share)
}

/// A smooth step from 0 to 1 at `edge`, within `width` of it.
fn step(edge: f64, width: f64, at: f64) -> f64 {
    let t = ((at - edge) / width + 0.5).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn wood(p: Point3<f64>, colours: [Rgb; 2], board_mm: f64, seed: u64) -> Rgb {
    let board = (p.y / board_mm).floor();
    let lot = seed.wrapping_add(board.to_bits());
    let along = p.x + 900.0 * share(lot);
    let bend = 9.0 * noise([along / 260.0, p.y / 35.0], lot);
    let growth = (p.y / 5.5 + bend + 0.5 * noise([along / 60.0, p.y / 4.0], lot ^ 5)).sin();
    let fibre = noise([along / 24.0, p.y / 0.9], lot ^ 9);
    let colour = mix(colours[0], colours[1], (0.42 + 0.3 * growth + 0.35 * (fibre - 0.5)).clamp(0.0, 1.0));
    let joint = (p.y - board * board_mm).min((board + 1.0) * board_mm - p.y);
    let dark = if joint < 0.8 { 0.45 } else { 0.9 + 0.2 * share(lot ^ 2) };
    colour.map(|c| c * dark)
}

fn cloth(p: Point3<f64>, colours: [Rgb; 2], stripe_mm: f64, checks: bool, seed: u64) -> Rgb {
    let stripe = |along: f64| {
        let at = (along / stripe_mm).rem_euclid(1.0);
        step(0.34, 0.02, at) - step(0.66, 0.02, at) + 0.6 * (step(0.8, 0.02, at) - step(0.84, 0.02, at))
    };
    let print = if checks { 0.5 * (stripe(p.x) + stripe(p.y)) } else { stripe(p.y) };
    let weave = 1.0 + 0.09 * (p.x * 4.4).sin() * (p.y * 4.4).sin() + 0.08 * (noise([p.x, p.y], seed) - 0.5);
    let fold = 1.0 + 0.1 * (noise([p.x / 140.0, p.y / 90.0], seed ^ 4) - 0.5);
    mix(colours[0], colours[1], print.clamp(0.0, 1.0)).map(|c| c * weave * fold)
}

fn printed(p: Point3<f64>, colours: [Rgb; 2], rings_mm: [[f64; 2]; 2], motifs: (u32, f64, f64)) -> Rgb {
    let radius = p.x.hypot(p.y);
    let is_ring = rings_mm.iter().any(|[from, to]| (*from..*to).contains(&radius));
    let (number, distance, size) = motifs;
    let turn = std::f64::consts::TAU / f64::from(number.max(1));
    let off = (p.y.atan2(p.x) / turn).rem_euclid(1.0) - 0.5;
    let is_motif =
        number > 0 && (off * turn * radius).hypot(1.4 * (radius - distance)) < size * (0.8 + 0.2 * (off * 40.0).cos());
    if is_ring || is_motif { colours[1] } else { colours[0] }
}

fn screen(p: Point3<f64>, seed: u64) -> Rgb {
    let line = (p.y / 6.0).floor();
    let lot = seed.wrapping_add(line.to_bits());
    let is_text = (p.y / 6.0 - line) < 0.5 && (-28.0..(50.0 * share(lot) - 22.0)).contains(&p.x);
    let is_word = share(lot ^ (p.x / 2.5).floor().to_bits()) < 0.8;
    if is_text && is_word { [0.1, 0.12, 0.2] } else { [0.75, 0.85, 0.95] }
}
