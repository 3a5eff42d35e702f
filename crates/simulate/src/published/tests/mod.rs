//! Tests of the study as it is read back, without the code that wrote it.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod files;
mod marks;
mod pictures;
mod sensors;

use std::path::{Path, PathBuf};
use std::{fs, io};

use super::*;

/// The study without pictures, in a folder that lives as long as the first value.
fn study(seed: u64) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("study");
    published_bench(&root, &Options { seed, render: false }, &|_, _| {}).unwrap();
    (folder, root)
}

/// All files below `root`, sorted, with paths relative to it.
fn files_below(root: &Path) -> Vec<PathBuf> {
    fn walk(folder: &Path, found: &mut Vec<PathBuf>) -> io::Result<()> {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            if path.is_dir() {
                walk(&path, found)?;
            } else {
                found.push(path);
            }
        }
        Ok(())
    }
    let mut found = Vec::new();
    walk(root, &mut found).unwrap();
    found.sort();
    found.into_iter().map(|path| path.strip_prefix(root).unwrap().to_owned()).collect()
}

fn all_sessions() -> Vec<SessionPlan> {
    sessions(&Published::load().unwrap(), &camera().unwrap()).unwrap()
}
