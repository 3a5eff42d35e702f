//! Pictures of a table whose texture is a function of the place, from known poses.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use aim_batch_ties::{Disc, Feature, features, register, tie};
use ingest::Picture;
use model::{Camera, LensModel, Pose, View};
use nalgebra::{Point2, Rotation2, Vector2};

/// The camera's place and heading on the common table.
#[derive(Clone, Copy)]
struct Stand {
    pitch_deg: f64,
    roll_deg: f64,
    range_mm: f64,
    turn_deg: f64,
    foot_mm: [f64; 2],
}

const FIRST: Stand = Stand { pitch_deg: 55.0, roll_deg: 2.0, range_mm: 470.0, turn_deg: 0.0, foot_mm: [0.0, 0.0] };
const SECOND: Stand =
    Stand { pitch_deg: 49.0, roll_deg: -3.0, range_mm: 500.0, turn_deg: 11.0, foot_mm: [60.0, -45.0] };
const THIRD: Stand = Stand { pitch_deg: 62.0, roll_deg: 0.0, range_mm: 430.0, turn_deg: -7.0, foot_mm: [-35.0, 40.0] };

fn view(stand: &Stand) -> View {
    let camera = Camera::new([864, 648], [565.0, 565.0], [431.0, 323.0], 0.0, LensModel::None).unwrap();
    let (pitch, roll) = (stand.pitch_deg.to_radians(), stand.roll_deg.to_radians());
    View::new(camera, Pose::new(pitch, roll, stand.range_mm).unwrap())
}

/// A number from 0 to 1 that belongs to a cell of the table.
fn hashed(x: i64, y: i64, seed: u64) -> f64 {
    let mut h = seed
        ^ (x.cast_unsigned().wrapping_mul(0x9e37_79b9_7f4a_7c15))
        ^ (y.cast_unsigned().wrapping_mul(0xc2b2_ae3d_27d4_eb4f));
    h ^= h >> 29;
    h = h.wrapping_mul(0xbf58_476d_1ce4_e5b9);
    h ^= h >> 32;
    f64::from(u32::try_from(h & 0xffff).unwrap()) / 65_535.0
}

/// Brightness of a table: patches of 14 mm in tones of their own, `contrast` apart; plain for 0.
fn tone(at_mm: Point2<f64>, contrast: f64, seed: u64) -> u8 {
    let cell = |v: f64| (v / 14.0).floor();
    #[expect(clippy::cast_possible_truncation, reason = "cells of a table")]
    let (x, y) = (cell(at_mm.x + 4.0 * (at_mm.y / 9.0).sin()) as i64, cell(at_mm.y) as i64);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a byte")]
    let tone = (150.0 + contrast * (hashed(x, y, seed) - 0.5)) as u8;
    tone
}

fn picture(stand: &Stand, contrast: f64, seed: u64) -> Picture {
    let view = view(stand);
    let turn = Rotation2::new(stand.turn_deg.to_radians());
    let at = |x: u32, y: u32| {
        let own = view.on_plane(Point2::new(f64::from(x), f64::from(y)), 0.0).ok()?;
        Some(Point2::from(Vector2::from(stand.foot_mm)) + turn * own.coords)
    };
    let pixels = (0..648).flat_map(|y| (0..864).map(move |x| (x, y)));
    let rgb = pixels.flat_map(|(x, y)| [at(x, y).map_or(90, |at| tone(at, contrast, seed)); 3]).collect();
    Picture { width_px: 864, height_px: 648, rgb }
}

fn features_of(stand: &Stand, contrast: f64, seed: u64) -> Vec<Feature> {
    features(&picture(stand, contrast, seed), &view(stand), &[])
}

#[test]
fn the_motion_between_two_pictures_of_one_table_is_found() {
    for contrast in [120.0, 24.0] {
        let found = register(&features_of(&FIRST, contrast, 1), &features_of(&SECOND, contrast, 1)).unwrap();
        assert!(found.inliers.len() >= 30, "{} of {}", found.inliers.len(), found.candidates);
        assert!((found.turn_rad.to_degrees() - 11.0).abs() < 0.2, "{}", found.turn_rad.to_degrees());
        assert!((found.shift_mm - Vector2::new(60.0, -45.0)).norm() < 1.5, "{}", found.shift_mm);
    }
}

#[test]
fn wrong_poses_by_as_much_as_sensors_err_do_no_harm() {
    let off = |stand: &Stand, pitch_deg: f64, range: f64| Stand {
        pitch_deg: stand.pitch_deg + pitch_deg,
        range_mm: stand.range_mm * range,
        ..*stand
    };
    let a = features(&picture(&FIRST, 120.0, 1), &view(&off(&FIRST, 1.0, 0.97)), &[]);
    let b = features(&picture(&SECOND, 120.0, 1), &view(&off(&SECOND, 0.5, 1.02)), &[]);
    let found = register(&a, &b).unwrap();
    assert!(found.inliers.len() >= 30 && (found.turn_rad.to_degrees() - 11.0).abs() < 1.0, "{found:?}");
}

#[test]
fn plain_tables_and_other_tables_tie_nothing() {
    let plain = [&FIRST, &SECOND].map(|stand| features_of(stand, 0.0, 1));
    assert_eq!(register(&plain[0], &plain[1]), None);
    assert_eq!(register(&features_of(&FIRST, 120.0, 1), &features_of(&SECOND, 120.0, 2)), None);
    assert_eq!(tie(&[]).placed, []);
}

#[test]
fn what_is_left_out_has_no_features() {
    let disc = Disc { center_mm: Point2::new(0.0, 270.0), radius_mm: 90.0 };
    let all = features(&picture(&FIRST, 120.0, 1), &view(&FIRST), &[]);
    let others = features(&picture(&FIRST, 120.0, 1), &view(&FIRST), &[disc]);
    let within = |features: &[Feature]| features.iter().filter(|f| (f.at_mm - disc.center_mm).norm() < 88.0).count();
    assert!(within(&all) > 20 && within(&others) == 0 && others.len() > 100);
}

#[test]
fn three_pictures_hang_together_in_whatever_order() {
    let by = |order: [&Stand; 3]| tie(&order.map(|stand| features_of(stand, 120.0, 1)));
    let ties = by([&FIRST, &SECOND, &THIRD]);
    for (placed, stand) in ties.placed.iter().zip([FIRST, SECOND, THIRD]) {
        let placed = placed.unwrap();
        assert!((placed.foot_mm - Point2::from(Vector2::from(stand.foot_mm))).norm() < 3.0, "{placed:?}");
        assert!((placed.turn_rad.to_degrees() - stand.turn_deg).abs() < 0.5);
    }
    let pictures_of = |feature: usize| ties.points.iter().filter(|point| point.feature == feature).count();
    assert!((0..20).all(|feature| (2..=3).contains(&pictures_of(feature))), "{:?}", ties.registered);
    // The first picture defines the frame, so another order gives the same places as seen from another one.
    let other = by([&THIRD, &FIRST, &SECOND]);
    assert!(
        other.points.len().abs_diff(ties.points.len()) * 20 < ties.points.len(),
        "which of two equals is first matters little"
    );
    assert!(other.placed.iter().all(Option::is_some));
    assert_eq!(by([&FIRST, &SECOND, &THIRD]), ties, "the same bytes give the same ties");
}
