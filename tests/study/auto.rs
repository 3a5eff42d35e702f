//! `run --marks auto`: rims found in rendered pictures, named, measured, written for LabelMe and read back.

use std::path::{Path, PathBuf};
use std::process::Output;

use model::{Camera, LensModel, Level, Method, Pose, Quantity, ResultRow, SessionStatus, Severity, View};
use nalgebra::Point2;
use simulate::render::Renderer;
use simulate::scene::{Bowl, Outline, Plate, Scene, Solid};

use crate::support::{Shot, StudyFolder, aim_batch, assert_exit, files_below, stderr};

const CAMERA: &str = "schema_version = 1\nname = \"c\"\nwidth_px = 800\nheight_px = 600\nfocal_px = [520.0, 520.0]\n\
     principal_px = [401.0, 296.0]\n[lens]\nmodel = \"none\"\n";
/// The plate is flat; what the program finds by itself it takes to be as high as plates commonly are.
const OBJECTS: &str = "object,kind,shape,true_diameter_mm,rim_height_mm\ndinner plate,plate,circle,230.0,0.01\n";
const RANGE_MM: f64 = 480.0;

fn plate(center_mm: Point2<f64>) -> Scene {
    let plate = Plate { center_mm, half_width_mm: 115.0, outline: Outline::Circle };
    Scene { solid: Solid::Plate(plate), colour: [230.0, 228.0, 220.0] }
}

/// A deep bowl: its foot is seen from 50 degrees.
fn bowl(center_mm: Point2<f64>) -> Scene {
    let bowl = Bowl { center_mm, foot_radius_mm: 50.0, rim_radius_mm: 60.0, height_mm: 80.0 };
    Scene { solid: Solid::Bowl(bowl), colour: [90.0, 170.0, 190.0] }
}

/// A picture of what stands near where the camera looks; the wearer moves a little between pictures.
fn shot(scene: fn(Point2<f64>) -> Scene, pitch_deg: f64, number: u32) -> Shot {
    let camera = Camera::new([800, 600], [520.0, 520.0], [401.0, 296.0], 0.0, LensModel::None).unwrap();
    let pose = Pose::new(pitch_deg.to_radians(), 0.0, RANGE_MM).unwrap();
    let aside = 12.0 * f64::from(number);
    let center = View::new(camera, pose).on_plane(Point2::new(420.0 + aside, 290.0 - aside), 0.0).unwrap();
    let picture = Renderer::new(camera).render(&scene(center), &pose).to_jpeg("x.jpg").unwrap();
    Shot { picture, extension: "jpg", pitch_deg, roll_deg: 0.0, range_mm: RANGE_MM, marks: None }
}

/// A plate in three selected images of session S1, and in one at a pitch that is not selected; a bowl in two of S2.
pub fn study() -> StudyFolder {
    let study = StudyFolder::new("", OBJECTS, CAMERA);
    study.session("S1", &[shot(plate, 55.0, 0), shot(plate, 53.0, 1), shot(plate, 57.0, 2), shot(plate, 35.0, 3)]);
    study.session("S2", &[shot(bowl, 48.0, 0), shot(bowl, 50.0, 1)]);
    study
}

pub struct Ran {
    pub output: Output,
    pub out: PathBuf,
}

impl Ran {
    pub fn rows(&self) -> Vec<ResultRow> {
        report::Results::read(&self.out).unwrap().rows
    }

    pub fn sessions(&self) -> Vec<SessionStatus> {
        report::Results::read(&self.out).unwrap().metadata.sessions
    }

    fn bytes(&self) -> [Vec<u8>; 2] {
        [&self.out, &self.out.with_extension("frames.parquet")].map(|file| std::fs::read(file).unwrap())
    }
}

