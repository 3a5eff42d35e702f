//! Plans -> a study on disk.

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use model::{Camera, CameraSpec, Kind};
use serde::Serialize;

use super::catalogue::WARES;
use super::frame::Frame;
use super::plan::Plan;
use super::{bench, worn};
use crate::Summary;
use crate::error::SimulateError;
use crate::study::{ObjectRow, StudyFolder, image_stem, labelme_json};

/// Which of both.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LaidPreset {
    /// Nine setups, eight objects each, empty; the head is a stand.
    Bench,
    /// So many sessions of people eating, with so many images each.
    Worn {
        /// Sessions, 1 to 10,000.
        sessions: u32,
        /// Images of each, 1 to 2000.
        images: u32,
    },
}

/// What is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LaidOptions {
    /// Which preset.
    pub preset: LaidPreset,
    /// Of all randomness.
    pub seed: u64,
    /// Width and height of the pictures, 64 to 8192 px. The field of view is the AIM-2's whatever the size.
    pub size_px: [u32; 2],
}

impl LaidOptions {
    /// Default size of the pictures: half the AIM-2's each way.
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

    fn plans(&self) -> Vec<Plan> {
        match self.preset {
            LaidPreset::Bench => bench(self.seed, self.size_px[0]),
            LaidPreset::Worn { sessions, images } => {
                worn(self.seed, self.size_px[0], sessions as usize, images as usize)
            }
        }
    }

    fn name(&self) -> &'static str {
        match self.preset {
            LaidPreset::Bench => "bench",
            LaidPreset::Worn { .. } => "worn",
        }
    }
}

/// Focal length over width and height of the sensor: the AIM-2's (Raju et al., Table I), and a lens of the division model.
const FOCAL_OVER_SIDE: [f64; 2] = [2.4 / 3.67, 2.4 / 2.74];
const CAMERA_FILE: &str = "devices/laid-camera.toml";
const RATER: &str = "exact";

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

/// A row of truth.csv: one per image and container, or one without a container.
#[derive(Debug, Default, Serialize)]
struct TruthRow {
    session: String,
    image: String,
    pitch_deg: f64,
    roll_deg: f64,
    range_mm: f64,
    range_seen_mm: f64,
    object: Option<&'static str>,
    kind: Option<Kind>,
    true_diameter_mm: Option<f64>,
    true_width_mm: Option<f64>,
    true_length_mm: Option<f64>,
    true_height_mm: Option<f64>,
    rim_level_mm: Option<f64>,
    center_x_mm: Option<f64>,
    center_y_mm: Option<f64>,
    rim_in_picture: Option<f64>,
    rim_seen: Option<f64>,
}

/// Writes the study into `out`, a folder that is empty or does not exist yet. `progress` is called after each picture with the
/// number done and their total. The bytes are the same for any number of threads. Memory: a picture's light (12 bytes per
/// pixel, twice) and the plans (some kB per picture).
///
/// # Errors
/// [`SimulateError::Option`] for an option out of range, [`SimulateError::NotEmpty`] for a folder with something in it,
/// [`SimulateError::Io`] when a file cannot be written. The other errors would be faults of the presets themselves.
pub fn write(
    out: &Path,
    options: &LaidOptions,
    progress: &(dyn Fn(u64, u64) + Sync),
) -> Result<Summary, SimulateError> {
    options.check()?;
    let camera = camera(options.size_px)?;
    let folder = StudyFolder::create(out)?;
    folder.write(CAMERA_FILE, camera_toml(options.size_px).as_bytes())?;
    folder.write("study.toml", study_toml(options.name()).as_bytes())?;
    folder.write("README.md", include_bytes!("README.md"))?;
    folder.write_csv("objects.csv", &WARES.map(|(object, ware)| object_row(object, &ware)))?;
    let plans = options.plans();
    let (done, total) = (AtomicU64::new(0), plans.iter().map(|plan| plan.frames.len() as u64).sum());
    let (mut rows, mut mark_files, mut images) = (Vec::new(), 0, 0);
    for plan in &plans {
        write_card(&folder, plan, options.seed, &camera)?;
        for frame in &plan.frames {
            let (truths, is_marked) = write_frame(&folder, plan, frame, &camera)?;
            rows.extend(truths);
            mark_files += usize::from(is_marked);
            images += 1;
            progress(done.fetch_add(1, Ordering::Relaxed) + 1, total);
        }
    }
    folder.write_csv("truth.csv", &rows)?;
    Ok(Summary { sessions: plans.len(), images, mark_files })
}

