//! Tests of scene files that are accepted, and of the studies that they make.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod refused;

use model::{Kind, Quantity, Shape};

use super::*;
use crate::laid::Frame;

const HEAD: &str = "schema_version = 1\nname = \"s\"\ncamera = \"c\"\n";
const SESSION: &str = "[[sessions]]\nname = \"a\"\nstand = { pitch_deg = 55, height_mm = 440 }\n";

fn read(text: &str) -> Result<SceneSpec, toml::de::Error> {
    toml::from_str(text)
}

fn scene(parts: &str) -> SceneSpec {
    read(&format!("{HEAD}{parts}")).unwrap()
}

/// The line of an error, counted from 1, and its text.
fn refused(text: &str) -> (usize, String) {
    let error = read(text).unwrap_err();
    let line = text[..error.span().unwrap().start].matches('\n').count() + 1;
    (line, error.message().to_owned())
}

fn frames(scene: &SceneSpec) -> Vec<Vec<Frame>> {
    let planner = Planner::new(scene, scene.seed(), 200);
    (0..planner.extent().0).map(|number| planner.plan(number).frames).collect()
}

fn camera() -> CameraSpec {
    let text = "schema_version = 1\nname = \"c\"\nwidth_px = 96\nheight_px = 72\nfocal_px = [62.0, 62.0]\n\
                principal_px = [48.0, 36.0]\nlens = { model = \"division\", lambda = -0.1 }\n";
    toml::from_str(text).unwrap()
}

#[test]
fn sizes_are_those_of_the_file() {
    let scene = scene(&format!(
        "[[plates]]\nname = \"round\"\ndiameter_mm = 240\n[[plates]]\nname = \"square\"\nwidth_mm = 190\nheight_mm = 20\n\
         [[plates]]\nname = \"long\"\nwidth_mm = 150\nlength_mm = 260\n[[bowls]]\nname = \"bowl\"\ndiameter_mm = 130\n\
         height_mm = 60\nthickness_mm = 6\n[[boxes]]\nname = \"box\"\nwidth_mm = 110\nlength_mm = 170\nheight_mm = 50\n\
         {SESSION}one_at_a_time = true\n"
    ));
    let frames = frames(&scene).remove(0);
    let expected = [
        ("round", Kind::Plate, Shape::Circle, [Some(240.0), None, None], 21.5),
        ("square", Kind::Plate, Shape::Square, [None, Some(190.0), None], 20.0),
        ("long", Kind::Plate, Shape::Rectangle, [None, Some(150.0), Some(260.0)], 24.0),
        ("bowl", Kind::Bowl, Shape::Circle, [Some(130.0), None, None], 57.0),
        ("box", Kind::Box, Shape::Rectangle, [None, Some(110.0), Some(170.0)], 50.0),
    ];
    assert_eq!(frames.len(), expected.len());
    for (frame, (name, kind, shape, sizes, level_mm)) in frames.iter().zip(expected) {
        let truth = frame.truths(&frame.view(&camera().camera().unwrap()).unwrap()).remove(0);
        assert_eq!((&*truth.object, truth.kind, truth.shape), (name, kind, shape));
        assert_eq!([truth.true_diameter_mm, truth.true_width_mm, truth.true_length_mm], sizes);
        assert!((truth.rim_level_mm - level_mm).abs() < 1e-9, "{name}: {}", truth.rim_level_mm);
    }
}

/// A ray straight down onto a rectangle meets the top at the rim's height just inside of the outline, and the table outside.
#[test]
fn rectangles_stand_where_they_should() {
    let scene = scene(&format!(
        "[[plates]]\nname = \"p\"\nwidth_mm = 150\nlength_mm = 240\nheight_mm = 25\nturn_deg = 30\nat_mm = [40, 300]\n\
         [[boxes]]\nname = \"b\"\nwidth_mm = 110\nlength_mm = 170\nheight_mm = 50\nturn_deg = 70\nat_mm = [-60, 250]\n\
         {SESSION}one_at_a_time = true\n"
    ));
    for frame in frames(&scene).remove(0) {
        let placed = &frame.placed[0];
        let [half_x, half_y] = [0.5 * placed.ware.diameter_mm, 0.5 * placed.ware.width_mm];
        let top = |x: f64, y: f64| {
            let at = placed.at_mm + nalgebra::Rotation2::new(placed.turn_rad) * nalgebra::Vector2::new(x, y);
            let origin = nalgebra::Point3::new(at.x, at.y, 300.0);
            300.0 - frame.world.distance(&crate::scene::Ray { origin, direction: -nalgebra::Vector3::z() }).unwrap()
        };
        for (x, y) in [(1.0, 0.0), (-1.0, 0.2), (0.0, 1.0), (0.3, -1.0), (0.99, 0.99), (-0.99, 0.98)] {
            let (inside, outside) =
                (top(x * (half_x - 0.2), y * (half_y - 0.2)), top(x * (half_x + 0.5), y * (half_y + 0.5)));
            assert!((inside - placed.ware.rim_level_mm()).abs() < 1.2, "{}: {inside} at {x}, {y}", placed.object);
            assert!(x.abs().max(y.abs()) < 1.0 || outside.abs() < 1e-9, "{}: {outside} at {x}, {y}", placed.object);
        }
        let middle = top(0.0, 0.0);
        assert!(middle < 0.4 * placed.ware.height_mm, "{}: {middle} in the middle", placed.object);
    }
}