/// Runs with results in a folder beside the study's files; `name` is that of the results.
#[track_caller]
pub fn run(study: &StudyFolder, name: &str, options: &[&str], exit: i32) -> Ran {
    let out = study.path().join(format!("out/{name}.parquet"));
    let output = aim_batch().arg("run").arg(study.path()).arg("--out").arg(&out).args(options).output().unwrap();
    assert_exit(&output, exit);
    Ran { output, out }
}

pub fn by_ray(rows: &[ResultRow], level: Level, quantity: Quantity) -> Vec<ResultRow> {
    let is_one = |row: &&ResultRow| row.method == Method::Ray && row.level == level && row.quantity == quantity;
    rows.iter().filter(is_one).cloned().collect()
}

#[test]
fn plates_and_bowls_are_found_named_and_measured() {
    let study = study();
    let rows = run(&study, "auto", &["--marks", "auto"], 0).rows();
    assert!(rows.iter().all(|row| row.rater == "auto" && row.truth_mm.is_none()));
    assert!(rows.iter().all(|row| row.session == "S2" || row.object == "auto-1"), "one plate, one name");
    assert!(rows.iter().all(|row| row.confidence.is_some_and(|confidence| (0.5..=1.0).contains(&confidence))));
    // The floor of the bowl is a circle as well, and may have a name of its own.
    let rows: Vec<ResultRow> = rows.into_iter().filter(|row| row.object == "auto-1").collect();
    let frames = by_ray(&rows, Level::Frame, Quantity::Diameter);
    let of = |session: &str| frames.iter().filter(|row| row.session == session).count();
    assert_eq!((of("S1"), of("S2")), (3, 2), "every selected image, and no other");
    for (session, true_mm, within) in [("S1", 230.0, 0.07), ("S2", 120.0, 0.05)] {
        let fused = by_ray(&rows, Level::Fused, Quantity::Diameter);
        let fused = fused.iter().find(|row| row.session == session).unwrap();
        let found_mm = fused.predicted_mm.unwrap();
        assert!((found_mm / true_mm - 1.0).abs() < within, "{session}: {found_mm} mm");
        assert!((found_mm - true_mm).abs() < 2.5 * fused.sigma_mm.unwrap());
    }
    let heights = by_ray(&rows, Level::Fused, Quantity::Height);
    let [height] = heights.as_slice() else { panic!("the bowl's alone: {heights:?}") };
    assert!((height.predicted_mm.unwrap() - 80.0).abs() < 2.0 * height.sigma_mm.unwrap(), "{height:?}");
    let frames = by_ray(&rows, Level::Frame, Quantity::Height);
    let surest = frames.iter().filter_map(|row| row.sigma_mm).fold(f64::INFINITY, f64::min);
    assert!(height.sigma_mm.unwrap() > 0.99 * surest, "what images share does not average out");
}

#[test]
fn flag_before_environment_before_study() {
    let study = study();
    assert_eq!(run(&study, "r", &[], 0).rows().len(), 0, "people marked nothing");
    let toml = std::fs::read_to_string(study.path().join("study.toml")).unwrap();
    study.write("study.toml", format!("{toml}\n[marks]\nsource = \"auto\"\n"));
    let found = run(&study, "r", &[], 0).rows();
    assert!(!found.is_empty());
    let out = study.path().join("out/r.parquet");
    let mut by_environment = aim_batch();
    by_environment.arg("run").arg(study.path()).arg("--out").arg(&out).env("AIM_BATCH_MARKS", "manual");
    assert_exit(&by_environment.output().unwrap(), 0);
    assert_eq!(report::Results::read(&out).unwrap().rows.len(), 0);
    by_environment.args(["--marks", "both"]);
    assert_exit(&by_environment.output().unwrap(), 0);
    assert_eq!(report::Results::read(&out).unwrap().rows, found);
    study.write("study.toml", format!("{toml}\n[marks]\nsource = \"auto\"\nmin_confidence = 1.0\n"));
    assert!(run(&study, "r", &[], 0).rows().len() < found.len(), "a higher threshold measures again");
}

