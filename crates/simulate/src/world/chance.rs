//! Random numbers that depend on a seed or a place alone, so that every thread draws the same ones.

/// A number with the bits of `seed` mixed (`SplitMix64`, Steele et al. 2014).
pub(super) fn mixed(seed: u64) -> u64 {
    let z = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// A uniform number from 0 to 1.
#[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
pub(super) fn share(seed: u64) -> f64 {
    (mixed(seed) >> 11) as f64 / (1_u64 << 53) as f64
}

/// A standard normal number (Box and Muller 1958).
pub(super) fn normal(seed: u64) -> f64 {
    let radius = (-2.0 * (1.0 - share(seed)).ln()).sqrt();
    radius * (std::f64::consts::TAU * share(seed ^ 0x5DEE_CE66_D1CE_4E5B)).cos()
}

/// Smooth noise (value noise) from 0 to 1 with a period of about one unit.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "places on a table; far ones saturate")]
pub(super) fn noise(at: [f64; 2], seed: u64) -> f64 {
    let [x, y] = at.map(f64::floor);
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let (u, v) = (smooth(at[0] - x), smooth(at[1] - y));
    let corner = |dx: f64, dy: f64| {
        let lattice = ((x + dx) as i64 as u64).wrapping_mul(0x9E37_79B1) ^ ((y + dy) as i64 as u64).rotate_left(32);
        share(seed ^ mixed(lattice))
    };
    let near = corner(0.0, 0.0) * (1.0 - u) + corner(1.0, 0.0) * u;
    let far = corner(0.0, 1.0) * (1.0 - u) + corner(1.0, 1.0) * u;
    near * (1.0 - v) + far * v
}
