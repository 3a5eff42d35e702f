//! Counts of values in bins of one width.

use serde::Serialize;

/// Counts of values in bins of one width. The unit is that of the values. The last bin has its upper edge.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Histogram {
    /// The lower edge of the first bin.
    pub from: f64,
    /// The upper edge of the last bin.
    pub to: f64,
    /// The width of each bin.
    pub bin_width: f64,
    /// The number of values in each bin.
    pub counts: Vec<u64>,
    /// The number of values below `from`.
    pub below: u64,
    /// The number of values above `to`.
    pub above: u64,
}

impl Histogram {
    /// An empty histogram with `bins` bins of width `bin_width` from `from` on.
    #[must_use]
    pub fn new(from: f64, bin_width: f64, bins: u32) -> Self {
        let counts = vec![0; bins as usize];
        Self { from, to: from + f64::from(bins) * bin_width, bin_width, counts, below: 0, above: 0 }
    }

    /// Counts a value; one that is not a number is passed over.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not negative, and capped")]
    pub fn add(&mut self, value: f64) {
        if value < self.from {
            self.below += 1;
        } else if value > self.to {
            self.above += 1;
        } else if value.is_finite() {
            let bin = ((value - self.from) / self.bin_width) as usize;
            let last = self.counts.len().saturating_sub(1);
            if let Some(count) = self.counts.get_mut(bin.min(last)) {
                *count += 1;
            }
        }
    }

    /// The number of values in the bins.
    #[must_use]
    pub fn inside(&self) -> u64 {
        self.counts.iter().sum()
    }

    /// The number of all values.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.below + self.inside() + self.above
    }

    /// The middle of the bin with the median of all values; none where there are none, or it is in no bin.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "an index of a bin")]
    pub(super) fn median(&self) -> Option<f64> {
        let half = self.total().div_ceil(2);
        let mut seen = self.below;
        if half == 0 || half <= seen {
            return None;
        }
        let bin = self.counts.iter().position(|count| {
            seen += count;
            seen >= half
        })?;
        Some(self.from + (bin as f64 + 0.5) * self.bin_width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_fall_where_they_belong() {
        let mut histogram = Histogram::new(0.0, 5.0, 18);
        for value in [-0.1, 0.0, 4.9, 5.0, 89.9, 90.0, 90.1, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            histogram.add(value);
        }
        assert_eq!((histogram.below, histogram.above, histogram.inside()), (2, 2, 5));
        assert_eq!((histogram.counts[0], histogram.counts[1], histogram.counts[17]), (2, 1, 2));
        assert_eq!(histogram.total(), 9);
    }

    #[test]
    fn the_median_is_known_to_a_bin() {
        let mut histogram = Histogram::new(0.0, 1.0, 10);
        assert_eq!(histogram.median(), None);
        for value in [2.2, 7.7, 7.1] {
            histogram.add(value);
        }
        assert!(histogram.median().is_some_and(|median| (median - 7.5).abs() < 1e-12));
        [-1.0; 9].into_iter().for_each(|value| histogram.add(value));
        assert_eq!(histogram.median(), None);
    }
}
