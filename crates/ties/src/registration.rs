//! The motion of the table between two pictures.

use nalgebra::{Matrix2, Point2, Rotation2, Vector2};

use crate::features::Feature;
use crate::matching::matches;

/// The table turns by no more than this between two pictures of one person at it, in radians.
const MOST_TURN_RAD: f64 = 1.0;
/// Errors of range make one picture larger than the other by no more than this share.
const MOST_SCALE: f64 = 0.15;
/// Two matches closer than this, in mm, say too little of a turn.
const LEAST_BASE_MM: f64 = 60.0;
/// Matches within this of a motion follow it, in mm; at first, since errors of pitch and roll bend the table.
const NEAR_MM: f64 = 6.0;
/// The same once the bend is taken up.
const CLOSE_MM: f64 = 4.0;
/// Fewer matches may follow one motion by chance, or because they all lie on one thing that stands up.
const LEAST_MATCHES: usize = 12;
/// The matches spread over at least this, in mm (standard deviation along the axis along which they spread less).
const LEAST_SPREAD_MM: f64 = 12.0;
/// The number of pairs of matches that are tried.
const TRIALS: usize = 1500;

/// The motion between two pictures of one table, from places on Z = 0 by the view of one to those by the view of the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Registration {
    /// The turn about the vertical, in radians, counter-clockwise from above.
    pub turn_rad: f64,
    /// Where the point under the second camera lies in the frame of the first, in mm.
    pub shift_mm: Vector2<f64>,
    /// Pairs of the numbers of features, of the first picture and the second, that follow the motion.
    pub inliers: Vec<(usize, usize)>,
    /// The number of pairs that look alike.
    pub candidates: usize,
}

/// The motion of the table between two pictures; none where too few features show one.
#[must_use]
pub fn register(first: &[Feature], second: &[Feature]) -> Option<Registration> {
    let pairs = matches(first, second);
    if pairs.len() < LEAST_MATCHES {
        return None;
    }
    let places: Vec<[Point2<f64>; 2]> = pairs.iter().map(|(i, j)| [first[*i].at_mm, second[*j].at_mm]).collect();
    let motion = best_motion(&places)?;
    let followers = bent_followers(&places, &motion)?;
    let chosen: Vec<[Point2<f64>; 2]> = followers.iter().map(|i| places[*i]).collect();
    let Motion { matrix, shift_mm } = Motion::through(&chosen)?;
    let turn_rad = (matrix[(1, 0)] - matrix[(0, 1)]).atan2(matrix[(0, 0)] + matrix[(1, 1)]);
    let is_enough = followers.len() >= LEAST_MATCHES && spread_mm(&chosen) >= LEAST_SPREAD_MM;
    let inliers = followers.into_iter().map(|i| pairs[i]).collect();
    is_enough.then_some(Registration { turn_rad, shift_mm, inliers, candidates: pairs.len() })
}

/// A linear map and a shift, from the second picture's places to the first's.
#[derive(Debug, Clone, Copy)]
struct Motion {
    matrix: Matrix2<f64>,
    shift_mm: Vector2<f64>,
}

impl Motion {
    fn error_mm(&self, [first, second]: &[Point2<f64>; 2]) -> f64 {
        (self.matrix * second.coords + self.shift_mm - first.coords).norm()
    }

    /// The similarity through two matches; none where it is not one that errors of pose explain.
    fn of_two([a, b]: [&[Point2<f64>; 2]; 2]) -> Option<Self> {
        let (there, here) = (b[1] - a[1], b[0] - a[0]);
        let scale = here.norm() / there.norm();
        if there.norm() < LEAST_BASE_MM || (scale - 1.0).abs() > MOST_SCALE {
            return None;
        }
        let turn_rad = Vector2::new(there.dot(&here), there.perp(&here));
        let turn_rad = turn_rad.y.atan2(turn_rad.x);
        let matrix = Rotation2::new(turn_rad).into_inner() * scale;
        (turn_rad.abs() <= MOST_TURN_RAD).then(|| Self { matrix, shift_mm: a[0].coords - matrix * a[1].coords })
    }

