//! The table top: a grain of low contrast, like wood. It is smooth, so that pictures of it stay small.

use nalgebra::Point2;

use super::Colour;

/// The colour of the bare table at a point.
#[expect(clippy::cast_possible_truncation, reason = "a colour needs no more than 24 bits")]
pub(super) fn colour_at(point_mm: Point2<f64>) -> Colour {
    // Far away a pixel covers more than the grain, which is faded out so that it does not flicker.
    let fade = 1.0 / (1.0 + (point_mm.coords.norm() / 1500.0).powi(4));
    let warp = smooth_noise(point_mm.x / 300.0, point_mm.y / 90.0);
    let broad = smooth_noise(point_mm.x / 420.0 + 7.3, point_mm.y / 60.0 + 1.7);
    let rings = (point_mm.y / 34.0 + 2.5 * warp).sin();
    let tone = (fade * (9.0 * broad + 3.0 * rings)) as f32;
    [150.0 + tone, 111.0 + 0.85 * tone, 74.0 + 0.6 * tone]
}

/// Value noise from -1 to 1 with smooth derivatives and one cell per unit.
fn smooth_noise(x: f64, y: f64) -> f64 {
    let (cell_x, cell_y) = (x.floor(), y.floor());
    let (u, v) = (ease(x - cell_x), ease(y - cell_y));
    let row = |dy: f64| {
        let (left, right) = (lattice(cell_x, cell_y + dy), lattice(cell_x + 1.0, cell_y + dy));
        left + u * (right - left)
    };
    row(0.0) + v * (row(1.0) - row(0.0))
}

fn ease(t: f64) -> f64 {
    t * t * (3.0 - 2.0 * t)
}

/// The pseudo-random value from -1 to 1 of a lattice point, which is always the same.
#[expect(clippy::cast_possible_truncation, reason = "far cells may share a value")]
#[expect(clippy::cast_precision_loss, reason = "24 bits of a hash are exact")]
#[expect(clippy::cast_sign_loss, reason = "bits of a hash")]
fn lattice(x: f64, y: f64) -> f64 {
    let mut hash = (x as i64 as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (y as i64 as u64).rotate_left(32);
    hash = (hash ^ (hash >> 31)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    hash = (hash ^ (hash >> 29)).wrapping_mul(0x94D0_49BB_1331_11EB);
    (hash >> 40) as f64 / f64::from(1 << 23) - 1.0
}
