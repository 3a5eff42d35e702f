//! Known sizes of a bench.

use super::correction::Correction;
use crate::container::{Container, Method, Quantity};
use crate::marks::ObjectMarks;
use crate::measure::Judge;
use crate::sigma::InputSigma;
use crate::source::Source;
use crate::uncertainty::{Estimate, estimate_judged};
use crate::view::View;

/// A known size with the marks and the view by which it is measured.
#[derive(Debug, Clone, PartialEq)]
pub struct BenchSize {
    /// Name of the object that was measured.
    pub object: String,
    /// The setup or session: the sizes of one setup share its errors.
    pub setup: String,
    /// The view by the uncorrected readings.
    pub view: View,
    /// An exact method whose assumptions hold.
    pub method: Method,
    /// The facts that are known about the container.
    pub container: Container,
    /// The marks of the object.
    pub marks: ObjectMarks,
    /// The quantity whose size is known.
    pub quantity: Quantity,
    /// The true size.
    pub true_mm: f64,
    /// Standard uncertainties of the picture's inputs.
    pub inputs: InputSigma,
}

/// A size as it is measured under a correction.
pub(super) struct Predicted {
    /// The logarithm of predicted over true size.
    pub log_ratio: f64,
    /// The derivatives of that logarithm by the four parameters, in the order of [`Correction::values`].
    pub by_parameter: [f64; 4],
    /// The SD of that logarithm from the picture's noise and the marks.
    pub own_sd: f64,
}

impl BenchSize {
    /// The corrected view, and the estimate of the size on it; `None` where the size cannot be measured.
    fn estimate(&self, correction: &Correction) -> Option<(View, Estimate)> {
        let view = correction.apply(&self.view)?;
        let judge = Judge::trusting();
        let sizes = estimate_judged(&view, self.method, &self.container, &self.marks, &self.inputs, &judge);
        Some((view, sizes.into_iter().find(|(quantity, _)| *quantity == self.quantity)?.1.ok()?))
    }

    /// The size under a correction; `None` where it cannot be measured.
    pub(super) fn predicted(&self, correction: &Correction) -> Option<Predicted> {
        let (view, estimate) = self.estimate(correction)?;
        let size_mm = estimate.measured.predicted_mm;
        let by = |source: Source| estimate.sensitivity.by_source[source.index()] / size_mm;
        let by_parameter = [
            by(Source::Mount),
            by(Source::RangeScale) * self.view.pose().range_mm() / view.pose().range_mm(),
            by(Source::RangeOffset),
            by(Source::Focal) / (1.0 + correction.focal_share),
        ];
        let noise = estimate.sensitivity.by_noise().map(|d| d * d).dot(&self.inputs.noise());
        let marks = (estimate.sensitivity.marks_mm_per_px * self.inputs.mark_px).powi(2);
        Some(Predicted {
            log_ratio: (size_mm / self.true_mm).ln(),
            by_parameter,
            own_sd: ((noise + marks).sqrt() / size_mm).max(LEAST_SD),
        })
    }

    /// The standard uncertainty, in per cent, that the size claims under a correction with these uncertainties of the inputs;
    /// `None` where it cannot be measured.
    #[must_use]
    pub fn claimed_pct(&self, correction: &Correction, inputs: &InputSigma) -> Option<f64> {
        let (_, estimate) = self.estimate(correction)?;
        Some(100.0 * estimate.sensitivity.sigma(inputs).total_mm / estimate.measured.predicted_mm)
    }

    /// The error under a correction, in per cent of the truth; `None` where the size cannot be measured.
    pub(super) fn error_pct(&self, correction: &Correction) -> Option<f64> {
        let (_, estimate) = self.estimate(correction)?;
        Some(100.0 * (estimate.measured.predicted_mm / self.true_mm - 1.0))
    }
}

/// The smallest SD of a size, as a share of it: neither true sizes nor pixels are known better.
const LEAST_SD: f64 = 1e-3;