#[test]
fn written_marks_are_read_back_to_the_same_sizes() {
    let study = study();
    let marks = study.path().join("marks");
    let auto = run(&study, "auto", &["--marks", "auto", "--write-marks", marks.to_str().unwrap()], 0).rows();
    let files = files_below(&marks);
    assert_eq!(files.len(), 5, "{:?}", files.keys());
    for (path, bytes) in &files {
        let json: serde_json::Value = serde_json::from_slice(bytes).unwrap();
        let picture = path.parent().unwrap().join(json["imagePath"].as_str().unwrap());
        assert!(picture.is_file(), "LabelMe finds the picture: {}", picture.display());
        assert_eq!((&json["imageWidth"], &json["imageHeight"]), (&800.into(), &600.into()));
        assert!(json["shapes"].as_array().unwrap().iter().any(|shape| shape["label"] == "auto-1/rim"));
    }
    assert_eq!(run(&study, "manual", &[], 0).rows(), auto);
    assert_eq!(run(&study, "both", &["--marks", "both"], 0).rows(), auto, "files come before a search");

    // A person says what it is, and then it has a truth; the file is his, and stays.
    let stem = StudyFolder::image_stem(0);
    let mine = marks.join(format!("auto/S1/{stem}.json"));
    let text = std::fs::read_to_string(&mine).unwrap().replace("auto-1/rim", "dinner plate/rim");
    std::fs::write(&mine, &text).unwrap();
    let named = run(&study, "manual", &[], 0).rows();
    let named = by_ray(&named, Level::Frame, Quantity::Diameter);
    let errors: Vec<f64> = named.iter().filter_map(|row| row.error_pct).collect();
    assert!(matches!(errors.as_slice(), [error] if error.abs() < 1.0), "{errors:?}");
    let again = run(&study, "auto", &["--marks", "auto", "--write-marks", marks.to_str().unwrap()], 0);
    assert!(
        stderr(&again.output).contains("1 more hold what a person has made or corrected"),
        "{}",
        stderr(&again.output)
    );
    assert_eq!(std::fs::read_to_string(&mine).unwrap(), text);
}

/// Where people mark other pictures than those of the card, rims are on theirs.
#[test]
fn rims_are_on_the_pictures_that_people_mark() {
    let study = study();
    let recorded = run(&study, "recorded", &["--marks", "auto"], 0).rows();
    let half = CAMERA.replace("800", "400").replace("600", "300").replace("520.0", "260.0");
    study.write("devices/half.toml", half.replace("401.0", "200.25").replace("296.0", "147.75"));
    let toml = std::fs::read_to_string(study.path().join("study.toml")).unwrap();
    study.write("study.toml", format!("{toml}\n[marks]\ncamera = \"half\"\n"));
    let folder = study.path().join("written");
    let marked = run(&study, "half", &["--marks", "auto", "--write-marks", folder.to_str().unwrap()], 0).rows();
    let sizes = |rows: &[ResultRow]| -> Vec<f64> {
        by_ray(rows, Level::Frame, Quantity::Diameter).iter().filter_map(|row| row.predicted_mm).collect()
    };
    let (recorded, marked) = (sizes(&recorded), sizes(&marked));
    assert_eq!(recorded.len(), marked.len());
    assert!(recorded.iter().zip(&marked).all(|(a, b)| (a / b - 1.0).abs() < 1e-3), "{recorded:?} {marked:?}");
    let file = folder.join(format!("auto/S1/{}.json", StudyFolder::image_stem(0)));
    let json: serde_json::Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    assert_eq!((&json["imageWidth"], &json["imageHeight"]), (&400.into(), &300.into()));
    assert_eq!(json["imagePath"], format!("{}.jpg", StudyFolder::image_stem(0)));
}

/// The largest chunk holds pictures: a byte in the last third of the file is one of theirs.
pub fn damage(recording: &Path) {
    let mut bytes = std::fs::read(recording).unwrap();
    let at = bytes.len() * 2 / 3;
    bytes[at] ^= 0xff;
    std::fs::write(recording, bytes).unwrap();
}

