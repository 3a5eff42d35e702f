//! The height of a rim above the table, and its source.

use serde::{Deserialize, Serialize};

/// The height of a rim above the table, in mm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RimHeight {
    /// The height.
    pub mm: f64,
    /// Its standard uncertainty.
    pub sigma_mm: f64,
    /// The source of it.
    pub source: HeightSource,
}

/// The source of a rim's height.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HeightSource {
    /// It was given.
    Given,
    /// The foot or the wall is seen below the rim, about the same axis.
    Foot,
    /// The floor or the well is seen within the rim, about the same axis.
    Floor,
    /// Several pictures of one table show it from places apart.
    Session,
    /// Neither is seen: the height is what is common, in proportion to the diameter, as far as what is hidden allows.
    Common,
}

/// Heights of a plate and of a bowl, of which only one is there: that of the likelier kind is less sure for what the other one
/// would make of it. `plate_log_odds`: natural logarithm of the odds of a plate against a bowl.
#[must_use]
pub fn as_judged(plate: RimHeight, bowl: RimHeight, plate_log_odds: f64) -> (RimHeight, RimHeight) {
    let is_other = 1.0 / (1.0 + plate_log_odds.abs().exp());
    if plate_log_odds >= 0.0 { (plate.unless(&bowl, is_other), bowl) } else { (plate, bowl.unless(&plate, is_other)) }
}

impl RimHeight {
    /// Returns this height with a larger uncertainty, for another one that is true with this probability.
    fn unless(self, other: &Self, probability: f64) -> Self {
        let apart = other.sigma_mm.hypot(other.mm - self.mm);
        let variance = (1.0 - probability) * self.sigma_mm.powi(2) + probability * apart.powi(2);
        Self { sigma_mm: variance.sqrt(), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::{HeightSource, RimHeight};

    #[test]
    fn a_doubtful_kind_makes_a_height_less_sure_and_no_other() {
        let plate = RimHeight { mm: 20.0, sigma_mm: 5.0, source: HeightSource::Floor };
        let bowl = RimHeight { mm: 80.0, sigma_mm: 15.0, source: HeightSource::Foot };
        assert_eq!(plate.unless(&bowl, 0.0), plate);
        let even = plate.unless(&bowl, 0.5);
        assert!((even.mm, even.source) == (plate.mm, plate.source));
        // By hand: half of 25 and half of 225 + 3600.
        assert!((even.sigma_mm - 1925_f64.sqrt()).abs() < 1e-9);
        assert!(plate.unless(&bowl, 0.1).sigma_mm < even.sigma_mm);
    }
}
