//! Spearman's rank correlation.

/// The ranks of the values, from 0; equal values share their mean rank.
#[expect(clippy::cast_precision_loss, reason = "a count of pairs")]
pub(super) fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let mut ranks = vec![0.0; values.len()];
    let mut below = 0;
    for ties in order.chunk_by(|a, b| values[*a].total_cmp(&values[*b]).is_eq()) {
        let shared = below as f64 + (ties.len() as f64 - 1.0) / 2.0;
        for i in ties {
            ranks[*i] = shared;
        }
        below += ties.len();
    }
    ranks
}

/// The correlation of two lists of ranks; none where one of them is flat.
#[expect(clippy::cast_precision_loss, reason = "a count of pairs")]
pub(super) fn correlation(a: &[f64], b: &[f64]) -> Option<f64> {
    let n = a.len().min(b.len()) as f64;
    let (mean_a, mean_b) = (a.iter().sum::<f64>() / n, b.iter().sum::<f64>() / n);
    let sum = |f: &dyn Fn(f64, f64) -> f64| a.iter().zip(b).map(|(a, b)| f(a - mean_a, b - mean_b)).sum::<f64>();
    let (aa, bb, ab) = (sum(&|a, _| a * a), sum(&|_, b| b * b), sum(&|a, b| a * b));
    (aa > 0.0 && bb > 0.0).then(|| ab / (aa * bb).sqrt())
}
