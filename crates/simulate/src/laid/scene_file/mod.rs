//! Scene files: users describe a scene in TOML, and the program makes a study of it (docs/simulate.md lists the keys).
//!
//! Every value is checked where it stands, so that an error names the line and the key that is wrong. Values that the file leaves
//! out are random or have a default.

mod camera;
mod containers;
mod frames;
mod light;
mod number;
mod sensors;
mod sessions;
mod surface;
#[cfg(test)]
mod tests;
mod things;

use std::path::Path;
use std::sync::Arc;

use model::CameraSpec;
use serde::Deserialize;

pub use camera::SceneCamera;

use super::plan::Plan;
use super::sensors::SensorErrors;
use super::write::Laid;
use crate::error::SimulateError;
use crate::render::JPEG_QUALITY;
use crate::study::Simulated;
use crate::world::Light;
use containers::{BowlFields, BoxFields, Container, PlateFields};
use frames::Planner;
use light::{LightSpec, PictureSpec};
use number::{Checked, Count, Name};
use sensors::SensorSpec;
use sessions::{Session, SessionFields};
use surface::TableSpec;
use things::{CutlerySpec, GlassSpec, HandFields, HandSpec, NapkinSpec, TelephoneSpec};

/// Version of the scene file that this program reads.
const SCENE_SCHEMA_VERSION: u32 = 1;
/// Greatest length of a session in seconds. Its packets are all made at once, in memory.
const LONGEST_S: f64 = 86_400.0;
const CAMERA: &str = "scene-camera";

/// A scene file. Unknown keys are refused, and so are values out of range.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneSpec {
    schema_version: u32,
    name: Name,
    camera: SceneCamera,
    #[serde(default)]
    seed: Option<u64>,
    jpeg_quality: Option<Count<1, 100>>,
    table: Option<TableSpec>,
    light: Option<Checked<LightSpec, Light>>,
    picture: Option<PictureSpec>,
    sensors: Option<Checked<SensorSpec, SensorErrors>>,
    #[serde(default)]
    plates: Vec<Checked<PlateFields, Container>>,
    #[serde(default)]
    bowls: Vec<Checked<BowlFields, Container>>,
    #[serde(default)]
    boxes: Vec<Checked<BoxFields, Container>>,
    #[serde(default)]
    glasses: Vec<GlassSpec>,
    #[serde(default)]
    cutlery: Vec<CutlerySpec>,
    #[serde(default)]
    napkins: Vec<NapkinSpec>,
    #[serde(default)]
    telephones: Vec<TelephoneSpec>,
    #[serde(default)]
    hands: Vec<Checked<HandFields, HandSpec>>,
    sessions: Vec<Checked<SessionFields, Session>>,
}

impl SceneSpec {
    /// The camera that the file names or describes.
    #[must_use]
    pub fn camera(&self) -> &SceneCamera {
        &self.camera
    }

