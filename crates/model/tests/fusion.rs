//! Fused sizes: common errors stay, others average out, and outliers are named.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use aim_batch_model::{
    Camera, Doubt, Estimate, Fused, InputSigma, JointError, LensModel, Mark, Measured, Method, ObjectMarks, Part,
    PerSource, Pose, Quantity, Sensitivity, Share, Sight, Sights, Source, Verdict, View, best_of, fuse, joint_height,
    sights,
};
use nalgebra::Point3;
use proptest::prelude::*;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

const INPUTS: InputSigma = InputSigma {
    pitch_rad: 0.01,
    range_relative: 0.03,
    range_noise_mm: 4.0,
    turn_noise_rad: 0.004,
    mark_px: 2.0,
    ..InputSigma::NONE
};

fn share(value_mm: f64, picture: usize) -> Share {
    let mut by_source = PerSource::zeros();
    by_source[Source::Pitch.index()] = 150.0;
    by_source[Source::RangeScale.index()] = 200.0;
    by_source[Source::RangeOffset.index()] = 0.4;
    let sensitivity = Sensitivity { by_source, marks_mm_per_px: 0.8 };
    Share::of_picture(value_mm, Part { sensitivity, inputs: INPUTS, picture }, 1.0)
}

fn fused(values: &[f64]) -> Fused {
    fuse(&values.iter().enumerate().map(|(i, v)| share(*v, i)).collect::<Vec<_>>()).unwrap()
}

#[test]
fn what_is_common_does_not_shrink() {
    let (one, many) = (fused(&[200.0]), fused(&[200.0; 25]));
    assert!((many.sigma.common_mm - one.sigma.common_mm).abs() < 1e-9);
    assert!((one.sigma.marks_mm / many.sigma.marks_mm - 5.0).abs() < 1e-9);
    let own = |sigma: &aim_batch_model::SizeSigma| (sigma.total_mm.powi(2) - sigma.common_mm.powi(2)).sqrt();
    assert!((own(&one.sigma) / own(&many.sigma) - 5.0).abs() < 1e-9);
    assert_eq!((one.spread_mm, one.consistency), (None, None));
}

/// Two raters of one picture share the noise of the picture, while two pictures do not.
#[test]
fn raters_of_one_picture_share_its_noise() {
    let one_picture = fuse(&[share(200.0, 0), share(200.0, 0)]).unwrap();
    let two_pictures = fuse(&[share(200.0, 0), share(200.0, 1)]).unwrap();
    assert!((one_picture.sigma.marks_mm - two_pictures.sigma.marks_mm).abs() < 1e-12);
    assert!(one_picture.sigma.range_mm > two_pictures.sigma.range_mm);
    let expected = (200.0 * 0.03_f64).hypot(0.4 * 4.0);
    assert!((one_picture.sigma.range_mm - expected).abs() < 1e-9);
}

#[test]
fn one_that_is_off_is_named_and_counts_less() {
    let result = fused(&[200.0, 201.0, 199.0, 200.5, 140.0]);
    assert_eq!(result.outliers, [4]);
    assert!(result.weights[4] < 0.05 && (result.value_mm - 200.0).abs() < 2.0, "{result:?}");
    assert_eq!(result.consistency.unwrap().verdict, Verdict::Inconsistent);
    let fine = fused(&[200.0, 201.0, 199.0, 200.5, 198.0]);
    assert_eq!((fine.outliers.len(), fine.consistency.unwrap().verdict), (0, Verdict::Consistent));
}

#[test]
fn a_doubtful_picture_counts_less() {
    let shares = [in_proportion(200.0, 0, 0.8), Share { penalty: 4.0, ..in_proportion(210.0, 1, 0.8) }];
    let result = fuse(&shares).unwrap();
    assert!((result.weights[0] / result.weights[1] - 4.0).abs() < 1e-9 && (result.value_mm - 202.0).abs() < 1e-9);
}

