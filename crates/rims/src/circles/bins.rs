//! A circle divided into bins by direction.

/// The number of bins that a circle is divided into, by direction.
pub(crate) const BINS: usize = 72;
/// Share of a bin's length that must be edges.
const BIN_SHARE: f32 = 0.4;

/// The bin of a direction, by two numbers in the proportion of its cosine and sine.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "bins")]
pub(crate) fn bin_of(cos: f32, sin: f32) -> usize {
    let turn = angle_of(cos, sin) * (1.0 / std::f32::consts::TAU);
    (((if turn < 0.0 { turn + 1.0 } else { turn }) * BINS as f32) as i32 as usize).min(BINS - 1)
}

/// The angle of a direction in radians, from minus half a turn to half a turn, to 0.0015 (a fiftieth of a bin): a polynomial
/// for the arc tangent up to an eighth of a turn (Rajan et al. 2006, IEEE Signal Processing Magazine 23(3), equation 9).
pub(crate) fn angle_of(cos: f32, sin: f32) -> f32 {
    let (c, s) = (cos.abs(), sin.abs());
    let (short, long) = if c < s { (c, s) } else { (s, c) };
    let ratio = short / long.max(f32::MIN_POSITIVE);
    let eighth = ratio * (std::f32::consts::FRAC_PI_4 + (1.0 - ratio) * (0.2447 + 0.0663 * ratio));
    let quarter = if c < s { std::f32::consts::FRAC_PI_2 - eighth } else { eighth };
    let half = if cos < 0.0 { std::f32::consts::PI - quarter } else { quarter };
    if sin < 0.0 { -half } else { half }
}

/// Length of edges that covers a bin of a circle.
#[expect(clippy::cast_precision_loss, reason = "bins")]
pub(crate) fn bin_length(radius: f32) -> f32 {
    BIN_SHARE * std::f32::consts::TAU * radius / BINS as f32
}

#[cfg(test)]
mod tests {
    use super::angle_of;

    #[test]
    fn angles_are_those_of_the_arc_tangent() {
        for i in -1800_i16..=1800 {
            let angle = f32::from(i) * 0.1_f32.to_radians();
            let off = angle_of(7.0 * angle.cos(), 7.0 * angle.sin()) - angle;
            let off = off.sin().abs().max(1.0 - off.cos()); // half a turn is minus half a turn
            assert!(off < 0.002, "{off} at {angle}");
        }
        assert!(angle_of(0.0, 0.0).is_finite());
    }
}
