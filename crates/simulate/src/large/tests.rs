//! Tests of the study as it is read back.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use model::{Container, Mark, Method, ObjectMarks, Quantity, View, measure};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::*;

const SMALL: LargeOptions = LargeOptions { seed: 7, sessions: 12, images: 4, size_px: [64, 48], damage_pct: 33.0 };

/// All files of a study by their path in it.
type Files = BTreeMap<PathBuf, Vec<u8>>;

fn study(options: &LargeOptions) -> Files {
    written(options).0
}

fn read_below(root: &Path, folder: &Path, files: &mut Files) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            read_below(root, &path, files);
        } else {
            files.insert(path.strip_prefix(root).unwrap().to_owned(), fs::read(&path).unwrap());
        }
    }
}

fn written(options: &LargeOptions) -> (Files, Vec<TruthRow>) {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("study");
    let truth = large(&root, options, &|_, _| {}).unwrap().truth;
    let mut files = Files::new();
    read_below(&root, &root, &mut files);
    (files, truth)
}

fn column(files: &Files, table: &str, column: &str) -> Vec<String> {
    let mut reader = csv::Reader::from_reader(files[Path::new(table)].as_slice());
    let at = reader.headers().unwrap().iter().position(|name| name == column).unwrap();
    reader.records().map(|record| record.unwrap()[at].to_owned()).collect()
}

#[test]
fn the_same_seed_gives_the_same_bytes_for_any_number_of_threads_and_another_seed_does_not() {
    let with_threads = |threads: usize, options: LargeOptions| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| written(&options))
    };
    let one = with_threads(1, SMALL);
    assert!(one == with_threads(3, SMALL));
    // The study with the other seed has no damage, so that the same files are there and none is damaged in the same way in both.
    let whole = study(&LargeOptions { damage_pct: 0.0, ..SMALL });
    let other = study(&LargeOptions { damage_pct: 0.0, seed: 8, ..SMALL });
    let of_cards = |files: &Files| files.keys().filter(|path| path.starts_with("cards")).cloned().collect::<Vec<_>>();
    assert_eq!(of_cards(&whole), of_cards(&other));
    for path in of_cards(&whole).iter().filter(|path| path.file_name().unwrap() != "session.toml") {
        assert!(whole[path] != other[path], "{} does not depend on the seed", path.display());
    }
}

#[test]
fn no_file_of_sensors_or_pictures_is_there_twice() {
    let files = study(&LargeOptions { damage_pct: 0.0, sessions: 30, ..SMALL });
    let is_data = |path: &&PathBuf| path.extension().is_some_and(|extension| extension == "JPG" || extension == "BIN");
    let data: Vec<&Vec<u8>> = files.keys().filter(is_data).map(|path| &files[path]).collect();
    assert_eq!(data.len(), 30 * (4 + SMALL.images as usize));
    assert_eq!(data.iter().collect::<BTreeSet<_>>().len(), data.len());
}

#[test]
fn damage_harms_exactly_the_sessions_that_it_names() {
    let (whole, damaged) = (study(&LargeOptions { damage_pct: 0.0, ..SMALL }), study(&SMALL));
    let named: BTreeSet<String> = column(&damaged, "damaged.csv", "session").into_iter().collect();
    assert_eq!(named.len(), 4, "33 % of 12 are 3.96");
    assert!(!whole.contains_key(Path::new("damaged.csv")));
    // The paths are cards/SESSION/FILE and marks/RATER/SESSION/FILE.
    let session_of = |path: &Path| {
        let parts: Vec<_> = path.iter().map(|part| part.to_str().unwrap().to_owned()).collect();
        match parts[0].as_str() {
            "cards" => Some(parts[1].clone()),
            "marks" => Some(parts[2].clone()),
            _ => None,
        }
    };
    let mut harmed = BTreeSet::new();
    for (path, bytes) in &whole {
        if damaged.get(path) != Some(bytes) {
            harmed.insert(session_of(path).unwrap_or_else(|| panic!("{} was changed", path.display())));
        }
    }
    assert_eq!(harmed, named);
    assert!(damaged.keys().all(|path| whole.contains_key(path) || path == Path::new("damaged.csv")));
}

