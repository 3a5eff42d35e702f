//! Confidence intervals by resampling whole clusters.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore as _, SeedableRng as _};

use super::summary::quantile;

/// A confidence interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

/// The 95 % percentile interval of a statistic; `None` for fewer than two clusters, which show no scatter. Errors of one
/// cluster (an object, a participant) are not independent, so whole clusters are drawn with replacement (Davison and Hinkley
/// 1997, section 3.8). The same seed gives the same interval.
#[must_use]
pub fn bootstrap(
    clusters: &[Vec<f64>],
    statistic: impl Fn(&[f64]) -> Option<f64>,
    draws: usize,
    seed: u64,
) -> Option<Interval> {
    if clusters.len() < 2 {
        return None;
    }
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut drawn = Vec::new();
    let mut sample = Vec::new();
    for _ in 0..draws {
        sample.clear();
        for _ in 0..clusters.len() {
            sample.extend_from_slice(&clusters[random_below(&mut random, clusters.len())]);
        }
        drawn.extend(statistic(&sample));
    }
    (!drawn.is_empty()).then(|| Interval { low: quantile(drawn.clone(), 0.025), high: quantile(drawn, 0.975) })
}

/// A random number below `n`: the high half of a product, whose bias is below n / 2^64.
fn random_below(random: &mut ChaCha8Rng, n: usize) -> usize {
    let product = u128::from(random.next_u64()) * n as u128;
    usize::try_from(product >> 64).unwrap_or_default()
}
