//! Calibrations recover the biases of a bench, and refuse those that its data do not determine.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use aim_batch_model::calibrate::empirical::{self, Row, ScaleError};
use aim_batch_model::calibrate::physical::{self, BenchSize, Correction, CorrectionError};
use aim_batch_model::calibrate::protractor::protractor;
use aim_batch_model::{
    Camera, Container, Feature, InputSigma, Kind, LensModel, Mark, Method, ObjectMarks, Pose, Quantity, Shape, View,
};
use nalgebra::{Point2, Point3, Rotation3, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

const OFF: Correction = Correction { mount_rad: 0.025, range_scale: -0.04, range_offset_mm: 9.0, focal_share: 0.0 };

fn camera() -> Camera {
    Camera::new([2592, 1944], [1695.0, 1703.0], [1296.0, 972.0], 0.0, LensModel::None).unwrap()
}

/// The view by the readings of a device with these errors, whose camera is at `pose`.
fn reading(pose: Pose, off: &Correction) -> View {
    let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), -off.mount_rad);
    let (pitch, roll) = Pose::pitch_roll_of_down(&(turn * pose.down_in_camera())).unwrap();
    let range_mm = (pose.range_mm() - off.range_offset_mm) / (1.0 + off.range_scale);
    View::new(camera(), Pose::new(pitch, roll, range_mm).unwrap())
}

/// Plates in setups of these heights and of four pitches, whose marks have errors of `mark_px`.
fn bench(off: &Correction, mark_px: f64, heights_mm: &[f64]) -> Vec<BenchSize> {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut sizes = Vec::new();
    for height_mm in heights_mm {
        for pitch_deg in [40.0_f64, 50.0, 60.0, 70.0] {
            let pitch_rad = pitch_deg.to_radians();
            let pose = Pose::new(pitch_rad, 0.03, height_mm / pitch_rad.sin()).unwrap();
            let view = View::new(camera(), pose);
            for radius_mm in [60.0, 75.0, 90.0] {
                let points_px = (0..16)
                    .map(|i| (f64::from(i) * 0.39).sin_cos())
                    .map(|(s, c)| {
                        let y_mm = height_mm / pitch_rad.tan();
                        let seen = view.pixel_of(Point3::new(radius_mm * c, y_mm + radius_mm * s, 0.0)).unwrap();
                        let mut off_px = || mark_px * Distribution::<f64>::sample(&StandardNormal, &mut random);
                        Point2::new(seen.x + off_px(), seen.y + off_px())
                    })
                    .collect();
                let rim = Mark::Outline { feature: Feature::Rim, points_px };
                sizes.push(BenchSize {
                    object: format!("plate {radius_mm}"),
                    setup: format!("{height_mm} {pitch_deg}"),
                    view: reading(pose, off),
                    method: Method::Ray,
                    container: Container { kind: Kind::Plate, shape: Shape::Circle, rim_height_mm: None, wall: None },
                    marks: ObjectMarks { object: "plate".to_owned(), marks: vec![rim] },
                    quantity: Quantity::Diameter,
                    true_mm: 2.0 * radius_mm,
                    inputs: InputSigma { mark_px: mark_px.max(0.1), ..InputSigma::NONE },
                });
            }
        }
    }
    sizes
}

#[test]
fn the_biases_of_a_bench_are_recovered() {
    let prior = InputSigma { focal_relative: 0.0, ..InputSigma::default() };
    let fitted = physical::calibrate(&bench(&OFF, 0.0, &[200.0, 350.0, 500.0]), &prior).unwrap();
    assert_eq!(fitted.determined, [true, true, true, false], "the focal length is known beforehand");
    let (got, expected) = (fitted.correction.values(), OFF.values());
    for (got, (expected, unit)) in got.into_iter().zip(expected.into_iter().zip([0.02, 0.03, 5.0, 0.01])) {
        assert!((got - expected).abs() < 1e-4 * unit, "{got} {expected}");
    }
    assert!(fitted.without_object.before_rmse_pct > 1.0);
    assert!(
        fitted.without_object.after_rmse_pct.unwrap() < 1e-3 && fitted.without_setup.after_rmse_pct.unwrap() < 1e-3
    );
}

/// With noisy marks the corrections lie within four of their SDs, sizes that were left out become far better, and one bad size
/// changes little.
#[test]
fn noise_and_one_bad_size_do_little_harm() {
    let mut sizes = bench(&OFF, 2.0, &[200.0, 350.0, 500.0]);
    sizes[5].true_mm *= 1.6;
    let fitted = physical::calibrate(&sizes, &InputSigma::default()).unwrap();
    for i in (0..4).filter(|&i| fitted.determined[i]) {
        let sd = fitted.sd[i].unwrap();
        assert!(sd > 0.0 && (fitted.correction.values()[i] - OFF.values()[i]).abs() < 4.0 * sd, "{i}: {fitted:?}");
    }
    assert!(fitted.determined[0] && fitted.determined[1]);
    sizes.remove(5);
    let clean = physical::calibrate(&sizes, &InputSigma::default()).unwrap();
    assert!((fitted.correction.mount_rad - clean.correction.mount_rad).abs() < 0.002);
    assert!(clean.without_setup.after_rmse_pct.unwrap() < 0.5 * clean.without_setup.before_rmse_pct);
}

