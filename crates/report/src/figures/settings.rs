//! The settings of a run that figures show.

use crate::parquet::Results;

use super::drawing::{Drawing, Paint};
use super::panel::Panel;
use super::words::number;

/// The window of pitch in which images are selected, in degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Window {
    pub(super) low_deg: f64,
    pub(super) high_deg: f64,
}

impl Window {
    /// The window as the run resolved it; none where the metadata of the run do not hold it.
    pub(super) fn from_results(results: &Results) -> Option<Self> {
        let select = results.metadata.settings.get("study")?.get("select")?;
        let number = |key: &str| select.get(key)?.as_f64().filter(|number| (0.0..=90.0).contains(number));
        let (target, tolerance) = (number("target_pitch_deg")?, number("pitch_tolerance_deg")?);
        Some(Self { low_deg: target - tolerance, high_deg: target + tolerance })
    }

    /// The window in words, such as `47.5 to 62.5 deg`.
    pub(super) fn name(self) -> String {
        format!("{} to {} deg", number(self.low_deg, 1), number(self.high_deg, 1))
    }

    /// Draws the borders in a panel whose x is pitch.
    pub(super) fn draw_upright(self, drawing: &mut Drawing, panel: &Panel, paint: Paint) {
        panel.upright(drawing, "window", paint, self.low_deg);
        panel.upright(drawing, "window", paint, self.high_deg);
    }
}
