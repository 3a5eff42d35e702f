//! Opens the SQLite file of a state, to work or only to look; checks it, and sets it aside.

use std::path::{Path, PathBuf};
use std::time::Duration;

use rusqlite::{Connection, ErrorCode, OpenFlags};

use super::WorkError;

/// The version of the tables. A state of another version is set aside, and everything is made anew from the cards and MCAP
/// files.
const STATE_VERSION: i64 = 1;

/// The columns that are read or written; a file without them was not made by this program.
const COLUMNS: &str = "SELECT session, stage, stage.key, fingerprint, made_utc, seconds, output_sha256, status, json, files, id, \
     written.key FROM stage JOIN output USING (session, stage), written LIMIT 0";

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

/// The reason why a state file cannot be opened.
pub(super) enum Refused {
    /// It is damaged, or of an older version of the program.
    Unusable(String),
    Newer(i64),
    Other(rusqlite::Error),
}

impl Refused {
    /// The error with the file's path.
    pub fn error(self, path: &Path) -> WorkError {
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

/// How long to wait for others, who only look, and only for moments.
const BUSY: Duration = Duration::from_secs(30);

/// Opens a state only to look; none when it is of an older program, or was not made by this program.
pub(super) fn look(path: &Path, access: OpenFlags) -> Result<Option<Connection>, Refused> {
    let connection = Connection::open_with_flags(plain(path), access)?;
    connection.busy_timeout(BUSY)?;
    match version(&connection)? {
        STATE_VERSION => check_tables(&connection).map(|()| Some(connection)),
        newer if newer > STATE_VERSION => Err(Refused::Newer(newer)),
        _ => Ok(None),
    }
}

/// Opens a state to work, and makes it where there is none.
pub(super) fn connect(path: &Path) -> Result<Connection, Refused> {
    let connection = Connection::open(plain(path))?;
    connection.busy_timeout(BUSY)?;
    connection.pragma_update(None, "page_size", 32 * 1024)?; // for a new file: outputs are long
    // A rollback journal, not a write-ahead log: work folders lie on network file systems too.
    connection.pragma_update(None, "journal_mode", "DELETE")?;
    connection.pragma_update(None, "synchronous", "FULL")?;
    let verdict: String = connection.query_row("PRAGMA quick_check(1)", [], |row| row.get(0))?;
    if verdict != "ok" {
        return Err(Refused::Unusable(format!("the state file is damaged ({verdict})")));
    }
    match version(&connection)? {
        0 => {
            connection.execute_batch(&format!("BEGIN; {TABLES} PRAGMA user_version = {STATE_VERSION}; COMMIT;"))?;
        }
        STATE_VERSION => {}
        newer if newer > STATE_VERSION => return Err(Refused::Newer(newer)),
        older => return Err(Refused::Unusable(format!("the state file is of version {older}"))),
    }
    check_tables(&connection)?;
    Ok(connection)
}

/// The path in a form that SQLite takes for a plain path: one that begins with `file:` would be a URI.
fn plain(path: &Path) -> PathBuf {
    if path.is_relative() { Path::new(".").join(path) } else { path.to_owned() }
}

fn check_tables(connection: &Connection) -> Result<(), Refused> {
    let other = |why: &str| Err(Refused::Unusable(format!("the state file has other tables ({why})")));
    match connection.prepare(COLUMNS) {
        Ok(_) => Ok(()),
        Err(rusqlite::Error::SqlInputError { msg, .. }) => other(&msg),
        Err(error) if error.sqlite_error_code() == Some(ErrorCode::Unknown) => other(&error.to_string()),
        Err(error) => Err(error.into()),
    }
}

fn version(connection: &Connection) -> rusqlite::Result<i64> {
    connection.query_row("PRAGMA user_version", [], |row| row.get(0))
}

/// Renames the file to `.old`.
pub(super) fn set_aside(path: &Path) -> Result<(), WorkError> {
    let with = |suffix: &str| {
        let mut name = path.as_os_str().to_owned();
        name.push(suffix);
        PathBuf::from(name)
    };
    // A journal belongs to the file that is set aside; beside a new file SQLite would play it into that one.
    let journal = match std::fs::remove_file(with("-journal")) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    };
    let moved = journal.and_then(|()| std::fs::rename(path, with(".old")));
    moved.map_err(|source| WorkError::File { path: path.to_owned(), source })
}
