//! Plate or bowl, by a height that is known.

use crate::priors::{CUPS_BY_DIAMETER, CUPS_MM, PLATES_BY_DIAMETER, ROUND_BOWLS, ROUND_PLATES};
use crate::rim_height::RimHeight;

/// No rim is lower, in mm.
const LEAST_MM: f64 = 1.0;

/// Natural logarithm of the odds of a plate against a bowl or cup, by the height and the diameter of a rim (`priors.rs`).
#[must_use]
pub fn plate_log_odds(height: &RimHeight, diameter_mm: f64) -> f64 {
    let RimHeight { mm, sigma_mm, .. } = *height;
    let ln_density = |off: f64, sd: f64| -0.5 * (off / sd).powi(2) - sd.ln();
    let plate = ln_density(mm - ROUND_PLATES.mean * diameter_mm, (ROUND_PLATES.sd * diameter_mm).hypot(sigma_mm));
    let hollow = |median_mm: f64, ln_sd: f64| {
        // The density by the logarithm, over the height, becomes that by the height.
        let mm = mm.max(LEAST_MM);
        ln_density((mm / median_mm).ln(), ln_sd.hypot(sigma_mm / mm)) - mm.ln()
    };
    let bowl = hollow(ROUND_BOWLS.median * diameter_mm, ROUND_BOWLS.ln_sd);
    let cup = hollow(CUPS_MM.median, CUPS_MM.ln_sd);
    let cups = CUPS_BY_DIAMETER.at_diameter(diameter_mm);
    let hollow = ((1.0 - cups) * bowl.exp() + cups * cup.exp()).max(f64::MIN_POSITIVE).ln();
    let plates = PLATES_BY_DIAMETER.at_diameter(diameter_mm);
    plate - hollow + (plates / (1.0 - plates)).ln()
}

#[cfg(test)]
mod tests {
    use super::plate_log_odds;
    use crate::rim_height::{HeightSource, RimHeight};

    fn odds(mm: f64, sigma_mm: f64, diameter_mm: f64) -> f64 {
        plate_log_odds(&RimHeight { mm, sigma_mm, source: HeightSource::Session }, diameter_mm)
    }

    #[test]
    fn heights_tell_plates_from_bowls() {
        for (mm, diameter_mm) in [(18.0, 230.0), (26.0, 270.0), (33.0, 232.0), (16.0, 160.0)] {
            assert!(odds(mm, 4.0, diameter_mm) > 1.0, "a plate of {diameter_mm} mm: {}", odds(mm, 4.0, diameter_mm));
        }
        for (mm, diameter_mm) in [(60.0, 118.0), (56.0, 150.0), (80.0, 208.0), (45.0, 127.0), (95.0, 85.0)] {
            assert!(odds(mm, 6.0, diameter_mm) < -1.0, "a bowl of {diameter_mm} mm: {}", odds(mm, 6.0, diameter_mm));
        }
    }

    #[test]
    fn a_height_that_is_hardly_known_leaves_it_to_the_diameter() {
        assert!(odds(30.0, 80.0, 260.0) > 2.0 && odds(30.0, 80.0, 110.0) < 0.0);
        assert!(odds(0.0, 1.0, 200.0).is_finite() && odds(500.0, 1.0, 90.0).is_finite());
    }
}
