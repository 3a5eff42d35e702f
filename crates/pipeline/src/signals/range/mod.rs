//! Range at an image: robust over a short window.

use model::{UtcNs, median};

/// What the range sensor said around one image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Range {
    /// Median of the valid readings; none when there are too few.
    pub median_mm: Option<f64>,
    /// Their robust SD: 1.4826 times the median absolute deviation.
    pub spread_mm: Option<f64>,
    /// How many readings were valid.
    pub valid_samples: u32,
}

/// Codes of the VL53L0X for 'no target' (ST UM2039: out of range).
const NO_TARGET_MM: [f64; 2] = [8190.0, 8191.0];
/// Fewer valid readings than this in the window give no range.
const MIN_VALID: usize = 3;
/// Nor does a window in which fewer than one in this many readings are valid: a few echoes among 'no target' (a reading
/// is held over several records) are not the table.
const MIN_VALID_ONE_IN: usize = 3;

/// Median of the readings that are ranges: between the limits, and no code.
pub(super) fn of(samples: &[(UtcNs, f64)], min_mm: f64, max_mm: f64) -> Range {
    let is_range = |mm: &f64| *mm >= min_mm && *mm <= max_mm && !NO_TARGET_MM.contains(mm);
    let valid: Vec<f64> = samples.iter().map(|(_, mm)| *mm).filter(is_range).collect();
    let valid_samples = u32::try_from(valid.len()).unwrap_or(u32::MAX);
    if valid.len() < MIN_VALID || valid.len() * MIN_VALID_ONE_IN < samples.len() {
        return Range { median_mm: None, spread_mm: None, valid_samples };
    }
    let center_mm = median(valid.clone());
    let spread_mm = 1.4826 * median(valid.iter().map(|mm| (mm - center_mm).abs()).collect());
    Range { median_mm: Some(center_mm), spread_mm: Some(spread_mm), valid_samples }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_readings(readings: &[f64]) -> Range {
        let samples: Vec<_> = readings.iter().map(|mm| (UtcNs(0), *mm)).collect();
        of(&samples, 30.0, 2000.0)
    }

    #[test]
    fn codes_and_nonsense_are_refused() {
        let found = of_readings(&[8190.0, 580.0, 12.0, 581.0, 8191.0, 579.0, 2500.0, -1.0, f64::NAN]);
        assert_eq!(found.median_mm, Some(580.0));
        assert_eq!(found.valid_samples, 3);
    }

    #[test]
    fn a_hand_in_a_third_of_the_window_does_not_move_it() {
        let found = of_readings(&[580.0, 581.0, 300.0, 579.0, 310.0, 580.0, 580.0]);
        assert_eq!(found.median_mm, Some(580.0));
        assert!(found.spread_mm.expect("a spread") < 2.0);
    }

    #[test]
    fn a_code_is_refused_even_where_the_limits_would_allow_it() {
        let samples = [(UtcNs(0), 8190.0); 10];
        assert_eq!(of(&samples, 30.0, 9000.0).median_mm, None);
    }

    #[test]
    fn a_stray_echo_among_codes_is_no_range() {
        let mut readings = vec![8190.0; 120];
        readings.extend([123.0; 8]);
        assert_eq!(of_readings(&readings).median_mm, None);
        assert_eq!(of_readings(&readings).valid_samples, 8);
    }

    #[test]
    fn too_few_readings_give_none() {
        assert_eq!(of_readings(&[580.0, 581.0]).median_mm, None);
        assert_eq!(of_readings(&[580.0, 581.0]).valid_samples, 2);
    }
}
