//! The preset `large`: many sessions for load tests, some of which are damaged where that is asked for.
//!
//! A few poses of each container are drawn once. Every image is one of those, in its own light and with its own noise. The
//! sensors follow the poses, the marks are exact, and the truth is written beside the study. A session follows from the seed and
//! its number alone, so that any number of threads gives the same bytes.

mod camera;
mod damage;
mod gallery;
mod objects;
mod options;
mod plan;
mod session;
#[cfg(test)]
mod tests;

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use model::results::TruthRow;
use rayon::prelude::*;
use serde::Serialize;

pub use damage::Damage;
pub use options::LargeOptions;

use crate::error::SimulateError;
use crate::render::Renderer;
use crate::study::{Simulated, StudyFolder, Summary};
use camera::{camera_of, camera_toml};
use gallery::{Gallery, Noise};
use objects::OBJECTS;
use plan::{Session, Use, random};
use session::SessionWriter;

const CAMERA_FILE: &str = "devices/large-camera.toml";

/// A row of damaged.csv.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
struct DamagedRow<'a> {
    session: &'a str,
    kind: Damage,
    code: &'static str,
}

impl<'a> DamagedRow<'a> {
    fn from_session(session: &'a Session) -> Option<Self> {
        let kind = session.damage?;
        Some(Self { session: &session.name, kind, code: kind.code().code() })
    }
}

/// Writes the study into `out`, a folder that is empty or does not exist yet. `progress` is called after each session, from
/// any thread, with the number of sessions that are done and the total number.
///
/// Memory holds eight pictures, the rays of one, and for each session at work its packets (10 kB per image) and a picture.
///
/// # Errors
/// [`SimulateError::Option`] for an option out of range, [`SimulateError::NotEmpty`] for a folder with something in it,
/// [`SimulateError::Io`] when a file cannot be written. The other errors would be faults of the preset itself.
pub fn large(
    out: &Path,
    options: &LargeOptions,
    progress: &(dyn Fn(u64, u64) + Sync),
) -> Result<Simulated, SimulateError> {
    options.check()?;
    let camera_file = camera_toml(options.size_px);
    let camera = camera_of(&camera_file)?;
    let renderer = Renderer::new(camera);
    let folder = StudyFolder::create(out)?;
    let sessions = Session::all(options);
    write_study_files(&folder, &camera_file, &sessions)?;

    let done = AtomicU64::new(0);
    let noise = Noise::new(&mut random(options.seed, Use::Noise, 0));
    let mut truth: Vec<(usize, Vec<TruthRow>)> = Vec::new();
    for (at, object) in OBJECTS.iter().enumerate() {
        let gallery = Gallery::draw(object, &camera, &renderer, &mut random(options.seed, Use::Poses, at))?;
        let writer = SessionWriter { folder: &folder, options, object, gallery: &gallery, noise: &noise };
        let write = |session: &Session| {
            let rows = writer.write(session)?;
            progress(done.fetch_add(1, Ordering::Relaxed) + 1, sessions.len() as u64);
            Ok((session.number, rows))
        };
        let of_object: Vec<&Session> = sessions.iter().filter(|session| session.object() == at).collect();
        truth.extend(of_object.into_par_iter().map(write).collect::<Result<Vec<_>, SimulateError>>()?);
    }
    truth.sort_by_key(|(number, _)| *number);
    let truth: Vec<TruthRow> = truth.into_iter().flat_map(|(_, rows)| rows).collect();
    let mark_files = truth.iter().filter(|row| row.marked).count();
    Ok(Simulated { summary: Summary { sessions: sessions.len(), images: truth.len(), mark_files }, truth })
}

fn write_study_files(folder: &StudyFolder, camera_file: &str, sessions: &[Session]) -> Result<(), SimulateError> {
    folder.write("README.md", include_bytes!("README.md"))?;
    folder.write("study.toml", include_bytes!("study.toml"))?;
    folder.write(CAMERA_FILE, camera_file.as_bytes())?;
    folder.write_csv("objects.csv", &OBJECTS.map(|object| object.row()))?;
    let damaged: Vec<_> = sessions.iter().filter_map(DamagedRow::from_session).collect();
    if damaged.is_empty() { Ok(()) } else { folder.write_csv("damaged.csv", &damaged) }
}