fn study_toml(name: &str) -> String {
    format!(
        "# A simulated study; README.md says how it was made.\nschema_version = 1\nname = \"{name}\"\n\
         statement = \"Simulated: rendered pictures and modelled sensors, with known truth.\"\n\
         time_zone = \"UTC\"\ndevice_profile = \"aim2-packets\"\ncamera = \"laid-camera\"\n"
    )
}

fn object_row(object: &'static str, ware: &super::Ware) -> ObjectRow {
    let is_round = ware.kind != Kind::Box;
    ObjectRow {
        object,
        kind: ware.kind,
        shape: ware.shape(),
        true_diameter_mm: is_round.then_some(ware.diameter_mm),
        true_width_mm: (!is_round).then_some(ware.width_mm),
        true_length_mm: (!is_round).then_some(ware.diameter_mm),
        true_height_mm: (ware.kind != Kind::Plate).then_some(ware.height_mm),
        rim_height_mm: is_round.then_some(ware.rim_level_mm()),
    }
}

fn write_card(folder: &StudyFolder, plan: &Plan, seed: u64, camera: &Camera) -> Result<(), SimulateError> {
    let card = format!("cards/{}", plan.name);
    let toml = match plan.setup {
        Some((height_mm, pitch_deg)) => {
            format!("setup_height_mm = {height_mm:.1}\nsetup_pitch_deg = {pitch_deg:.1}\n")
        }
        None => format!("participant = \"P{:03}\"\n", plan.number + 1),
    };
    folder.write(&format!("{card}/session.toml"), toml.as_bytes())?;
    folder.write(&format!("{card}/SENSORS/ACC0001.BIN"), &plan.acceleration(seed).concat())?;
    folder.write(&format!("{card}/SENSORS/RNG0001.BIN"), &plan.range(seed, camera)?.concat())
}

fn write_frame(
    folder: &StudyFolder,
    plan: &Plan,
    frame: &Frame,
    camera: &Camera,
) -> Result<(Vec<TruthRow>, bool), SimulateError> {
    let view = frame.view(camera)?;
    let stem = image_stem(plan.start().plus_seconds(frame.time_s))?;
    let image = format!("IMAGES/{stem}.JPG");
    let path = format!("cards/{}/{image}", plan.name);
    folder.write(&path, &frame.photograph(&view).to_jpeg(&path)?)?;
    let marks = frame.marks(&view);
    if !marks.is_empty() {
        let json = labelme_json(&format!("../../../{path}"), camera.size_px(), &marks)?;
        folder.write(&format!("marks/{RATER}/{}/{stem}.json", plan.name), &json)?;
    }
    let row = || TruthRow {
        session: plan.name.clone(),
        image: image.clone(),
        pitch_deg: frame.head.pitch_deg,
        roll_deg: frame.head.roll_deg,
        range_mm: frame.head.range_mm,
        range_seen_mm: frame.cone_mm(&view),
        ..TruthRow::default()
    };
    let mut rows: Vec<TruthRow> = frame.truths(&view).iter().map(|truth| truth.row(row())).collect();
    if rows.is_empty() {
        rows.push(row());
    }
    Ok((rows, !marks.is_empty()))
}

impl super::Truth {
    fn row(&self, row: TruthRow) -> TruthRow {
        TruthRow {
            object: Some(self.object),
            kind: Some(self.kind),
            true_diameter_mm: self.true_diameter_mm,
            true_width_mm: self.true_width_mm,
            true_length_mm: self.true_length_mm,
            true_height_mm: Some(self.true_height_mm),
            rim_level_mm: Some(self.rim_level_mm),
            center_x_mm: Some(self.center_x_mm),
            center_y_mm: Some(self.center_y_mm),
            rim_in_picture: Some(self.rim_in_picture),
            rim_seen: Some(self.rim_seen),
            ..row
        }
    }
}
