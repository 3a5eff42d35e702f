//! The images of a session with their signals, and how far each is to be trusted.

use ingest::{DroppedImage, ImageEntry};
use model::{Camera, FrameFlag, InputSigma};

use super::prepared::Prepared;
use super::recording::Recording;
use crate::calibration::inputs_after;
use crate::signals::{FrameSignals, Reading};
use crate::study::{SessionDir, SessionSpec, Study};

/// An image with its signals, as the later steps see it.
pub(super) struct Frame {
    pub image: ImageEntry,
    pub signals: FrameSignals,
}

/// All of a session that is known once its card and session.toml are read.
pub(super) struct Session<'a> {
    pub study: &'a Study,
    pub dir: &'a SessionDir,
    pub spec: SessionSpec,
    /// Camera of the pictures that were marked.
    pub marks_camera: Camera,
    pub frames: Vec<Frame>,
    pub dropped: Vec<DroppedImage>,
}

impl<'a> Session<'a> {
    pub(super) fn new(study: &'a Study, dir: &'a SessionDir, prepared: &Prepared, recording: Recording) -> Self {
        let frames = frames(study, prepared, &recording);
        let (spec, marks_camera) = (prepared.spec.clone(), prepared.marks_camera.1);
        Self { study, dir, spec, marks_camera, frames, dropped: recording.dropped }
    }

    /// Where a file of the card is, relative to the study.
    pub(super) fn place_of(&self, file: &str) -> String {
        format!("cards/{}/{file}", self.dir.name)
    }
}

/// The images of a recording with their signals.
pub(super) fn frames(study: &Study, prepared: &Prepared, recording: &Recording) -> Vec<Frame> {
    let settings = prepared.pose_settings(study, recording.mount_pitch_deg);
    let of_image =
        |(image, reading): (&ImageEntry, &Reading)| Frame { image: image.clone(), signals: reading.judge(&settings) };
    recording.images.iter().zip(&recording.readings).map(of_image).collect()
}

/// Uncertainties of one image: the study's, with the noise that its own signals show.
pub(super) fn inputs_of(study: &Study, frame: &Frame) -> InputSigma {
    let signals = &frame.signals;
    let readings = f64::from(signals.range_distinct.max(1));
    let range_error_mm = signals.range_spread_mm.unwrap_or_default() / readings.sqrt();
    let inputs = study.spec.uncertainty.inputs_of_image(signals.stillness_mg.unwrap_or_default(), range_error_mm);
    inputs_after(study.calibration.as_ref(), inputs)
}

/// Doubts about an image that its uncertainties do not hold: motion near the threshold, readings of the range that scatter
/// by more than the sensor's accuracy, and flagged signals (docs/uncertainty.md).
pub(super) fn penalty_of(study: &Study, frame: &Frame) -> f64 {
    let signals = &frame.signals;
    let motion = signals.stillness_mg.unwrap_or_default() / study.spec.signals.stillness_max_mg;
    let range_mm = signals.range_mm.unwrap_or(f64::INFINITY);
    let spread = signals.range_spread_mm.unwrap_or_default() / (UNSTEADY_RANGE * range_mm);
    let doubtful = [FrameFlag::RangeHeld, FrameFlag::RangeStep, FrameFlag::GravityEdge];
    let flags = signals.flags.iter().filter(|flag| doubtful.contains(flag)).count();
    (1.0 + motion * motion) * (1.0 + spread * spread) * FLAGGED.powi(i32::try_from(flags).unwrap_or(i32::MAX))
}

/// Readings that scatter by this share of the range are unsteady.
const UNSTEADY_RANGE: f64 = 0.03;
/// A flag doubles the standard uncertainty that an image is weighed with.
const FLAGGED: f64 = 4.0;
