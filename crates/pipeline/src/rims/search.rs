//! The search: from a picture to scored circles on the plane Z = 0.

use model::View;

use super::arcs::{self, Arc};
use super::buckets::Buckets;
use super::outward::outermost;
use super::select::{self, Scored};
use super::significance::Evidence;
use super::votes::{Disc, likely_discs};

/// Radii that are looked for on the plane Z = 0, in mm: from a small cup on the table to a platter raised a little.
const RADII_MM: [f64; 2] = [30.0, 330.0];
/// The pose may be wrong by as much, in radians (17 mg of zero-g offset per degree).
const POSE_ERROR_RAD: f64 = 0.03;
/// Tableware is round within this share of its radius.
const ROUND: f64 = 0.01;
/// Circles that are the same to this share of the radius are one.
const SAME: f64 = 0.02;
/// How far from round a level circle looks for an error of the pose: half of what stretches it, cot(depression) per radian.
fn most_oval(view: &View, disc: &Disc) -> f64 {
    ROUND + 0.5 * POSE_ERROR_RAD * disc.x.hypot(disc.y) / view.pose().camera_height_mm()
}

/// The rims of a picture, the likeliest first.
pub(super) fn rims(view: &View, buckets: &Buckets) -> Vec<Scored> {
    let score = |arc: Arc| {
        let evidence = Evidence::of(view, &arc);
        Scored { confidence: evidence.confidence(&arc), evidence, arc }
    };
    let likely = likely_discs(buckets.edges(), RADII_MM);
    let mut arcs: Vec<Arc> =
        likely.iter().filter_map(|disc| arcs::fit(buckets, disc, most_oval(view, disc))).collect();
    arcs.sort_by(|a, b| b.coverage.total_cmp(&a.coverage));
    let mut distinct: Vec<Arc> = Vec::new();
    for arc in arcs {
        if !distinct.iter().any(|other| are_same(&arc.disc, &other.disc)) {
            distinct.push(arc);
        }
    }
    let inner = select::one_per_container(distinct.into_iter().map(score).collect());
    let outer = inner.into_iter().map(|inner| {
        let most = most_oval(view, &inner.arc.disc);
        score(outermost(buckets, inner.arc, most))
    });
    select::one_per_container(outer.filter(|s| s.arc.disc.radius >= RADII_MM[0]).collect())
}

fn are_same(a: &Disc, b: &Disc) -> bool {
    (a.x - b.x).hypot(a.y - b.y) + (a.radius - b.radius).abs() < SAME * a.radius
}
