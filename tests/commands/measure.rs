//! `measure` and `ingest` on made-up input: one picture, one card.

use serde_json::Value;

use crate::support::{assert_exit, label_me, line, outline, run, run_with_input, stderr, stdout};

const CAMERA: &str = "schema_version = 1\nname = \"c\"\nwidth_px = 1280\nheight_px = 960\nfocal_px = [900.0, 900.0]\n\
                      principal_px = [640.0, 480.0]\n[lens]\nmodel = \"division\"\nlambda = -0.2\n";
const POSE: [&str; 3] = ["--pitch=52", "--roll=-7.5", "--range=600"];

struct Scene {
    folder: tempfile::TempDir,
}

impl Scene {
    fn new() -> Self {
        let scene = Self { folder: tempfile::tempdir().unwrap() };
        std::fs::write(scene.path("cam.toml"), CAMERA).unwrap();
        image::RgbImage::new(1280, 960).save(scene.path("picture.png")).unwrap();
        scene
    }

    fn path(&self, file: &str) -> String {
        self.folder.path().join(file).to_str().unwrap().to_owned()
    }

    /// Pixels of points in mm, by `project --inverse`.
    fn pixels(&self, z_mm: f64, points_mm: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let input: String = points_mm.iter().map(|[x, y]| format!("{x},{y}\n")).collect();
        let (camera, plane) = (format!("--camera={}", self.path("cam.toml")), format!("--plane-z={z_mm}"));
        let arguments = ["project", "--inverse", &camera, &plane, POSE[0], POSE[1], POSE[2]];
        let output = run_with_input(&arguments, &format!("world_x_mm,world_y_mm\n{input}"));
        assert_exit(&output, 0);
        let number = |cell: &str| cell.parse::<f64>().unwrap();
        let pixel = |line: &str| {
            let cells: Vec<_> = line.split(',').collect();
            [number(cells[2]), number(cells[3])]
        };
        stdout(&output).lines().skip(1).map(pixel).collect()
    }

    fn measure(&self, shapes: Vec<Value>, more: &[&str]) -> std::process::Output {
        std::fs::write(self.path("marks.json"), label_me(shapes).to_string()).unwrap();
        let (camera, marks) = (self.path("cam.toml"), self.path("marks.json"));
        let picture = self.path("picture.png");
        run([&["measure", &picture, "--camera", &camera, "--marks", &marks], &POSE[..], more].concat())
    }

    /// Sizes by method `ray`: quantity and mm.
    fn sizes(&self, shapes: Vec<Value>, more: &[&str]) -> Vec<(String, f64)> {
        let output = self.measure(shapes, &[more, &["--json"]].concat());
        assert_exit(&output, 0);
        let rows: Vec<Value> = serde_json::from_str(&stdout(&output)).unwrap();
        let by_ray = rows.iter().filter(|row| row["method"] == "ray");
        by_ray.map(|r| (r["quantity"].as_str().unwrap().to_owned(), r["predicted_mm"].as_f64().unwrap())).collect()
    }
}

fn circle(radius_mm: f64, y_mm: f64) -> Vec<[f64; 2]> {
    (0..16).map(|i| (f64::from(i) * 0.39).sin_cos()).map(|(s, c)| [radius_mm * c, y_mm + radius_mm * s]).collect()
}

fn ends(points: &[[f64; 2]]) -> [[f64; 2]; 2] {
    [points[0], points[1]]
}

#[track_caller]
fn assert_size(sizes: &[(String, f64)], quantity: &str, expected_mm: f64) {
    let (_, got_mm) = sizes.iter().find(|(q, _)| q == quantity).unwrap();
    assert!((got_mm - expected_mm).abs() < 1e-6, "{quantity}: {got_mm} mm for {expected_mm} mm");
}

