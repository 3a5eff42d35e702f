//! `project`: one point by hand.

use crate::support::{assert_exit, root, run_with_input, stderr, stdout};

const CAMERA: &str = r#"
schema_version = 1
name = "c"
width_px = 640
height_px = 480
focal_px = [600.0, 600.0]
principal_px = [320.0, 240.0]
[lens]
model = "none"
"#;

fn camera_file(folder: &tempfile::TempDir, text: &str) -> String {
    let path = folder.path().join("cam.toml");
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

/// An independent program's points (crates/model/tests/vectors/plane.csv), through the command line both ways.
#[test]
fn independent_vectors_through_the_command_line() {
    let folder = tempfile::tempdir().unwrap();
    let mut vectors = csv::Reader::from_path(root().join("crates/model/tests/vectors/plane.csv")).unwrap();
    let header = vectors.headers().unwrap().clone();
    let column = |name: &str| header.iter().position(|h| h == name).unwrap();
    let mut checked = 0;
    for record in vectors.records().map(Result::unwrap).step_by(6) {
        let get = |name: &str| record[column(name)].to_owned();
        let number = |name: &str| get(name).parse::<f64>().unwrap();
        let camera = format!(
            "schema_version = 1\nname = \"v\"\nwidth_px = 2592\nheight_px = 1944\nfocal_mm = {}\n\
             scale_px_per_mm = [{}, {}]\nprincipal_px = [{}, {}]\n[lens]\nmodel = \"radial\"\nk_per_mm2 = {}\n",
            get("f_mm"),
            get("s_x_px_per_mm"),
            get("s_y_px_per_mm"),
            get("c_x_px"),
            get("c_y_px"),
            get("k_per_mm2"),
        );
        let (camera, pitch, range) = (camera_file(&folder, &camera), get("pitch_deg"), get("range_mm"));
        let (roll, plane_z) = (format!("--roll={}", get("roll_deg")), get("plane_z_mm"));
        let pose = ["project", "--camera", &camera, "--pitch", &pitch, &roll, "--range", &range, "--plane-z", &plane_z];
        let answer = |more: &[&str], input: String| {
            let output = run_with_input(&[&pose, more].concat(), &input);
            assert_exit(&output, 0);
            let text = stdout(&output);
            let cells: Vec<f64> = text.lines().nth(1).unwrap().split(',').map(|cell| cell.parse().unwrap()).collect();
            (cells[2], cells[3])
        };
        let (x_mm, y_mm) = answer(&[], format!("x,y\n{},{}\n", get("pixel_x"), get("pixel_y")));
        assert!((x_mm - number("world_x_mm")).abs() < 1e-6 && (y_mm - number("world_y_mm")).abs() < 1e-6);
        let world = format!("world_x_mm,world_y_mm\n{},{}\n", get("world_x_mm"), get("world_y_mm"));
        let (x_px, y_px) = answer(&["--inverse"], world);
        assert!((x_px - number("pixel_x")).abs() < 1e-6 && (y_px - number("pixel_y")).abs() < 1e-6);
        checked += 1;
    }
    assert!(checked >= 10);
}

#[test]
fn a_point_without_an_answer_keeps_its_row() {
    let folder = tempfile::tempdir().unwrap();
    let camera = camera_file(&folder, CAMERA);
    let pose = ["project", "--camera", &camera, "--pitch", "10", "--range", "500"];
    let output = run_with_input(&pose, "x,y\n320,240\n320,0\nabc,5\n");
    assert_exit(&output, 3);
    let text = stdout(&output);
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines[0], "x,y,world_x_mm,world_y_mm");
    assert!(lines[1].starts_with("320,240,0,492.4"), "{}", lines[1]);
    assert_eq!(lines[2..], ["320,0,,", "abc,5,,"]);
    assert!(stderr(&output).contains("at or above the horizon") && stderr(&output).contains("'abc' is not a number"));
}

#[test]
fn a_point_beyond_the_lens_has_no_answer() {
    let folder = tempfile::tempdir().unwrap();
    let barrel = CAMERA.replace("model = \"none\"", "model = \"radial\"\nk1 = -1.0");
    let camera = camera_file(&folder, &barrel);
    let output = run_with_input(&["project", "--camera", &camera, "--pitch", "60", "--range", "500"], "x,y\n600,240\n");
    assert_exit(&output, 3);
    assert_eq!(stdout(&output).lines().nth(1), Some("600,240,,"));
    assert!(stderr(&output).contains("no such point"), "{}", stderr(&output));
}

#[test]
fn wrong_use_is_told_with_exit_code_2() {
    let folder = tempfile::tempdir().unwrap();
    let camera = camera_file(&folder, CAMERA);
    let behind = ["project", "--camera", &camera, "--pitch", "-5", "--range", "500"];
    let output = run_with_input(&behind, "x,y\n1,2\n");
    assert_exit(&output, 2);
    assert!(stderr(&output).contains("never meets the table"), "{}", stderr(&output));

    let header = run_with_input(&["project", "--camera", &camera, "--pitch", "50", "--range", "500"], "u,v\n1,2\n");
    assert_exit(&header, 2);
    assert!(stderr(&header).contains("expected CSV with a header and the columns x,y, got u,v"), "{}", stderr(&header));

    let typo = camera_file(&folder, &CAMERA.replace("focal_px", "focal_pix"));
    let output = run_with_input(&["project", "--camera", &typo, "--pitch", "50", "--range", "500"], "x,y\n1,2\n");
    assert_exit(&output, 2);
    assert!(stderr(&output).contains("focal_pix") && stderr(&output).contains("focal_px"), "{}", stderr(&output));
}
