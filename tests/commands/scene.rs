//! Scene files of one's own: `simulate SCENE.toml`, then `run` on what it made.

use std::path::{Path, PathBuf};

use model::results::TruthRow;
use model::{Kind, Level, Method, Quantity};

use crate::support::{assert_exit, files_below, root, run, stderr};

fn kitchen() -> PathBuf {
    root().join("data-samples/scenes/kitchen.toml")
}

fn simulate(scene: &Path, out: &Path, more: &[&str]) -> std::process::Output {
    let arguments = ["simulate", scene.to_str().unwrap(), "-o", out.to_str().unwrap()];
    run(arguments.iter().chain(more))
}

/// The scene that ships with the program: made twice to the byte, and measured as a study.
#[test]
fn the_shipped_scene_is_made_checked_and_measured() {
    let folder = tempfile::tempdir().unwrap();
    let [study, again, other] = ["a", "b", "c"].map(|name| folder.path().join(name));
    for (out, more) in [(&study, &[] as &[&str]), (&again, &["--seed", "7"]), (&other, &["--seed", "8"])] {
        assert_exit(&simulate(&kitchen(), out, more), 0);
    }
    let bytes = |out: &Path| files_below(out).into_values().collect::<Vec<_>>();
    assert!(bytes(&study) == bytes(&again), "the seed of the file is 7");
    assert!(bytes(&study) != bytes(&other));
    assert_eq!(std::fs::read(study.join("scene.toml")).unwrap(), std::fs::read(kitchen()).unwrap());

    let (truth, made_from) = report::read_truth(&study.join("truth.parquet")).unwrap();
    assert!(made_from.contains(r#""scene":"scene.toml""#) && made_from.contains(r#""seed":7"#), "{made_from}");
    assert_eq!((truth.len(), truth.iter().filter(|row| row.object.is_none()).count()), (10, 1));
    let results = folder.path().join("results.parquet");
    assert_exit(&run(["run", study.to_str().unwrap(), "--out", results.to_str().unwrap()]), 0);
    let frames = report::read_frames(&folder.path().join("frames.parquet")).unwrap();
    for row in &truth {
        let frame = frames.iter().find(|f| (&f.session, &f.image) == (&row.session, &row.image)).unwrap();
        assert_eq!(frame.time_utc, Some(row.time_utc));
        let off = frame.pitch_deg.unwrap() - row.pitch_deg;
        assert!(off.abs() < 1.0, "{}: a zero-g offset of 5 mg turns gravity by 0.3 degrees: {off}", row.image);
    }
    assert_sizes(&results, &truth);
}

/// Marks are exact, so that only the sensors err.
fn assert_sizes(results: &Path, truth: &[TruthRow]) {
    let rows = report::Results::read(results).unwrap().rows;
    let of = |object: &str, quantity: Quantity| {
        let mut fused = rows.iter().filter(|row| {
            (row.object.as_str(), row.quantity, row.level, row.method) == (object, quantity, Level::Fused, Method::Ray)
        });
        fused.next().unwrap_or_else(|| panic!("no {quantity} of {object}")).clone()
    };
    for (object, kind, quantity, true_mm) in [
        ("square plate", Kind::Plate, Quantity::Width, 190.0),
        ("rice bowl", Kind::Bowl, Quantity::Diameter, 130.0),
        ("lunch box", Kind::Box, Quantity::Length, 180.0),
        ("lunch box", Kind::Box, Quantity::Width, 120.0),
        ("lunch box", Kind::Box, Quantity::Height, 55.0),
    ] {
        let row = of(object, quantity);
        assert_eq!((row.kind, row.truth_mm), (kind, Some(true_mm)));
        let error_pct = row.error_pct.unwrap();
        assert!(error_pct.abs() < 12.0, "{object} {quantity}: {error_pct} %");
        let known = truth.iter().find(|row| row.object.as_deref() == Some(object)).unwrap();
        let sizes = [known.true_diameter_mm, known.true_width_mm, known.true_length_mm, known.true_height_mm];
        assert!(sizes.contains(&Some(true_mm)), "{known:?}");
    }
}

#[test]
fn what_is_wrong_is_told_with_file_and_line() {
    let folder = tempfile::tempdir().unwrap();
    let (file, out) = (folder.path().join("mine.toml"), folder.path().join("study"));
    let shipped = std::fs::read_to_string(kitchen()).unwrap();
    let at = |start: &str| shipped.lines().position(|line| line.starts_with(start)).unwrap() + 1;
    let refused = |text: &str, expected: &str| {
        std::fs::write(&file, text).unwrap();
        let output = simulate(&file, &out, &[]);
        assert_exit(&output, 2);
        assert!(stderr(&output).contains(expected), "{expected}\n{}", stderr(&output));
        assert!(!out.exists());
    };
    let line = at("blur_px");
    refused(
        &shipped.replace("blur_px", "blur_pix"),
        &format!("mine.toml:{line}:1: unknown key 'blur_pix': did you mean 'blur_px'"),
    );
    refused(
        &shipped.replace("blur_px = 0.5", "blur_px = -1"),
        &format!("mine.toml:{line}:11: picture.blur_px: got -1, expected 0 to 50"),
    );
    refused(&shipped.replace("width_mm = 190", "height_cm = 190"), "unknown key 'height_cm': did you mean 'height_mm'");
    refused(&shipped.replace("focal_px", "focal_pix"), "unknown key 'focal_pix': did you mean 'focal_px'");
    refused(&shipped.replace("[262.0, 262.0]", "[-1.0, 262.0]"), "mine.toml: the scene's camera: ");
    refused(
        &shipped.replace("one_at_a_time = true", ""),
        "mine.toml: session 'bench': 'square plate' and 'rice bowl' stand in one",
    );
    let line = at("  { pitch_deg = 48");
    refused(
        &shipped.replace("pitch_deg = 48", "pitch_deg = 95"),
        &format!("mine.toml:{line}:17: sessions.pitch_deg: got 95, expected 5 to 90"),
    );
    let line = at("[[bowls]]");
    refused(
        &shipped.replace("height_mm = 62", "height_mm = 6"),
        &format!("mine.toml:{line}:1: bowls: 'rice bowl': height_mm = 6, expected 11.0 to 500.0"),
    );
    refused("", "missing field");
    let output = simulate(&kitchen(), &out, &["--image-size", "64x64"]);
    assert_exit(&output, 2);
    assert!(stderr(&output).contains("a scene file says them itself"));
    assert_exit(&simulate(&folder.path().join("none.toml"), &out, &[]), 2);
    let output = run(["simulate", "wron", "-o", out.to_str().unwrap()]);
    assert_exit(&output, 2);
    assert!(stderr(&output).contains("published-bench, large, bench, worn, or a scene file"), "{}", stderr(&output));
}

/// A camera by its name: built in, or a file beside the scene.
#[test]
fn cameras_are_found_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let (file, out) = (folder.path().join("mine.toml"), folder.path().join("study"));
    let scene = "schema_version = 1\nname = \"s\"\ncamera = \"lens.toml\"\n[[sessions]]\nname = \"a\"\n\
                 stand = { pitch_deg = 55, height_mm = 440 }\n";
    std::fs::write(&file, scene).unwrap();
    std::fs::write(folder.path().join("lens.toml"), crate::support::small_camera()).unwrap();
    assert_exit(&simulate(&file, &out, &[]), 0);
    let picture =
        files_below(&out.join("cards")).into_iter().find(|(path, _)| path.extension().is_some_and(|e| e == "JPG"));
    let picture = image::load_from_memory(&picture.unwrap().1).unwrap();
    assert_eq!((picture.width(), picture.height()), (64, 48));
    std::fs::write(&file, scene.replace("lens.toml", "aim3")).unwrap();
    let output = simulate(&file, &folder.path().join("other"), &[]);
    assert_exit(&output, 2);
    assert!(stderr(&output).contains("unknown camera 'aim3' (did you mean 'aim2-raw'?)"), "{}", stderr(&output));
}
