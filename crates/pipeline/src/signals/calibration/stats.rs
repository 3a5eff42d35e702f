//! The mean and the SD of samples as they come.

use nalgebra::Vector3;

/// Sums about the first sample, so that squares of 1 g do not hide an SD of 1 mg.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct AxisStats {
    n: u32,
    origin: Vector3<f64>,
    sum: Vector3<f64>,
    squares: Vector3<f64>,
}

impl AxisStats {
    pub(super) fn push(&mut self, value: &Vector3<f64>) {
        if self.n == 0 {
            self.origin = *value;
        }
        let from_origin = value - self.origin;
        self.n += 1;
        self.sum += from_origin;
        self.squares += from_origin.component_mul(&from_origin);
    }

    pub(super) fn n(&self) -> u32 {
        self.n
    }

    pub(super) fn mean(&self) -> Vector3<f64> {
        self.origin + self.sum / f64::from(self.n)
    }

    /// The SD of each axis (divisor n).
    pub(super) fn sd(&self) -> Vector3<f64> {
        let n = f64::from(self.n);
        let variance = self.squares / n - (self.sum / n).component_mul(&(self.sum / n));
        variance.map(|v| v.max(0.0).sqrt())
    }
}
