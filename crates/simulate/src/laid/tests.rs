//! Tests of the promises of the presets.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use model::{Kind, View};
use nalgebra::{Point2, Point3};

use super::*;

const SIZE_PX: [u32; 2] = [160, 120];

fn view(frame: &Frame) -> View {
    frame.view(&camera(SIZE_PX).unwrap()).unwrap()
}

#[test]
fn the_bench_has_nine_setups_of_eight_objects_all_in_the_picture() {
    let plans = bench(1, SIZE_PX[0]);
    assert_eq!((plans.len(), plans.iter().map(|plan| plan.frames.len()).sum::<usize>()), (9, 72));
    for frame in plans.iter().flat_map(|plan| &plan.frames) {
        let truths = frame.truths(&view(frame));
        assert_eq!(truths.len(), 1);
        assert!(truths[0].rim_in_picture > 0.99, "{truths:?}");
        assert!(truths[0].rim_seen > 0.6, "{truths:?}");
    }
}

#[test]
fn heads_of_worn_sessions_wander_and_some_pictures_have_no_container() {
    let plans = worn(3, SIZE_PX[0], 2, 60);
    let frames: Vec<&Frame> = plans.iter().flat_map(|plan| &plan.frames).collect();
    let pitches: Vec<f64> = frames.iter().map(|frame| frame.head.pitch_deg).collect();
    let (least, most) = (pitches.iter().copied().fold(f64::MAX, f64::min), pitches.iter().copied().fold(0.0, f64::max));
    assert!((19.0..35.0).contains(&least) && (70.0..81.0).contains(&most), "{least} to {most}");
    let bare = frames.iter().filter(|frame| frame.placed.is_empty()).count();
    assert!((25..35).contains(&bare), "{bare}");
    assert!(frames.iter().any(|frame| frame.truths(&view(frame)).iter().any(|t| t.rim_seen < 0.8 * t.rim_in_picture)));
}

#[test]
fn any_number_of_threads_gives_the_same_bytes_and_another_seed_gives_others() {
    let written = |threads: usize, seed: u64| {
        let folder = tempfile::tempdir().unwrap();
        let preset = LaidPreset::Worn { sessions: 1, images: 3 };
        let options = LaidOptions { preset, seed, size_px: SIZE_PX };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let made = pool.install(|| write(folder.path(), &options, &|_, _| {})).unwrap();
        assert_eq!((made.summary.sessions, made.summary.images), (1, 3));
        let card = folder.path().join("cards/worn-001");
        let mut files: Vec<_> = ["IMAGES", "SENSORS"]
            .iter()
            .flat_map(|part| std::fs::read_dir(card.join(part)).unwrap())
            .map(|entry| entry.unwrap().path())
            .collect();
        files.sort();
        (made.truth, files.iter().map(|path| std::fs::read(path).unwrap()).collect::<Vec<_>>())
    };
    assert_eq!(written(1, 5), written(4, 5));
    assert_ne!(written(2, 5), written(2, 6));
}

/// The rendered rim lies where the mathematics of the camera puts it: a ray just inside of it meets the container, and one
/// outside does not.
#[test]
fn rims_appear_where_the_truth_says() {
    for frame in
        bench(2, SIZE_PX[0]).iter().flat_map(|plan| &plan.frames).filter(|f| f.placed[0].ware.kind != Kind::Box)
    {
        let placed = &frame.placed[0];
        let (level, radius) = (placed.ware.rim_level_mm(), 0.5 * placed.ware.diameter_mm);
        for angle in [0.0_f64, 0.7, 1.6, 2.9] {
            let at = |share: f64| {
                let place: Point2<f64> =
                    placed.at_mm + nalgebra::Vector2::new(angle.cos(), angle.sin()) * (radius * share);
                Point3::new(place.x, place.y, 2.0 * level)
            };
            let fall = |from: Point3<f64>| {
                frame.world.distance(&crate::scene::Ray { origin: from, direction: -nalgebra::Vector3::z() }).unwrap()
            };
            let (inside, outside) = (fall(at(0.999)), fall(at(1.001)));
            assert!((inside - level).abs() < 2.6, "{}: met {inside} mm below {}", placed.object, 2.0 * level);
            assert!(outside > 1.5 * level, "{}: {outside}", placed.object);
        }
    }
}

/// Over a bare table, the reading of the cone is that of the closed form in docs/signals.md.
#[test]
fn the_cone_reads_what_the_signals_document_says() {
    for (pitch_deg, expected) in [(40.0_f64, 0.9792), (55.0, 1.0002), (70.0, 1.0087)] {
        let mut frame = bench(1, SIZE_PX[0])[0].frames[0].clone();
        frame.world.bodies.clear();
        frame.world.table_mm.0 = [1e5; 2];
        frame.head.pitch_deg = pitch_deg;
        let reading = frame.cone_mm(&view(&frame)) / frame.head.range_mm;
        assert!((reading - expected).abs() < 0.003, "{pitch_deg}: {reading}");
    }
}
