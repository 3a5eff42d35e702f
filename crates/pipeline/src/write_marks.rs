//! Writes found rims as files of marks that a person can check and correct.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write as _};
use std::path::{Component, Path, PathBuf};

use ingest::card::entry_named;
use ingest::orientation_of_file;
use model::{Orientation, Stage};

use crate::labelme::{AutoRim, MarkedPicture, MarksAuthor, author_of, read_bytes, seal_in, text_of};
use crate::session::{Prepared, SessionOutput};
use crate::study::{AUTO, SessionDir, Study, marks_in, stem_of};
use crate::work::{WorkError, WorkFolder};

/// The files that were written, or left alone.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct MarksWritten {
    /// The number of files with rims that are now in the folder as they would be written.
    pub files: usize,
    /// The number of files that a person has made or corrected. They were left alone.
    pub corrected: usize,
    /// The number of files with the rims of another run. They were left alone.
    pub of_other_run: usize,
}

impl MarksWritten {
    fn count(&mut self, done: Done) {
        *match done {
            Done::AsWritten => &mut self.files,
            Done::LeftCorrected => &mut self.corrected,
            Done::LeftOtherRun => &mut self.of_other_run,
        } += 1;
    }
}

/// What became of one file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Done {
    /// It holds what was to be written.
    AsWritten,
    /// It holds a person's marks, and was left alone.
    LeftCorrected,
    /// It holds the rims of another run, and was left alone.
    LeftOtherRun,
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
        let Ok(prepared) = Prepared::new(study, dir, program) else { continue };
        let session = Writer { study, dir, prepared: &prepared, folder: there_or_new(&folder.join(AUTO), &dir.name) };
        if !output.auto.is_empty() {
            session.write(&output.auto, &mut written)?;
        }
        written.corrected += session.corrected_without_rims(&output.auto);
    }
    Ok(written)
}

/// Writes the files of one session.
struct Writer<'a> {
    study: &'a Study,
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
            let picture = marked_on_card(self.study, self.dir, self.prepared, image)
                .map_err(|(path, source)| failed(&path, source))?;
            let text = text_of(rims, &picture_for(&self.folder, self.dir, self.prepared, image), picture)
                .map_err(io::Error::from);
            let path = there_or_new(&self.folder, &format!("{stem}.json"));
            let done =
                text.and_then(|text| write_unless_other(&path, &text)).map_err(|source| failed(&path, source))?;
            written.count(done);
        }
        Ok(())
    }

    /// The number of files that a person has made for images in which the program found nothing.
    fn corrected_without_rims(&self, auto: &BTreeMap<String, Vec<AutoRim>>) -> usize {
        let with_rims: BTreeSet<String> = auto.keys().map(|image| stem_of(image)).collect();
        let is_corrected = |path: &PathBuf| {
            !with_rims.contains(&stem_of(&path.to_string_lossy()))
                && read_bytes(path).is_ok_and(|bytes| author_of(&bytes) == MarksAuthor::Person)
        };
        marks_in(&self.folder).unwrap_or_default().iter().filter(|path| is_corrected(path)).count()
    }
}

/// The path by which LabelMe opens the picture, from the folder of the marks: on the card, or beside the marks where people
/// mark other pictures than those of the card.
pub(crate) fn picture_for(folder: &Path, dir: &SessionDir, prepared: &Prepared, image: &str) -> String {
    let beside = || image.rsplit('/').next().unwrap_or(image).to_owned();
    let is_recorded = prepared.camera == prepared.marks_camera.1;
    let picture = on_card(dir, image).filter(|_| is_recorded);
    picture.and_then(|picture| relative_path(folder, &picture)).unwrap_or_else(beside)
}

/// The file of a picture of a session's card.
fn on_card(dir: &SessionDir, image: &str) -> Option<PathBuf> {
    let card = dir.card.as_ref()?;
    Some(image.split('/').fold(card.clone(), |folder, part| there_or_new(&folder, part)))
}

/// A picture of a session's card, as somebody may mark it.
///
/// # Errors
/// The file, and the system's error, where it cannot be read.
pub(crate) fn marked_on_card(
    study: &Study,
    dir: &SessionDir,
    prepared: &Prepared,
    image: &str,
) -> Result<MarkedPicture, (PathBuf, io::Error)> {
    let orientation = match on_card(dir, image) {
        Some(path) => orientation_of_file(&path).map_err(|error| (path, error))?,
        None => Orientation::Upright,
    };
    Ok(prepared.marked_picture(study, orientation))
}

/// The file or folder of this name, in whatever Unicode form it is there; else the place for a new one.
fn there_or_new(folder: &Path, name: &str) -> PathBuf {
    entry_named(folder, name).unwrap_or_else(|| folder.join(name))
}

fn failed(path: &Path, source: io::Error) -> WriteMarksError {
    WriteMarksError::File { path: path.to_owned(), source }
}

/// Writes a new file. One that is there is left alone, whatever it holds.
fn write_unless_other(path: &Path, text: &str) -> io::Result<Done> {
    match std::fs::read(path) {
        Ok(there) if there == text.as_bytes() => return Ok(Done::AsWritten),
        Ok(there) => {
            return Ok(match seal_in(&there) {
                None => Done::LeftCorrected,
                same if same == seal_in(text.as_bytes()) => Done::AsWritten, // somebody looked at it, and saved it
                Some(_) => Done::LeftOtherRun,
            });
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => {}
        Err(error) => return Err(error),
    }
    write_whole(path, text)?;
    Ok(Done::AsWritten)
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
        assert_eq!(write_unless_other(&path, "mine").unwrap(), Done::AsWritten);
        assert_eq!(write_unless_other(&path, "mine").unwrap(), Done::AsWritten, "as it would be written");
        assert_eq!(write_unless_other(&path, "other").unwrap(), Done::LeftCorrected, "no seal");
        assert_eq!(std::fs::read(&path).unwrap(), b"mine");
        let sealed = text_of(&[], "a.jpg", [4, 3]).unwrap();
        std::fs::write(&path, &sealed).unwrap();
        let again = sealed.replace("5.4.1", "6.3.1");
        assert_ne!(again, sealed);
        assert_eq!(write_unless_other(&path, &again).unwrap(), Done::AsWritten, "the same marks");
        let with_rim = sealed.replace("\"marks_sha256\": \"", "\"marks_sha256\": \"0");
        assert_eq!(write_unless_other(&path, &with_rim).unwrap(), Done::LeftOtherRun);
        assert_eq!(std::fs::read(&path).unwrap(), sealed.as_bytes());
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