    /// The similarity that fits matches best.
    fn through(places: &[[Point2<f64>; 2]]) -> Option<Self> {
        let [here, there] = middles(places)?;
        let (mut dot, mut perp, mut norm) = (0.0, 0.0, 0.0);
        for [first, second] in places {
            let (here, there) = (first - here, second - there);
            dot += there.dot(&here);
            perp += there.perp(&here);
            norm += there.norm_squared();
        }
        let matrix = Matrix2::new(dot, -perp, perp, dot) / norm;
        matrix.iter().all(|v| v.is_finite()).then(|| Self { matrix, shift_mm: here.coords - matrix * there.coords })
    }

    /// The affine map that fits matches best.
    fn affine(places: &[[Point2<f64>; 2]]) -> Option<Self> {
        let [here, there] = middles(places)?;
        let (mut cross, mut square) = (Matrix2::zeros(), Matrix2::zeros());
        for [first, second] in places {
            cross += (first - here) * (second - there).transpose();
            square += (second - there) * (second - there).transpose();
        }
        let matrix = cross * square.try_inverse()?;
        Some(Self { matrix, shift_mm: here.coords - matrix * there.coords })
    }
}

fn middles(places: &[[Point2<f64>; 2]]) -> Option<[Point2<f64>; 2]> {
    #[expect(clippy::cast_precision_loss, reason = "some hundreds")]
    let count = places.len() as f64;
    (!places.is_empty())
        .then(|| [0, 1].map(|side| Point2::from(places.iter().map(|p| p[side].coords).sum::<Vector2<f64>>() / count)))
}

/// The similarity that most matches follow, of those through two of them.
fn best_motion(places: &[[Point2<f64>; 2]]) -> Option<Motion> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut draw = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        usize::try_from((state >> 32) % below as u64).unwrap_or(0)
    };
    let mut best: Option<(usize, Motion)> = None;
    for _ in 0..TRIALS {
        let (a, b) = (draw(places.len()), draw(places.len()));
        let Some(motion) = Motion::of_two([&places[a], &places[b]]) else { continue };
        let count = places.iter().filter(|pair| motion.error_mm(pair) < NEAR_MM).count();
        if best.is_none_or(|(most, _)| count > most) {
            best = Some((count, motion));
        }
    }
    Some(best?.1)
}

/// The matches that follow a motion, once an affine map has taken up how errors of the pose bend the table.
fn bent_followers(places: &[[Point2<f64>; 2]], motion: &Motion) -> Option<Vec<usize>> {
    let near = |motion: &Motion, limit_mm: f64| -> Vec<usize> {
        (0..places.len()).filter(|i| motion.error_mm(&places[*i]) < limit_mm).collect()
    };
    let mut followers = near(motion, NEAR_MM);
    for limit_mm in [NEAR_MM, CLOSE_MM] {
        let chosen: Vec<[Point2<f64>; 2]> = followers.iter().map(|i| places[*i]).collect();
        let fitted = if chosen.len() >= LEAST_MATCHES { Motion::affine(&chosen) } else { Motion::through(&chosen) };
        followers = near(&fitted?, limit_mm);
    }
    Some(followers)
}

/// The standard deviation of the first picture's places along the axis along which it is least.
fn spread_mm(places: &[[Point2<f64>; 2]]) -> f64 {
    let Some([middle, _]) = middles(places) else { return 0.0 };
    let square: Matrix2<f64> = places.iter().map(|[first, _]| (first - middle) * (first - middle).transpose()).sum();
    #[expect(clippy::cast_precision_loss, reason = "some hundreds")]
    let least = square.symmetric_eigenvalues().min() / places.len() as f64;
    least.max(0.0).sqrt()
}
