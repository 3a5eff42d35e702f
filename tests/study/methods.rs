//! Methods, fused sizes and calibration through the whole program, on marks of exact geometry.

use model::{Camera, LensModel, Level, Method, Pose, Quantity, ResultRow, View};
use nalgebra::Point3;
use report::Results;
use serde_json::Value;

use crate::support::{
    Shot, StudyFolder, assert_exit, label_me, line, outline, run, small_camera, small_picture, stdout,
};

pub const OBJECTS: &str =
    "object,kind,shape,true_diameter_mm,true_height_mm\nbowl,bowl,circle,160,60\nplate,plate,circle,200,\n";

pub fn view(pitch_deg: f64, roll_deg: f64, range_mm: f64) -> View {
    let camera = Camera::new([64, 48], [60.0, 60.0], [32.0, 24.0], 0.0, LensModel::None).unwrap();
    View::new(camera, Pose::new(pitch_deg.to_radians(), roll_deg.to_radians(), range_mm).unwrap())
}

fn circle(view: &View, radius_mm: f64, z_mm: f64) -> Vec<[f64; 2]> {
    let y_mm = view.pose().range_mm() * view.pose().pitch_rad().cos();
    (0..16)
        .map(|i| (f64::from(i) * 0.39).sin_cos())
        .map(|(s, c)| view.pixel_of(Point3::new(5.0 + radius_mm * c, y_mm + radius_mm * s, z_mm)).unwrap())
        .map(|p| [p.x, p.y])
        .collect()
}

/// A bowl 60 mm high whose rim overhangs its base by 35 mm, and a plate in its place.
fn marks(view: &View) -> Value {
    let y_mm = view.pose().range_mm() * view.pose().pitch_rad().cos();
    let away = nalgebra::Vector2::new(5.0, y_mm).normalize();
    let end = |along_mm: f64, z_mm: f64| {
        let p = view.pixel_of(Point3::new(5.0 + away.x * along_mm, y_mm + away.y * along_mm, z_mm)).unwrap();
        [p.x, p.y]
    };
    label_me(vec![
        outline("bowl/rim", &circle(view, 80.0, 60.0)),
        outline("bowl/base", &circle(view, 45.0, 0.0)),
        line("bowl/height", [end(45.0, 0.0), end(80.0, 60.0)]),
        outline("plate/rim", &circle(view, 100.0, 0.0)),
    ])
}

/// A picture of the scene from a pose, as sensors see it that are off.
pub fn shot(pitch_deg: f64, roll_deg: f64, range_mm: f64, pitch_off_deg: f64, range_factor: f64) -> Shot {
    Shot {
        picture: small_picture(),
        extension: "jpg",
        pitch_deg: pitch_deg + pitch_off_deg,
        roll_deg,
        range_mm: range_mm * range_factor,
        marks: Some(marks(&view(pitch_deg, roll_deg, range_mm))),
    }
}

fn results(study: &StudyFolder, more: &[&str]) -> Results {
    let out = study.path().join("out/r.parquet");
    let arguments = ["run", study.path().to_str().unwrap(), "--out", out.to_str().unwrap()];
    assert_exit(&run([&arguments[..], more].concat()), 0);
    Results::read(&out).unwrap()
}

fn row(results: &Results, level: Level, object: &str, quantity: Quantity, method: Method) -> ResultRow {
    let same = |row: &&ResultRow| {
        (row.level, row.object.as_str(), row.quantity, row.method) == (level, object, quantity, method)
    };
    results
        .rows
        .iter()
        .find(same)
        .unwrap_or_else(|| panic!("no {level} row of {object} {quantity} by {method}"))
        .clone()
}

#[track_caller]
fn assert_mm(row: &ResultRow, expected_mm: f64, tolerance_mm: f64) {
    let got_mm = row.predicted_mm.unwrap();
    assert!((got_mm - expected_mm).abs() < tolerance_mm, "{got_mm} for {expected_mm} mm: {row:?}");
}

