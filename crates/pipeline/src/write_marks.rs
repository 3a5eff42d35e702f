//! Writes found rims as files of marks that a person can check and correct.

use std::collections::BTreeMap;
use std::io::{self, Write as _};
use std::path::{Component, Path, PathBuf};

use ingest::card::entry_named;
use model::Stage;

use crate::labelme::{AutoRim, text_of};
use crate::session::{Prepared, SessionOutput};
use crate::study::{AUTO, SessionDir, Study, stem_of};
use crate::work::{WorkError, WorkFolder};

/// The files that were written, or left alone.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct MarksWritten {
    /// The number of files with rims that are now in the folder as they would be written.
    pub files: usize,
    /// The number of files that were there with other content: somebody's corrections, or the rims of another run. They were
    /// left alone.
    pub left: usize,
}

/// The reason why marks were not written.
#[derive(Debug, thiserror::Error)]
pub enum WriteMarksError {
    /// The work folder cannot be used.
    #[error(transparent)]
    Work(#[from] WorkError),
    /// The output that is kept there cannot be read.
    #[error("session '{session}': what was kept of it cannot be read: {source}; run with --force")]
    Kept {
        /// The name of the session.
        session: String,
        /// The error behind it.
        source: serde_json::Error,
    },
    /// A file cannot be written.
    #[error("cannot write the marks: {source}: {}", path.display())]
    File {
        /// The file or folder.
        path: PathBuf,
        /// The error behind it.
        source: io::Error,
    },
}

/// Writes the rims that the last run of `study` in `work_dir` found: `folder/auto/SESSION/IMAGE.json`, LabelMe files as in
/// `marks/` of a study. A file that is there and differs is left alone.
///
/// # Errors
/// [`WriteMarksError`]; what was written until then stays.
pub fn write_marks(
    study: &Study,
    work_dir: &Path,
    program: &str,
    folder: &Path,
) -> Result<MarksWritten, WriteMarksError> {
    let work = WorkFolder::open(work_dir, program)?;
    let mut written = MarksWritten::default();
    for dir in &study.sessions {
        let Some(text) = work.state.output(&dir.name, Stage::Measure)? else { continue };
        let refuse = |source| WriteMarksError::Kept { session: dir.name.clone(), source };
        let output: SessionOutput = serde_json::from_str(&text).map_err(refuse)?;
        if let (false, Ok(prepared)) = (output.auto.is_empty(), Prepared::new(study, dir, program)) {
            let session = Writer { dir, prepared: &prepared, folder: there_or_new(&folder.join(AUTO), &dir.name) };
            session.write(&output.auto, &mut written)?;
        }
    }
    Ok(written)
}

/// Writes the files of one session.
struct Writer<'a> {
    dir: &'a SessionDir,
    prepared: &'a Prepared,
    folder: PathBuf,
}

impl Writer<'_> {
    fn write(&self, auto: &BTreeMap<String, Vec<AutoRim>>, written: &mut MarksWritten) -> Result<(), WriteMarksError> {
        std::fs::create_dir_all(&self.folder).map_err(|source| failed(&self.folder, source))?;
        let mut by_stem: BTreeMap<String, Vec<&String>> = BTreeMap::new();
        for image in auto.keys() {
            by_stem.entry(stem_of(image)).or_default().push(image);
        }
        for (stem, images) in by_stem {
            let &[image] = images.as_slice() else {
                let session = &self.dir.name;
                tracing::warn!(session, stem, "{} images have this name, so none of them gets a file", images.len());
                continue;
            };
            let rims = auto.get(image).map(Vec::as_slice).unwrap_or_default();
            let picture_px = self.prepared.marks_camera.1.size_px();
            let text = text_of(rims, &picture_for(&self.folder, self.dir, self.prepared, image), picture_px)
                .map_err(io::Error::from);
            let path = there_or_new(&self.folder, &format!("{stem}.json"));
            let done =
                text.and_then(|text| write_unless_other(&path, &text)).map_err(|source| failed(&path, source))?;
            *(if done { &mut written.files } else { &mut written.left }) += 1;
        }
        Ok(())
    }
}

/// The path by which LabelMe opens the picture, from the folder of the marks: on the card, or beside the marks where people
/// mark other pictures than those of the card.
pub(crate) fn picture_for(folder: &Path, dir: &SessionDir, prepared: &Prepared, image: &str) -> String {
    let beside = || image.rsplit('/').next().unwrap_or(image).to_owned();
    let is_recorded = prepared.camera == prepared.marks_camera.1;
    let picture = dir
        .card
        .as_ref()
        .filter(|_| is_recorded)
        .map(|card| image.split('/').fold(card.clone(), |folder, part| there_or_new(&folder, part)));
    picture.and_then(|picture| relative_path(folder, &picture)).unwrap_or_else(beside)
}

/// The file or folder of this name, in whatever Unicode form it is there; else the place for a new one.
fn there_or_new(folder: &Path, name: &str) -> PathBuf {
    entry_named(folder, name).unwrap_or_else(|| folder.join(name))
}

fn failed(path: &Path, source: io::Error) -> WriteMarksError {
    WriteMarksError::File { path: path.to_owned(), source }
}

/// Whether the file now holds this text. A file that held another text is left alone.
fn write_unless_other(path: &Path, text: &str) -> io::Result<bool> {
    match std::fs::read(path) {
        Ok(there) => return Ok(there == text.as_bytes()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {}
        Err(error) => return Err(error),
    }
    write_whole(path, text)?;
    Ok(true)
}

/// Writes a file aside and renames it.
pub(crate) fn write_whole(path: &Path, text: &str) -> io::Result<()> {
    let partial = path.with_extension("json.partial"); // half a file would be taken for marks
    let mut file = std::fs::File::create(&partial)?;
    file.write_all(text.as_bytes())?;
    file.sync_all()?;
    std::fs::rename(&partial, path)
}

/// The way from a folder to a file, with `/`; none where there is no way (another drive), or no such file.
fn relative_path(folder: &Path, file: &Path) -> Option<String> {
    let (folder, file) = (folder.canonicalize().ok()?, file.canonicalize().ok()?);
    let shared = folder.components().zip(file.components()).take_while(|(a, b)| a == b).count();
    if shared == 0 {
        return None;
    }
    let up = folder.components().skip(shared).map(|_| "..".to_owned());
    let down = file
        .components()
        .skip(shared)
        .map(|component: Component<'_>| component.as_os_str().to_string_lossy().into_owned());
    Some(up.chain(down).collect::<Vec<_>>().join("/"))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    #[test]
    fn a_file_that_differs_is_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        assert!(write_unless_other(&path, "mine").unwrap());
        assert!(write_unless_other(&path, "mine").unwrap(), "as it would be written");
        assert!(!write_unless_other(&path, "other").unwrap());
        assert_eq!(std::fs::read(&path).unwrap(), b"mine");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn the_way_to_a_picture() {
        let folder = tempfile::tempdir().unwrap();
        let (marks, card) = (folder.path().join("marks/auto/S1"), folder.path().join("cards/S1"));
        std::fs::create_dir_all(&marks).unwrap();
        std::fs::create_dir_all(&card).unwrap();
        std::fs::write(card.join("a b.JPG"), b"").unwrap();
        let way = relative_path(&marks, &card.join("a b.JPG"));
        assert_eq!(way.as_deref(), Some("../../../cards/S1/a b.JPG"));
        assert_eq!(relative_path(&marks, &card.join("b.JPG")), None, "not there");
    }
}
