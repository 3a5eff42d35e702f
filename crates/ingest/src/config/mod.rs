//! Configuration files: TOML in which an unknown key is an error that names the nearest known one.

mod error;
mod locate;

pub use error::ConfigError;
pub use locate::nearest;

use std::fs::File;
use std::io::Read;
use std::path::Path;

use serde::de::DeserializeOwned;

/// Larger than any configuration written by hand; keeps a mistaken path (a 10 GB video) out of memory.
const LARGEST_FILE_BYTES: u64 = 4 * 1024 * 1024;

/// Reads a TOML file.
///
/// `T` should carry `#[serde(deny_unknown_fields)]`: an unknown key is then reported with the nearest known key.
///
/// # Errors
/// [`ConfigError`] when the file cannot be read, is not TOML, or does not fit `T`.
pub fn read_toml<T: DeserializeOwned>(path: &Path) -> Result<T, ConfigError> {
    parse_toml(&read_text(path)?, path)
}

/// Parses TOML. `path` is only for messages.
///
/// # Errors
/// [`ConfigError`] when the text is not TOML or does not fit `T`.
pub fn parse_toml<T: DeserializeOwned>(text: &str, path: &Path) -> Result<T, ConfigError> {
    toml::from_str(text).map_err(|error| locate::config_error(&error, text, path))
}

/// Reads a configuration file as text.
///
/// # Errors
/// [`ConfigError`] when the file cannot be read, is far too large for a configuration, or is not UTF-8.
pub fn read_text(path: &Path) -> Result<String, ConfigError> {
    let unreadable = |source| ConfigError::Unreadable { path: path.to_owned(), source };
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(unreadable)?;
    file.take(LARGEST_FILE_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST_FILE_BYTES {
        return Err(ConfigError::TooLarge { path: path.to_owned(), limit_bytes: LARGEST_FILE_BYTES });
    }
    String::from_utf8(bytes)
        .map_err(|error| ConfigError::NotUtf8 { path: path.to_owned(), offset: error.utf8_error().valid_up_to() })
}