#[test]
fn a_sloped_bowl_by_every_method() {
    let study = StudyFolder::new("[uncertainty]\nmark_px = 0.05\n", OBJECTS, &small_camera());
    let shots = [(40.0, 4.0, 700.0), (55.0, -6.0, 560.0), (58.0, 2.0, 540.0), (70.0, 0.0, 500.0)];
    study.session("s", &shots.map(|(pitch, roll, range)| shot(pitch, roll, range, 0.0, 1.0)));
    let results = results(&study, &[]);
    let of = |level, quantity, method| row(&results, level, "bowl", quantity, method);

    for level in [Level::Frame, Level::Fused] {
        let coaxial = of(level, Quantity::Height, Method::Coaxial);
        assert_mm(&coaxial, 60.0, 0.01);
        assert!((coaxial.wall_slope.unwrap() - 35.0 / 60.0).abs() < 1e-3 && coaxial.doubts.is_empty());
        assert_mm(&of(level, Quantity::Diameter, Method::Coaxial), 160.0, 0.02);
        let best = of(level, Quantity::Height, Method::Best);
        assert!(matches!(best.method_used, Some(Method::Coaxial | Method::Joint)), "{best:?}");
        let ray = of(level, Quantity::Height, Method::Ray);
        assert!(ray.doubts.contains("wall_sloped") && ray.error_pct.unwrap() > 20.0);
    }
    let joint = of(Level::Fused, Quantity::Height, Method::Joint);
    assert_mm(&joint, 60.0, 0.05);
    assert!((joint.wall_slope.unwrap() - 35.0 / 60.0).abs() < 2e-3 && joint.frames == 4);
    assert_mm(&of(Level::Fused, Quantity::Diameter, Method::Joint), 160.0, 0.1);

    let fused = row(&results, Level::Fused, "plate", Quantity::Diameter, Method::Ray);
    assert_eq!((fused.frames, fused.consistency.map(|verdict| verdict.code())), (2, Some("consistent")));
    assert!(fused.sigma_common_mm.unwrap() > 0.9 * fused.sigma_mm.unwrap(), "a range 3 % off is so in both images");
    let frames = results.rows.iter().filter(|row| row.level == Level::Frame && row.object == "plate");
    let ray: Vec<_> = frames.filter(|row| row.method == Method::Ray && row.selected).collect();
    let weights: f64 = ray.iter().map(|row| row.weight.unwrap()).sum();
    assert!((weights - 1.0).abs() < 1e-9);
    let mut ranks: Vec<_> = ray.iter().map(|row| row.rank.unwrap()).collect();
    ranks.sort_unstable();
    assert_eq!(ranks, [1, 2]);
}

/// Sensors 2 degrees and 5 % off: a bench of nine setups finds both, and a run with what it found is right.
#[test]
fn a_bench_teaches_what_the_sensors_are_off_by() {
    let study = StudyFolder::new(
        "[uncertainty]\nmark_px = 0.05\nrange_noise_mm = 0.1\nturn_noise_deg = 0.01\n",
        OBJECTS,
        &small_camera(),
    );
    for (i, height_mm) in [300.0, 400.0, 500.0_f64].into_iter().enumerate() {
        for pitch_deg in [42.0, 55.0, 68.0_f64] {
            let range_mm = height_mm / pitch_deg.to_radians().sin();
            let name = format!("setup-{i}-{pitch_deg}");
            study.session(&name, &[shot(pitch_deg, 3.0, range_mm, -2.0, 1.0 / 0.95)]);
            study.write(
                &format!("cards/{name}/session.toml"),
                format!("setup_height_mm = {height_mm:.1}\nsetup_pitch_deg = {pitch_deg:.1}\n"),
            );
        }
    }
    let file = study.path().join("out/calibration.toml");
    std::fs::create_dir_all(study.path().join("out")).unwrap();
    let output = run(["calibrate", study.path().to_str().unwrap(), "--out", file.to_str().unwrap()]);
    assert_exit(&output, 0);
    let found: toml::Value = toml::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
    let number = |key: &str| found["physical"][key].as_float().unwrap();
    assert!((number("mount_deg") - 2.0).abs() < 0.05, "{}", stdout(&output));
    assert!((number("range_scale_pct") + 5.0).abs() < 0.2, "{}", stdout(&output));
    assert_eq!(found["physical"]["range_cone"].as_str(), Some("off"));
    assert!((found["protractor"]["mean_difference_deg"].as_float().unwrap() + 2.0).abs() < 0.05);

    let worst = |results: &Results, method: Method| {
        let errors = results.rows.iter().filter(|row| row.method == method).filter_map(|row| row.error_pct);
        errors.map(f64::abs).fold(0.0, f64::max)
    };
    let before = results(&study, &[]);
    let after = results(&study, &["--calibration", file.to_str().unwrap()]);
    assert!(worst(&before, Method::Coaxial) > 4.0, "{}", worst(&before, Method::Coaxial));
    assert!(worst(&after, Method::Coaxial) < 0.5, "{}", worst(&after, Method::Coaxial));
    let sigma = |results: &Results| {
        let plate = row(results, Level::Frame, "plate", Quantity::Diameter, Method::Ray);
        plate.sigma_range_mm.unwrap().hypot(plate.sigma_mount_mm.unwrap()).hypot(plate.sigma_pitch_mm.unwrap())
    };
    assert!(sigma(&after) < 0.4 * sigma(&before), "what was learned is sure: {} {}", sigma(&after), sigma(&before));
}
