//! The range sensor's cone on a tilted table (docs/signals.md).
//!
//! The sensor does not measure along a ray: it averages over a cone 25 degrees wide. On a table seen at a slant, the near
//! side of the cone sends back more light from a shorter way, so the reading is shorter than the distance along the axis.

use std::f64::consts::FRAC_PI_2;

/// Half of the cone. VL53L0X data sheet: field of view 25 degrees.
const HALF_CONE_RAD: f64 = 12.5 * std::f64::consts::PI / 180.0;

/// The ratio of the reading to the distance along the axis, for a table at a depression of `pitch_rad` from the axis. None
/// where part of the cone misses the table.
///
/// It is assumed that the sensitivity is the same all over the cone and zero outside, that the table is matt (Lambert), and
/// that the reading is the mean distance, weighted by the light that comes back. A ray at depression e meets the table at r
/// = c / sin e, and of the light sent into the solid angle dO, sin(e) / r^2 comes back. With c = d sin pitch,
/// and g for the light that comes back:
///
/// k(pitch) = integral of r g dO / (d integral of g dO) = sin pitch I2 / I3, where In is the integral of sin^n e dO.
///
/// With sin e = cos a sin pitch + sin a cos f cos pitch, for a ray at angle a off the axis in the direction f, both integrals have
/// the closed form used here.
#[must_use]
pub(crate) fn reading_over_axis(pitch_rad: f64) -> Option<f64> {
    if !(pitch_rad > HALF_CONE_RAD && pitch_rad <= FRAC_PI_2 + 1e-9) {
        return None;
    }
    let (sin_pitch, cos_pitch) = pitch_rad.sin_cos();
    let (s, c) = HALF_CONE_RAD.sin_cos();
    let i2 = sin_pitch.powi(2) * (1.0 - c.powi(3)) / 3.0 + 0.5 * cos_pitch.powi(2) * (2.0 / 3.0 - c + c.powi(3) / 3.0);
    let i3 = sin_pitch.powi(3) * (1.0 - c.powi(4)) / 4.0 + 1.5 * sin_pitch * cos_pitch.powi(2) * s.powi(4) / 4.0;
    Some(sin_pitch * i2 / i3)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    /// The definition, summed over rays that are built as vectors: an independent way to the same number.
    fn by_rays(pitch_rad: f64) -> f64 {
        let n = 400;
        let down = nalgebra::Vector3::new(0.0, pitch_rad.cos(), pitch_rad.sin());
        let (mut weight, mut distance) = (0.0, 0.0);
        for i in 0..n {
            let off_axis = (f64::from(i) + 0.5) / f64::from(n) * HALF_CONE_RAD;
            for j in 0..n {
                let turn = (f64::from(j) + 0.5) / f64::from(n) * std::f64::consts::TAU;
                let ray =
                    nalgebra::Vector3::new(off_axis.sin() * turn.cos(), off_axis.sin() * turn.sin(), off_axis.cos());
                let r = pitch_rad.sin() / ray.dot(&down); // axis range 1
                let light = off_axis.sin() * ray.dot(&down) / (r * r);
                weight += light;
                distance += light * r;
            }
        }
        distance / weight
    }

    #[test]
    fn closed_form_is_the_sum_over_rays() {
        for pitch_deg in [15.0_f64, 25.0, 40.0, 55.0, 70.0, 90.0] {
            let (closed, summed) =
                (reading_over_axis(pitch_deg.to_radians()).unwrap(), by_rays(pitch_deg.to_radians()));
            assert!((closed - summed).abs() < 1e-5, "{pitch_deg}: {closed} {summed}");
        }
    }

    #[test]
    fn table_of_the_document() {
        let document = include_str!("../../../../../docs/signals.md");
        for pitch_deg in [25.0_f64, 40.0, 55.0, 70.0, 90.0] {
            let k = reading_over_axis(pitch_deg.to_radians()).unwrap();
            let row = format!("| {pitch_deg} | {k:.4} | {:+.2} |", 100.0 * (k - 1.0));
            assert!(document.contains(&row), "docs/signals.md lacks {row}");
        }
    }

    #[test]
    fn the_near_side_weighs_more_and_straight_down_it_does_not() {
        let k = |pitch_deg: f64| reading_over_axis(pitch_deg.to_radians()).unwrap();
        assert!(k(40.0) < k(55.0) && k(55.0) < k(70.0) && k(40.0) < 0.99);
        // Straight down all rays but the axis are longer: by half of the mean square angle, a quarter of the half cone's.
        assert!((k(90.0) - (1.0 + 0.25 * HALF_CONE_RAD.powi(2))).abs() < 2e-4);
    }

    #[test]
    fn a_cone_that_misses_the_table_has_no_correction() {
        assert_eq!(reading_over_axis(12.0_f64.to_radians()), None);
        assert_eq!(reading_over_axis(-0.5), None);
        assert_eq!(reading_over_axis(f64::NAN), None);
    }
}