    /// Seed of all randomness: that of the file, or 1.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.seed.unwrap_or(1)
    }

    /// Writes the study into `out`, a folder that is empty or does not exist yet, with a copy of the scene file (`text`).
    /// `camera` is the one that [`SceneSpec::camera`] stands for. `progress` is called after each picture with the number that are
    /// done and the total number. The same file, camera and seed give the same bytes for any number of threads.
    ///
    /// # Errors
    /// [`SimulateError::Scene`] when parts of the file do not go together, [`SimulateError::SceneCamera`] when `camera` is no camera,
    /// [`SimulateError::NotEmpty`] for a folder with something in it, [`SimulateError::Io`] when a file cannot be written.
    pub fn write(
        &self,
        out: &Path,
        camera: &CameraSpec,
        seed: u64,
        text: &[u8],
        progress: &(dyn Fn(u64, u64) + Sync),
    ) -> Result<Simulated, SimulateError> {
        self.check()?;
        let camera_toml = toml::to_string(camera).map_err(SimulateError::CameraText)?;
        let planner = Planner::new(self, seed, camera.width_px);
        let laid = Laid {
            name: &self.name.0,
            camera_name: CAMERA,
            camera_toml: &camera_toml,
            camera: camera.camera().map_err(SimulateError::SceneCamera)?,
            wares: self.containers().map(|each| (Arc::from(each.name.as_str()), each.ware)).collect(),
            extent: planner.extent(),
            plan: &|number| planner.plan(number),
            seed,
            sensors: self.sensors.as_ref().map_or_else(SensorErrors::default, |sensors| sensors.0),
            jpeg_quality: self.jpeg_quality.and_then(|q| u8::try_from(q.get()).ok()).unwrap_or(JPEG_QUALITY),
            scene: Some(text),
        };
        laid.write(out, progress)
    }

    /// The plans of the sessions, for pictures of this width. Every frame can be photographed and gives its truth without any file.
    ///
    /// # Errors
    /// [`SimulateError::Scene`] when parts of the file do not go together.
    pub fn plans(&self, seed: u64, width_px: u32) -> Result<Vec<Plan>, SimulateError> {
        self.check()?;
        let planner = Planner::new(self, seed, width_px);
        Ok((0..self.sessions.len()).map(|number| planner.plan(number)).collect())
    }

    /// Plates, bowls and boxes, in this order.
    fn containers(&self) -> impl Iterator<Item = &Container> {
        let plates = self.plates.iter().map(|plate| &plate.0);
        plates.chain(self.bowls.iter().map(|bowl| &bowl.0)).chain(self.boxes.iter().map(|each| &each.0))
    }

    /// The containers that are on the table of a session, with their indices among all containers.
    fn served<'a>(&'a self, session: &'a Session) -> Vec<(usize, &'a Container)> {
        let is_served = |each: &Container| session.objects.as_ref().is_none_or(|names| names.contains(&each.name));
        self.containers().enumerate().filter(|(_, each)| is_served(each)).collect()
    }

    /// Refuses a file whose parts do not go together.
    fn check(&self) -> Result<(), SimulateError> {
        if self.schema_version != SCENE_SCHEMA_VERSION {
            let got = self.schema_version;
            let fact = format!("schema_version = {got}: this program reads version {SCENE_SCHEMA_VERSION}");
            return Err(SimulateError::Scene { fact });
        }
        let fault = self.fault_of_names();
        let fault = fault.or_else(|| self.sessions.iter().find_map(|session| self.fault_of(&session.0)));
        fault.map_or(Ok(()), |fact| Err(SimulateError::Scene { fact }))
    }

    fn fault_of_names(&self) -> Option<String> {
        let containers: Vec<&str> = self.containers().map(|each| each.name.as_str()).collect();
        let sessions: Vec<&str> = self.sessions.iter().map(|session| session.0.name.as_str()).collect();
        if sessions.is_empty() {
            return Some("no [[sessions]], expected at least one".to_owned());
        }
        let both = [("containers", containers), ("sessions", sessions)];
        both.iter().find_map(|(what, names)| {
            let name = twice(names)?;
            Some(format!("two {what} are called '{name}', expected names of their own"))
        })
    }

    /// The fault of a session that asks for things that it cannot have; none where it has no fault.
    fn fault_of(&self, session: &Session) -> Option<String> {
        let name = &session.name;
        let names: Vec<&str> = self.containers().map(|each| each.name.as_str()).collect();
        if let Some(unknown) = session.objects.iter().flatten().find(|name| !names.contains(&name.as_str())) {
            let known = names.join(", ");
            return Some(format!("session '{name}': no container is called '{unknown}'; there are: {known}"));
        }
        let served = self.served(session);
        let (images, period_s) = (session.images(served.len()), session.period_s);
        #[expect(clippy::cast_precision_loss, reason = "some thousand images")]
        if images as f64 * period_s > LONGEST_S {
            return Some(format!(
                "session '{name}': {images} images, {period_s} s apart, expected at most a day of them"
            ));
        }
        let [a, b] = standing_in_one_another(&served).filter(|_| !session.one_at_a_time)?;
        Some(format!(
            "session '{name}': '{a}' and '{b}' stand in one another, expected places (at_mm) further apart, or \
             one_at_a_time = true"
        ))
    }
}

/// A name that is there twice. Upper and lower case are the same, as on some file systems.
fn twice<'a>(names: &[&'a str]) -> Option<&'a str> {
    let same = |a: &str, b: &str| a.to_lowercase() == b.to_lowercase();
    names
        .iter()
        .enumerate()
        .find(|(at, name)| names[..*at].iter().any(|other| same(other, name)))
        .map(|(_, name)| *name)
}

/// The names of two containers that stand in one another: the circles that fit into their outlines overlap.
fn standing_in_one_another<'a>(served: &[(usize, &'a Container)]) -> Option<[&'a str; 2]> {
    let meet = |a: &Container, b: &Container| (a.at_mm - b.at_mm).norm() < 0.5 * (a.ware.width_mm + b.ware.width_mm);
    served.iter().enumerate().find_map(|(at, (_, a))| {
        let other = served[at + 1..].iter().find(|(_, b)| meet(a, b))?;
        Some([a.name.as_str(), other.1.name.as_str()])
    })
}
