//! Marks of other annotation tools, and for them, through the whole program.

mod tools;

use std::path::Path;
use std::process::Output;

use model::ResultRow;
use report::Results;

use crate::study::methods::{OBJECTS, shot};
use crate::support::{
    StudyFolder, assert_exit, copy_folder, files_below, label_me, line, published_bench, run, small_camera, stderr,
    stdout,
};
use tools::Picture;

const SIZE_PX: [u32; 2] = [64, 48];

/// Two sessions with images of the same names, marked by rater A to hundredths of a pixel; and the marked pictures.
fn study() -> (StudyFolder, Vec<Picture>) {
    let study = StudyFolder::new("[uncertainty]\nmark_px = 0.05\n", OBJECTS, &small_camera());
    let mut pictures = Vec::new();
    for (session, roll_deg) in [("s1", 3.0), ("s2", -5.0)] {
        let mut shots = [(55.0, 560.0), (58.0, 540.0)].map(|(pitch, range)| shot(pitch, roll_deg, range, 0.0, 1.0));
        for (i, shot) in shots.iter_mut().enumerate() {
            let mut marks = shot.marks.take().unwrap();
            let more = line("plate/length", [[12.0, 24.0], [51.5, 24.25]]);
            marks["shapes"].as_array_mut().unwrap().push(more);
            let marks = tools::rounded(marks);
            let name = format!("{session}/images/{}.jpg", StudyFolder::image_stem(i));
            pictures.push(Picture { name, marks: marks.clone() });
            shot.marks = Some(marks);
        }
        study.session(session, &shots);
    }
    (study, pictures)
}

fn import(study: &Path, file: &Path, rater: &str, more: &[&str]) -> Output {
    let arguments = ["marks", "import", study.to_str().unwrap(), file.to_str().unwrap(), "--rater", rater];
    run([&arguments[..], more].concat())
}

/// Every size of a rater, as text, in the order of the rows.
fn sizes(results: &Results, rater: &str) -> Vec<String> {
    let of_rater = results.rows.iter().filter(|row| row.rater == rater);
    let text = |row: &ResultRow| {
        let row = ResultRow { rater: String::new(), ..row.clone() };
        format!("{row:?}")
    };
    of_rater.map(text).collect()
}

#[test]
fn marks_of_every_tool_measure_alike() {
    let (study, pictures) = study();
    let cvat = study.write("annotations.xml", tools::cvat(&pictures, SIZE_PX));
    let coco = study.write("instances.json", tools::coco(&pictures, SIZE_PX).to_string());
    for (file, rater) in [(&cvat, "cvat"), (&coco, "coco")] {
        let output = import(study.path(), file, rater, &[]);
        assert_exit(&output, 0);
        assert!(stdout(&output).contains("20 marks in ") && stdout(&output).contains(": 4 files written"));
        assert_eq!(stderr(&output), "");
        let again = import(study.path(), file, rater, &[]);
        assert_exit(&again, 0);
        assert!(stdout(&again).contains("0 files written, 4 held them already"), "{}", stdout(&again));
    }
    let out = study.path().join("out/r.parquet");
    assert_exit(&run(["run", study.path().to_str().unwrap(), "--out", out.to_str().unwrap()]), 0);
    let results = Results::read(&out).unwrap();
    let labelme = sizes(&results, "A");
    assert!(labelme.len() > 40, "{} rows", labelme.len());
    assert_eq!(labelme, sizes(&results, "cvat"));
    assert_eq!(labelme, sizes(&results, "coco"));
}

/// All marks that ship with the program, out and in again, are the same to the bit.
#[test]
fn out_and_in_again_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let study = published_bench();
    for (rater, marks) in [("bench", 99), ("RA1", 30)] {
        for format in ["coco", "cvat"] {
            let file = folder.path().join(format!("{rater}.{format}"));
            let (study, file) = (study.to_str().unwrap(), file.to_str().unwrap());
            let output = run(["marks", "export", study, "--rater", rater, "--format", format, "--out", file]);
            assert_exit(&output, 0);
            assert!(stdout(&output).starts_with(&format!("{marks} marks on ")), "{}", stdout(&output));
            let back = import(Path::new(study), Path::new(file), rater, &["--dry-run"]);
            assert_exit(&back, 0);
            let said = stdout(&back);
            assert!(said.starts_with(&format!("{marks} marks in ")) && said.contains(": 0 files to write"), "{said}");
        }
    }
}

