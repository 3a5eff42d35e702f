//! Normal equations whose features are eliminated: each feature is tied to its own pictures alone.

use nalgebra::{DMatrix, DVector, Matrix2, SVector, Vector2};

use super::BundleInput;
use super::residuals::{self, RIM, SensorRow, State, TieRows};
use super::shot::SHOT;

/// Tie points and rim points further off than this many standard uncertainties count for less and less (Cauchy's weights).
const TIE_TUNING: f64 = 2.0;
const RIM_TUNING: f64 = 3.0;
/// What defines the frame is held this tightly: turn (radians) and place (mm) of the first shot.
const HELD: [f64; 3] = [1e-9, 1e-6, 1e-6];

/// The sum of squares, its gradient and its curvature.
pub(super) struct Normal {
    pub cost: f64,
    /// By shots, rims and common errors.
    pub curvature: DMatrix<f64>,
    pub gradient: DVector<f64>,
    /// By feature: its own curvature and gradient, and its curvature with each shot that shows it.
    features: Vec<FeatureBlock>,
}

#[derive(Clone, Default)]
struct FeatureBlock {
    own: Matrix2<f64>,
    gradient: Vector2<f64>,
    with_shots: Vec<(usize, nalgebra::SMatrix<f64, SHOT, 2>)>,
}

/// Cauchy's weight and cost of a residual (in standard uncertainties).
fn robust(squared: f64, tuning: f64) -> (f64, f64) {
    let ratio = squared / (tuning * tuning);
    (1.0 / (1.0 + ratio), tuning * tuning * ratio.ln_1p())
}

impl Normal {
    /// The normal equations about a state. What cannot be seen from there (behind a camera, above the horizon) has a large constant cost.
    pub fn new(input: &BundleInput, state: &State) -> Self {
        let size = size(state);
        let mut normal = Self {
            cost: 0.0,
            curvature: DMatrix::zeros(size, size),
            gradient: DVector::zeros(size),
            features: vec![FeatureBlock::default(); state.features.len()],
        };
        for number in 0..state.shots.len() {
            normal.add_sensors(input, state, number);
        }
        for tie in &input.ties {
            normal.add_tie(input, state, tie);
        }
        for rim in &input.rims {
            normal.add_rim(input, state, rim);
        }
        normal.add_priors(input, state);
        normal
    }

    fn add_sensors(&mut self, input: &BundleInput, state: &State, number: usize) {
        for SensorRow { residual, by_shot, by_common } in residuals::sensors(input, state, number) {
            let mut row = DVector::zeros(self.gradient.len());
            row.rows_mut(SHOT * number, SHOT).copy_from(&by_shot);
            if let Some((which, derivative)) = by_common {
                row[common_at(state) + which] = derivative;
            }
            self.add_row(residual, &row);
        }
    }

    fn add_priors(&mut self, input: &BundleInput, state: &State) {
        let mut row = DVector::zeros(self.gradient.len());
        let mut one = |normal: &mut Self, at: usize, residual: f64, derivative: f64| {
            row.fill(0.0);
            row[at] = derivative;
            normal.add_row(residual, &row);
        };
        for which in 0..2 {
            let sigma = input.sigma.common_rad;
            one(self, common_at(state) + which, state.common[which] / sigma, 1.0 / sigma);
        }
        for (number, prior) in input.heights.iter().enumerate() {
            let residual = (state.rims[number][3] - prior.mm) / prior.sigma_mm;
            one(self, rim_at(state, number) + 3, residual, 1.0 / prior.sigma_mm);
        }
        for (i, sigma) in HELD.into_iter().enumerate() {
            one(self, 2 + i, 0.0, 1.0 / sigma);
        }
    }

    fn add_row(&mut self, residual: f64, row: &DVector<f64>) {
        self.cost += residual * residual;
        self.gradient.axpy(residual, row, 1.0);
        self.curvature.ger(1.0, row, row, 1.0);
    }

