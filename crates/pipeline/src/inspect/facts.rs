//! All that is told of one session.

use ingest::{ReadError, SessionReader};
use jiff::tz::TimeZone;
use model::{Problem, UtcNs};
use serde::Serialize;

use super::acceleration::{self, AccelerationFacts};
use super::channels::{self, ExtraFacts};
use super::clock::Ambiguous;
use super::images::ImageFacts;
use super::local_time::{LocalSpan, LocalTimeChange, changes};
use super::range::{self, RangeFacts};

/// What is in the recording of one session. Serialised, its keys are stable, with the unit in the name.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SessionFacts {
    /// Name of the session.
    pub session: String,
    /// The MCAP file.
    pub file: FileFacts,
    /// Device profile.
    pub profile: ProfileFacts,
    /// Camera.
    pub camera: CameraFacts,
    /// Camera pitch minus sensor pitch.
    pub mount_pitch_deg: f64,
    /// IANA time zone of the times here; UTC where the recording's has no such name.
    pub time_zone: String,
    /// From the first sample or image to the last.
    pub recorded: Option<LocalSpan>,
    /// Where local time changes between them.
    pub local_time_changes: Vec<LocalTimeChange>,
    /// Times that exist twice, because a sensor's clock was set back.
    pub ambiguous: Ambiguous,
    /// The accelerometer, if the profile declares one.
    pub acceleration: Option<AccelerationFacts>,
    /// The range sensor, if the profile declares one.
    pub range: Option<RangeFacts>,
    /// Channels that are carried along and not used.
    pub extra: Vec<ExtraFacts>,
    /// The images.
    pub images: ImageFacts,
    /// What was wrong with the card, and what is worth knowing of it.
    pub problems: Vec<Problem>,
}

/// The MCAP file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FileFacts {
    /// Program that wrote it.
    pub program: String,
    /// Version of the ingest that wrote it.
    pub ingest_version: u32,
    /// Files of the card that went in.
    pub input_files: usize,
    /// Whether it is a survey of the card, without pictures.
    pub is_survey: bool,
}

/// Device profile.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ProfileFacts {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
}

/// Camera.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CameraFacts {
    /// Its name.
    pub name: String,
    /// Width of its pictures.
    pub width_px: u32,
    /// Height of its pictures.
    pub height_px: u32,
}

/// Reads all that is told of a session.
pub(super) fn read(reader: &mut SessionReader, mount_pitch_deg: Option<f64>) -> Result<SessionFacts, ReadError> {
    let metadata = reader.metadata().clone();
    let zone = TimeZone::get(&metadata.time_zone).unwrap_or(TimeZone::UTC);
    let mount_pitch_deg = mount_pitch_deg.unwrap_or(metadata.mount_pitch_deg);
    let images = reader.images()?;
    let timeline = &metadata.timeline;
    let ends = ends(
        timeline.acceleration.iter().chain(&timeline.range).filter_map(|facts| facts.span).map(|s| (s.from, s.to)),
        images.iter().map(|image| image.time),
    );
    Ok(SessionFacts {
        acceleration: acceleration::read(reader, timeline.acceleration.as_ref(), &zone, mount_pitch_deg)?,
        range: range::read(reader, timeline.range.as_ref(), &zone)?,
        extra: channels::read(reader, &zone)?,
        images: ImageFacts::new(&images, &metadata.dropped_images, &zone),
        ambiguous: Ambiguous::new(timeline, &zone),
        recorded: ends.map(|(from, to)| LocalSpan::new(from, to, &zone)),
        local_time_changes: ends.map(|(from, to)| changes(from, to, &zone)).unwrap_or_default(),
        file: FileFacts {
            input_files: metadata.inputs_sha256.len(),
            is_survey: metadata.is_survey(),
            program: metadata.program,
            ingest_version: metadata.ingest_version,
        },
        session: metadata.session,
        profile: ProfileFacts { name: metadata.profile.name, version: metadata.profile.version },
        camera: CameraFacts {
            name: metadata.camera.name,
            width_px: metadata.camera.width_px,
            height_px: metadata.camera.height_px,
        },
        mount_pitch_deg,
        time_zone: zone.iana_name().unwrap_or("UTC").to_owned(),
        problems: metadata.problems,
    })
}

/// The earliest and the latest of all times.
fn ends(spans: impl Iterator<Item = (UtcNs, UtcNs)>, images: impl Iterator<Item = UtcNs>) -> Option<(UtcNs, UtcNs)> {
    let all = spans.chain(images.map(|time| (time, time)));
    all.reduce(|(from, to), (other_from, other_to)| (from.min(other_from), to.max(other_to)))
}
