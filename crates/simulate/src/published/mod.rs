//! The preset `published-bench`: the paper's bench, rebuilt from its published readings.
//!
//! The raw data of the paper is not public. This study has cards whose sensors read the values that the paper printed, and marks
//! that are worked back, through the equations of the paper, from the predictions that it printed. The study proves arithmetic,
//! selection, statistics and layout of Tables II-VI. It proves nothing about accuracy.

mod bench;
mod card;
mod catalogue;
mod expected;
mod placement;
mod plan;
mod printed;
mod tables;
mod worn;

use std::path::Path;

use model::Camera;

use crate::error::SimulateError;
use crate::render::Renderer;
use crate::study::{StudyFolder, Summary};
use card::CardWriter;
use plan::SessionPlan;
use tables::Published;

/// The options of the preset `published-bench`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Seed of all noise. The same seed gives the same study.
    pub seed: u64,
    /// Whether pictures are drawn (87 of 5 megapixels, which take about a minute on two cores). Everything else is written either way.
    pub render: bool,
}

impl Default for Options {
    /// The seed of the sample in `data-samples/published-bench`, and pictures.
    fn default() -> Self {
        Self { seed: 1, render: true }
    }
}

const CAMERA_FILE: &str = "devices/bench-camera.toml";
const CAMERA: &str = include_str!("bench-camera.toml");

/// Writes the study into `out`, a folder that is empty or does not exist yet. `progress` is called after each image with
/// the number of images that are done and the total number.
///
/// # Errors
/// [`SimulateError::NotEmpty`] for a folder with something in it, [`SimulateError::Io`] when a file cannot be written.
/// The other errors would be faults of the preset itself; its tests rule them out.
pub fn published_bench(
    out: &Path,
    options: &Options,
    progress: &(dyn Fn(u64, u64) + Sync),
) -> Result<Summary, SimulateError> {
    let published = Published::load()?;
    let camera = camera()?;
    let sessions = sessions(&published, &camera)?;
    let folder = StudyFolder::create(out)?;
    write_study_files(&folder, &published)?;

    let writer = CardWriter {
        folder: &folder,
        seed: options.seed,
        size_px: camera.size_px(),
        renderer: options.render.then(|| Renderer::new(camera)),
    };
    let total = sessions.iter().map(|session| session.shots.len()).sum::<usize>();
    let mut summary = Summary { sessions: sessions.len(), images: 0, mark_files: 0 };
    for session in &sessions {
        writer.write_sensors(session)?;
        for shot in &session.shots {
            writer.write_shot(session, shot)?;
            summary.images += 1;
            summary.mark_files += shot.marks.len();
            progress(summary.images as u64, total as u64);
        }
    }
    Ok(summary)
}

/// The camera of the study, with AIM-2's published geometry and a lens coefficient of our own.
fn camera() -> Result<Camera, SimulateError> {
    let spec: model::CameraSpec =
        toml::from_str(CAMERA).map_err(|source| SimulateError::CameraFile { name: CAMERA_FILE, source })?;
    spec.camera().map_err(|source| SimulateError::Camera { name: CAMERA_FILE, source })
}

fn sessions(published: &Published, camera: &Camera) -> Result<Vec<SessionPlan>, SimulateError> {
    let mut sessions = bench::sessions(published, camera)?;
    sessions.extend(worn::sessions(published, camera)?);
    Ok(sessions)
}

fn write_study_files(folder: &StudyFolder, published: &Published) -> Result<(), SimulateError> {
    folder.write("README.md", include_bytes!("README.md"))?;
    folder.write("study.toml", include_bytes!("study.toml"))?;
    folder.write(CAMERA_FILE, CAMERA.as_bytes())?;
    folder.write_csv("objects.csv", &catalogue::objects(published))?;
    printed::write(folder, published)?;
    expected::write(folder, published)
}

#[cfg(test)]
mod tests;
