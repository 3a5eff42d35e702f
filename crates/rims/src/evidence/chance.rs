//! How likely chance is to do as well.

/// Upper bound of log10 P(at least `share` of `trials` succeed by chance `p` each), by Hoeffding (1963, Theorem 1).
pub(crate) fn binomial_tail_log10(trials: f64, share: f64, p: f64) -> f64 {
    let p = p.clamp(1e-3, 1.0);
    if share <= p {
        return 0.0;
    }
    let part = |share: f64, p: f64| if share > 0.0 { share * (share / p).log10() } else { 0.0 };
    -trials * (part(share, p) + part(1.0 - share, 1.0 - p))
}