#[test]
fn a_plate_by_line_and_by_rim() {
    let scene = Scene::new();
    let diameter = scene.pixels(0.0, &[[-100.0, 380.0], [100.0, 380.0]]);
    assert_size(&scene.sizes(vec![line("p/diameter", ends(&diameter))], &["--kind=plate"]), "diameter", 200.0);
    let rim = outline("p/rim", &scene.pixels(0.0, &circle(110.0, 390.0)));
    assert_size(&scene.sizes(vec![rim], &["--kind=plate"]), "diameter", 220.0);
    let raised = outline("p/rim", &scene.pixels(20.0, &circle(110.0, 390.0)));
    assert_size(&scene.sizes(vec![raised], &["--kind=plate", "--rim-height=20"]), "diameter", 220.0);
}

#[test]
fn a_bowl_with_a_vertical_wall() {
    let scene = Scene::new();
    let (foot, rim) = (scene.pixels(0.0, &[[0.0, 450.0]])[0], scene.pixels(65.0, &[[0.0, 450.0]])[0]);
    let outline = outline("b/rim", &scene.pixels(65.0, &circle(70.0, 380.0)));
    let sizes = scene.sizes(vec![line("b/height", [foot, rim]), outline], &["--kind=bowl"]);
    assert_size(&sizes, "height", 65.0);
    assert_size(&sizes, "diameter", 140.0);
}

#[test]
fn a_box_by_its_corners() {
    let scene = Scene::new();
    let corners = scene.pixels(40.0, &[[-120.0, 350.0], [120.0, 350.0], [120.0, 510.0], [-120.0, 510.0]]);
    let sizes = scene.sizes(vec![outline("x/rim", &corners)], &["--kind=box", "--rim-height=40"]);
    assert_size(&sizes, "length", 240.0);
    assert_size(&sizes, "width", 160.0);
}

#[test]
fn text_shows_sizes_with_their_uncertainty() {
    let scene = Scene::new();
    let diameter = line("p/diameter", ends(&scene.pixels(0.0, &[[-100.0, 380.0], [100.0, 380.0]])));
    let output = scene.measure(vec![diameter], &["--kind=plate"]);
    assert_exit(&output, 0);
    let text = stdout(&output);
    assert!(text.contains("sigma, mm") && text.contains("200.00"), "{text}");
}

#[test]
fn what_cannot_be_measured_is_told_and_the_rest_is_measured() {
    let scene = Scene::new();
    let good = line("p/diameter", ends(&scene.pixels(0.0, &[[-100.0, 380.0], [100.0, 380.0]])));
    let told = |shapes: Vec<Value>, kind: &str, code: i32, fact: &str| {
        let output = scene.measure(shapes, &[kind, "--json"]);
        assert_exit(&output, code);
        assert!(stderr(&output).contains(fact), "'{fact}' is missing in {}", stderr(&output));
    };
    told(vec![good.clone(), line("q/girth", [[1.0, 2.0], [3.0, 4.0]])], "--kind=plate", 3, "'girth' is nothing");
    told(vec![good.clone(), line("q/width", [[9.0, 9.0], [9.0, 9.0]])], "--kind=plate", 3, "lie on one spot");
    told(
        vec![good.clone(), outline("q/base", &[[1.0, 2.0], [3.0, 4.0], [5.0, 9.0]])],
        "--kind=plate",
        3,
        "'q' give no size",
    );
    told(vec![good.clone()], "--kind=bowl", 1, "the rim's height is not known");
    told(vec![line("p/diameter", [[640.0, 480.0], [640.0, -5000.0]])], "--kind=plate", 1, "beyond what the lens");
    let twisted = line("p/height", ends(&scene.pixels(0.0, &[[0.0, 450.0], [0.0, 400.0]])));
    told(vec![good, twisted], "--kind=bowl", 1, "towards the wearer");
}

#[test]
fn marks_outside_the_picture_are_measured_with_a_warning() {
    let scene = Scene::new();
    let wide = line("p/diameter", [[-200.0, 480.0], [640.0, 480.0]]);
    let output = scene.measure(vec![wide], &["--kind=plate"]);
    assert_exit(&output, 0);
    assert!(stderr(&output).contains("marks of 'p' lie outside the picture"), "{}", stderr(&output));
}