    fn add_tie(&mut self, input: &BundleInput, state: &State, tie: &super::BundleTie) {
        let (shot, feature) = (&state.shots[tie.shot], &state.features[tie.feature]);
        let Some(TieRows { residual, by_shot, by_feature }) = residuals::tie(shot, feature, &tie.ray, &input.sigma)
        else {
            self.cost += UNSEEN;
            return;
        };
        let (weight, cost) = robust(residual[0].powi(2) + residual[1].powi(2), TIE_TUNING);
        self.cost += cost;
        let block = &mut self.features[tie.feature];
        let mut with_shot = nalgebra::SMatrix::<f64, SHOT, 2>::zeros();
        let mut own_shot = nalgebra::SMatrix::<f64, SHOT, SHOT>::zeros();
        let mut gradient = SVector::<f64, SHOT>::zeros();
        for k in 0..2 {
            own_shot += weight * by_shot[k] * by_shot[k].transpose();
            with_shot += weight * by_shot[k] * by_feature[k].transpose();
            block.own += weight * by_feature[k] * by_feature[k].transpose();
            block.gradient += weight * residual[k] * by_feature[k];
            gradient += weight * residual[k] * by_shot[k];
        }
        block.with_shots.push((tie.shot, with_shot));
        self.add_block(SHOT * tie.shot, SHOT * tie.shot, &own_shot);
        let mut part = self.gradient.rows_mut(SHOT * tie.shot, SHOT);
        part += gradient;
    }

    fn add_rim(&mut self, input: &BundleInput, state: &State, rim: &super::BundleRim) {
        let (shot, circle) = (&state.shots[rim.shot], &state.rims[rim.container]);
        let (at_shot, at_rim) = (SHOT * rim.shot, rim_at(state, rim.container));
        for ray in &rim.rays {
            let Some((residual, by_shot, by_rim)) = residuals::rim_point(shot, circle, ray, &input.sigma) else {
                self.cost += UNSEEN;
                continue;
            };
            let (weight, cost) = robust(residual * residual, RIM_TUNING);
            self.cost += cost;
            self.add_block(at_shot, at_shot, &(weight * by_shot * by_shot.transpose()));
            self.add_block(at_rim, at_rim, &(weight * by_rim * by_rim.transpose()));
            let between = weight * by_shot * by_rim.transpose();
            self.add_block(at_shot, at_rim, &between);
            self.add_block(at_rim, at_shot, &between.transpose());
            let mut part = self.gradient.rows_mut(at_shot, SHOT);
            part += weight * residual * by_shot;
            let mut part = self.gradient.rows_mut(at_rim, RIM);
            part += weight * residual * by_rim;
        }
    }

    fn add_block<const R: usize, const C: usize>(
        &mut self,
        row: usize,
        column: usize,
        block: &nalgebra::SMatrix<f64, R, C>,
    ) {
        let mut part = self.curvature.view_mut((row, column), (R, C));
        part += block;
    }

    /// The curvature and gradient of all but the features, once the features are eliminated; `damping` is Levenberg's and Marquardt's.
    pub fn reduced(&self, damping: f64) -> (DMatrix<f64>, DVector<f64>) {
        let (mut curvature, mut gradient) = (self.curvature.clone(), self.gradient.clone());
        for i in 0..curvature.nrows() {
            curvature[(i, i)] *= 1.0 + damping;
        }
        for block in &self.features {
            let Some(inverse) = block.inverse(damping) else { continue };
            for (a, of_a) in &block.with_shots {
                let through = of_a * inverse;
                let mut part = gradient.rows_mut(SHOT * a, SHOT);
                part -= through * block.gradient;
                for (b, of_b) in &block.with_shots {
                    let mut part = curvature.view_mut((SHOT * a, SHOT * b), (SHOT, SHOT));
                    part -= through * of_b.transpose();
                }
            }
        }
        (curvature, gradient)
    }

    /// The steps of the features that belong to a step of all others.
    pub fn feature_steps(&self, step: &DVector<f64>, damping: f64) -> Vec<Vector2<f64>> {
        let of_feature = |block: &FeatureBlock| {
            let Some(inverse) = block.inverse(damping) else { return Vector2::zeros() };
            let pulled = block.with_shots.iter().fold(block.gradient, |pulled, (shot, with_shot)| {
                pulled + with_shot.tr_mul(&step.fixed_rows::<SHOT>(SHOT * shot))
            });
            -inverse * pulled
        };
        self.features.iter().map(of_feature).collect()
    }
}

/// The cost of what cannot be seen.
const UNSEEN: f64 = 1e6;

impl FeatureBlock {
    fn inverse(&self, damping: f64) -> Option<Matrix2<f64>> {
        (self.own + Matrix2::from_diagonal(&self.own.diagonal()) * damping).try_inverse()
    }
}

/// The number of parameters but for those of the features.
pub(super) fn size(state: &State) -> usize {
    common_at(state) + 2
}

/// Where the parameters of a rim begin.
pub(super) fn rim_at(state: &State, number: usize) -> usize {
    SHOT * state.shots.len() + RIM * number
}

/// Where the common errors begin.
pub(super) fn common_at(state: &State) -> usize {
    rim_at(state, state.rims.len())
}