#[test]
fn the_same_bytes_however_a_run_came_about() {
    let study = study();
    let expected = run(&study, "cold", &["--marks", "auto"], 0).bytes();
    for (name, options) in [("one", ["--jobs", "1"]), ("two", ["--jobs", "2"]), ("little", ["--memory", "1"])] {
        assert!(run(&study, name, &[&["--marks", "auto"][..], &options].concat(), 0).bytes() == expected, "{name}");
    }
    run(&study, "cold", &["--marks", "manual"], 0);
    let resumed = run(&study, "cold", &["--marks", "auto"], 0);
    assert!(resumed.bytes() == expected, "after a run without");
    run(&study, "cold", &["--marks", "manual"], 0);
    damage(&study.path().join("out/cold.work/mcap/S2.mcap"));
    let mended = run(&study, "cold", &["--marks", "auto", "-v"], 0);
    assert!(stderr(&mended.output).contains("ingested again"), "{}", stderr(&mended.output));
    assert!(mended.bytes() == expected, "after a damaged recording");
}

/// The picture as PNG, whole by its checksums, with a first block that is not zlib's.
pub fn undecodable(jpeg: &[u8]) -> Vec<u8> {
    let mut png = std::io::Cursor::new(Vec::new());
    image::load_from_memory(jpeg).unwrap().write_to(&mut png, image::ImageFormat::Png).unwrap();
    let mut png = png.into_inner();
    let begin = png.windows(4).position(|bytes| bytes == b"IDAT").unwrap();
    let length = u32::from_be_bytes(png[begin - 4..begin].try_into().unwrap()) as usize;
    png[begin + 4] = 0;
    let end = begin + 4 + length;
    let crc = !png[begin..end].iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 * (crc & 1)))
    });
    png[end..end + 4].copy_from_slice(&crc.to_be_bytes());
    png
}

#[test]
fn a_picture_that_cannot_be_decoded_is_told_and_the_others_are_searched() {
    let study = study();
    let mut shots = [shot(plate, 55.0, 0), shot(plate, 54.0, 1)];
    (shots[0].picture, shots[0].extension) = (undecodable(&shots[0].picture), "png");
    study.session("S3", &shots);
    let ran = run(&study, "auto", &["--marks", "auto"], 3);
    let sessions = ran.sessions();
    let problems = sessions.iter().flat_map(|session| &session.problems);
    let problems: Vec<_> = problems.filter(|problem| problem.severity == Severity::Loss).collect();
    assert!(matches!(problems.as_slice(), [one] if one.code.code() == "picture_not_searched"), "{problems:?}");
    assert!(ran.rows().iter().any(|row| row.session == "S3"));
}

#[test]
fn what_makes_no_sense_is_refused() {
    let study = StudyFolder::new("", OBJECTS, CAMERA);
    study.session("S1", &[shot(plate, 55.0, 0)]);
    let folder = study.path().join("w");
    let cards = study.path().join("cards/x");
    let (folder, cards) = (folder.to_str().unwrap(), cards.to_str().unwrap());
    for (options, expected) in [
        (&["--marks", "people"][..], "manual, auto, both"),
        (&["--write-marks", folder], "give --marks auto or --marks both"),
        (&["--marks", "auto", "--write-marks", cards], "outside the study's cards/"),
    ] {
        let said = stderr(&run(&study, "r", options, 2).output);
        assert!(said.contains(expected), "{said}");
    }
    let toml = std::fs::read_to_string(study.path().join("study.toml")).unwrap();
    study.write("study.toml", format!("{toml}\n[marks]\nmin_confidence = 1.5\n"));
    let said = stderr(&run(&study, "r", &[], 2).output);
    assert!(said.contains("marks.min_confidence = 1.5: expected 0 to 1"), "{said}");
}