/// tan(pitch) has no bound: the paper's height must not reach the camera.
#[test]
fn a_height_above_the_camera_is_refused() {
    let scene = Scene::new();
    let marks = label_me(vec![line("b/height", [[640.0, 480.0], [640.0, 300.0]])]);
    std::fs::write(scene.path("marks.json"), marks.to_string()).unwrap();
    let (camera, marks) = (scene.path("cam.toml"), scene.path("marks.json"));
    let picture = scene.path("picture.png");
    let output = run([
        "measure",
        &picture,
        "--camera",
        &camera,
        "--marks",
        &marks,
        "--pitch=89.9",
        "--range=600",
        "--kind=bowl",
        "--json",
    ]);
    assert_exit(&output, 3);
    assert!(stderr(&output).contains("height of 'b' by paper: a wall"), "{}", stderr(&output));
    let rows: Vec<Value> = serde_json::from_str(&stdout(&output)).unwrap();
    let paper = rows.iter().find(|row| row["method"] == "paper").unwrap();
    assert!(paper["predicted_mm"].is_null() && paper["problem"].as_str().unwrap().contains("above the camera"));
}

#[test]
fn a_picture_of_another_size_is_refused() {
    let scene = Scene::new();
    image::RgbImage::new(64, 48).save(scene.path("picture.png")).unwrap();
    let output = scene.measure(vec![], &["--kind=plate"]);
    assert_exit(&output, 2);
    assert!(stderr(&output).contains("64 x 48") && stderr(&output).contains("1280 x 960"), "{}", stderr(&output));
}

#[test]
fn one_card_to_one_mcap_file() {
    let folder = tempfile::tempdir().unwrap();
    let card = crate::support::published_bench().join("cards/bench-35cm-55deg");
    let out = folder.path().join("session.mcap");
    let devices = crate::support::published_bench().join("devices");
    let output = run([
        "ingest",
        card.to_str().unwrap(),
        "--out",
        out.to_str().unwrap(),
        "--camera=bench-camera",
        "--devices",
        devices.to_str().unwrap(),
    ]);
    assert_exit(&output, 0);
    assert!(stdout(&output).contains("8 images"), "{}", stdout(&output));
    let mut reader = ingest::SessionReader::open(&out).unwrap();
    let images = reader.images().unwrap();
    assert_eq!(images.len(), 8);
    let bytes = reader.image_bytes(&images[0].file).unwrap();
    assert!(bytes == std::fs::read(card.join(&images[0].file)).unwrap(), "the picture is unchanged");

    let nowhere = run(["ingest", "nowhere", "--out", out.to_str().unwrap()]);
    assert_exit(&nowhere, 1);
    assert!(
        stderr(&nowhere).contains("nowhere") && stderr(&nowhere).contains("copy the SD card"),
        "{}",
        stderr(&nowhere)
    );
}

/// A white disc of 200 mm on a dark table, painted where the camera shows it.
fn paint_disc(file: &str) {
    use nalgebra::Point2;
    let lens = model::LensModel::Division(model::lens::Division { lambda: -0.2 });
    let camera = model::Camera::new([1280, 960], [900.0, 900.0], [640.0, 480.0], 0.0, lens).unwrap();
    let pose = model::Pose::new(52_f64.to_radians(), (-7.5_f64).to_radians(), 600.0).unwrap();
    let view = model::View::new(camera, pose);
    let center = view.on_plane(Point2::new(700.0, 450.0), 0.0).unwrap();
    let picture = image::RgbImage::from_fn(1280, 960, |x, y| {
        let place = view.on_plane(Point2::new(f64::from(x), f64::from(y)), 0.0);
        let inside = place.is_ok_and(|place| (place - center).norm() < 100.0);
        image::Rgb(if inside { [220, 220, 215] } else { [70, 60, 50] })
    });
    picture.save(file).unwrap();
}

