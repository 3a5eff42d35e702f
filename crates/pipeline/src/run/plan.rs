//! Plans a run: looks at every session, and reads no file of a card.

use std::collections::BTreeMap;
use std::path::Path;

use ingest::{CardFingerprinter, Fingerprint};
use model::{SessionStatus, Stage};

use super::Halted;
use super::keys::{self, MeasureParts};
use crate::inputs::sha256_of_file;
use crate::session::Prepared;
use crate::study::{SessionDir, Study};
use crate::work::{Kept, KeptStage, State};

/// The stages of a session that need not be done again.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Current {
    /// Whether the recording is that of the card.
    pub ingest: bool,
    /// Whether the readings are those of that recording, under these settings.
    pub signals: bool,
    /// Whether the sizes are those of these readings and marks, under these settings.
    pub measure: bool,
}

impl Current {
    /// Whether nothing has to be done.
    #[must_use]
    pub fn all(self) -> bool {
        self.ingest && self.signals && self.measure
    }
}

/// The plan for one session.
pub(crate) struct SessionPlan<'a> {
    pub dir: &'a SessionDir,
    pub current: Current,
    /// The number of bytes of the card that have to be read.
    pub bytes_to_read: u64,
    pub kept: Kept,
}

/// The study, the program, and what else all sessions of a run have in common.
pub(crate) struct RunContext<'a> {
    pub study: &'a Study,
    pub program: &'a str,
    /// SHA-256 of objects.csv.
    objects_csv: String,
    pub fingerprinter: CardFingerprinter,
}

impl<'a> RunContext<'a> {
    pub fn new(study: &'a Study, program: &'a str) -> Result<Self, Halted> {
        let objects = study.dir.join("objects.csv");
        let objects_csv = sha256_of_file(&objects).map_err(|source| Halted::Input { path: objects, source })?;
        let fingerprinter =
            CardFingerprinter::new(&study.profile).map_err(|error| Halted::Ingest { error: Box::new(error) })?;
        Ok(Self { study, program, objects_csv, fingerprinter })
    }

    pub fn measure_parts<'p>(
        &'p self,
        dir: &'p SessionDir,
        prepared: &'p Prepared,
        signals_key: &'p str,
    ) -> MeasureParts<'p> {
        MeasureParts::new(self.study, dir, prepared, self.program, signals_key, &self.objects_csv)
    }

    /// The plan for a session; `kept` is what the state has of it.
    pub fn plan(&self, dir: &'a SessionDir, kept: Kept, state: Option<&State>, mcap: &Path) -> SessionPlan<'a> {
        let prepared = Prepared::new(self.study, dir, self.program);
        let card = prepared.as_ref().ok().and_then(|prepared| self.fingerprinter.fingerprint(&prepared.source).ok());
        let current = match (&prepared, &card) {
            (Ok(prepared), Some(card)) => self.current(dir, prepared, card, &kept, state, mcap).unwrap_or_default(),
            _ => Current::default(),
        };
        let bytes = card.map_or(0, |card| card.bytes());
        SessionPlan { dir, current, bytes_to_read: if current.ingest { 0 } else { bytes }, kept }
    }

    fn current(
        &self,
        dir: &SessionDir,
        prepared: &Prepared,
        card: &Fingerprint,
        kept: &Kept,
        state: Option<&State>,
        mcap: &Path,
    ) -> Option<Current> {
        let mut current = Current::default();
        let ingest = kept.ingest.as_ref().filter(|stage| stage.fingerprint.as_ref() == Some(&card.hex()))?;
        current.ingest = recording_is_there(&dir.name, ingest, state, mcap);
        let signals_key = keys::signals_key(self.study, self.program, &ingest.key).ok()?;
        current.signals = kept.signals.as_ref().is_some_and(|stage| stage.key == signals_key);
        let measured = kept.measure.as_ref().filter(|stage| current.signals && !stage.key.is_empty());
        let marks = self.measure_parts(dir, prepared, &signals_key).fingerprint(dir).ok()?;
        current.measure = measured.is_some_and(|stage| stage.fingerprint.as_ref() == Some(&marks.hex()));
        Some(current)
    }
}

/// Whether the MCAP file is as ingest left it, or is at least whole and has that key.
fn recording_is_there(session: &str, ingest: &KeptStage, state: Option<&State>, mcap: &Path) -> bool {
    let now = recording_fingerprint(mcap).hex();
    let then = state.and_then(|state| state.output(session, Stage::Ingest).ok().flatten());
    then == Some(now) || ingest::ingest_is_current(mcap, &ingest.key)
}

/// The fingerprint of an MCAP file: size, times and inode, as the system gives them.
pub(super) fn recording_fingerprint(mcap: &Path) -> Fingerprint {
    let mut fingerprint = Fingerprint::default();
    fingerprint.add_file("mcap", mcap);
    fingerprint
}

/// The statuses of the sessions for which nothing has to be done, by name.
pub(super) fn statuses(current: &[&SessionPlan<'_>]) -> BTreeMap<String, SessionStatus> {
    let named = current.iter().filter_map(|plan| Some((plan.dir.name.clone(), plan.kept.status.clone()?)));
    named.collect()
}
