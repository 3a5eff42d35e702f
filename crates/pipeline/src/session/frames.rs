//! Step *select*: decides for each image whether it has a pose and counts for fused sizes, and how far it is to be trusted.
//!
//! - Input: the images and sensor readings of a [`Recording`], and the thresholds of `[signals]` and `[select]`.
//! - Output: a [`Session`], whose frames hold signals, pose and the one reason that the ledger gives.

use ingest::{DroppedImage, ImageEntry};
use model::{Camera, FrameFlag, InputSigma, Orientation};

use super::prepared::Prepared;
use super::recording::Recording;
use crate::calibration::inputs_after;
use crate::labelme::MarkedPicture;
use crate::signals::{FrameSignals, Reading};
use crate::study::{SessionDir, SessionSpec, Study};

/// An image with its signals, as all later steps see it.
pub(super) struct Frame {
    pub image: ImageEntry,
    pub signals: FrameSignals,
}

/// A session once its card and session.toml have been read.
pub(super) struct Session<'a> {
    pub study: &'a Study,
    pub dir: &'a SessionDir,
    pub spec: SessionSpec,
    /// The camera of the pictures that people marked.
    pub marks_camera: Camera,
    /// A marked picture that is upright.
    marked_upright: MarkedPicture,
    pub frames: Vec<Frame>,
    pub dropped: Vec<DroppedImage>,
}

impl<'a> Session<'a> {
    pub(super) fn new(study: &'a Study, dir: &'a SessionDir, prepared: &Prepared, recording: Recording) -> Self {
        let frames = frames(study, prepared, &recording);
        let (spec, marks_camera) = (prepared.spec.clone(), prepared.marks_camera.1);
        let marked_upright = prepared.marked_picture(study, Orientation::Upright);
        Self { study, dir, spec, marks_camera, marked_upright, frames, dropped: recording.dropped }
    }

    /// A picture that people marked, by its EXIF orientation on the card.
    pub(super) fn marked_picture(&self, orientation: Orientation) -> MarkedPicture {
        MarkedPicture { orientation, ..self.marked_upright }
    }

    /// The path of a file of the card, relative to the study.
    pub(super) fn place_of(&self, file: &str) -> String {
        format!("cards/{}/{file}", self.dir.name)
    }
}

/// The images of a recording with their signals, in the order of time.
pub(super) fn frames(study: &Study, prepared: &Prepared, recording: &Recording) -> Vec<Frame> {
    let settings = prepared.pose_settings(study, recording.mount_pitch_deg);
    let of_image =
        |(image, reading): (&ImageEntry, &Reading)| Frame { image: image.clone(), signals: reading.judge(&settings) };
    recording.images.iter().zip(&recording.readings).map(of_image).collect()
}

/// The uncertainties of one image's inputs: the study's, with the noise that the image's own signals show.
pub(super) fn inputs_of(study: &Study, frame: &Frame) -> InputSigma {
    let signals = &frame.signals;
    let readings = f64::from(signals.range_distinct.max(1));
    let range_error_mm = signals.range_spread_mm.unwrap_or_default() / readings.sqrt();
    let inputs = study.spec.uncertainty.inputs_of_image(signals.stillness_mg.unwrap_or_default(), range_error_mm);
    inputs_after(study.calibration.as_ref(), inputs)
}

/// The factor, at least 1, on the variance with which an image is weighed. It stands for doubts that the uncertainties do
/// not hold: motion near the threshold, range readings that scatter by more than the sensor's accuracy, and flagged signals
/// (docs/uncertainty.md).
pub(super) fn penalty_of(study: &Study, frame: &Frame) -> f64 {
    let signals = &frame.signals;
    let motion = signals.stillness_mg.unwrap_or_default() / study.spec.signals.stillness_max_mg;
    let range_mm = signals.range_mm.unwrap_or(f64::INFINITY);
    let spread = signals.range_spread_mm.unwrap_or_default() / (UNSTEADY_RANGE * range_mm);
    let doubtful = [FrameFlag::RangeHeld, FrameFlag::RangeStep, FrameFlag::GravityEdge];
    let flags = signals.flags.iter().filter(|flag| doubtful.contains(flag)).count();
    (1.0 + motion * motion) * (1.0 + spread * spread) * FLAGGED.powi(i32::try_from(flags).unwrap_or(i32::MAX))
}

/// Range readings whose spread is this share of the range are unsteady.
const UNSTEADY_RANGE: f64 = 0.03;
/// A flag doubles the standard uncertainty with which an image is weighed.
const FLAGGED: f64 = 4.0;
