//! The state of a work folder, in an SQLite file, which survives a kill at any moment and opens in common tools.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use jiff::Timestamp;
use model::{SessionStatus, Stage};
use rusqlite::{Connection, ErrorCode, OpenFlags, OptionalExtension as _, params};

use super::database::{Refused, connect, look, set_aside};
use super::{Kept, KeptStage, WorkError};
use crate::inputs::sha256_of_bytes;

/// The results that were written last.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Written {
    /// SHA-256 of everything that went into them.
    pub key: String,
    /// The fingerprint of their files.
    pub files: String,
}

/// The output of a stage, to be kept.
pub(crate) struct StageOutput<'a> {
    pub key: &'a str,
    pub fingerprint: Option<String>,
    pub seconds: f64,
    pub output: &'a str,
    pub status: Option<&'a SessionStatus>,
}

/// The open state. Every change is on disk when a call returns.
pub(crate) struct State {
    path: PathBuf,
    connection: Mutex<Connection>,
}

impl State {
    /// Opens the state, and makes it where there is none. A file that is damaged or of an older program is set aside as
    /// `state.sqlite.old`.
    pub fn open(path: &Path) -> Result<Self, WorkError> {
        match connect(path) {
            Ok(connection) => Ok(Self { path: path.to_owned(), connection: Mutex::new(connection) }),
            Err(Refused::Unusable(why)) => {
                tracing::warn!("{why}; it is set aside as state.sqlite.old, and made anew: {}", path.display());
                set_aside(path)?;
                let connection = connect(path).map_err(|refused| refused.error(path))?;
                Ok(Self { path: path.to_owned(), connection: Mutex::new(connection) })
            }
            Err(refused) => Err(refused.error(path)),
        }
    }

    /// Opens the state only to look, also while a run is at work; none when there is no usable state.
    pub fn open_to_look(path: &Path) -> Result<Option<Self>, WorkError> {
        if !path.is_file() {
            return Ok(None);
        }
        let looked = match look(path, OpenFlags::SQLITE_OPEN_READ_ONLY) {
            // A killed run left a journal. SQLite undoes what that run had begun, as the next run would.
            Err(Refused::Other(error)) if error.sqlite_error_code() == Some(ErrorCode::ReadOnly) => {
                look(path, OpenFlags::SQLITE_OPEN_READ_WRITE)
            }
            other => other,
        };
        match looked {
            Ok(connection) => {
                Ok(connection.map(|connection| Self { path: path.to_owned(), connection: Mutex::new(connection) }))
            }
            Err(Refused::Unusable(_)) => Ok(None),
            Err(refused) => Err(refused.error(path)),
        }
    }

    /// The stages that are kept, by session.
    pub fn kept_by_session(&self) -> Result<BTreeMap<String, Kept>, WorkError> {
        self.with(|db| {
            let mut kept: BTreeMap<String, Kept> = BTreeMap::new();
            let columns = "session, stage, key, fingerprint, made_utc, seconds, output_sha256, status";
            let mut query = db.prepare(&format!("SELECT {columns} FROM stage"))?;
            let mut rows = query.query([])?;
            while let Some(row) = rows.next()? {
                let Some(stage) = unless_odd(stage_of(row))? else { continue };
                let (session, name, stage, status) = stage;
                let session = kept.entry(session).or_default();
                match name.as_str() {
                    "ingest" => session.ingest = Some(stage),
                    "signals" => session.signals = Some(stage),
                    "measure" => {
                        session.status = status.and_then(|text| serde_json::from_str(&text).ok());
                        // Without its status a session is measured again.
                        session.measure = session.status.is_some().then_some(stage);
                    }
                    _ => {}
                }
            }
            Ok(kept)
        })
    }

    /// The output of a stage of a session; none where it is not what was written.
    pub fn output(&self, session: &str, stage: Stage) -> Result<Option<String>, WorkError> {
        let stored: Option<(String, String)> = self.with(|db| {
            let query = "SELECT json, output_sha256 FROM stage JOIN output USING (session, stage) \
                         WHERE session = ?1 AND stage = ?2";
            let row = db.query_row(query, [session, stage.code()], |row| Ok((row.get(0)?, row.get(1)?)));
            Ok(unless_odd(row.optional())?.flatten())
        })?;
        let good = stored.filter(|(output, sha256)| sha256_of_bytes(output.as_bytes()) == *sha256);
        Ok(good.map(|(output, _)| output))
    }