#[test]
fn a_rim_is_found_without_marks() {
    let scene = Scene::new();
    paint_disc(&scene.path("picture.png"));
    let (camera, picture, overlay) = (scene.path("cam.toml"), scene.path("picture.png"), scene.path("overlay.png"));
    let found = |more: &[&str]| run([&["measure", &picture, "--camera", &camera, "--auto"], &POSE[..], more].concat());
    let output = found(&["--kind=plate", "--rim-height=0", "--json", "--overlay", &overlay]);
    assert_exit(&output, 0);
    let rows: Vec<Value> = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(rows.len(), 2, "one diameter by each method");
    for row in &rows {
        assert_eq!(
            (&row["object"], &row["kind"], &row["quantity"]),
            (&"auto-1".into(), &"plate".into(), &"diameter".into())
        );
        assert!(row["confidence"].as_f64().unwrap() > 0.9);
        assert!(row["rim_px"].as_array().unwrap().len() >= 24 && row["center_px"].as_array().unwrap().len() == 2);
    }
    let diameter_mm = rows.iter().find(|row| row["method"] == "ray").unwrap()["predicted_mm"].as_f64().unwrap();
    assert!((diameter_mm - 200.0).abs() < 0.6, "{diameter_mm} mm");
    let drawn = image::open(&overlay).unwrap().to_rgb8();
    assert_eq!(drawn.dimensions(), (1280, 960));
    assert_ne!(drawn, image::open(&picture).unwrap().to_rgb8());

    // A plate's rim stands above the table, nobody knows exactly how far.
    let rows: Vec<Value> = serde_json::from_str(&stdout(&found(&["--kind=plate", "--json"]))).unwrap();
    let plate = rows.iter().find(|row| row["method"] == "ray").unwrap();
    let (size_mm, sigma_mm) = (plate["predicted_mm"].as_f64().unwrap(), plate["sigma_mm"].as_f64().unwrap());
    assert!(
        (185.0..198.0).contains(&size_mm) && (size_mm - 200.0).abs() < 3.0 * sigma_mm,
        "{size_mm} +- {sigma_mm} mm"
    );

    // A bowl of unknown height is smaller, for its rim is nearer, and less certain.
    let rows: Vec<Value> = serde_json::from_str(&stdout(&found(&["--kind=bowl", "--json"]))).unwrap();
    let of = |quantity: &str| rows.iter().find(|row| row["quantity"] == quantity).unwrap();
    assert!(of("height")["predicted_mm"].as_f64().unwrap() > 0.0);
    assert!(of("diameter")["predicted_mm"].as_f64().unwrap() < 190.0);
    assert!(stdout(&found(&[])).contains("confidence"), "as text");
}

#[test]
fn a_picture_without_a_rim_gives_an_empty_list() {
    let scene = Scene::new();
    let (camera, picture) = (scene.path("cam.toml"), scene.path("picture.png"));
    let measure = |more: &[&str]| run([&["measure", &picture, "--camera", &camera], &POSE[..], more].concat());
    let output = measure(&["--auto", "--json"]);
    assert_exit(&output, 0);
    assert_eq!(stdout(&output).trim(), "[]");
    assert!(stderr(&output).contains("no rim"));
    for wrong in [
        &["--auto", "--marks=marks.json"][..],
        &["--auto", "--shape=square"],
        &["--auto", "--kind=box"],
        &["--auto", "--min-confidence=2"],
        &["--kind=plate"],
        &[],
    ] {
        assert_exit(&measure(wrong), 2);
    }
}

#[test]
fn marks_are_drawn_as_well() {
    let scene = Scene::new();
    let overlay = scene.path("overlay.png");
    let rim = scene.pixels(0.0, &circle(90.0, 370.0));
    let output = scene.measure(vec![outline("plate/rim", &rim)], &["--kind=plate", "--overlay", &overlay]);
    assert_exit(&output, 0);
    let drawn = image::open(&overlay).unwrap().to_rgb8();
    assert!(drawn.pixels().any(|pixel| pixel.0 == [0, 255, 0]) && drawn.pixels().any(|pixel| pixel.0 == [255, 255, 0]));
}