/// The sizes are drawn with common errors and with errors of their own. The stated uncertainty covers them, and the verdict is
/// wrong as often as it claims.
#[test]
fn intervals_cover_and_verdicts_hold() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut draw = |sigma: f64| sigma * Distribution::<f64>::sample(&StandardNormal, &mut random);
    let (mut covered, mut inconsistent, runs) = (0, 0, 4000);
    for _ in 0..runs {
        let (pitch, scale) = (draw(0.01), draw(0.03));
        let shares: Vec<Share> = (0..6)
            .map(|i| {
                let pitch = pitch + draw(0.004);
                share(200.0 + 150.0 * pitch + 200.0 * scale + 0.4 * draw(4.0) + 0.8 * draw(2.0), i)
            })
            .collect();
        let result = fuse(&shares).unwrap();
        covered += u32::from((result.value_mm - 200.0).abs() < 1.96 * result.sigma.total_mm);
        inconsistent += u32::from(result.consistency.unwrap().verdict == Verdict::Inconsistent);
    }
    let share_of = |n: u32| f64::from(n) / f64::from(runs);
    assert!((0.94..0.96).contains(&share_of(covered)), "{}", share_of(covered));
    assert!((0.005..0.017).contains(&share_of(inconsistent)), "{}", share_of(inconsistent));
}

/// A size that is `value_mm` large, with errors of pose, range and camera in proportion to it, as those of real sizes are.
fn in_proportion(value_mm: f64, picture: usize, marks_mm_per_px: f64) -> Share {
    let by_source = share(value_mm, picture).parts[0].sensitivity.by_source * (value_mm / 200.0);
    Share::of_picture(
        value_mm,
        Part { sensitivity: Sensitivity { by_source, marks_mm_per_px }, inputs: INPUTS, picture },
        1.0,
    )
}

/// Three raters see 250 to 270 mm, and one slipped. By inverse variances in mm the slip would have ten times the
/// weight of any other, for being small: 112 mm.
#[test]
fn a_small_size_is_not_surer_for_being_small() {
    let values = [262.3, 251.8, 74.6, 268.2];
    let shares: Vec<Share> = values.iter().enumerate().map(|(i, v)| in_proportion(*v, i, 0.8)).collect();
    let result = fuse(&shares).unwrap();
    assert!((result.value_mm - 260.8).abs() < 1.0, "the mean of the other three: {result:?}");
    assert_eq!((result.outliers.as_slice(), result.weights[2]), (&[2][..], 0.0));
    assert!(result.sigma.total_mm > 7.0, "3 % are common to all");
    let two = fuse(&[in_proportion(100.0, 0, 0.8), in_proportion(300.0, 1, 0.8)]).unwrap();
    assert!((two.value_mm - 200.0).abs() < 10.0, "neither of two is surer: {two:?}");
}

/// Half of the difference of two sizes is the standard error of their mean.
#[test]
fn the_uncertainty_holds_a_disagreement_and_only_that() {
    let [a, b] = [200.0, 260.0].map(|v| in_proportion(v, usize::from(v > 200.0), 0.8));
    let apart = fuse(&[a, b]).unwrap();
    // Common to both, of which nothing is disagreement: 3 % of range, and 0.01 rad of pitch, at 230 mm.
    let own = 230.0 * 0.03_f64.hypot(0.01 * 150.0 / 200.0);
    assert_eq!(apart.consistency.unwrap().verdict, Verdict::Inconsistent);
    assert!((apart.sigma.total_mm - 30.0_f64.hypot(own)).abs() < 0.1, "{apart:?}");
    assert!((apart.sigma.disagreement_mm - 30.0).abs() < 0.2, "{apart:?}");
    assert!(fused(&[200.0, 202.0]).sigma.disagreement_mm < 1e-12);
}

/// Sizes of one thing, each with 3 mm of error of its own, and their uncertainty by the marks, in mm per pixel.
fn honest() -> impl Strategy<Value = Vec<(f64, f64)>> {
    (40.0..300.0_f64, prop::collection::vec((-3.0..3.0_f64, 0.5..2.0_f64), 2..8))
        .prop_map(|(size, errors)| errors.into_iter().map(|(error, marks)| (size + error, marks)).collect())
}

fn shares(sizes: &[(f64, f64)], factor: f64) -> Vec<Share> {
    sizes.iter().enumerate().map(|(i, (v, marks))| in_proportion(v * factor, i, marks * factor)).collect()
}

