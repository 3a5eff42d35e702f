//! The errors of a configuration file.

use std::path::PathBuf;

/// An error of a configuration file. Lines and columns count from 1.
#[derive(Debug, thiserror::Error)]
pub enum ConfigError {
    /// The file cannot be opened or read.
    #[error("cannot read {path}: {source}")]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The message of the operating system.
        source: std::io::Error,
    },
    /// Far too large for a configuration.
    #[error("{path} is larger than {limit_bytes} bytes: this is not a configuration file")]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Most that is read.
        limit_bytes: u64,
    },
    /// The bytes are not UTF-8.
    #[error("{path}: byte {offset} is not UTF-8: save the file as UTF-8 text")]
    NotUtf8 {
        /// The file.
        path: PathBuf,
        /// Offset of the first bad byte.
        offset: usize,
    },
    /// A key that nothing reads.
    #[error("{path}:{line}:{column}: unknown key '{key}'{}", suggestion(nearest.as_deref(), known))]
    UnknownKey {
        /// The file.
        path: PathBuf,
        /// Line.
        line: usize,
        /// Column.
        column: usize,
        /// The key as written.
        key: String,
        /// The known key that is most like it.
        nearest: Option<String>,
        /// All keys known at that place.
        known: Vec<String>,
    },
    /// Not TOML, a value of the wrong type, a key that is missing.
    #[error("{path}:{line}:{column}: {}{message}", key.as_ref().map(|key| format!("{key}: ")).unwrap_or_default())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Line.
        line: usize,
        /// Column.
        column: usize,
        /// The key at that place, with its table.
        key: Option<String>,
        /// Expected and got.
        message: String,
    },
    /// Well-formed, but the values contradict themselves or make no sense.
    #[error("{path}: {key}: {fact}: {remedy}")]
    Invalid {
        /// The file.
        path: PathBuf,
        /// The key, with its table.
        key: String,
        /// The fault.
        fact: String,
        /// The text to write instead.
        remedy: String,
    },
    /// A name that is neither built in nor a file in the devices folder.
    #[error(
        "unknown {kind} '{name}'{}: known are {}; or write {devices_dir}/{name}.toml",
        nearest.as_ref().map(|near| format!(" (did you mean '{near}'?)")).unwrap_or_default(),
        known.join(", ")
    )]
    UnknownName {
        /// 'camera' or 'device profile'.
        kind: &'static str,
        /// The name as given.
        name: String,
        /// The known name that is most like it.
        nearest: Option<String>,
        /// All known names, sorted.
        known: Vec<String>,
        /// Where files of that name are looked for.
        devices_dir: PathBuf,
    },
}

fn suggestion(nearest: Option<&str>, known: &[String]) -> String {
    match nearest {
        Some(near) => format!(": did you mean '{near}'? Known here: {}", known.join(", ")),
        None => ": no keys are known here".to_owned(),
    }
}
