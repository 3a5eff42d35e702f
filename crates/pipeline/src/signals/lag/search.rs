//! The lag at which pictures and gravity agree best, and whether that says anything.

use model::median;

use super::rank::{correlation, ranks};
use super::{LAGS, STEP_S, lag_s};

/// A pair of images: how much the picture changed, and the gravity around both.
#[derive(Debug, Clone, Copy)]
pub struct PairMotion<'a> {
    /// The change of the picture, from [`change`](super::change).
    pub change: f64,
    /// The directions of gravity around the first image, by lag.
    pub from: &'a [Option<nalgebra::Vector3<f64>>],
    /// The directions of gravity around the second image, by lag.
    pub to: &'a [Option<nalgebra::Vector3<f64>>],
}

/// Whether a lag can be stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LagVerdict {
    /// It can be stated.
    Known,
    /// Too few pairs of pictures with acceleration around both.
    TooFewPairs,
    /// At no lag do pictures and gravity agree much better than by chance.
    NoAgreement,
    /// They agree nearly as well at other lags.
    NotSharp,
    /// They agree best at the end of the range that was searched.
    AtTheEnd,
}

/// The lag by pictures and gravity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LagEstimate {
    /// Whether it can be stated.
    pub verdict: LagVerdict,
    /// Sensor time minus image time, in seconds, where the two agree best. None without an agreement to compare.
    pub lag_s: Option<f64>,
    /// The rank correlation at that lag.
    pub correlation: Option<f64>,
    /// Half the width of the interval of lags that agree nearly as well.
    pub half_width_s: Option<f64>,
    /// The number of pairs of pictures.
    pub pairs: usize,
}

/// Fewer pairs say nothing.
const MIN_PAIRS: usize = 30;
/// A peak is at least this high, in standard errors of a rank correlation of unrelated series, 1/sqrt(n - 1). The best of
/// 201 lags by chance stays below 4 (1 in 80).
const MIN_STANDARD_ERRORS: f64 = 5.0;
/// A peak is also at least this high in itself.
const MIN_CORRELATION: f64 = 0.3;
/// Lags within one standard error of the peak agree nearly as well; they may not spread more than this.
const MAX_HALF_WIDTH_S: f64 = 1.0;
/// The peak is at least this much above the median over all lags, in standard errors: an agreement at all lags alike is no
/// peak.
const MIN_ABOVE_MEDIAN: f64 = 3.0;

/// The lag at which the changes of the pictures and the rotations of gravity agree best, by rank correlation.
#[must_use]
pub fn estimate(pairs: &[PairMotion<'_>]) -> LagEstimate {
    // Only pairs known at every lag, so that the lags are compared on the same pairs.
    let known: Vec<(f64, Vec<f64>)> =
        pairs.iter().filter_map(|pair| Some((pair.change, rotations(pair.from, pair.to)?))).collect();
    let mut estimated = LagEstimate {
        verdict: LagVerdict::TooFewPairs,
        lag_s: None,
        correlation: None,
        half_width_s: None,
        pairs: known.len(),
    };
    if known.len() < MIN_PAIRS {
        return estimated;
    }
    let changes = ranks(&known.iter().map(|(change, _)| *change).collect::<Vec<_>>());
    let curve: Vec<f64> = (0..LAGS)
        .map(|i| {
            let angles: Vec<f64> = known.iter().map(|(_, angles)| angles[i]).collect();
            correlation(&changes, &ranks(&angles)).unwrap_or(0.0)
        })
        .collect();
    judge(&curve, &mut estimated);
    estimated
}

/// The angle between the directions at each lag; none unless all are known.
fn rotations(from: &[Option<nalgebra::Vector3<f64>>], to: &[Option<nalgebra::Vector3<f64>>]) -> Option<Vec<f64>> {
    let angle = |(a, b): (&Option<nalgebra::Vector3<f64>>, &Option<nalgebra::Vector3<f64>>)| {
        let (a, b) = ((*a)?, (*b)?);
        Some(a.cross(&b).norm().atan2(a.dot(&b)))
    };
    from.iter().zip(to).map(angle).collect()
}

#[expect(clippy::cast_precision_loss, reason = "a count of pairs")]
fn judge(curve: &[f64], estimated: &mut LagEstimate) {
    let Some(peak) = (0..curve.len()).max_by(|a, b| curve[*a].total_cmp(&curve[*b])) else { return };
    let standard_error = 1.0 / (estimated.pairs as f64 - 1.0).sqrt();
    let near = |i: &usize| curve[*i] > curve[peak] - standard_error;
    let (first, last) = ((0..LAGS).find(near).unwrap_or(peak), (0..LAGS).rfind(near).unwrap_or(peak));
    let half_width_s = 0.5 * (last - first + 1) as f64 * STEP_S;
    estimated.lag_s = Some(lag_s(peak) + STEP_S * top_of_parabola(curve, peak));
    estimated.correlation = Some(curve[peak]);
    estimated.half_width_s = Some(half_width_s);
    let above_median = curve[peak] - median(curve.to_vec());
    estimated.verdict = if curve[peak] < MIN_CORRELATION.max(MIN_STANDARD_ERRORS * standard_error) {
        LagVerdict::NoAgreement
    } else if peak == 0 || peak + 1 == curve.len() {
        LagVerdict::AtTheEnd
    } else if half_width_s > MAX_HALF_WIDTH_S || above_median < MIN_ABOVE_MEDIAN * standard_error {
        LagVerdict::NotSharp
    } else {
        LagVerdict::Known
    };
}

/// The place where the parabola through the peak and its neighbours is highest, in steps from the peak.
fn top_of_parabola(curve: &[f64], peak: usize) -> f64 {
    match peak.checked_sub(1).and_then(|before| curve.get(before..=peak + 1)) {
        Some(&[before, top, after]) if before + after < 2.0 * top => {
            0.5 * (before - after) / (before + after - 2.0 * top)
        }
        _ => 0.0,
    }
}