#[test]
fn what_is_unclear_is_told_and_the_rest_is_used() {
    let (study, pictures) = study();
    let text = tools::cvat(&pictures[..1], SIZE_PX);
    let text = text.replace("plate/rim", "Plate rim").replace(
        "  </image>",
        "    <box label=\"bowl/rim\" occluded=\"0\" xtl=\"1\" ytl=\"2\" xbr=\"3\" ybr=\"4\"></box>\n    \
         <polygon label=\"fork\" occluded=\"0\" points=\"1,2;3,4;5,6\"></polygon>\n  </image>\n  \
         <image id=\"7\" name=\"nowhere.jpg\" width=\"64\" height=\"48\"><tag label=\"x\"></tag></image>",
    );
    let file = study.write("a.xml", text);
    let output = import(study.path(), &file, "b", &[]);
    assert_exit(&output, 3);
    let said = stderr(&output);
    for expected in [
        "left out: label 'Plate rim' is unclear (nearest: 'plate/rim'); expected OBJECT/WHAT",
        "OBJECT is one of: bowl, plate",
        "WHAT is one of: diameter, width, length, height, rim, base",
        "left out: a box says nothing of a rim",
        "a.xml: line 22, 'Plate rim' on 's1/images/",
        "left out: no card has an image of this name (4 images of 2 sessions",
        "'nowhere.jpg' (1 annotation)",
    ] {
        assert!(said.contains(expected), "'{expected}' in:\n{said}");
    }
    assert!(stdout(&output).starts_with("4 marks in "), "{}", stdout(&output));

    // The file differs now, and somebody may have corrected it.
    let mended = ["--label", "Plate rim=plate/rim", "--ignore", "fork"];
    let output = import(study.path(), &file, "b", &mended);
    assert!(stderr(&output).contains("holds other marks, and is left as it is; --force writes over it"));
    assert!(!stderr(&output).contains("fork"));
    let output = import(study.path(), &file, "b", &[&mended[..], &["--force", "--dry-run"]].concat());
    assert!(stdout(&output).contains(": 1 files to write; 1 annotations passed over"), "{}", stdout(&output));
    let output = import(study.path(), &file, "b", &[&mended[..], &["--force"]].concat());
    assert!(stdout(&output).starts_with("5 marks in ") && stdout(&output).contains(": 1 files written"));
}

#[test]
fn an_image_that_may_be_several_is_not_guessed() {
    let (study, mut pictures) = study();
    pictures.truncate(1);
    pictures[0].name = format!("{}.jpg", StudyFolder::image_stem(0));
    let file = study.write("a.json", tools::coco(&pictures, SIZE_PX).to_string());
    let output = import(study.path(), &file, "b", &[]);
    assert_exit(&output, 1);
    let said = stderr(&output);
    assert!(said.contains("it may be any of: s1/images/") && said.contains("or give --session"), "{said}");
    assert_exit(&import(study.path(), &file, "b", &["--session", "s2"]), 0);
    assert!(study.path().join("marks/b/s2").is_dir() && !study.path().join("marks/b/s1").exists());
    assert_exit(&import(study.path(), &file, "b", &["--session", "s3"]), 2);
}