#[test]
fn a_camera_looks_where_it_aims_from_any_side() {
    for yaw_deg in [0, 35, -120] {
        let stand = format!("stand = {{ pitch_deg = 50, height_mm = 430, aim_mm = [25, 280], yaw_deg = {yaw_deg} }}");
        let scene = scene(&format!("[[sessions]]\nname = \"a\"\n{stand}\n"));
        let frame = &frames(&scene)[0][0];
        let seen = frame.in_view(nalgebra::Point2::new(25.0, 280.0));
        let away = 430.0 / 50.0_f64.to_radians().tan();
        assert!(seen.x.abs() < 1e-9 && (seen.y - away).abs() < 1e-9, "{yaw_deg}: {seen}");
    }
}

#[test]
fn meals_are_served_eaten_and_taken_away() {
    let bowl = "[[bowls]]\nname = \"b\"\ndiameter_mm = 130\nheight_mm = 60\nfood_pct = 80\n";
    let hand = "[[hands]]\ntip_mm = [60, 260, 80]\nelbow_mm = [300, 0, 60]\nseen_pct = 50\n";
    let head =
        "head = { images = 40, pitch_deg = [40, 60], height_mm = [400, 450], roll_deg = [-3, 3], sway_deg = 0 }\n";
    let scene = scene(&format!(
        "{bowl}{hand}[[sessions]]\nname = \"a\"\nbare_pct = [10, 20]\neaten_pct = 100\nperiod_s = 12\n{head}"
    ));
    let frames = frames(&scene).remove(0);
    let is_bare: Vec<bool> = frames.iter().map(|frame| frame.placed.is_empty()).collect();
    assert!(is_bare.iter().enumerate().all(|(at, bare)| *bare != (4..32).contains(&at)), "{is_bare:?}");
    // The number of bodies of an image depends on whether there is a hand.
    let numbers: std::collections::BTreeSet<usize> =
        frames[4..32].iter().map(|frame| frame.world.bodies.len()).collect();
    assert_eq!(numbers.len(), 2, "{numbers:?}");
    let level = |frame: &Frame| {
        let mut world = frame.world.clone();
        world.bodies.truncate(2); // the bowl, and what fills it
        let origin = nalgebra::Point3::new(6.0, 313.0, 400.0);
        400.0 - world.distance(&crate::scene::Ray { origin, direction: -nalgebra::Vector3::z() }).unwrap()
    };
    let levels: Vec<f64> = frames[4..32].iter().map(level).collect();
    assert!(levels.windows(2).all(|pair| pair[1] < pair[0]), "{levels:?}");
    for frame in &frames {
        let height_mm = frame.head.range_mm * frame.head.pitch_deg.to_radians().sin();
        assert!((40.0..=60.0).contains(&frame.head.pitch_deg) && frame.head.roll_deg.abs() <= 3.0);
        assert!((399.999..450.001).contains(&height_mm), "{height_mm}");
    }
    assert!((frames[1].time_s - frames[0].time_s - 12.0).abs() < 1e-9);
}

