//! The state of a work folder: an SQLite file, which survives a kill at any moment and opens in tools that people have.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use jiff::Timestamp;
use model::{SessionStatus, Stage};
use rusqlite::{Connection, ErrorCode, OpenFlags, OptionalExtension as _, params};

use super::{Kept, KeptStage, WorkError};
use crate::inputs::sha256_of_bytes;

/// Version of the tables. Another one's state is set aside, and all is made anew from the cards and MCAP files.
const STATE_VERSION: i64 = 1;

const TABLES: &str = "
    CREATE TABLE IF NOT EXISTS stage (
        session       TEXT NOT NULL,
        stage         TEXT NOT NULL,  -- ingest, signals, measure
        key           TEXT NOT NULL,  -- SHA-256 of what it was made from; empty: to be done again
        fingerprint   TEXT,           -- of its input files: names, sizes, times
        made_utc      TEXT NOT NULL,
        seconds       REAL NOT NULL,
        output_sha256 TEXT NOT NULL,
        status        TEXT,           -- JSON: how the session fared, of stage measure
        PRIMARY KEY (session, stage)
    );
    CREATE TABLE IF NOT EXISTS output ( -- apart, so that a look at all stages does not read them
        session       TEXT NOT NULL,
        stage         TEXT NOT NULL,
        json          TEXT NOT NULL,
        PRIMARY KEY (session, stage)
    );
    CREATE TABLE IF NOT EXISTS written (
        id    INTEGER PRIMARY KEY CHECK (id = 1),
        key   TEXT NOT NULL,          -- SHA-256 of all that went into the files of results
        files TEXT NOT NULL           -- fingerprint of those files
    );";

/// What was last written as results.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Written {
    /// SHA-256 of all that went in.
    pub key: String,
    /// Fingerprint of the files.
    pub files: String,
}

/// What a stage gave.
pub(crate) struct StageOutput<'a> {
    pub key: &'a str,
    pub fingerprint: Option<String>,
    pub seconds: f64,
    pub output: &'a str,
    pub status: Option<&'a SessionStatus>,
}

/// The open state. Every change is on disk when the call returns.
pub(crate) struct State {
    path: PathBuf,
    connection: Mutex<Connection>,
}

impl State {
    /// Opens or makes it. A file that is damaged or of an older program is set aside as `state.sqlite.old`.
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

    /// Opens it to look, beside a run at work; none when there is no usable state.
    pub fn open_to_look(path: &Path) -> Result<Option<Self>, WorkError> {
        if !path.is_file() {
            return Ok(None);
        }
        let open = || -> rusqlite::Result<Option<Connection>> {
            let connection = Connection::open_with_flags(path, OpenFlags::SQLITE_OPEN_READ_ONLY)?;
            connection.busy_timeout(BUSY)?;
            Ok((version(&connection)? == STATE_VERSION).then_some(connection))
        };
        match open() {
            Ok(connection) => {
                Ok(connection.map(|connection| Self { path: path.to_owned(), connection: Mutex::new(connection) }))
            }
            Err(error) if is_damage(&error) => Ok(None),
            Err(source) => Err(WorkError::State { path: path.to_owned(), source }),
        }
    }

    /// What is kept, by session.
    pub fn all(&self) -> Result<BTreeMap<String, Kept>, WorkError> {
        self.with(|db| {
            let mut kept: BTreeMap<String, Kept> = BTreeMap::new();
            let columns = "session, stage, key, fingerprint, made_utc, seconds, output_sha256, status";
            let mut query = db.prepare(&format!("SELECT {columns} FROM stage"))?;
            let mut rows = query.query([])?;
            while let Some(row) = rows.next()? {
                let stage = KeptStage {
                    key: row.get(2)?,
                    fingerprint: row.get(3)?,
                    made_utc: row.get(4)?,
                    seconds: row.get(5)?,
                    output_sha256: row.get(6)?,
                };
                let session = kept.entry(row.get(0)?).or_default();
                match row.get::<_, String>(1)?.as_str() {
                    "ingest" => session.ingest = Some(stage),
                    "signals" => session.signals = Some(stage),
                    "measure" => {
                        let status: Option<String> = row.get(7)?;
                        session.status = status.and_then(|text| serde_json::from_str(&text).ok());
                        // Without its status a session is measured anew.
                        session.measure = session.status.is_some().then_some(stage);
                    }
                    _ => {}
                }
            }
            Ok(kept)
        })
    }

    /// What a stage of a session gave; none when it is not what was written.
    pub fn output(&self, session: &str, stage: Stage) -> Result<Option<String>, WorkError> {
        let found: Option<(String, String)> = self.with(|db| {
            let query = "SELECT json, output_sha256 FROM stage JOIN output USING (session, stage) \
                         WHERE session = ?1 AND stage = ?2";
            db.query_row(query, [session, stage.code()], |row| Ok((row.get(0)?, row.get(1)?))).optional()
        })?;
        let good = found.filter(|(output, sha256)| sha256_of_bytes(output.as_bytes()) == *sha256);
        Ok(good.map(|(output, _)| output))
    }