/// Names as Label Studio and Roboflow export them lead to the same sizes, and a note says so; one that fits two pictures is refused.
#[test]
fn names_that_tools_changed_are_found() {
    let (study, mut pictures) = study();
    for (number, picture) in pictures.iter_mut().enumerate() {
        let (session, file) = picture.name.split_once("/images/").unwrap();
        let stem = file.strip_suffix(".jpg").unwrap().replace('.', "-");
        picture.name = match number % 2 {
            0 => format!("{session}/0a1b2c3d-{file}"),
            _ => format!("{session}/{stem}_jpg.rf.0123456789abcdef0123456789abcdef.jpg"),
        };
    }
    let file = study.write("a.json", tools::coco(&pictures, SIZE_PX).to_string());
    let output = import(study.path(), &file, "b", &[]);
    assert_exit(&output, 0);
    let said = stderr(&output);
    for tool in ["Label Studio", "Roboflow"] {
        assert!(said.contains(tool) && said.contains("2 images, first "), "{said}");
    }
    let out = study.path().join("out/r.parquet");
    assert_exit(&run(["run", study.path().to_str().unwrap(), "--out", out.to_str().unwrap()]), 0);
    let results = Results::read(&out).unwrap();
    assert_eq!(sizes(&results, "A"), sizes(&results, "b"));
    let name = format!("0a1b2c3d-{}.jpg", StudyFolder::image_stem(0));
    let both = [Picture { name, marks: pictures[0].marks.clone() }];
    let file = study.write("b.json", tools::coco(&both, SIZE_PX).to_string());
    let output = import(study.path(), &file, "c", &[]);
    assert_exit(&output, 1);
    assert!(stderr(&output).contains("any of: s1/images/") && stderr(&output).contains(", s2/images/"));
}

#[test]
fn a_picture_of_another_size_is_refused() {
    let (study, pictures) = study();
    let file = study.write("a.xml", tools::cvat(&pictures, [640, 480]));
    let output = import(study.path(), &file, "b", &[]);
    assert_exit(&output, 1);
    assert!(stderr(&output).contains("marked on a picture of 640 x 480 px, but the camera's are 64 x 48"));
    assert!(!study.path().join("marks/b").exists());
}

#[test]
fn files_that_are_something_else_are_refused() {
    let (study, _) = study();
    let before = files_below(&study.path().join("marks"));
    for (content, rater, code, expected) in [
        (label_me(Vec::new()).to_string(), "b", 1, "a LabelMe file, which needs no import"),
        ("PK\u{3}\u{4}zip".to_owned(), "b", 1, "this is a ZIP archive: unpack it"),
        ("\u{1}".to_owned(), "b", 1, "neither XML nor JSON"),
        ("<annotations><track/></annotations>".to_owned(), "b", 1, "tracks of 'CVAT for video'"),
        ("<annotations>".to_owned(), "b", 1, "it is not whole"),
        ("<annotations/>".to_owned(), "../b", 2, "rater '../b': expected a name"),
        ("<annotations/>".to_owned(), "auto", 2, "rater 'auto'"),
    ] {
        let file = study.write("a.any", content);
        let output = import(study.path(), &file, rater, &[]);
        assert_exit(&output, code);
        assert!(stderr(&output).contains(expected), "{}", stderr(&output));
    }
    assert_eq!(before, files_below(&study.path().join("marks")));
    let nobody =
        ["marks", "export", study.path().to_str().unwrap(), "--rater", "B", "--format", "coco", "-o", "x.json"];
    let output = run(nobody);
    assert_exit(&output, 2);
    assert!(stderr(&output).contains("rater 'B' has no marks in this study; raters: A"), "{}", stderr(&output));
}

/// A study can be copied whole, marked elsewhere, and its marks fetched.
#[test]
fn marks_go_from_one_copy_of_a_study_to_another() {
    let (study, _) = study();
    let copy = tempfile::tempdir().unwrap();
    copy_folder(study.path(), copy.path());
    std::fs::remove_dir_all(copy.path().join("marks")).unwrap();
    let file = copy.path().join("a.xml");
    let (from, to) = (study.path().to_str().unwrap(), file.to_str().unwrap());
    assert_exit(&run(["marks", "export", from, "--rater", "A", "--format", "cvat", "-o", to]), 0);
    assert_exit(&import(copy.path(), &file, "A", &[]), 0);
    let stem = StudyFolder::image_stem(0);
    let text = std::fs::read_to_string(copy.path().join(format!("marks/A/s1/{stem}.json"))).unwrap();
    assert!(text.contains(&format!("\"imagePath\": \"../../../cards/s1/images/{stem}.jpg\"")), "{text}");
}
