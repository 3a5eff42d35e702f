//! Small studies of the built-in profile `csv`: photographs with the sensor readings that their poses give.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

/// Sensor samples per second; the accelerometer is still for [`STILL_S`] around each image.
const RATE_HZ: i32 = 64;
const STILL_S: i32 = 3;
/// Seconds between images.
const PERIOD_S: i32 = 10;
/// 2024-01-01T00:00:00Z.
const START_S: i32 = 1_704_067_200;

/// One picture with its pose and its marks.
#[derive(Clone)]
pub struct Shot {
    pub picture: Vec<u8>,
    pub extension: &'static str,
    pub pitch_deg: f64,
    pub roll_deg: f64,
    pub range_mm: f64,
    /// LabelMe file of rater `A`, if it is marked.
    pub marks: Option<Value>,
}

/// A study in a temporary folder.
pub struct StudyFolder {
    folder: tempfile::TempDir,
}

impl StudyFolder {
    /// With study.toml (camera `cam`, profile `csv`, and `more` at its end) and objects.csv.
    pub fn new(more: &str, objects: &str, camera: &str) -> Self {
        let study = Self { folder: tempfile::tempdir().unwrap() };
        study.write(
            "study.toml",
            format!("schema_version = 1\nname = \"test\"\ndevice_profile = \"csv\"\ncamera = \"cam\"\n{more}"),
        );
        study.write("objects.csv", objects);
        study.write("devices/cam.toml", camera);
        study
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    pub fn write(&self, file: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path().join(file);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, content).unwrap();
        path
    }

    /// Name of the `i`-th picture of a session, without extension.
    pub fn image_stem(i: usize) -> String {
        let seconds = PERIOD_S * (i32::try_from(i).unwrap() + 1);
        format!("20240101T{:02}{:02}{:02}.000Z", seconds / 3600, seconds / 60 % 60, seconds % 60)
    }

    /// A card whose sensors saw the poses of `shots`, with their pictures and marks.
    pub fn session(&self, name: &str, shots: &[Shot]) {
        let (mut accel, mut range) = ("time_s,x_g,y_g,z_g\n".to_owned(), "time_s,range_mm\n".to_owned());
        for (i, shot) in shots.iter().enumerate() {
            let stem = Self::image_stem(i);
            self.write(&format!("cards/{name}/images/{stem}.{}", shot.extension), &shot.picture);
            if let Some(marks) = &shot.marks {
                self.write(&format!("marks/A/{name}/{stem}.json"), marks.to_string());
            }
            let at_s = START_S + PERIOD_S * (i32::try_from(i).unwrap() + 1);
            let [x, y, z] = at_rest_g(shot.pitch_deg, shot.roll_deg);
            for step in -STILL_S * RATE_HZ..=STILL_S * RATE_HZ {
                let time_s = f64::from(at_s) + f64::from(step) / f64::from(RATE_HZ);
                writeln!(accel, "{time_s},{x},{y},{z}").unwrap();
                writeln!(range, "{time_s},{}", shot.range_mm).unwrap();
            }
        }
        self.write(&format!("cards/{name}/accel.csv"), accel);
        self.write(&format!("cards/{name}/range.csv"), range);
    }
}

/// The reading of an accelerometer at rest (it feels the table's push, upwards) for a camera that looks `pitch_deg` down.
fn at_rest_g(pitch_deg: f64, roll_deg: f64) -> [f64; 3] {
    let (sin_pitch, cos_pitch) = pitch_deg.to_radians().sin_cos();
    let (sin_roll, cos_roll) = roll_deg.to_radians().sin_cos();
    [-sin_roll * cos_pitch, -cos_roll * cos_pitch, -sin_pitch]
}

/// A LabelMe file.
pub fn label_me(shapes: Vec<Value>) -> Value {
    json!({"version": "5.4.1", "flags": {}, "shapes": shapes, "imagePath": "x.jpg", "imageData": null})
}

/// A line in a LabelMe file.
pub fn line(label: &str, ends: [[f64; 2]; 2]) -> Value {
    json!({"label": label, "points": ends, "group_id": null, "shape_type": "line", "flags": {}})
}

/// A polygon in a LabelMe file.
pub fn outline(label: &str, points: &[[f64; 2]]) -> Value {
    json!({"label": label, "points": points, "group_id": null, "shape_type": "polygon", "flags": {}})
}

/// A camera file for [`small_picture`].
pub fn small_camera() -> String {
    "schema_version = 1\nname = \"c\"\nwidth_px = 64\nheight_px = 48\nfocal_px = [60.0, 60.0]\n\
     principal_px = [32.0, 24.0]\n[lens]\nmodel = \"none\"\n"
        .to_owned()
}

/// A black JPEG of 64 x 48 px.
pub fn small_picture() -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbImage::new(64, 48).write_to(&mut bytes, image::ImageFormat::Jpeg).unwrap();
    bytes.into_inner()
}