    /// Keeps what a stage of a session gave; gives its SHA-256.
    pub fn keep(&self, session: &str, stage: Stage, output: &StageOutput<'_>) -> Result<String, WorkError> {
        let status = output.status.map(serde_json::to_string).transpose()?;
        let sha256 = sha256_of_bytes(output.output.as_bytes());
        self.with(|db| {
            let (name, now) = (stage.code(), Timestamp::now().to_string());
            let StageOutput { key, fingerprint, seconds, output, .. } = output;
            let both = db.unchecked_transaction()?;
            let stage = "INSERT OR REPLACE INTO stage VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)";
            both.execute(stage, params![session, name, key, fingerprint, now, seconds, sha256, status])?;
            both.execute("INSERT OR REPLACE INTO output VALUES (?1, ?2, ?3)", params![session, name, output])?;
            both.commit()
        })?;
        Ok(sha256)
    }

    /// The input files of a stage were looked at again, and are what they were.
    pub fn touch(&self, session: &str, stage: Stage, fingerprint: Option<&str>) -> Result<(), WorkError> {
        let update = "UPDATE stage SET fingerprint = ?3 WHERE session = ?1 AND stage = ?2";
        self.with(|db| db.execute(update, params![session, stage.code(), fingerprint])).map(|_| ())
    }

    /// Forgets a session.
    pub fn forget(&self, session: &str) -> Result<(), WorkError> {
        self.with(|db| {
            let both = db.unchecked_transaction()?;
            both.execute("DELETE FROM stage WHERE session = ?1", [session])?;
            both.execute("DELETE FROM output WHERE session = ?1", [session])?;
            both.commit()
        })
    }

    /// What was last written as results.
    pub fn written(&self) -> Result<Option<Written>, WorkError> {
        self.with(|db| {
            let found = |row: &rusqlite::Row<'_>| Ok(Written { key: row.get(0)?, files: row.get(1)? });
            db.query_row("SELECT key, files FROM written", [], found).optional()
        })
    }

    /// Remembers what was written as results.
    pub fn set_written(&self, written: &Written) -> Result<(), WorkError> {
        let insert = "INSERT OR REPLACE INTO written VALUES (1, ?1, ?2)";
        self.with(|db| db.execute(insert, params![written.key, written.files])).map(|_| ())
    }

    fn with<T>(&self, work: impl FnOnce(&Connection) -> rusqlite::Result<T>) -> Result<T, WorkError> {
        work(&self.lock()).map_err(|source| WorkError::State { path: self.path.clone(), source })
    }

    fn lock(&self) -> MutexGuard<'_, Connection> {
        self.connection.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Why a state file cannot be opened.
enum Refused {
    /// It is damaged, or of an older program.
    Unusable(String),
    Newer(i64),
    Other(rusqlite::Error),
}

impl Refused {
    fn error(self, path: &Path) -> WorkError {
        let path = path.to_owned();
        match self {
            Self::Newer(got) => WorkError::Newer { path, expected: STATE_VERSION, got },
            Self::Other(source) => WorkError::State { path, source },
            Self::Unusable(why) => WorkError::Unusable { path, why },
        }
    }
}

impl From<rusqlite::Error> for Refused {
    fn from(error: rusqlite::Error) -> Self {
        if is_damage(&error) {
            Self::Unusable(format!("the state file is damaged ({error})"))
        } else {
            Self::Other(error)
        }
    }
}

fn is_damage(error: &rusqlite::Error) -> bool {
    matches!(error.sqlite_error_code(), Some(ErrorCode::DatabaseCorrupt | ErrorCode::NotADatabase))
}

/// Others only look, for moments.
const BUSY: Duration = Duration::from_secs(30);

fn connect(path: &Path) -> Result<Connection, Refused> {
    let connection = Connection::open(path)?;
    connection.busy_timeout(BUSY)?;
    connection.pragma_update(None, "page_size", 32 * 1024)?; // for a new file: outputs are long
    // A rollback journal, not a write-ahead log: work folders lie on network file systems too.
    connection.pragma_update(None, "journal_mode", "DELETE")?;
    connection.pragma_update(None, "synchronous", "FULL")?;
    let found: String = connection.query_row("PRAGMA quick_check(1)", [], |row| row.get(0))?;
    if found != "ok" {
        return Err(Refused::Unusable(format!("the state file is damaged ({found})")));
    }
    match version(&connection)? {
        0 => {
            connection.execute_batch(&format!("BEGIN; {TABLES} PRAGMA user_version = {STATE_VERSION}; COMMIT;"))?;
        }
        STATE_VERSION => {}
        newer if newer > STATE_VERSION => return Err(Refused::Newer(newer)),
        older => return Err(Refused::Unusable(format!("the state file is of version {older}"))),
    }
    Ok(connection)
}

fn version(connection: &Connection) -> rusqlite::Result<i64> {
    connection.query_row("PRAGMA user_version", [], |row| row.get(0))
}

fn set_aside(path: &Path) -> Result<(), WorkError> {
    let with = |suffix: &str| PathBuf::from(format!("{}{suffix}", path.display()));
    // A journal belongs to the file that is set aside; beside a new one it would be played into it.
    let journal = match std::fs::remove_file(with("-journal")) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    };
    let moved = journal.and_then(|()| std::fs::rename(path, with(".old")));
    moved.map_err(|source| WorkError::Folder { path: path.to_owned(), source })
}