#[test]
fn damaged_sessions_are_counted_by_rounding_and_take_all_kinds_in_turn() {
    for (sessions, damage_pct, expected) in
        [(300, 10.0, 30), (7, 50.0, 4), (10, 4.9, 0), (10, 5.0, 1), (3, 100.0, 3), (1, 49.0, 0)]
    {
        let options = LargeOptions { sessions, damage_pct, ..SMALL };
        let kinds: Vec<Damage> = Session::all(&options).into_iter().filter_map(|session| session.damage).collect();
        assert_eq!(kinds.len(), expected, "{damage_pct} % of {sessions}");
        let in_turn: Vec<Damage> = Damage::ALL.into_iter().cycle().take(expected).collect();
        assert_eq!(kinds, in_turn);
    }
    let damaged = |seed| {
        let sessions = Session::all(&LargeOptions { seed, sessions: 300, damage_pct: 10.0, ..SMALL });
        sessions.into_iter().filter_map(|session| session.damage.map(|_| session.number)).collect::<Vec<_>>()
    };
    assert_ne!(damaged(1), damaged(2));
}

#[test]
fn marks_measured_by_the_true_pose_give_the_true_sizes() {
    let camera = camera_of(&camera_toml([320, 240])).unwrap();
    let renderer = Renderer::new(camera);
    for object in &OBJECTS {
        let gallery = Gallery::draw(object, &camera, &renderer, &mut ChaCha8Rng::seed_from_u64(3)).unwrap();
        let (row, sizes) = (serde_json::to_value(object.row()).unwrap(), object.true_sizes());
        let container = Container {
            kind: object.kind,
            shape: serde_json::from_value(row["shape"].clone()).unwrap(),
            rim_height_mm: row["rim_height_mm"].as_f64(),
            wall: None,
        };
        for sight in &gallery.sights {
            let head = sight.head;
            let pose =
                model::Pose::new(head.pitch_deg.to_radians(), head.roll_deg.to_radians(), head.range_mm).unwrap();
            let lines = sight.marks.iter();
            let marks = lines.map(|line| Mark::Line { quantity: line.quantity, ends_px: line.ends_px }).collect();
            let marks = ObjectMarks { object: object.name.to_owned(), marks };
            let measured = measure(&View::new(camera, pose), Method::Ray, &container, &marks);
            assert_eq!(measured.len(), sight.marks.len());
            for (quantity, size) in measured {
                let truth_mm = match quantity {
                    Quantity::Diameter => sizes.true_diameter_mm,
                    Quantity::Width => sizes.true_width_mm,
                    Quantity::Length => sizes.true_length_mm,
                    Quantity::Height => sizes.true_height_mm,
                };
                let error_mm = size.unwrap().predicted_mm - truth_mm.unwrap();
                assert!(error_mm.abs() < 1e-6, "{} {quantity} at {head:?}: {error_mm} mm off", object.name);
            }
        }
    }
}

#[test]
fn pictures_have_the_camera_s_size_and_truth_names_each_of_them() {
    let options = LargeOptions { damage_pct: 0.0, size_px: [90, 50], ..SMALL };
    let (files, truth) = written(&options);
    let camera = String::from_utf8(files[Path::new(CAMERA_FILE)].clone()).unwrap();
    assert_eq!(camera_of(&camera).unwrap().size_px(), [90, 50]);
    let named: Vec<PathBuf> =
        truth.iter().map(|row| PathBuf::from(format!("cards/{}/{}", row.session, row.image))).collect();
    let pictures: Vec<&PathBuf> = files.keys().filter(|path| path.extension().is_some_and(|e| e == "JPG")).collect();
    assert_eq!(named.iter().collect::<Vec<_>>(), pictures);
    for path in pictures {
        let decoded = image::load_from_memory(&files[path]).unwrap();
        assert_eq!((decoded.width(), decoded.height()), (90, 50), "{}", path.display());
    }
}

#[test]
fn options_out_of_range_are_refused_before_anything_is_written() {
    let bad = [
        LargeOptions { sessions: 0, ..SMALL },
        LargeOptions { images: 2001, ..SMALL },
        LargeOptions { size_px: [31, 48], ..SMALL },
        LargeOptions { size_px: [64, 4097], ..SMALL },
        LargeOptions { damage_pct: 100.5, ..SMALL },
        LargeOptions { damage_pct: f64::NAN, ..SMALL },
    ];
    for options in bad {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().join("study");
        assert!(matches!(large(&root, &options, &|_, _| {}), Err(SimulateError::Option { .. })), "{options:?}");
        assert!(!root.exists());
    }
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    assert!(matches!(large(folder.path(), &SMALL, &|_, _| {}), Err(SimulateError::NotEmpty { .. })));
}
