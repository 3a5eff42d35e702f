//! Which rims lie at one place on the table.

use model::bundle::SolvedShot;
use model::fit_circle;
use nalgebra::{Point2, Vector3};

/// A round rim of a picture that is tied to others.
#[derive(Debug, Clone)]
pub(in crate::session::auto) struct Candidate {
    /// The number of the sighting.
    pub sighting: usize,
    /// The number of its picture among those that are tied.
    pub shot: usize,
    pub rays: Vec<Vector3<f64>>,
    pub at_place: AtPlace,
}

/// A rim as it appears on Z = 0, in the common frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::session::auto) struct AtPlace {
    pub center_mm: Point2<f64>,
    pub radius_mm: f64,
    /// The point under the camera, and the camera's height above the table.
    foot_mm: Point2<f64>,
    camera_mm: f64,
}

/// Heights of rims that are tried, in mm.
const HEIGHTS_MM: std::ops::RangeInclusive<u32> = 2..=180;
/// A rim is lower than this share of the camera's height.
const MOST_OF_CAMERA: f64 = 0.6;
/// The standard deviation of a rim's place about its container's, in mm, and of its radius, as a share.
const PLACE_MM: f64 = 8.0;
const RADIUS: f64 = 0.03;
/// Two rims are not one if they differ by more (squared standard deviations).
const MOST: f64 = 12.0;
/// All rims of a group are at least this much like each other.
const MOST_WITHIN: f64 = 20.0;

impl AtPlace {
    /// The circle of a rim; none where it is not seen on the table.
    pub fn new(shot: &SolvedShot, rays: &[Vector3<f64>]) -> Option<Self> {
        let points: Vec<Point2<f64>> = rays.iter().filter_map(|ray| shot.on_level(ray, 0.0)).collect();
        let circle = fit_circle(&points, |_, _| 1.0).ok()?.circle;
        let camera_mm = shot.pose.camera_height_mm();
        Some(Self { center_mm: circle.center_mm, radius_mm: circle.radius_mm, foot_mm: shot.foot_mm, camera_mm })
    }

    /// Centre and radius if the rim is at this height.
    fn at_height(&self, height_mm: f64) -> (Point2<f64>, f64) {
        let lowered = 1.0 - height_mm / self.camera_mm;
        (self.foot_mm + (self.center_mm - self.foot_mm) * lowered, self.radius_mm * lowered)
    }

    /// How unlike two rims are, at the height at which they are most alike, in squared standard deviations.
    fn unlike(&self, other: &Self) -> f64 {
        let highest = MOST_OF_CAMERA * self.camera_mm.min(other.camera_mm);
        let at = |height: u32| {
            let height_mm = f64::from(height);
            let ((a, a_mm), (b, b_mm)) = (self.at_height(height_mm), other.at_height(height_mm));
            let possible = height_mm < highest && height_mm < 2.0 * a_mm;
            let unlike = ((a - b).norm() / PLACE_MM).powi(2) + ((a_mm / b_mm).ln() / RADIUS).powi(2);
            if possible { unlike } else { f64::INFINITY }
        };
        HEIGHTS_MM.step_by(2).map(at).fold(f64::INFINITY, f64::min)
    }
}

/// Groups of the numbers of candidates at one place; each has two at least, from different pictures.
pub(super) fn clusters(candidates: &[Candidate]) -> Vec<Vec<usize>> {
    let count = candidates.len();
    let unlike: Vec<Vec<f64>> = candidates
        .iter()
        .map(|a| {
            let of = |b: &Candidate| if a.shot == b.shot { f64::INFINITY } else { a.at_place.unlike(&b.at_place) };
            candidates.iter().map(of).collect()
        })
        .collect();
    let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
    let mut pairs: Vec<(usize, usize)> = pairs.filter(|(a, b)| unlike[*a][*b] <= MOST).collect();
    pairs.sort_by(|x, y| unlike[x.0][x.1].total_cmp(&unlike[y.0][y.1]).then(x.cmp(y)));
    let mut groups: Vec<Vec<usize>> = (0..count).map(|i| vec![i]).collect();
    let mut group_of: Vec<usize> = (0..count).collect();
    for (a, b) in pairs {
        let (into, from) = (group_of[a].min(group_of[b]), group_of[a].max(group_of[b]));
        let fit = groups[into].iter().all(|i| groups[from].iter().all(|j| unlike[*i][*j] <= MOST_WITHIN));
        if into != from && fit {
            let moved = std::mem::take(&mut groups[from]);
            moved.iter().for_each(|i| group_of[*i] = into);
            groups[into].extend(moved);
        }
    }
    groups.retain(|group| group.len() > 1);
    groups
}
