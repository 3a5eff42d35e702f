//! Roots of polynomials, which bound the monotone range of a lens, and inversion inside that range.

/// Value at `x` of the polynomial with `coefficients`, given from the constant term upwards.
pub(crate) fn evaluate(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Smallest root in (0, `limit`] of a polynomial that is positive at 0; `None` where it stays positive.
///
/// The roots of the derivative cut the range into monotone pieces; the first piece with a change of sign is bisected.
pub(crate) fn first_root(coefficients: &[f64], limit: f64) -> Option<f64> {
    roots(coefficients, limit).first().copied()
}

/// All roots in (0, `limit`] at which the polynomial changes its sign, in increasing order.
fn roots(coefficients: &[f64], limit: f64) -> Vec<f64> {
    if coefficients.len() < 2 {
        return Vec::new();
    }
    let derivative: Vec<f64> = (1..).zip(&coefficients[1..]).map(|(power, c)| f64::from(power) * c).collect();
    let mut crossings = Vec::new();
    let mut low = 0.0;
    for high in roots(&derivative, limit).into_iter().chain([limit]) {
        let (at_low, at_high) = (evaluate(coefficients, low), evaluate(coefficients, high));
        if (at_low > 0.0) != (at_high > 0.0) {
            let root = bisect(|x| evaluate(coefficients, x), low, high);
            if root > 0.0 {
                crossings.push(root);
            }
        }
        low = high;
    }
    crossings
}

/// The x in [`low`, `high`] at which the increasing function `value` takes the value `target`, to the last bit that bisection
/// can give. The caller has checked that the target lies between the values at both ends.
pub(crate) fn solve_increasing(value: impl Fn(f64) -> f64, target: f64, low: f64, high: f64) -> f64 {
    bisect(|x| value(x) - target, low, high)
}

/// The x in [`low`, `high`] at which `value` changes its sign. The caller has checked that it does.
fn bisect(value: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let rising = value(high) >= value(low);
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if (value(middle) > 0.0) == rising {
            high = middle;
        } else {
            low = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_several_roots_is_returned() {
        // (1 - x)(2 - x)(3 - x)
        let coefficients = [6.0, -11.0, 6.0, -1.0];
        let root = first_root(&coefficients, 10.0).expect("a root");
        assert!((root - 1.0).abs() < 1e-12, "{root}");
    }

    #[test]
    fn a_positive_polynomial_has_no_root() {
        assert_eq!(first_root(&[1.0, 0.0, 1.0], 100.0), None);
        assert_eq!(first_root(&[1.0], 100.0), None);
        assert_eq!(first_root(&[1.0, -0.001], 100.0), None, "its root 1000 lies beyond the limit");
    }

    #[test]
    fn increasing_functions_are_inverted_to_the_last_bits() {
        let x = solve_increasing(|x| x + x.powi(3), 10.0, 0.0, 5.0);
        assert!((x - 2.0).abs() < 1e-14);
    }
}
