//! Accelerations that no sensor on a pair of glasses gives: fillers of loggers and damaged numbers.

/// The full scale of a sensor whose profile gives none, g: wearable accelerometers reach 2 to 16 g (data sheets of the ADXL362, LIS2DH12,
/// BMA400, ICM-20948).
const USUAL_FULL_SCALE_G: f64 = 16.0;
/// Readings may exceed the nominal full scale by this factor and, as the zero is taken off, by this offset (ADXL362: scale 10 %, offset
/// 250 mg).
const OVER_FULL_SCALE: f64 = 1.1;
const OFFSET_G: f64 = 0.3;
/// Counts that loggers write for 'no value', of any unit; the last two are what a 16-bit number holds at most.
const FILLERS: [f64; 6] = [999.0, 9999.0, 99_999.0, 999_999.0, 32_767.0, 32_768.0];
/// A filler that would be a smaller acceleration than this is taken for a reading: it hardly changes gravity, and a reading may have that
/// count.
const FILLER_FROM_G: f64 = 2.5;
/// A 16-bit number at its end is a filler from here on; below, it is a sensor of +-4 g that met a knock.
const CLIPPED_FROM_G: f64 = 7.5;

/// The counts that an accelerometer can give.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PossibleCounts {
    g_per_count: f64,
    zero_g_counts: [f64; 3],
    most_g: f64,
}

impl PossibleCounts {
    pub fn new(g_per_count: f64, zero_g_counts: [f64; 3], full_scale_g: Option<f64>) -> Self {
        let most_g = full_scale_g.unwrap_or(USUAL_FULL_SCALE_G) * OVER_FULL_SCALE + OFFSET_G;
        Self { g_per_count, zero_g_counts, most_g }
    }

    /// Whether the counts of x, y, z are all so small that they need no closer look. For the common case, without a branch.
    pub fn are_usual(&self, axis: usize, counts: &[f64]) -> bool {
        let zero = self.zero_g_counts.get(axis).copied().unwrap_or(0.0);
        let usual = self.most_g.min(FILLER_FROM_G) / self.g_per_count;
        counts.iter().fold(true, |usual_so_far, count| usual_so_far & ((count - zero).abs() < usual))
    }

    /// Whether a sensor can have given the counts of x, y, z.
    pub fn contain(&self, counts: impl IntoIterator<Item = f64>) -> bool {
        counts.into_iter().zip(self.zero_g_counts).all(|(count, zero)| {
            let g = ((count - zero) * self.g_per_count).abs();
            let filler_from_g =
                if count.abs() > 32_766.0 && count.abs() < 32_769.0 { CLIPPED_FROM_G } else { FILLER_FROM_G };
            g <= self.most_g && !(g >= filler_from_g && FILLERS.contains(&count.abs()))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_possible(count: f64, g_per_count: f64, full_scale_g: Option<f64>) -> bool {
        PossibleCounts::new(g_per_count, [0.0; 3], full_scale_g).contain([0.0, count, 0.0])
    }

    #[test]
    fn fillers_and_damaged_numbers_are_impossible_in_every_unit() {
        for (count, g_per_count) in [
            (-9999.0, 1.0),
            (-9999.0, 0.001),
            (9999.0, 0.000_976_562_5),
            (999.0, 0.004),
            (1e30, 1e-6),
            (-32_768.0, 0.000_488),
        ] {
            assert!(!is_possible(count, g_per_count, None), "{count} x {g_per_count}");
        }
        assert!(!is_possible(9000.0, 0.001, Some(2.0)) && is_possible(9000.0, 0.001, None));
    }

    #[test]
    fn what_a_sensor_can_give_stays() {
        for (count, g_per_count, full_scale_g) in [
            (-999.0, 0.001, None),               // -0.999 g
            (-32_768.0, 1.0 / 16_384.0, None),   // -2 g, the end of a sensor of +-2 g
            (32_767.0, 1.0 / 8192.0, Some(4.0)), // 4 g, likewise
            (2047.0, 0.001, Some(2.0)),
            (16.3, 1.0, None),
            (9.81, 1.0, None), // m/s^2 read as g: told elsewhere
        ] {
            assert!(is_possible(count, g_per_count, full_scale_g), "{count} x {g_per_count}");
        }
    }
}
