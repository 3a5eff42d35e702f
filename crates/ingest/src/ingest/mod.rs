//! From a card to an MCAP file.

mod clock_problems;
mod common_time;
mod dropped;
mod image_tally;
mod read_ahead;
mod recordings;
mod run;

use std::path::Path;

use crate::card::{Card, Place};
use crate::error::IngestError;
use crate::key;
use crate::mcap_file::Keep;
use crate::progress::IngestProgress;
use crate::read::ingest_is_current;
use crate::source::SessionSource;
use crate::summary::IngestSummary;
use run::Run;

/// The outcome of [`ingest_if_changed`].
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
        if ingest_is_current(out, &key) {
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
    let listing = key::listing_problems(source, &card)?;
    let (of_card, unread) = listing.split_at(card.problems.len());
    run.problems.extend_from_slice(of_card);
    run.sensors(&card)?;
    let entries = run.images(&card)?;
    if run.inputs.sha256.is_empty() {
        return Err(nothing_fits(source, &card));
    }
    run.problems.extend_from_slice(unread);
    run.finish(&entries, &camera, &listing)
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