proptest! {
    #[test]
    fn fused_sizes_lie_within_the_range_of_theirs(
        sizes in prop::collection::vec((1.0..1e4_f64, 0.0..50.0_f64), 1..9)
    ) {
        let value_mm = fuse(&shares(&sizes, 1.0)).unwrap().value_mm;
        let all = || sizes.iter().map(|(v, _)| *v);
        prop_assert!(all().reduce(f64::min).unwrap() <= value_mm && value_mm <= all().reduce(f64::max).unwrap());
    }

    #[test]
    fn fused_sizes_scale_with_theirs(
        sizes in prop::collection::vec((1.0..1e4_f64, 0.1..50.0_f64), 1..9), factor in 0.01..100.0_f64
    ) {
        let [one, scaled] = [1.0, factor].map(|f| fuse(&shares(&sizes, f)).unwrap());
        prop_assert!((scaled.value_mm / (factor * one.value_mm) - 1.0).abs() < 1e-6);
        prop_assert!((scaled.sigma.total_mm / (factor * one.sigma.total_mm) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn one_absurd_size_moves_the_others_by_less_than_their_uncertainty(
        sizes in honest(), times in prop_oneof![0.001..0.4_f64, 2.5..1000.0], place in 0..8_usize
    ) {
        let without = fuse(&shares(&sizes, 1.0)).unwrap();
        let mut with = sizes.clone();
        with.insert(place.min(sizes.len()), (without.value_mm * times, 1.0));
        let with = fuse(&shares(&with, 1.0)).unwrap();
        let moved = (with.value_mm - without.value_mm).abs();
        prop_assert!(moved < without.sigma.total_mm.min(with.sigma.total_mm), "{} -> {}", without.value_mm, with.value_mm);
    }
}

fn view(pitch_deg: f64) -> View {
    let camera = Camera::new([2592, 1944], [1695.0, 1703.0], [1296.0, 972.0], 0.0, LensModel::None).unwrap();
    View::new(camera, Pose::new(pitch_deg.to_radians(), 0.05, 560.0).unwrap())
}

/// The far side of a wall that is 60 mm high and leans outwards by 24 mm.
fn sight(view: &View) -> Vec<Sight> {
    let end = |y: f64, z: f64| view.pixel_of(Point3::new(0.0, y, z)).unwrap();
    let distance = 560.0 * view.pose().pitch_rad().cos();
    let line = Mark::Line { quantity: Quantity::Height, ends_px: [end(distance, 0.0), end(distance + 24.0, 60.0)] };
    sights(view, &ObjectMarks { object: "bowl".to_owned(), marks: vec![line] }, &INPUTS).unwrap()
}

fn pictures(pitches_deg: &[f64]) -> Vec<Sights> {
    let sights = |(picture, pitch): (usize, &f64)| Sights { walls: sight(&view(*pitch)), inputs: INPUTS, picture };
    pitches_deg.iter().enumerate().map(sights).collect()
}

#[test]
fn height_and_slope_together() {
    let pictures = pictures(&[40.0, 55.0, 70.0]);
    let joint = joint_height(&pictures).unwrap();
    assert!((joint.height_mm - 60.0).abs() < 1e-6 && (joint.overhang_mm - 24.0).abs() < 1e-6, "{joint:?}");
    assert!(joint.sigma.total_mm > 1.0 && joint.sigma.total_mm < 20.0);
}

#[test]
fn pictures_from_one_angle_say_nothing() {
    let alike = pictures(&[55.0, 55.4]);
    assert!(matches!(joint_height(&alike), Err(JointError::TooAlike { .. })));
    assert_eq!(joint_height(&alike[..1]), Err(JointError::TooFew(1)));
}

fn candidate(method: Method, total_mm: f64, doubts: Vec<Doubt>) -> Estimate {
    let measured = Measured::by_one_mark(Quantity::Height, 60.0, 0.0);
    let sensitivity = Sensitivity { by_source: PerSource::zeros(), marks_mm_per_px: total_mm };
    let sigma = sensitivity.sigma(&InputSigma { mark_px: 1.0, ..InputSigma::NONE });
    Estimate { method, measured, sensitivity, sigma, wall_slope: None, doubts }
}

#[test]
fn the_best_is_the_surest_of_those_that_apply() {
    let paper = candidate(Method::Paper, 1.0, vec![Doubt::PaperApproximation, Doubt::WallSloped]);
    let ray = candidate(Method::Ray, 2.0, vec![Doubt::WallSloped]);
    let coaxial = candidate(Method::Coaxial, 3.0, vec![]);
    let best = |estimates: &[&Estimate]| best_of(estimates.iter().copied()).map(|estimate| estimate.method);
    assert_eq!(best(&[&paper, &ray, &coaxial]), Some(Method::Coaxial));
    assert_eq!(best(&[&paper, &ray]), Some(Method::Ray), "where all have doubts, the fewest");
    assert_eq!(best(&[]), None);
}
