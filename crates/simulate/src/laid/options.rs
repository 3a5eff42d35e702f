//! The presets `bench` and `worn`, and their camera.

use std::path::Path;

use model::{Camera, CameraSpec};

use super::catalogue::WARES;
use super::plan::Plan;
use super::sensors::SensorErrors;
use super::write::Laid;
use super::{bench, worn};
use crate::error::SimulateError;
use crate::render::JPEG_QUALITY;
use crate::study::Simulated;

/// One of the two presets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LaidPreset {
    /// Nine setups with eight empty objects each. The camera is on a stand.
    Bench,
    /// Sessions of people who eat.
    Worn {
        /// Number of sessions, 1 to 10,000.
        sessions: u32,
        /// Number of images of each session, 1 to 2000.
        images: u32,
    },
}

/// The options of both presets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LaidOptions {
    /// The preset.
    pub preset: LaidPreset,
    /// Seed of all randomness.
    pub seed: u64,
    /// Width and height of the pictures, 64 to 8192 px. The field of view is AIM-2's for any size.
    pub size_px: [u32; 2],
}

impl LaidOptions {
    /// Default size of the pictures, which is half of AIM-2's each way.
    pub const SIZE_PX: [u32; 2] = [1296, 972];

    fn check(&self) -> Result<(), SimulateError> {
        let refuse = |option, got: String, expected: &str| {
            Err(SimulateError::Option { option, got, expected: expected.to_owned() })
        };
        if self.size_px.iter().any(|side| !(64..=8192).contains(side)) {
            let got = format!("{}x{}", self.size_px[0], self.size_px[1]);
            return refuse("--image-size", got, "64 to 8192 px each way");
        }
        match self.preset {
            LaidPreset::Worn { sessions, .. } if !(1..=10_000).contains(&sessions) => {
                refuse("--sessions", sessions.to_string(), "1 to 10000")
            }
            LaidPreset::Worn { images, .. } if !(1..=2000).contains(&images) => {
                refuse("--images", images.to_string(), "1 to 2000")
            }
            _ => Ok(()),
        }
    }

    fn plan(&self, number: usize) -> Plan {
        match self.preset {
            LaidPreset::Bench => bench::session(self.seed, self.size_px[0], number),
            LaidPreset::Worn { images, .. } => worn::session(self.seed, self.size_px[0], number, images as usize),
        }
    }

    /// The number of sessions, and that of all images.
    fn extent(&self) -> (usize, u64) {
        match self.preset {
            LaidPreset::Bench => (bench::SESSIONS, (bench::SESSIONS * WARES.len()) as u64),
            LaidPreset::Worn { sessions, images } => (sessions as usize, u64::from(sessions) * u64::from(images)),
        }
    }

    fn name(&self) -> &'static str {
        match self.preset {
            LaidPreset::Bench => "bench",
            LaidPreset::Worn { .. } => "worn",
        }
    }
}

/// Focal length over width and over height of the sensor, which are AIM-2's (Raju et al., Table I).
const FOCAL_OVER_SIDE: [f64; 2] = [2.4 / 3.67, 2.4 / 2.74];
const CAMERA: &str = "laid-camera";
const CAMERA_FILE: &str = "devices/laid-camera.toml";

/// The text of the camera file. The lens has the division model.
fn camera_toml([width_px, height_px]: [u32; 2]) -> String {
    let [width, height] = [width_px, height_px].map(f64::from);
    format!(
        "# The AIM-2's field of view in pictures of {width_px} x {height_px} px, with barrel distortion.\n\
         schema_version = 1\nname = \"laid-camera\"\nwidth_px = {width_px}\nheight_px = {height_px}\n\
         focal_px = [{:?}, {:?}]\nprincipal_px = [{:?}, {:?}]\n\n[lens]\nmodel = \"division\"\nlambda = -0.1\n",
        FOCAL_OVER_SIDE[0] * width,
        FOCAL_OVER_SIDE[1] * height,
        0.503 * width,
        0.494 * height,
    )
}

/// The camera of both presets.
///
/// # Errors
/// [`SimulateError::CameraFile`] and [`SimulateError::Camera`], which would be faults of the preset.
pub fn camera(size_px: [u32; 2]) -> Result<Camera, SimulateError> {
    let spec: CameraSpec = toml::from_str(&camera_toml(size_px))
        .map_err(|source| SimulateError::CameraFile { name: CAMERA_FILE, source })?;
    spec.camera().map_err(|source| SimulateError::Camera { name: CAMERA_FILE, source })
}

/// Writes the study into `out`, a folder that is empty or does not exist yet. `progress` is called after each picture with the
/// number of pictures that are done and the total number. The bytes are the same for any number of threads. Memory holds the
/// light of a picture (12 bytes per pixel, twice), the plan of a session (some 10 kB per picture) and the truth.
///
/// # Errors
/// [`SimulateError::Option`] for an option out of range, [`SimulateError::NotEmpty`] for a folder with something in it,
/// [`SimulateError::Io`] when a file cannot be written. The other errors would be faults of the presets themselves.
pub fn write(
    out: &Path,
    options: &LaidOptions,
    progress: &(dyn Fn(u64, u64) + Sync),
) -> Result<Simulated, SimulateError> {
    options.check()?;
    let laid = Laid {
        name: options.name(),
        camera_name: CAMERA,
        camera_toml: &camera_toml(options.size_px),
        camera: camera(options.size_px)?,
        wares: WARES.map(|(object, ware)| (object.into(), ware)).to_vec(),
        extent: options.extent(),
        plan: &|number| options.plan(number),
        seed: options.seed,
        sensors: SensorErrors::default(),
        jpeg_quality: JPEG_QUALITY,
        scene: None,
    };
    laid.write(out, progress)
}
