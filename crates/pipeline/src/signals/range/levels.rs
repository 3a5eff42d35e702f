//! Two distances in one window: a hand, a fork, the edge of a plate.

use model::median;

use super::ROBUST_SD;

/// Readings that fall into two groups.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Levels {
    /// The larger group, sorted.
    major_mm: Vec<f64>,
    /// The number of readings in the smaller one.
    minor: usize,
}

/// Levels that are closer than this are one: food is no flatter.
const MIN_STEP_MM: f64 = 20.0;
/// Two levels are at least this far apart, in robust SDs of the readings around them. Gaussian noise, split at its best,
/// stays below 3, and so does a steady drift.
const MIN_STEP_SD: f64 = 5.0;
/// The smaller group comes at least this many times in a row; the median takes care of single stray echoes.
const MIN_MINOR: usize = 3;
/// A majority below this part of the readings is not clear.
const CLEAR: f64 = 0.6;

impl Levels {
    /// The readings of the larger group, if it is clearly the larger one.
    #[expect(clippy::cast_precision_loss, reason = "a window holds some thousand readings at most")]
    pub(super) fn clear_majority(self) -> Option<Vec<f64>> {
        let all = self.major_mm.len() + self.minor;
        (self.major_mm.len() as f64 >= CLEAR * all as f64).then_some(self.major_mm)
    }
}

/// The two levels of `readings_mm` (in the order of time); none when there is one.
///
/// The sorted readings are split where the two sides' means are furthest apart (Otsu 1979). They are two levels when the
/// sides' medians are far apart against the robust SD of the readings around their own median. Sorting, unlike a split in
/// time, also detects a hand that came and went.
pub(super) fn two_levels(readings_mm: &[f64]) -> Option<Levels> {
    let mut sorted = readings_mm.to_vec();
    sorted.sort_by(f64::total_cmp);
    let (low, high) = sorted.split_at(best_split(&sorted)?);
    let (low_mm, high_mm) = (median(low.to_vec()), median(high.to_vec()));
    let around = low.iter().map(|mm| (mm - low_mm).abs()).chain(high.iter().map(|mm| (mm - high_mm).abs()));
    let noise_mm = ROBUST_SD * median(around.collect());
    if high_mm - low_mm < MIN_STEP_MM.max(MIN_STEP_SD * noise_mm) {
        return None;
    }
    let low_is_minor = low.len() < high.len();
    let (major, minor) = if low_is_minor { (high, low) } else { (low, high) };
    let in_minor = |mm: f64| (mm < high[0]) == low_is_minor;
    let mut stretches = readings_mm.chunk_by(|a, b| in_minor(*a) == in_minor(*b));
    let persists = stretches.any(|stretch| stretch.len() >= MIN_MINOR && in_minor(stretch[0]));
    persists.then(|| Levels { major_mm: major.to_vec(), minor: minor.len() })
}

/// The number of sorted values on the low side when the variance between the sides is largest.
#[expect(clippy::cast_precision_loss, reason = "a window holds some thousand readings at most")]
fn best_split(sorted: &[f64]) -> Option<usize> {
    let (n, total) = (sorted.len() as f64, sorted.iter().sum::<f64>());
    let mut low_sum = 0.0;
    let between = sorted.iter().enumerate().map(|(i, mm)| {
        low_sum += mm;
        let low_n = (i + 1) as f64;
        (i + 1, (low_sum / low_n - (total - low_sum) / (n - low_n)).powi(2) * low_n * (n - low_n))
    });
    let splits: Vec<(usize, f64)> = between.take(sorted.len().saturating_sub(1)).collect();
    splits.into_iter().max_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(split, _)| split)
}
