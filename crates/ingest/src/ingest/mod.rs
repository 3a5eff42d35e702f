//! From a card to an MCAP file.

mod clock_problems;
mod dropped;
mod error;
mod image_tally;
mod read_ahead;
mod recordings;
mod run;

pub use error::IngestError;

use std::path::{Path, PathBuf};

use crate::card::{Card, Declared, Place};
use crate::key;
use crate::mcap_file::Keep;
use crate::profile::Profile;
use crate::progress::IngestProgress;
use crate::summary::IngestSummary;
use jiff::Timestamp;
use jiff::tz::TimeZone;
use model::CameraSpec;
use run::Run;

/// What one session is ingested from.
#[derive(Debug, Clone)]
pub struct SessionSource {
    /// Name of the session.
    pub session: String,
    /// The card as it was copied.
    pub card_dir: PathBuf,
    /// What the device writes.
    pub profile: Profile,
    /// The camera of this session.
    pub camera_spec: CameraSpec,
    /// For image times that name no zone.
    pub time_zone: TimeZone,
    /// When a boot-relative clock was zero, where the profile says that the session tells.
    pub clock_zero_utc: Option<Timestamp>,
    /// Program and version, for the file's metadata.
    pub program: String,
}

/// What [`ingest_if_changed`] did.
#[derive(Debug, Clone, PartialEq)]
pub enum Ingested {
    /// The MCAP file was made from the same input by the same ingest; nothing was written.
    Current {
        /// Key of that input; see [`inputs_key`](crate::inputs_key).
        key: String,
    },
    /// The MCAP file is new.
    Fresh(Box<IngestSummary>),
}

impl Ingested {
    /// Key of the input; see [`inputs_key`](crate::inputs_key).
    #[must_use]
    pub fn key(&self) -> &str {
        match self {
            Self::Current { key } => key,
            Self::Fresh(summary) => &summary.key,
        }
    }
}

impl SessionSource {
    pub(crate) fn list_card(&self) -> Result<Card, IngestError> {
        Card::list(&self.card_dir).map_err(|source| IngestError::NoCard {
            session: self.session.clone(),
            card_dir: self.card_dir.clone(),
            source,
        })
    }
}

/// Ingests a session unless `out` was made from the same input. The card is hashed beforehand only if `out` exists.
///
/// # Errors
/// As [`ingest_session`].
pub fn ingest_if_changed(
    source: &SessionSource,
    out: &Path,
    progress: &dyn IngestProgress,
) -> Result<Ingested, IngestError> {
    if out.is_file() {
        let key = key::inputs_key_with(source, progress)?;
        if progress.is_stopped() {
            return Err(IngestError::Stopped);
        }
        if key::ingest_is_current(out, &key) {
            return Ok(Ingested::Current { key });
        }
    }
    ingest_session(source, out, progress).map(|summary| Ingested::Fresh(Box::new(summary)))
}

/// Writes the MCAP file of a session. `out` is there whole or not at all: it is written under another name in the same
/// folder, made durable and renamed. Memory is bounded by a packet, a chunk and an image. Equal input gives equal bytes.
///
/// Bad files do not stop it; the summary and the MCAP file list what was lost.
///
/// # Errors
/// [`IngestError`] when nothing of the session can be used, or `out` cannot be written.
pub fn ingest_session(
    source: &SessionSource,
    out: &Path,
    progress: &dyn IngestProgress,
) -> Result<IngestSummary, IngestError> {
    ingest_as(Keep::Images, source, out, progress)
}

/// As [`ingest_session`], and finds the same problems, but `out` has no image data, only the list of images: what a check
/// needs before a run. Reads as much of the card, and writes little. The file is not made durable, and its key is that of
/// no session, so that it never passes for one; write it into a temporary folder.
///
/// # Errors
/// As [`ingest_session`].
pub fn survey_session(
    source: &SessionSource,
    out: &Path,
    progress: &dyn IngestProgress,
) -> Result<IngestSummary, IngestError> {
    ingest_as(Keep::ListOfImages, source, out, progress)
}

fn ingest_as(
    keep: Keep,
    source: &SessionSource,
    out: &Path,
    progress: &dyn IngestProgress,
) -> Result<IngestSummary, IngestError> {
    source.profile.check(Path::new("device profile"))?;
    let camera = source.camera_spec.camera()?;
    let card = source.list_card()?;
    let place = Place::of_card(&source.card_dir);
    let bytes = key::input_files(&card, &source.profile)?.iter().map(|file| file.bytes).sum();
    progress.begin(bytes);
    tracing::debug!(session = source.session, bytes, "ingest");

    let mut run = Run::new(source, out, keep, &place, progress)?;
    run.problems.extend(card.problems.iter().cloned());
    run.sensors(&card)?;
    let entries = run.images(&card)?;
    if run.inputs.sha256.is_empty() {
        return Err(nothing_fits(source, &card));
    }
    let images = source.profile.images.as_ref().map_or(&[][..], |images| &images.files);
    let declared = Declared { all: &key::all_patterns(&source.profile), images };
    run.problems.extend(card.unread(&declared, &place).map_err(IngestError::Pattern)?);
    run.finish(&entries, &camera)
}

fn nothing_fits(source: &SessionSource, card: &Card) -> IngestError {
    IngestError::NothingFits {
        session: source.session.clone(),
        card_dir: source.card_dir.clone(),
        files: card.files.len(),
        profile: source.profile.name.clone(),
        patterns: key::all_patterns(&source.profile).join(" "),
    }
}
