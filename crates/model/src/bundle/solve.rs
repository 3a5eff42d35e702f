//! Solves a bundle by Levenberg's and Marquardt's method.

use nalgebra::{DMatrix, DVector, Point2, Vector2};

use super::normal::{Normal, common_at, rim_at};
use super::residuals::{self, RIM, State};
use super::shot::{SHOT, Stand, parameters, solved};
use super::{BundleInput, BundleRim, HeightPrior, SolvedBundle, SolvedRim, SolvedShot};
use crate::circle::fit_circle;
use crate::pose::PoseError;

/// The most steps; a bundle that starts within some cm takes about ten.
const MOST_STEPS: usize = 60;
/// A step that lowers the cost by a smaller share than this is the last.
const LEAST_GAIN: f64 = 1e-7;
/// Tie points further off than this many standard uncertainties contradict the others.
const REJECTED: f64 = 5.0;
/// The height of a first guess is within the prior's mean, and no more than this share of the lowest camera's.
const HIGHEST_GUESS: f64 = 0.5;

/// The reason why a bundle has no solution.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum BundleError {
    /// There are no pictures.
    #[error("there are no pictures to solve")]
    Empty,
    /// A number of the input names a picture, a feature or a container that is not there.
    #[error("a {0} is named that is not there")]
    Unknown(&'static str),
    /// A rim cannot be placed on its level from the first guess.
    #[error("the rim of container {0} cannot be placed from the first guess of its pictures")]
    NoStart(usize),
    /// The equations have no solution.
    #[error("the equations have no solution: pictures, features or rims hang in the air")]
    Singular,
    /// A solved pose is none.
    #[error(transparent)]
    Pose(#[from] PoseError),
}

/// Solves for poses, features and rims together.
///
/// # Errors
/// [`BundleError`] where the input names what is not there, or does not fix the unknowns.
pub fn solve_bundle(input: &BundleInput) -> Result<SolvedBundle, BundleError> {
    check(input)?;
    // The table alone first: a rim that was moved must not pull its picture away from the features of the table.
    let table = BundleInput { rims: Vec::new(), heights: Vec::new(), ..input.clone() };
    let (poses, _) = settled(&table, start(&table));
    let (state, normal) = settled(input, State { rims: first_rims(input, &poses)?, ..poses });
    let covariance = normal.reduced(0.0).0.cholesky().ok_or(BundleError::Singular)?.inverse();
    Ok(SolvedBundle {
        shots: state.shots.iter().map(|shot| solved(*shot)).collect::<Result<Vec<SolvedShot>, _>>()?,
        rims: (0..state.rims.len()).map(|number| solved_rim(input, &state, &covariance, number)).collect(),
        rejected: (0..input.ties.len()).filter(|i| tie_misfit(input, &state, *i) > REJECTED).collect(),
        tie_misfit: rms((0..input.ties.len())
            .map(|i| tie_misfit(input, &state, i))
            .filter(|misfit| *misfit <= REJECTED)),
    })
}

/// The state of least cost near a first one, with its normal equations.
fn settled(input: &BundleInput, mut state: State) -> (State, Normal) {
    let mut normal = Normal::new(input, &state);
    let mut damping = 1e-4;
    for _ in 0..MOST_STEPS {
        let Some((next, next_normal)) = better(input, &state, &normal, &mut damping) else { break };
        let gain = 1.0 - next_normal.cost / normal.cost;
        (state, normal) = (next, next_normal);
        if gain < LEAST_GAIN {
            break;
        }
    }
    (state, normal)
}

fn check(input: &BundleInput) -> Result<(), BundleError> {
    let (shots, containers) = (input.shots.len(), input.heights.len());
    if shots == 0 {
        return Err(BundleError::Empty);
    }
    let mut named = input.ties.iter().map(|tie| tie.shot).chain(input.rims.iter().map(|rim| rim.shot));
    if named.any(|shot| shot >= shots) {
        return Err(BundleError::Unknown("picture"));
    }
    if input.rims.iter().any(|rim| rim.container >= containers) {
        return Err(BundleError::Unknown("container"));
    }
    Ok(())
}

/// The state after a step that lowers the cost; none where no step does.
fn better(input: &BundleInput, state: &State, normal: &Normal, damping: &mut f64) -> Option<(State, Normal)> {
    for _ in 0..12 {
        let (curvature, gradient) = normal.reduced(*damping);
        if let Some(factors) = curvature.cholesky() {
            let step = -factors.solve(&gradient);
            let next = stepped(state, &step, &normal.feature_steps(&step, *damping));
            let next_normal = Normal::new(input, &next);
            if next_normal.cost < normal.cost {
                *damping = (*damping * 0.2).max(1e-12);
                return Some((next, next_normal));
            }
        }
        *damping *= 8.0;
    }
    None
}

fn stepped(state: &State, step: &DVector<f64>, features: &[Vector2<f64>]) -> State {
    let mut next = state.clone();
    for (number, shot) in next.shots.iter_mut().enumerate() {
        shot.iter_mut().enumerate().for_each(|(i, value)| *value += step[SHOT * number + i]);
    }
    for (number, rim) in next.rims.iter_mut().enumerate() {
        rim.iter_mut().enumerate().for_each(|(i, value)| *value += step[rim_at(state, number) + i]);
    }
    for (feature, step) in next.features.iter_mut().zip(features) {
        (feature[0], feature[1]) = (feature[0] + step.x, feature[1] + step.y);
    }
    (0..2).for_each(|which| next.common[which] += step[common_at(state) + which]);
    next
}

/// The first guess: the sensors' poses at the given places, and features where they are seen on the table.
fn start(input: &BundleInput) -> State {
    let shots: Vec<_> = input.shots.iter().map(parameters).collect();
    let count = input.ties.iter().map(|tie| tie.feature + 1).max().unwrap_or(0);
    let mut seen: Vec<(Vector2<f64>, f64)> = vec![(Vector2::zeros(), 0.0); count];
    for tie in &input.ties {
        if let Some((at_mm, _)) = Stand::new(&shots[tie.shot]).on_level(&tie.ray, 0.0) {
            seen[tie.feature] = (seen[tie.feature].0 + at_mm.coords, seen[tie.feature].1 + 1.0);
        }
    }
    let features = seen.into_iter().map(|(sum, count)| (sum / count.max(1.0)).into()).collect();
    State { shots, features, rims: Vec::new(), common: [0.0; 2] }
}

/// The rims where their pictures show them at the height that is known beforehand.
fn first_rims(input: &BundleInput, poses: &State) -> Result<Vec<[f64; RIM]>, BundleError> {
    let lowest_mm = poses.shots.iter().map(|shot| shot[5]).fold(f64::INFINITY, f64::min);
    let first = |(number, prior): (usize, &HeightPrior)| {
        let height_mm = prior.mm.min(HIGHEST_GUESS * lowest_mm);
        let of_it = input.rims.iter().filter(|rim| rim.container == number);
        let circles: Vec<[f64; 3]> =
            of_it.map(|rim| first_circle(&poses.shots[rim.shot], rim, height_mm)).collect::<Result<_, _>>()?;
        // The middle one, since a picture may be of another place or thing.
        let middle = |i: usize| {
            let mut values: Vec<f64> = circles.iter().map(|circle| circle[i]).collect();
            values.sort_by(f64::total_cmp);
            values.get(values.len() / 2).copied().ok_or(BundleError::NoStart(number))
        };
        Ok([middle(0)?, middle(1)?, middle(2)?, height_mm])
    };
    input.heights.iter().enumerate().map(first).collect()
}

fn first_circle(shot: &[f64; SHOT], rim: &BundleRim, height_mm: f64) -> Result<[f64; 3], BundleError> {
    let stand = Stand::new(shot);
    let points: Vec<Point2<f64>> = rim.rays.iter().filter_map(|ray| Some(stand.on_level(ray, height_mm)?.0)).collect();
    let fit = fit_circle(&points, |_, _| 1.0).map_err(|_| BundleError::NoStart(rim.container))?;
    Ok([fit.circle.center_mm.x, fit.circle.center_mm.y, fit.circle.radius_mm])
}

fn solved_rim(input: &BundleInput, state: &State, covariance: &DMatrix<f64>, number: usize) -> SolvedRim {
    let [x, y, radius_mm, height_mm] = state.rims[number];
    let at = rim_at(state, number);
    let sigma = |i: usize| covariance[(at + i, at + i)].max(0.0).sqrt();
    let of_it = input.rims.iter().filter(|rim| rim.container == number);
    let misfits: Vec<(usize, f64)> = of_it.map(|rim| (rim.shot, rim_misfit(input, state, rim))).collect();
    // Where pictures contradict each other by more than the uncertainties allow, the latter are too small.
    let scale = rms(misfits.iter().map(|(_, misfit)| *misfit)).max(1.0);
    SolvedRim {
        center_mm: Point2::new(x, y),
        radius_mm,
        height_mm,
        sigma_radius_mm: scale * sigma(2),
        sigma_height_mm: scale * sigma(3),
        misfits,
    }
}

fn rim_misfit(input: &BundleInput, state: &State, rim: &BundleRim) -> f64 {
    let (shot, circle) = (&state.shots[rim.shot], &state.rims[rim.container]);
    rms(rim.rays.iter().filter_map(|ray| Some(residuals::rim_point(shot, circle, ray, &input.sigma)?.0)))
}

fn tie_misfit(input: &BundleInput, state: &State, number: usize) -> f64 {
    let tie = &input.ties[number];
    residuals::tie(&state.shots[tie.shot], &state.features[tie.feature], &tie.ray, &input.sigma)
        .map_or(f64::INFINITY, |rows| rows.residual[0].hypot(rows.residual[1]) / std::f64::consts::SQRT_2)
}

/// The root of the mean square; 0 of nothing.
fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = values.fold((0.0, 0.0), |(count, sum), value| (count + 1.0, sum + value * value));
    if count > 0.0 { f64::sqrt(sum / count) } else { 0.0 }
}
