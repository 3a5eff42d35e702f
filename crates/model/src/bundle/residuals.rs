//! What the parameters fail to explain, in standard uncertainties, with derivatives.

use nalgebra::{Point2, SVector, Vector3};

use super::shot::{SHOT, ShotParameters, Stand};
use super::{BundleInput, BundleSigma};

/// The number of parameters of a container: centre x, y, radius, height (mm).
pub(super) const RIM: usize = 4;

/// Everything that is solved for.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub shots: Vec<ShotParameters>,
    pub features: Vec<[f64; 2]>,
    pub rims: Vec<[f64; RIM]>,
    /// The errors of pitch and roll that all pictures share, in radians.
    pub common: [f64; 2],
}

/// Steps of the central differences: radians and mm.
const STEPS: ShotParameters = [1e-6, 1e-6, 1e-6, 1e-3, 1e-3, 1e-3];
const STEP_MM: f64 = 1e-3;

/// The two residuals of a tie point with their derivatives.
pub(super) struct TieRows {
    pub residual: [f64; 2],
    pub by_shot: [SVector<f64, SHOT>; 2],
    pub by_feature: [SVector<f64, 2>; 2],
}

/// A residual of a shot's sensors with its derivatives: by the shot, and by the common error of this number.
pub(super) struct SensorRow {
    pub residual: f64,
    pub by_shot: SVector<f64, SHOT>,
    pub by_common: Option<(usize, f64)>,
}

/// The residual of a tie point, and its derivatives by shot and feature; none where the feature is behind the camera.
pub(super) fn tie(
    shot: &ShotParameters,
    feature: &[f64; 2],
    ray: &Vector3<f64>,
    sigma: &BundleSigma,
) -> Option<TieRows> {
    let of = |shot: &ShotParameters, feature: &[f64; 2]| -> Option<[f64; 2]> {
        let [x, y] = Stand::new(shot).image_of(Point2::from(*feature))?;
        Some([(x - ray.x / ray.z) / sigma.tie_rad, (y - ray.y / ray.z) / sigma.tie_rad])
    };
    let residual = of(shot, feature)?;
    let (mut by_shot, mut by_feature) = ([SVector::zeros(); 2], [SVector::zeros(); 2]);
    for (i, step) in STEPS.into_iter().enumerate() {
        let [above, below] = [step, -step].map(|step| of(&moved(shot, i, step), feature));
        let (above, below) = (above?, below?);
        (0..2).for_each(|k| by_shot[k][i] = (above[k] - below[k]) / (2.0 * step));
    }
    for axis in [0, 1] {
        let [above, below] = [STEP_MM, -STEP_MM].map(|step| of(shot, &moved(feature, axis, step)));
        let (above, below) = (above?, below?);
        (0..2).for_each(|k| by_feature[k][axis] = (above[k] - below[k]) / (2.0 * STEP_MM));
    }
    Some(TieRows { residual, by_shot, by_feature })
}

/// The residual of a point of a rim, and its derivatives by shot and container; none where its ray does not reach the rim's level.
pub(super) fn rim_point(
    shot: &ShotParameters,
    rim: &[f64; RIM],
    ray: &Vector3<f64>,
    sigma: &BundleSigma,
) -> Option<(f64, SVector<f64, SHOT>, SVector<f64, RIM>)> {
    // The scatter changes slowly, so it is that of the present state in the derivatives as well.
    let (_, length_mm) = Stand::new(shot).on_level(ray, rim[3])?;
    let scatter_mm = sigma.rim_mm.hypot(sigma.rim_rad * length_mm);
    let of = |shot: &ShotParameters, [x, y, radius_mm, height_mm]: &[f64; RIM]| -> Option<f64> {
        let (at_mm, _) = Stand::new(shot).on_level(ray, *height_mm)?;
        Some(((at_mm - Point2::new(*x, *y)).norm() - radius_mm) / scatter_mm)
    };
    let residual = of(shot, rim)?;
    let (mut by_shot, mut by_rim) = (SVector::zeros(), SVector::zeros());
    for (i, step) in STEPS.into_iter().enumerate() {
        by_shot[i] = (of(&moved(shot, i, step), rim)? - of(&moved(shot, i, -step), rim)?) / (2.0 * step);
    }
    for i in 0..RIM {
        by_rim[i] = (of(shot, &moved(rim, i, STEP_MM))? - of(shot, &moved(rim, i, -STEP_MM))?) / (2.0 * STEP_MM);
    }
    Some((residual, by_shot, by_rim))
}

/// The residuals of a shot against its sensors: pitch, roll and range, each with its derivatives by the shot, and by the common error
/// of the same kind (none for the range).
pub(super) fn sensors(input: &BundleInput, state: &State, number: usize) -> [SensorRow; 3] {
    let (shot, sensed, sigma) = (&state.shots[number], &input.shots[number].sensed, &input.sigma);
    let mut by_pitch = SVector::zeros();
    by_pitch[0] = 1.0 / sigma.own_rad;
    let mut by_roll = SVector::zeros();
    by_roll[1] = 1.0 / sigma.own_rad;
    let mut by_range = SVector::zeros();
    by_range[0] = -1.0 / shot[0].tan() / sigma.own_range;
    by_range[5] = 1.0 / shot[5] / sigma.own_range;
    let angle = |i: usize, sensed: f64, by_shot| SensorRow {
        residual: (shot[i] - sensed - state.common[i]) / sigma.own_rad,
        by_shot,
        by_common: Some((i, -1.0 / sigma.own_rad)),
    };
    let range = (shot[5] / shot[0].sin() / sensed.range_mm()).ln() / sigma.own_range;
    [
        angle(0, sensed.pitch_rad(), by_pitch),
        angle(1, sensed.roll_rad(), by_roll),
        SensorRow { residual: range, by_shot: by_range, by_common: None },
    ]
}

fn moved<const N: usize>(values: &[f64; N], i: usize, step: f64) -> [f64; N] {
    let mut moved = *values;
    moved[i] += step;
    moved
}
