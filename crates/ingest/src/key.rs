//! The key of an MCAP file: one hash of all that it was made from, which says whether ingest must run again.

use std::path::Path;

use jiff::Timestamp;
use jiff::tz::TimeZone;
use model::Problem;
use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::card::{Card, CardFile, Declared, Inputs, Patterns, Place, is_housekeeping, open_hashing, too_large};
use crate::error::IngestError;
use crate::fingerprint::Fingerprint;
use crate::mcap_file::metadata::toml_text;
use crate::mcap_file::{Keep, SURVEY};
use crate::profile::Profile;
use crate::progress::{IngestProgress, NoProgress};
use crate::source::SessionSource;

/// Version of what ingest writes. A change of layout or meaning gives another number, and all sessions are ingested anew.
pub const INGEST_VERSION: u32 = 6;

/// SHA-256 over the session's name, the profile, the size of the camera's pictures, the time zone, [`INGEST_VERSION`], name and
/// SHA-256 of every file that the profile's patterns fit, and what there is to tell of what else lies there. Reads all of
/// them. The camera's calibration is not in it: the file has it for those who look at pictures, and nothing else in the file
/// depends on it.
///
/// # Errors
/// [`IngestError`] when there is no card, or the profile contradicts itself.
pub fn inputs_key(source: &SessionSource) -> Result<String, IngestError> {
    inputs_key_with(source, &NoProgress)
}

pub(crate) fn inputs_key_with(source: &SessionSource, progress: &dyn IngestProgress) -> Result<String, IngestError> {
    source.profile.check(Path::new("device profile"))?;
    let card = source.list_card()?;
    let files = input_files(&card, &source.profile)?;
    progress.begin(files.iter().map(|file| file.bytes).sum());
    let mut inputs = Inputs::default();
    let sensors = Patterns::new(&sensor_patterns(&source.profile)).map_err(IngestError::Pattern)?;
    for file in files {
        if let Some(reason) = too_large(file).filter(|_| !sensors.fits(&file.name)) {
            progress.advance(file.bytes);
            inputs.add_refused(file, reason);
            continue;
        }
        match open_hashing(file, progress) {
            // An unreadable file is recorded as such, here as in ingest.
            Ok(reader) => drop(inputs.add(file, reader)),
            Err(_) => inputs.add_unreadable(file),
        }
    }
    key_of(source, &inputs, &listing_problems(source, &card)?)
}

/// The problems that the listing of a card shows: links, odd names, and files that nobody reads. They are in the key, since they are in
/// the recording.
pub(crate) fn listing_problems(source: &SessionSource, card: &Card) -> Result<Vec<Problem>, IngestError> {
    let images = source.profile.images.as_ref().map_or(&[][..], |images| &images.files);
    let declared = Declared { all: &all_patterns(&source.profile), images };
    let unread = card.unread(&declared, &Place::of_card(&source.card_dir)).map_err(IngestError::Pattern)?;
    Ok(card.problems.iter().cloned().chain(unread).collect())
}

/// Takes fingerprints of cards without reading them: it is made once for a device profile, and serves every session.
pub struct CardFingerprinter {
    patterns: Patterns,
    profile: String,
}

impl CardFingerprinter {
    /// For cards of that profile.
    ///
    /// # Errors
    /// [`IngestError`] when the profile contradicts itself.
    pub fn new(profile: &Profile) -> Result<Self, IngestError> {
        let patterns = Patterns::new(&all_patterns(profile)).map_err(IngestError::Pattern)?;
        Ok(Self { patterns, profile: toml_text("profile", profile)? })
    }

    /// The fingerprint of a card: what the file system says of its files, under the same settings as [`inputs_key`]: where it is equal, the key is.
    /// The study's own files on the card do not count, nor do those of operating systems. Its bytes are those that are read.
    ///
    /// # Errors
    /// [`IngestError`] when there is no card.
    pub fn fingerprint(&self, source: &SessionSource) -> Result<Fingerprint, IngestError> {
        let card = source.list_card()?;
        let mut fingerprint = Fingerprint::default();
        fingerprint.add_text(&key_with(source, &self.profile, &Inputs::default(), &card.problems)?);
        card.special.iter().for_each(|name| fingerprint.add_text(name));
        for file in &card.files {
            if self.patterns.fits(&file.name) {
                fingerprint.add_stamp(&file.name, &file.stamp);
            } else if !is_housekeeping(&file.name) {
                fingerprint.add_unread(&file.name, &file.stamp);
            }
        }
        Ok(fingerprint)
    }
}

/// The key of a file with images, or of a survey.
pub(crate) fn key_as(
    keep: Keep,
    source: &SessionSource,
    inputs: &Inputs,
    listing: &[Problem],
) -> Result<String, IngestError> {
    let key = key_of(source, inputs, listing)?;
    Ok(if keep == Keep::Images { key } else { format!("{SURVEY}{key}") })
}

#[derive(Serialize)]
struct KeyParts<'a> {
    ingest_version: u32,
    session: &'a str,
    profile: &'a str,
    picture_size_px: (u32, u32),
    time_zone: String,
    clock_zero_utc: Option<Timestamp>,
    inputs: &'a std::collections::BTreeMap<String, String>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    listing: &'a [Problem],
}

pub(crate) fn key_of(source: &SessionSource, inputs: &Inputs, listing: &[Problem]) -> Result<String, IngestError> {
    key_with(source, &toml_text("profile", &source.profile)?, inputs, listing)
}

/// The key, where the profile is already text.
fn key_with(
    source: &SessionSource,
    profile: &str,
    inputs: &Inputs,
    listing: &[Problem],
) -> Result<String, IngestError> {
    let parts = KeyParts {
        ingest_version: INGEST_VERSION,
        session: &source.session,
        profile,
        picture_size_px: (source.camera_spec.width_px, source.camera_spec.height_px),
        time_zone: zone_name(&source.time_zone),
        clock_zero_utc: source.clock_zero_utc,
        inputs: &inputs.sha256,
        listing,
    };
    let text = serde_json::to_vec(&parts).map_err(IngestError::Key)?;
    Ok(format!("{:x}", Sha256::digest(text)))
}

/// The IANA name; for zones without one, their rule.
pub(crate) fn zone_name(zone: &TimeZone) -> String {
    zone.iana_name().map_or_else(|| format!("{zone:?}"), str::to_owned)
}

/// All patterns of a profile.
pub(crate) fn all_patterns(profile: &Profile) -> Vec<String> {
    let images = profile.images.iter().flat_map(|images| &images.files);
    sensor_patterns(profile).iter().chain(images).cloned().collect()
}

fn sensor_patterns(profile: &Profile) -> Vec<String> {
    let acceleration = profile.acceleration.iter().flat_map(|stream| &stream.files);
    let range = profile.range.iter().flat_map(|stream| &stream.files);
    acceleration.chain(range).cloned().collect()
}

/// The files that the profile's patterns fit, each once.
pub(crate) fn input_files<'c>(card: &'c Card, profile: &Profile) -> Result<Vec<&'c CardFile>, IngestError> {
    let patterns = Patterns::new(&all_patterns(profile)).map_err(IngestError::Pattern)?;
    Ok(card.files.iter().filter(|file| patterns.fits(&file.name)).collect())
}
