//! Writes a study to disk from the plans of its sessions.

use std::path::Path;
use std::sync::Arc;

use model::results::TruthRow;
use model::{Camera, Kind, Quantity, View};

use super::frame::{Frame, Truth};
use super::plan::Plan;
use super::sensors::SensorErrors;
use super::ware::Ware;
use crate::error::SimulateError;
use crate::study::{ObjectRow, Simulated, StudyFolder, Summary, image_stem, labelme_json};

const RATER: &str = "exact";

/// Everything that a study is made from.
pub(super) struct Laid<'a> {
    /// Its name.
    pub name: &'a str,
    /// Name of its camera.
    pub camera_name: &'a str,
    /// Text of the camera's file.
    pub camera_toml: &'a str,
    /// The camera that the file describes.
    pub camera: Camera,
    /// Its containers, with their names.
    pub wares: Vec<(Arc<str>, Ware)>,
    /// Number of its sessions, and number of all images.
    pub extent: (usize, u64),
    /// A function that returns the plan of a session from its number.
    pub plan: &'a dyn Fn(usize) -> Plan,
    /// Seed of the noise of the sensors.
    pub seed: u64,
    pub sensors: SensorErrors,
    /// Quality of the JPEG pictures, from 1 to 100.
    pub jpeg_quality: u8,
    /// The scene file that the study is made from, if it is made from one.
    pub scene: Option<&'a [u8]>,
}

impl Laid<'_> {
    /// Writes the study into `out`. `progress` is called after each picture with the number that are done and the total number.
    pub(super) fn write(&self, out: &Path, progress: &(dyn Fn(u64, u64) + Sync)) -> Result<Simulated, SimulateError> {
        let folder = StudyFolder::create(out)?;
        self.write_study_files(&folder)?;
        let (sessions, total) = self.extent;
        let (mut truth, mut mark_files, mut images) = (Vec::new(), 0, 0);
        for plan in (0..sessions).map(self.plan) {
            self.write_card(&folder, &plan)?;
            for frame in &plan.frames {
                let (rows, is_marked) = self.write_frame(&folder, &plan, frame)?;
                truth.extend(rows);
                mark_files += usize::from(is_marked);
                images += 1;
                progress(images as u64, total);
            }
        }
        Ok(Simulated { summary: Summary { sessions, images, mark_files }, truth })
    }

    fn write_study_files(&self, folder: &StudyFolder) -> Result<(), SimulateError> {
        folder.write(&format!("devices/{}.toml", self.camera_name), self.camera_toml.as_bytes())?;
        let study = format!(
            "# A simulated study; README.md says how it was made.\nschema_version = 1\nname = {}\n\
             statement = \"Simulated: rendered pictures and modelled sensors, with known truth.\"\n\
             time_zone = \"UTC\"\ndevice_profile = \"aim2-packets\"\ncamera = {}\n",
            quoted(self.name),
            quoted(self.camera_name),
        );
        folder.write("study.toml", study.as_bytes())?;
        folder.write("README.md", include_bytes!("README.md"))?;
        if let Some(scene) = self.scene {
            folder.write("scene.toml", scene)?;
        }
        let rows: Vec<ObjectRow> = self.wares.iter().map(|(object, ware)| object_row(object, ware)).collect();
        folder.write_csv("objects.csv", &rows)
    }

    fn write_card(&self, folder: &StudyFolder, plan: &Plan) -> Result<(), SimulateError> {
        let card = format!("cards/{}", plan.name);
        let mut toml = String::new();
        if let Some(participant) = &plan.participant {
            toml += &format!("participant = {}\n", quoted(participant));
        }
        if let Some((height_mm, pitch_deg)) = plan.setup {
            toml += &format!("setup_height_mm = {height_mm:.1}\nsetup_pitch_deg = {pitch_deg:.1}\n");
        }
        folder.write(&format!("{card}/session.toml"), toml.as_bytes())?;
        let acceleration = plan.acceleration(self.seed, &self.sensors);
        folder.write(&format!("{card}/SENSORS/ACC0001.BIN"), &acceleration.concat())?;
        let range = plan.range(self.seed, &self.camera, &self.sensors)?;
        folder.write(&format!("{card}/SENSORS/RNG0001.BIN"), &range.concat())
    }

    /// Writes a picture and its marks. Returns its truth, and whether it is marked.
    fn write_frame(
        &self,
        folder: &StudyFolder,
        plan: &Plan,
        frame: &Frame,
    ) -> Result<(Vec<TruthRow>, bool), SimulateError> {
        let view = frame.view(&self.camera)?;
        let stem = image_stem(plan.start().plus_seconds(frame.time_s))?;
        let image = format!("IMAGES/{stem}.JPG");
        let path = format!("cards/{}/{image}", plan.name);
        folder.write(&path, &frame.photograph(&view).to_jpeg_of_quality(&path, self.jpeg_quality)?)?;
        let marks = frame.marks(&view);
        if !marks.is_empty() {
            let json = labelme_json(&format!("../../../{path}"), self.camera.size_px(), &marks)?;
            folder.write(&format!("marks/{RATER}/{}/{stem}.json", plan.name), &json)?;
        }
        let is_marked = |object: &str| marks.iter().any(|line| line.object == object);
        Ok((truth_rows(plan, frame, &view, &image, is_marked), !marks.is_empty()))
    }
}

/// The text as a string of TOML.
fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

fn object_row(object: &str, ware: &Ware) -> ObjectRow {
    ObjectRow {
        object: object.to_owned(),
        kind: ware.kind,
        shape: ware.shape,
        true_diameter_mm: ware.across_mm(Quantity::Diameter),
        true_width_mm: ware.across_mm(Quantity::Width),
        true_length_mm: ware.across_mm(Quantity::Length),
        true_height_mm: (ware.kind != Kind::Plate).then_some(ware.height_mm),
        rim_height_mm: (ware.kind != Kind::Box).then_some(ware.rim_level_mm()),
    }
}

fn truth_rows(plan: &Plan, frame: &Frame, view: &View, image: &str, is_marked: impl Fn(&str) -> bool) -> Vec<TruthRow> {
    let head = frame.head;
    let time_utc = plan.start().plus_seconds(frame.time_s);
    let of_image = TruthRow {
        participant: plan.participant.clone(),
        range_seen_mm: Some(frame.cone_mm(view)),
        ..TruthRow::of_image(&plan.name, image, time_utc, [head.pitch_deg, head.roll_deg, head.range_mm])
    };
    let mut truths = frame.truths(view);
    truths.sort_by(|a, b| a.object.cmp(&b.object));
    if truths.is_empty() {
        return vec![of_image];
    }
    truths.iter().map(|truth| truth.row(of_image.clone(), is_marked(&truth.object))).collect()
}

impl Truth {
    fn row(&self, of_image: TruthRow, marked: bool) -> TruthRow {
        TruthRow {
            object: Some(self.object.to_string()),
            kind: Some(self.kind),
            shape: Some(self.shape),
            true_diameter_mm: self.true_diameter_mm,
            true_width_mm: self.true_width_mm,
            true_length_mm: self.true_length_mm,
            true_height_mm: Some(self.true_height_mm),
            rim_level_mm: Some(self.rim_level_mm),
            center_x_mm: Some(self.center_x_mm),
            center_y_mm: Some(self.center_y_mm),
            turn_deg: Some(self.turn_deg),
            rim_in_picture: Some(self.rim_in_picture),
            rim_seen: Some(self.rim_seen),
            marked,
            ..of_image
        }
    }
}
