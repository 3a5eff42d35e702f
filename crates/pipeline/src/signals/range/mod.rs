//! The range at an image, robust over a short window.

pub(super) mod cone;
mod held;
mod levels;
#[cfg(test)]
mod tests;

use model::{UtcNs, median};
use serde::{Deserialize, Serialize};

use super::settings::ReadingSettings;
use held::Reading;

/// The range readings around one image.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Range {
    /// The median of the valid readings, or of the level that most of them show if there are two. None when there are too
    /// few, or when neither level has a clear majority.
    pub median_mm: Option<f64>,
    /// Their robust SD: 1.4826 times the median absolute deviation.
    pub spread_mm: Option<f64>,
    /// The number of valid records.
    pub valid_samples: u32,
    /// The number of readings of the sensor behind them.
    pub distinct: u32,
    /// Whether there was one single value, held implausibly long.
    pub held: bool,
    /// Whether there were two distances.
    pub step: bool,
}

/// The codes of the VL53L0X for 'no target' (ST UM2039: out of range).
pub(crate) const NO_TARGET_MM: [f64; 2] = [8190.0, 8191.0];
/// Fewer valid readings than this in the window give no range.
const MIN_VALID: usize = 3;
/// Nor does a window in which fewer than one in this many readings are valid: a few echoes among 'no target' are not the
/// table.
const MIN_VALID_ONE_IN: usize = 3;
/// At least this many readings of one single value are a stuck sensor: the VL53L0X's noise is of the order of its resolution
/// or more (real log: SD 2.15 mm at 75 mm, where 25 equal readings in a row have a chance below 1e-17).
const HELD_READINGS: usize = 25;

/// The range by the readings between the limits that are no code.
pub(super) fn range_from(samples: &[(UtcNs, f64)], spec: &ReadingSettings) -> Range {
    let is_range = |mm: f64| mm >= spec.range_min_mm && mm <= spec.range_max_mm && !NO_TARGET_MM.contains(&mm);
    let valid_samples = count(samples.iter().filter(|(_, mm)| is_range(*mm)).count());
    let held = held::readings(samples, spec.range_update_s);
    let all: usize = held.iter().map(|reading| reading.count).sum();
    let valid: Vec<Reading> = held.into_iter().filter(|reading| is_range(reading.mm)).collect();
    let readings_mm: Vec<f64> = valid.iter().flat_map(|r| std::iter::repeat_n(r.mm, r.count)).collect();
    let distinct = count(readings_mm.len());
    if readings_mm.len() < MIN_VALID || readings_mm.len() * MIN_VALID_ONE_IN < all {
        return Range { median_mm: None, spread_mm: None, valid_samples, distinct, held: false, step: false };
    }
    let levels = levels::two_levels(&readings_mm);
    let step = levels.is_some();
    let used = match levels {
        Some(levels) => levels.clear_majority(),
        None => Some(readings_mm),
    };
    let center_mm = used.clone().map(median);
    let deviations = used.as_ref().zip(center_mm).map(|(used, c)| used.iter().map(|mm| (mm - c).abs()).collect());
    let spread_mm = deviations.map(|deviations| ROBUST_SD * median(deviations));
    let held = valid.len() == 1 && all == valid[0].count && all > HELD_READINGS;
    Range { median_mm: center_mm, spread_mm, valid_samples, distinct, held, step }
}

/// The robust SD of Gaussian noise, in median absolute deviations.
const ROBUST_SD: f64 = 1.4826;

fn count(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}
