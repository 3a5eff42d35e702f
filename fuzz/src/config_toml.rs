//! Configuration files. Input: the text, read as each of the kinds that there are.

use std::path::Path;

use ingest::{ConfigError, Profile, config};
use model::CameraSpec;
use pipeline::study::{SessionSpec, StudySpec};
use serde::Serialize;
use serde::de::DeserializeOwned;

const PATH: &str = "x.toml";

/// TOML: an error names the file, a line of it and the key; what is accepted can be written and read again.
pub fn config_toml(input: &[u8]) -> usize {
    let Ok(text) = std::str::from_utf8(input) else { return 0 };
    let path = Path::new(PATH);
    let profile = read::<Profile>(text).filter(|profile| match profile.check(path) {
        Ok(()) => true,
        Err(error) => refused(&error),
    });
    let camera = read::<CameraSpec>(text).filter(|camera| match camera.camera() {
        Ok(_) => true,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            false
        }
    });
    // The MCAP file of a session holds both as text.
    let kept = [profile.map(|profile| kept(&profile)), camera.map(|camera| kept(&camera))];
    let read = [read::<StudySpec>(text).is_some(), read::<SessionSpec>(text).is_some()];
    kept.iter().flatten().count() + read.iter().filter(|read| **read).count()
}

fn read<T: DeserializeOwned>(text: &str) -> Option<T> {
    match config::parse_toml::<T>(text, Path::new(PATH)) {
        Ok(value) => Some(value),
        Err(error) => {
            check_error(&error, text);
            None
        }
    }
}

fn check_error(error: &ConfigError, text: &str) {
    let message = error.to_string();
    assert!(message.starts_with("x.toml:"), "an error names the file: {message}");
    let place = match error {
        ConfigError::UnknownKey { line, column, key, nearest, known, .. } => {
            // A key with escapes is written otherwise.
            assert!(text.contains('\\') || text.contains(key.as_str()), "the key is in the text: {message}");
            assert!(nearest.as_ref().is_none_or(|near| known.contains(near)) && nearest.is_none() == known.is_empty());
            (*line, *column)
        }
        ConfigError::Malformed { line, column, message, .. } => {
            assert!(!message.is_empty() && !message.contains('\n'), "a message is one line: {message}");
            (*line, *column)
        }
        other => panic!("text gives no other errors: {other}"),
    };
    let lines: Vec<&str> = text.split('\n').collect();
    let line = place.0.checked_sub(1).and_then(|line| lines.get(line));
    let columns = line.map(|line| line.chars().count() + 1);
    assert!(columns.is_some_and(|columns| (1..=columns).contains(&place.1)), "{place:?} is in the text: {message}");
}

/// Values that contradict themselves: the message names file, key and remedy.
fn refused(error: &ConfigError) -> bool {
    let ConfigError::Invalid { key, fact, remedy, .. } = error else { panic!("another error: {error}") };
    assert!(error.to_string().starts_with("x.toml: ") && ![key, fact].iter().any(|part| part.is_empty()), "{error}");
    assert!(!remedy.is_empty(), "{error}");
    false
}

/// Compared as text, since NaN is not equal to itself.
fn kept<T: Serialize + DeserializeOwned>(value: &T) {
    let text = toml::to_string(value).expect("what was read can be written");
    let again: T = toml::from_str(&text).expect("what was written can be read");
    assert_eq!(toml::to_string(&again).expect("it was written before"), text);
}
