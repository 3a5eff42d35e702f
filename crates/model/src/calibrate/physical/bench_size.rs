//! Known sizes of a bench.

use super::correction::Correction;
use crate::container::{Container, Method, Quantity};
use crate::marks::ObjectMarks;
use crate::source::Source;
use crate::uncertainty::{Estimate, InputSigma, estimate};
use crate::view::View;

/// A known size as it was seen.
#[derive(Debug, Clone, PartialEq)]
pub struct BenchSize {
    /// What was measured.
    pub object: String,
    /// The setup or session: sizes of one share its errors.
    pub setup: String,
    /// The view that the readings give.
    pub view: View,
    /// An exact method whose assumptions hold.
    pub method: Method,
    /// What is known of the container.
    pub container: Container,
    /// Its marks.
    pub marks: ObjectMarks,
    /// Which size.
    pub quantity: Quantity,
    /// The truth.
    pub true_mm: f64,
    /// Uncertainties of the picture.
    pub inputs: InputSigma,
}

/// A size under a correction: log of predicted over true, and its derivatives by the four parameters.
pub(super) struct Predicted {
    pub log_ratio: f64,
    pub by_parameter: [f64; 4],
    pub own_sd: f64,
}

impl BenchSize {
    fn estimate(&self, correction: &Correction) -> Option<(View, Estimate)> {
        let view = correction.apply(&self.view)?;
        let sizes = estimate(&view, self.method, &self.container, &self.marks, &self.inputs);
        Some((view, sizes.into_iter().find(|(quantity, _)| *quantity == self.quantity)?.1.ok()?))
    }

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

    /// Standard uncertainty that the size claims under a correction, with these uncertainties of what goes in: in per cent.
    #[must_use]
    pub fn claimed_pct(&self, correction: &Correction, inputs: &InputSigma) -> Option<f64> {
        let (_, estimate) = self.estimate(correction)?;
        Some(100.0 * estimate.sensitivity.sigma(inputs).total_mm / estimate.measured.predicted_mm)
    }

    pub(super) fn error_pct(&self, correction: &Correction) -> Option<f64> {
        let (_, estimate) = self.estimate(correction)?;
        Some(100.0 * (estimate.measured.predicted_mm / self.true_mm - 1.0))
    }
}

/// Truths and pixels are never better than this share of a size.
const LEAST_SD: f64 = 1e-3;