/// The whole study is the same for any number of threads, and another one for another seed. Its sensors err as the file says.
#[test]
fn a_study_follows_from_the_file_and_the_seed() {
    let text = include_str!("../../../../../data-samples/scenes/kitchen.toml");
    let scene = read(text).unwrap();
    let written = |threads: usize, seed: u64| {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("study");
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let made = pool.install(|| scene.write(&out, &camera(), seed, text.as_bytes(), &|_, _| {})).unwrap();
        assert_eq!((made.summary.sessions, made.summary.images), (3, 10));
        assert_eq!(std::fs::read_to_string(out.join("scene.toml")).unwrap(), text);
        let mut files = Vec::new();
        for session in ["bench", "poses", "meal"] {
            for part in ["IMAGES", "SENSORS"] {
                let entries = std::fs::read_dir(out.join(format!("cards/{session}/{part}"))).unwrap();
                files.extend(entries.map(|entry| entry.unwrap().path()));
            }
        }
        files.sort();
        (made.truth, files.iter().map(|path| std::fs::read(path).unwrap()).collect::<Vec<_>>())
    };
    let (truth, files) = written(1, scene.seed());
    assert!((truth.clone(), files) == written(3, 7));
    let (other, _) = written(2, 8);
    let poses = |rows: &[model::results::TruthRow]| rows.iter().map(|row| row.pitch_deg).collect::<Vec<_>>();
    assert_eq!(poses(&truth)[..5], poses(&other)[..5], "a stand and poses do not depend on the seed");
    assert_ne!(poses(&truth)[5..], poses(&other)[5..], "a head does");
    assert_eq!(truth.len(), 10, "one row per container, or per image without one");
    assert_eq!(truth.iter().filter(|row| row.object.is_none()).count(), 1);
    let fixed = scene.sensors.as_ref().unwrap().0;
    assert_eq!((fixed.zero_g_offset_mg, fixed.range_noise), (Some([4.0, -6.0, 5.0]), 0.01));
    let boxed = truth.iter().find(|row| row.object.as_deref() == Some("lunch box")).unwrap();
    assert!(boxed.marked && (boxed.turn_deg.unwrap() + 15.0).abs() < 1e-9);
    assert_eq!(
        Quantity::ALL.iter().filter_map(|q| scene.boxes[0].0.ware.across_mm(*q)).collect::<Vec<_>>(),
        [120.0, 180.0]
    );
}

/// Every file that is accepted can be planned, and its numbers are finite. Sizes are drawn from all values that single keys allow,
/// so many of the files are refused, but not most of them.
#[test]
fn what_is_accepted_can_be_made() {
    use rand::{Rng, SeedableRng};
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
    let camera = camera().camera().unwrap();
    let mut accepted = 0;
    for _ in 0..400 {
        let mut any = |least: f64, most: f64| {
            let share =
                if random.random_bool(0.2) { f64::from(u8::from(random.random_bool(0.5))) } else { random.random() };
            format!("{:.3}", least + share * (most - least))
        };
        let text = format!(
            "{HEAD}[[plates]]\nname = \"p\"\nwidth_mm = {}\nlength_mm = {}\nheight_mm = {}\nthickness_mm = {}\nfood_pct = {}\n\
             [[bowls]]\nname = \"b\"\ndiameter_mm = {}\nheight_mm = {}\nthickness_mm = {}\nroundness_pct = {}\nfood_pct = {}\n\
             [[boxes]]\nname = \"x\"\nwidth_mm = {}\nlength_mm = {}\nheight_mm = {}\nfood_pct = {}\n\
             [[sessions]]\nname = \"a\"\none_at_a_time = true\n\
             stand = {{ pitch_deg = {}, height_mm = {}, roll_deg = {}, yaw_deg = {} }}\n",
            any(20.0, 400.0),
            any(200.0, 1000.0),
            any(3.0, 100.0),
            any(1.0, 12.0),
            any(0.0, 100.0),
            any(20.0, 1000.0),
            any(3.0, 500.0),
            any(1.0, 30.0),
            any(0.0, 100.0),
            any(0.0, 100.0),
            any(20.0, 400.0),
            any(200.0, 1000.0),
            any(3.0, 500.0),
            any(0.0, 100.0),
            any(5.0, 90.0),
            any(100.0, 2000.0),
            any(-60.0, 60.0),
            any(-360.0, 360.0),
        );
        let Ok(scene) = read(&text) else { continue };
        accepted += 1;
        for frame in frames(&scene).remove(0) {
            let view = frame.view(&camera).unwrap();
            let truth = frame.truths(&view).remove(0);
            let numbers =
                [truth.rim_level_mm, truth.center_x_mm, truth.center_y_mm, truth.rim_seen, frame.cone_mm(&view)];
            assert!(numbers.iter().all(|number| number.is_finite()), "{numbers:?}\n{text}");
            assert!(
                frame.marks(&view).iter().flat_map(|line| line.ends_px).all(|p| p.x.is_finite() && p.y.is_finite())
            );
        }
    }
    assert!(accepted > 60, "{accepted}");
}
