//! Priors of plates, bowls and cups, before a picture is looked at: their heights, feet and floors. The one source for round
//! and for rectangular ones.
//!
//! All numbers are estimates of our own; none is taken from a survey. Ratios have no unit; lengths are in mm.

/// A normal distribution.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Normal {
    pub mean: f64,
    pub sd: f64,
}

/// A distribution of which the logarithm is normal.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LogNormal {
    pub median: f64,
    /// Standard deviation of the natural logarithm.
    pub ln_sd: f64,
}

/// A share that goes from 0 to 1 with the diameter, by the logistic function.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ShareByDiameter {
    /// The diameter at which the share is one half, in mm.
    pub half_mm: f64,
    /// The share is 73 % at a diameter so much larger, in mm; negative where it falls with the diameter.
    pub step_mm: f64,
}

impl ShareByDiameter {
    /// The share at a diameter in mm, from 0 to 1.
    pub(crate) fn at_diameter(self, diameter_mm: f64) -> f64 {
        1.0 / (1.0 + ((self.half_mm - diameter_mm) / self.step_mm).exp())
    }
}

/// Values that are tried one after the other, each larger than the last by the same step. The last one is below `below`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Steps {
    pub first: f64,
    pub below: f64,
    pub step: f64,
}

impl Steps {
    /// The values, in rising order.
    pub(crate) fn values(self) -> impl Iterator<Item = f64> {
        std::iter::successors(Some(self.first), move |value| Some(value + self.step))
            .take_while(move |value| *value < self.below)
    }
}

/// Values that are tried one after the other, each larger than the last by the same ratio. The last one is below `below`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ratios {
    pub first: f64,
    pub below: f64,
    pub ratio: f64,
}

impl Ratios {
    /// The values, in rising order.
    pub(crate) fn values(self) -> impl Iterator<Item = f64> {
        std::iter::successors(Some(self.first), move |value| Some(value * self.ratio))
            .take_while(move |value| *value < self.below)
    }
}

/// A height of a floor above the table, and its share among containers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FloorLevel {
    pub height_mm: f64,
    pub share: f64,
}

/// Height over diameter of round plates. Flat ones have 0.07 to 0.1, deep ones up to 0.16.
pub(crate) const ROUND_PLATES: Normal = Normal { mean: 0.095, sd: 0.035 };
/// Height over side of square and rectangular plates, by the square root of their area. It was chosen apart from [`ROUND_PLATES`]: a
/// round plate of the same area is 13 % wider than this side.
pub(crate) const SQUARE_PLATES: Normal = Normal { mean: 0.1, sd: 0.035 };
/// Height over diameter of round bowls: between 0.25 and 0.6, with a longer tail upwards.
pub(crate) const ROUND_BOWLS: LogNormal = LogNormal { median: 0.4, ln_sd: 0.3 };
/// Height over side of square bowls and boxes, by the square root of their area. No more than a mean and a deviation is asked for,
/// since their walls are not looked at.
pub(crate) const SQUARE_BOWLS: Normal = Normal { mean: 0.38, sd: 0.12 };
/// Height of cups, mugs and glasses in mm: it hardly depends on their diameter.
pub(crate) const CUPS_MM: LogNormal = LogNormal { median: 98.0, ln_sd: 0.22 };
/// The share of cups among hollow containers: the wider, the fewer.
pub(crate) const CUPS_BY_DIAMETER: ShareByDiameter = ShareByDiameter { half_mm: 100.0, step_mm: -5.0 };
/// The share of plates among containers: the wider, the more.
pub(crate) const PLATES_BY_DIAMETER: ShareByDiameter = ShareByDiameter { half_mm: 175.0, step_mm: 14.0 };

/// Radius of the foot over that of the rim.
pub(crate) const FEET: Normal = Normal { mean: 0.6, sd: 0.17 };
/// Radius of the floor over that of the rim.
pub(crate) const FLOORS: Normal = Normal { mean: 0.56, sd: 0.1 };
/// Heights of a floor above the table: a foot ring and the thickness of the floor.
pub(crate) const FLOOR_LEVELS: [FloorLevel; 3] = [
    FloorLevel { height_mm: 4.0, share: 0.25 },
    FloorLevel { height_mm: 7.5, share: 0.5 },
    FloorLevel { height_mm: 11.0, share: 0.25 },
];

/// Heights over the diameter that are tried for a rim: from a flat plate to a tall glass.
pub(crate) const HEIGHTS_TRIED: Ratios = Ratios { first: 0.04, below: 2.2, ratio: 1.05 };
/// Radii of the foot over that of the rim that are tried.
pub(crate) const FEET_TRIED: Steps = Steps { first: 0.3, below: 1.04, step: 0.06 };
/// Radii of the floor over that of the rim that are tried.
pub(crate) const FLOORS_TRIED: Steps = Steps { first: 0.36, below: 0.8, step: 0.02 };

#[cfg(test)]
mod tests {
    use super::{CUPS_BY_DIAMETER, FLOOR_LEVELS, PLATES_BY_DIAMETER, Ratios, Steps};

    #[test]
    fn shares_are_half_where_they_say_and_go_the_way_they_should() {
        for share in [PLATES_BY_DIAMETER, CUPS_BY_DIAMETER] {
            assert!((share.at_diameter(share.half_mm) - 0.5).abs() < 1e-12);
            assert!((share.at_diameter(share.half_mm + share.step_mm) - 1.0 / (1.0 + (-1.0_f64).exp())).abs() < 1e-12);
        }
        assert!(PLATES_BY_DIAMETER.at_diameter(260.0) > 0.99 && CUPS_BY_DIAMETER.at_diameter(260.0) < 1e-6);
        assert!((FLOOR_LEVELS.iter().map(|level| level.share).sum::<f64>() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn values_rise_from_the_first_and_stay_below_the_limit() {
        let steps: Vec<f64> = Steps { first: 1.0, below: 2.0, step: 0.5 }.values().collect();
        assert!(steps == [1.0, 1.5]);
        let ratios: Vec<f64> = Ratios { first: 1.0, below: 8.0, ratio: 2.0 }.values().collect();
        assert!(ratios == [1.0, 2.0, 4.0]);
    }
}