    /// Keeps the output of a stage of a session, and returns its SHA-256.
    pub fn keep(&self, session: &str, stage: Stage, output: &StageOutput<'_>) -> Result<String, WorkError> {
        let status = output.status.map(serde_json::to_string).transpose()?;
        let sha256 = sha256_of_bytes(output.output.as_bytes());
        self.with(|db| {
            let (name, now) = (stage.code(), Timestamp::now().to_string());
            let StageOutput { key, fingerprint, seconds, output, .. } = output;
            let both = db.unchecked_transaction()?;
            let stage = "INSERT OR REPLACE INTO stage \
                (session, stage, key, fingerprint, made_utc, seconds, output_sha256, status) \
                VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)";
            both.execute(stage, params![session, name, key, fingerprint, now, seconds, sha256, status])?;
            let insert = "INSERT OR REPLACE INTO output (session, stage, json) VALUES (?1, ?2, ?3)";
            both.execute(insert, params![session, name, output])?;
            both.commit()
        })?;
        Ok(sha256)
    }

    /// Records that the input files of a stage were looked at again and have not changed.
    pub fn touch(&self, session: &str, stage: Stage, fingerprint: Option<&str>) -> Result<(), WorkError> {
        let update = "UPDATE stage SET fingerprint = ?3 WHERE session = ?1 AND stage = ?2";
        self.with(|db| db.execute(update, params![session, stage.code(), fingerprint])).map(|_| ())
    }

    /// Deletes all stages of a session.
    pub fn forget(&self, session: &str) -> Result<(), WorkError> {
        self.with(|db| {
            let both = db.unchecked_transaction()?;
            both.execute("DELETE FROM stage WHERE session = ?1", [session])?;
            both.execute("DELETE FROM output WHERE session = ?1", [session])?;
            both.commit()
        })
    }

    /// The results that were written last.
    pub fn written(&self) -> Result<Option<Written>, WorkError> {
        self.with(|db| {
            let written = |row: &rusqlite::Row<'_>| Ok(Written { key: row.get(0)?, files: row.get(1)? });
            Ok(unless_odd(db.query_row("SELECT key, files FROM written", [], written).optional())?.flatten())
        })
    }

    /// Remembers the results that were written.
    pub fn set_written(&self, written: &Written) -> Result<(), WorkError> {
        let insert = "INSERT OR REPLACE INTO written (id, key, files) VALUES (1, ?1, ?2)";
        self.with(|db| db.execute(insert, params![written.key, written.files])).map(|_| ())
    }

    fn with<T>(&self, work: impl FnOnce(&Connection) -> rusqlite::Result<T>) -> Result<T, WorkError> {
        work(&self.lock()).map_err(|source| WorkError::State { path: self.path.clone(), source })
    }

    fn lock(&self) -> MutexGuard<'_, Connection> {
        self.connection.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The columns of a row of stages: session, stage, what is kept, status.
fn stage_of(row: &rusqlite::Row<'_>) -> rusqlite::Result<(String, String, KeptStage, Option<String>)> {
    let stage = KeptStage {
        key: row.get(2)?,
        fingerprint: row.get(3)?,
        made_utc: row.get(4)?,
        seconds: row.get(5)?,
        output_sha256: row.get(6)?,
    };
    Ok((row.get(0)?, row.get(1)?, stage, row.get(7)?))
}

/// The value; none where its type is wrong. SQLite keeps values of any type in any column, and one of another type was not
/// written by this program.
fn unless_odd<T>(value: rusqlite::Result<T>) -> rusqlite::Result<Option<T>> {
    use rusqlite::Error::{FromSqlConversionFailure, IntegralValueOutOfRange, InvalidColumnType};
    match value {
        Err(FromSqlConversionFailure(..) | IntegralValueOutOfRange(..) | InvalidColumnType(..)) => Ok(None),
        other => other.map(Some),
    }
}
