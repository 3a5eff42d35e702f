//! Rectangular plates without marks: `run --shapes`, `measure --auto --shapes`.

use std::path::{Path, PathBuf};

use model::results::TruthRow;
use model::{Level, Method, Quantity, ResultRow, Shape};
use serde_json::Value;

use crate::support::{assert_exit, files_below, run, stdout};

/// One plate on a plain table, from three poses in the window; sensors with almost no errors.
const SCENE: &str = r#"
schema_version = 1
name = "tray"
seed = 3
jpeg_quality = 92

[camera]
schema_version = 1
name = "c"
width_px = 800
height_px = 600
focal_px = [520.0, 520.0]
principal_px = [401.0, 296.0]
lens = { model = "division", lambda = -0.1 }

[table]
texture = { wood = { colours = [[0.25, 0.13, 0.07], [0.20, 0.10, 0.06]] } }
gloss_pct = 0

[light]
lamp_mm = [-250, 350, 1300]

[sensors]
zero_g_offset_mg = [0, 0, 0]
acceleration_noise_mg = 1
range_scale_pct = 0
range_noise_pct = 0.2
range_lost_pct = 0
range_held_pct = 0

[[plates]]
name = "plate"
at_mm = [0, 310]
turn_deg = 20
width_mm = 160
length_mm = 220
height_mm = 20
well_mm = 164
glaze = { plain = { colour = [0.75, 0.73, 0.68] } }

[[sessions]]
name = "S1"
participant = "P01"
poses = [
  { pitch_deg = 55, height_mm = 440, aim_mm = [0, 310] },
  { pitch_deg = 58, height_mm = 460, roll_deg = 3, yaw_deg = 8, aim_mm = [10, 300] },
  { pitch_deg = 51, height_mm = 430, roll_deg = -2, yaw_deg = -6, aim_mm = [-5, 320] },
]
"#;

struct Made {
    folder: tempfile::TempDir,
    truth: Vec<TruthRow>,
}

impl Made {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let scene = folder.path().join("scene.toml");
        std::fs::write(&scene, SCENE).unwrap();
        let study = folder.path().join("study");
        assert_exit(&run(["simulate", scene.to_str().unwrap(), "-o", study.to_str().unwrap()]), 0);
        let (truth, _) = report::read_truth(&study.join("truth.parquet")).unwrap();
        Self { folder, truth }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn run(&self, name: &str, more: &[&str]) -> Vec<ResultRow> {
        let (study, out) = (self.path("study"), self.path(name));
        let fixed = ["run", study.to_str().unwrap(), "--out", out.to_str().unwrap()];
        assert_exit(&run(fixed.iter().chain(more)), 0);
        report::Results::read(&out).unwrap().rows
    }

    /// The file below the study whose path ends like this.
    fn file(&self, end: &str) -> PathBuf {
        let study = self.path("study");
        let is_it = |path: &Path| path.to_string_lossy().replace('\\', "/").ends_with(end);
        study.join(files_below(&study).into_keys().find(|path| is_it(Path::new(path))).unwrap())
    }
}

#[test]
fn a_rectangular_plate_is_found_named_measured_written_and_read_back() {
    let made = Made::new();
    let by_default = made.run("round.parquet", &["--marks", "auto"]);
    assert!(by_default.iter().all(|row| row.shape == Shape::Circle), "rectangles are looked for where asked");
    let marks = made.path("study/marks");
    let auto = ["--marks", "auto", "--shapes", "rectangle", "--write-marks", marks.to_str().unwrap()];
    let rows = made.run("auto.parquet", &auto);
    assert!(rows.iter().all(|row| row.rater == "auto" && row.object == "auto-1"), "one plate, one name");
    assert!(rows.iter().all(
        |row| row.shape == Shape::Rectangle && row.flags.contains("rim_height_common") || row.level == Level::Fused
    ));
    for (quantity, true_mm) in [(Quantity::Width, 160.0), (Quantity::Length, 220.0)] {
        let of_level = |level: Level| {
            let is_one =
                move |row: &&ResultRow| (row.quantity, row.level, row.method) == (quantity, level, Method::Ray);
            rows.iter().filter(is_one)
        };
        assert_eq!(of_level(Level::Frame).count(), 3);
        let fused = of_level(Level::Fused).next().unwrap();
        let (found_mm, sigma_mm) = (fused.predicted_mm.unwrap(), fused.sigma_mm.unwrap());
        assert!((found_mm / true_mm - 1.0).abs() < 0.03, "{quantity}: {found_mm} mm");
        assert!((found_mm - true_mm).abs() < 2.5 * sigma_mm && sigma_mm < 0.06 * true_mm, "{found_mm} +- {sigma_mm}");
    }
    // What was written is read back to the same sizes, with no search.
    let again = made.run("both.parquet", &["--marks", "both"]);
    let again: Vec<ResultRow> = again.into_iter().filter(|row| row.rater == "auto").collect();
    assert_eq!(again, rows);
}

#[test]
fn one_picture_with_and_without_rectangles() {
    let made = Made::new();
    let truth = &made.truth[0];
    let (picture, camera) = (made.file(&truth.image), made.file("scene-camera.toml"));
    let overlay = made.path("overlay.png");
    let pose = [("pitch", truth.pitch_deg), ("roll", truth.roll_deg), ("range", truth.range_mm)];
    let measure = |more: &[&str]| {
        let mut arguments = vec!["measure".to_owned(), picture.display().to_string(), "--auto".to_owned()];
        arguments.push(format!("--camera={}", camera.display()));
        arguments.extend(pose.iter().map(|(name, value)| format!("--{name}={value}")));
        arguments.extend(more.iter().map(|one| (*one).to_owned()));
        run(&arguments)
    };
    let rows = |more: &[&str]| -> Vec<Value> {
        let output = measure(more);
        assert_exit(&output, 0);
        serde_json::from_str(&stdout(&output)).unwrap()
    };
    let found =
        rows(&["--shapes=circle,rectangle", "--rim-height=20", "--json", "--overlay", overlay.to_str().unwrap()]);
    let rectangles: Vec<&Value> = found.iter().filter(|row| row["shape"] == "rectangle").collect();
    assert_eq!(rectangles.len(), 4, "two sizes by each of two methods");
    for row in rectangles {
        assert_eq!((&row["kind"], &row["rim_height_from"]), (&"plate".into(), &"given".into()));
        assert!(row["confidence"].as_f64().unwrap() > 0.5 && row["rim_px"].as_array().unwrap().len() == 4);
        let true_mm = if row["quantity"] == "width" { 160.0 } else { 220.0 };
        let by_ray = row["method"] == "ray";
        assert!(!by_ray || (row["predicted_mm"].as_f64().unwrap() / true_mm - 1.0).abs() < 0.01, "{row}");
    }
    assert!(std::fs::metadata(&overlay).unwrap().len() > 0);
    assert!(rows(&["--json"]).iter().all(|row| row["shape"] == "circle"));
    assert_exit(&measure(&["--shapes=square"]), 2);
}