/// At a single height, scale and offset of the range have the same effect.
#[test]
fn what_the_data_do_not_determine_is_refused() {
    let fitted = physical::calibrate(&bench(&Correction::default(), 1.0, &[350.0]), &InputSigma::default()).unwrap();
    assert!(!(fitted.determined[1] && fitted.determined[2]), "{fitted:?}");
    for i in (0..4).filter(|&i| !fitted.determined[i]) {
        assert!(fitted.correction.values()[i] == 0.0 && fitted.covariance[(i, i)] > 0.0, "what was known stays");
    }
    let few = bench(&OFF, 1.0, &[350.0]);
    let refused = physical::calibrate(&few[..5], &InputSigma::default());
    assert_eq!(refused, Err(CorrectionError::TooFew { sizes: 5, setups: 2 }));
}

fn row(object: &str, pitch_deg: f64, factor: f64) -> Row {
    Row {
        object: object.to_owned(),
        setup: format!("{pitch_deg}"),
        pitch_rad: pitch_deg.to_radians(),
        predicted_mm: 100.0 * factor,
        true_mm: 100.0,
    }
}

#[test]
fn a_line_in_the_tangent_is_fitted_and_a_slip_is_named() {
    let mut rows: Vec<Row> = ["a", "b", "c"]
        .into_iter()
        .flat_map(|object| {
            [38.0_f64, 42.0, 53.0, 56.0, 64.0, 70.0]
                .map(|pitch| row(object, pitch, 0.9 + 0.1 * pitch.to_radians().tan() + 0.001 * (pitch % 3.0)))
        })
        .collect();
    rows[7].predicted_mm /= 10.0;
    let fitted = empirical::calibrate(&rows).unwrap();
    assert!((fitted.scale.a - 0.9).abs() < 0.01 && (fitted.scale.b - 0.1).abs() < 0.01, "{:?}", fitted.scale);
    assert_eq!(fitted.slips, [empirical::Slip { row: 7, factor: 10.0 }]);
    let mended = empirical::calibrate(&empirical::mended(&rows, &fitted.slips)).unwrap();
    assert!(mended.slips.is_empty() && mended.without_object.after_rmse_pct.unwrap() < 0.2);
    assert_eq!(mended.without_object.folds, 3);
}

#[test]
fn one_pitch_has_no_trend() {
    let rows: Vec<Row> = (0..8).map(|i| row(["a", "b"][i % 2], 55.0, 1.05)).collect();
    assert_eq!(empirical::calibrate(&rows), Err(ScaleError::OnePitch));
    assert_eq!(empirical::calibrate(&rows[..3]), Err(ScaleError::TooFew(3)));
}

#[test]
fn angles_against_a_protractor() {
    let line = protractor(&[(30.0, 31.0), (45.0, 46.3), (60.0, 61.0), (75.0, 76.1)]).unwrap();
    assert!((line.slope - 1.0).abs() < 0.01 && (line.mean_difference - 1.1).abs() < 1e-12, "{line:?}");
    assert!(protractor(&[(30.0, 31.0), (30.0, 32.0), (30.0, 30.0)]).is_none());
}

/// The errors of objects that were left out, for the paper's Tables II to IV as they ship with the study of the published
/// bench.
#[test]
fn published_rows() {
    let read = |table: &str| -> Vec<Row> {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../data-samples/published-bench/printed")
            .join(format!("table_{table}.csv"));
        let mut reader = csv::Reader::from_path(path).unwrap();
        let names = reader.headers().unwrap().clone();
        let records: Vec<_> = reader.records().map(Result::unwrap).collect();
        let column = |name: &str| names.iter().position(|n| n == name).unwrap();
        let number = |record: &csv::StringRecord, name: &str| record[column(name)].parse::<f64>().unwrap();
        let row = |record: &csv::StringRecord| Row {
            object: record[column("object")].to_owned(),
            setup: format!("{}/{}", &record[column("height_cm")], &record[column("pitch_deg")]),
            pitch_rad: number(record, "pitch_deg").to_radians(),
            predicted_mm: 10.0 * number(record, "predicted_cm"),
            true_mm: 10.0 * number(record, "original_cm"),
        };
        records.iter().map(row).collect()
    };
    let left_out = |rows: &[Row]| empirical::calibrate(rows).unwrap().without_object;
    for (table, n, before, after) in [("II", 45, 5.25, 4.24), ("IV", 27, 8.08, 5.29), ("III", 27, 37.5, 28.6)] {
        let errors = left_out(&read(table));
        assert_eq!(errors.n, n);
        assert!((errors.before_rmse_pct - before).abs() < 0.02, "{table}: {errors:?}");
        assert!(errors.after_rmse_pct.unwrap() < after + 0.005, "{table}: {errors:?}");
    }
    let heights = read("III");
    let slips = empirical::calibrate(&heights).unwrap().slips;
    assert_eq!(slips.len(), 1);
    let slipped = &heights[slips[0].row];
    assert_eq!((slipped.object.as_str(), slipped.setup.as_str()), ("circular bowl (medium)", "20.0/64.0"));
    let mended = left_out(&empirical::mended(&heights, &slips));
    assert!((mended.before_rmse_pct - 34.7).abs() < 0.06 && mended.after_rmse_pct.unwrap() < 20.8, "{mended:?}");
}
