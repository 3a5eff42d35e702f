//! The facts of one session.

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

/// The content of one session's recording. The serialised keys are stable, with the unit in the name.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SessionFacts {
    /// The name of the session.
    pub session: String,
    /// The MCAP file.
    pub file: FileFacts,
    /// The device profile.
    pub profile: ProfileFacts,
    /// The camera.
    pub camera: CameraFacts,
    /// Camera pitch minus sensor pitch.
    pub mount_pitch_deg: f64,
    /// The IANA time zone of the times here; UTC where the recording's zone has no such name.
    pub time_zone: String,
    /// The time from the first sample or image to the last.
    pub recorded: Option<LocalSpan>,
    /// The changes of local time between them.
    pub local_time_changes: Vec<LocalTimeChange>,
    /// The times that exist twice, because a sensor's clock was set back.
    pub ambiguous: Ambiguous,
    /// The accelerometer, if the profile declares one.
    pub acceleration: Option<AccelerationFacts>,
    /// The range sensor, if the profile declares one.
    pub range: Option<RangeFacts>,
    /// The channels that are carried along and not used.
    pub extra: Vec<ExtraFacts>,
    /// The images.
    pub images: ImageFacts,
    /// The problems of the card, and notes.
    pub problems: Vec<Problem>,
}

/// The MCAP file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FileFacts {
    /// The program that wrote it.
    pub program: String,
    /// The version of the ingest that wrote it.
    pub ingest_version: u32,
    /// The number of files of the card that went into it.
    pub input_files: usize,
    /// Whether it is a survey of the card, without pictures.
    pub is_survey: bool,
}

/// The device profile.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ProfileFacts {
    /// The name.
    pub name: String,
    /// The version.
    pub version: String,
}

/// The camera.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CameraFacts {
    /// The name.
    pub name: String,
    /// The width of its pictures.
    pub width_px: u32,
    /// The height of its pictures.
    pub height_px: u32,
}

/// The facts of the session in a recording.
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
