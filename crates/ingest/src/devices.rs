//! Cameras and device profiles by name: the study's own first, then the built-in ones.

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

use crate::card::entry_named;
use crate::config::{self, ConfigError};

/// The built-in files of one kind.
pub(crate) struct Shelf {
    /// The noun for them in messages.
    pub kind: &'static str,
    /// Name and text of each.
    pub built_in: &'static [(&'static str, &'static str)],
    /// A file in the devices folder is of this kind when it has one of these top-level keys.
    pub marks: &'static [&'static str],
}

/// Finds and reads a file. `name_or_path`: a name, or a path that ends in `.toml` (relative to `devices_dir`).
pub(crate) fn find<T: DeserializeOwned>(
    shelf: &Shelf,
    name_or_path: &str,
    devices_dir: &Path,
) -> Result<(PathBuf, T), ConfigError> {
    if Path::new(name_or_path).extension().is_some_and(|extension| extension == "toml") {
        let path = entry_named(devices_dir, name_or_path).unwrap_or_else(|| devices_dir.join(name_or_path));
        return config::read_toml(&path).map(|value| (path, value));
    }
    // A name is one path component: '../x' is no name.
    let is_name = !name_or_path.is_empty() && !name_or_path.contains(['/', '\\']);
    let file = format!("{name_or_path}.toml");
    if let Some(path) = entry_named(devices_dir, &file).filter(|path| is_name && path.is_file()) {
        return config::read_toml(&path).map(|value| (path, value));
    }
    match shelf.built_in.iter().find(|(name, _)| *name == name_or_path) {
        Some((name, text)) => {
            let path = PathBuf::from(format!("built-in {} '{name}'", shelf.kind));
            config::parse_toml(text, &path).map(|value| (path, value))
        }
        None => Err(unknown(shelf, name_or_path, devices_dir)),
    }
}

fn unknown(shelf: &Shelf, name: &str, devices_dir: &Path) -> ConfigError {
    let mut known: Vec<String> = shelf.built_in.iter().map(|(name, _)| (*name).to_owned()).collect();
    known.extend(own_names(shelf, devices_dir));
    known.sort();
    known.dedup();
    let nearest = config::nearest(name, &known);
    ConfigError::UnknownName {
        kind: shelf.kind,
        name: name.to_owned(),
        nearest,
        known,
        devices_dir: devices_dir.to_owned(),
    }
}

fn own_names(shelf: &Shelf, devices_dir: &Path) -> Vec<String> {
    let Ok(entries) = std::fs::read_dir(devices_dir) else { return Vec::new() };
    let is_of_kind = |path: &Path| {
        config::read_toml::<toml::Table>(path).is_ok_and(|table| shelf.marks.iter().any(|key| table.contains_key(*key)))
    };
    entries
        .filter_map(|entry| entry.ok().map(|e| e.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml") && is_of_kind(path))
        .filter_map(|path| path.file_stem().map(|stem| stem.to_string_lossy().into_owned()))
        .collect()
}
