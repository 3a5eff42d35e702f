//! The fate of the images, as a user sees it.

use std::fs;

use crate::support::{Shot, StudyFolder, assert_exit, label_me, line, run, stderr, stdout};

const CAMERA: &str = "schema_version = 1\nname = \"c\"\nwidth_px = 64\nheight_px = 48\nfocal_px = [60.0, 60.0]\n\
                      principal_px = [32.0, 24.0]\n[lens]\nmodel = \"none\"\n";

/// Six images: two selected, of which one is marked; two with another pitch, of which one is marked; one that looks up;
/// one that is empty.
fn study() -> StudyFolder {
    let study = StudyFolder::new("", "object,kind,shape,true_diameter_mm\nplate,plate,circle,200\n", CAMERA);
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbImage::new(64, 48).write_to(&mut bytes, image::ImageFormat::Jpeg).unwrap();
    let marks = label_me(vec![line("plate/diameter", [[20.0, 24.0], [44.0, 24.0]])]);
    let picture = bytes.into_inner();
    let shot = |pitch_deg: f64, is_marked: bool| Shot {
        picture: picture.clone(),
        extension: "jpg",
        pitch_deg,
        roll_deg: 0.0,
        range_mm: 500.0,
        marks: is_marked.then(|| marks.clone()),
    };
    let empty = Shot { picture: Vec::new(), ..shot(55.0, false) };
    study.session(
        "s",
        &[shot(55.0, true), shot(55.0, false), shot(30.0, true), shot(30.0, false), shot(-10.0, false), empty],
    );
    study
}

#[test]
fn every_image_is_counted_where_it_left() {
    let study = study();
    let (out, tables) = (study.path().join("out/results.parquet"), study.path().join("tables"));
    let [study_arg, out_arg, tables_arg] = [study.path(), &out, &tables].map(|path| path.to_str().unwrap());
    let output = run(["run", study_arg, "--out", out_arg, "--report", tables_arg]);
    assert_exit(&output, 3);
    let flow = fs::read_to_string(tables.join("flow.csv")).unwrap();
    // found 6, readable 5, with pose 4, still 4, selected 2, marked 1, measured 1; marked elsewhere 1, measured 1
    assert!(flow.contains("\nrow,s,6,5,4,4,2,1,1,1,1,33.333333,") && flow.contains("\noverall,,6,5,4,4,2,"), "{flow}");
    let left_out = fs::read_to_string(tables.join("left_out.csv")).unwrap();
    let reasons: Vec<&str> = left_out.lines().skip(1).map(|line| line.split(',').next().unwrap()).collect();
    assert_eq!(reasons, ["empty_image", "not_below_horizon", "pitch_outside_target"]);
    let text = stdout(&output);
    assert!(text.contains("Flow of images") && text.contains("4 of the 6 images found are not selected"), "{text}");
    assert!(fs::read_to_string(tables.join("tables.md")).unwrap().contains("### Why images were left out"));
}

#[test]
fn a_report_goes_on_without_the_ledger_and_says_so_once() {
    let study = study();
    let out = study.path().join("night 1.parquet");
    let [study_arg, out_arg] = [study.path(), &out].map(|path| path.to_str().unwrap());
    assert_exit(&run(["run", study_arg, "--out", out_arg]), 3);
    let whole = run(["report", out_arg]);
    assert_exit(&whole, 0);
    assert!(stdout(&whole).contains("Flow of images") && stderr(&whole).is_empty());

    let ledger = study.path().join("night 1.frames.parquet");
    fs::write(&ledger, "not Parquet").unwrap();
    let damaged = run(["report", out_arg]);
    assert_exit(&damaged, 3);
    assert!(stderr(&damaged).contains("not a Parquet file") && stdout(&damaged).contains("Sizes"));

    fs::remove_file(&ledger).unwrap();
    let without = run(["report", out_arg]);
    assert_exit(&without, 0);
    assert_eq!(stderr(&without).matches("night 1.frames.parquet").count(), 1, "{}", stderr(&without));
    assert!(!stdout(&without).contains("Flow of images") && stdout(&without).contains("Sizes"));
}
