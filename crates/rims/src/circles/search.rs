//! The search: from a picture to scored circles on the plane Z = 0.

use std::cell::OnceCell;

use model::View;

use super::arcs::{self, Rough};
use super::buckets::Buckets;
use super::outward::outermost;
use super::select::{self, Scored};
use super::significance::evidence;
use super::trial::{Arc, Disc};
use super::votes::likely_discs;

/// Radii that are looked for on the plane Z = 0, in mm: from a small cup on the table to a platter raised a little.
const RADII_MM: [f64; 2] = [30.0, 330.0];
/// The pose may be wrong by as much, in radians (17 mg of zero-g offset per degree).
const POSE_ERROR_RAD: f64 = 0.03;
/// Tableware is round within this share of its radius.
const ROUND: f64 = 0.02;
/// Circles that are the same to this share of the radius are one.
const SAME: f64 = 0.02;
/// Circles less likely than this are not followed up, and not told in the end.
const WORTH_A_TRY: f64 = 0.05;
const LEAST_CONFIDENCE: f64 = 0.2;
/// As many of the circles voted for, those with most of their bins covered after rough steps, are fitted finely at first.
const FINE: usize = 64;
/// As many of the likeliest circles of a container are led outward.
const LED_OUTWARD: usize = 6;
/// Circles nearer to each other than this share of the radius may end at the same rim.
const NEAR: f64 = 0.3;

/// How far from round a level circle looks for an error of the pose: half of what stretches it, cot(depression) per radian.
fn most_oval(view: &View, disc: &Disc) -> f64 {
    ROUND + 0.5 * POSE_ERROR_RAD * disc.x.hypot(disc.y) / view.pose().camera_height_mm()
}

/// The rims of a picture, the likeliest first, by its edges and by pieces of chains of them.
pub(crate) fn rims(view: &View, buckets: &Buckets, pieces: &Buckets) -> Vec<Scored> {
    let camera_mm = view.pose().camera_height_mm();
    let score = |arc: Arc| {
        let evidence = evidence(view, &arc);
        Scored { confidence: evidence.rank(), evidence, best: evidence, arc }
    };
    let likely = likely_discs(pieces.edges(), RADII_MM);
    // Each of the circles voted for is fitted once, if ever.
    let roughs: Vec<OnceCell<Option<Rough>>> = vec![OnceCell::new(); likely.all.len()];
    let rough = |i: usize| roughs[i].get_or_init(|| arcs::rough(pieces, &likely.all[i])).as_ref();
    let mut fits: Vec<Option<Option<Arc>>> = vec![None; likely.all.len()];
    let mut fitted = |discs: &[usize]| -> Vec<Scored> {
        let arcs = discs.iter().filter_map(|i| {
            let fine = |rough| arcs::fine(buckets, rough, most_oval(view, &likely.all[*i]));
            fits[*i].get_or_insert_with(|| rough(*i).and_then(fine)).clone()
        });
        distinct(arcs.filter(|arc| arc.disc.radius >= RADII_MM[0]).collect()).into_iter().map(score).collect()
    };
    let mut first: Vec<(usize, f64)> = likely.peaks.iter().filter_map(|i| Some((*i, rough(*i)?.coverage))).collect();
    first.sort_by(|a, b| b.1.total_cmp(&a.1));
    let first: Vec<usize> = first.iter().map(|(i, _)| *i).take(FINE).collect();
    let found = select::one_per_container(fitted(&first), camera_mm, WORTH_A_TRY);
    // A fit may end beside the best one, or on an inner edge: whatever was voted for nearby is tried as well, and led outward.
    let polished = found.into_iter().flat_map(|found| {
        let is_near = |i: &usize| are_near(&likely.all[*i], &found.arc.disc);
        let near: Vec<usize> = (0..likely.all.len()).filter(is_near).collect();
        let mut tried = fitted(&near);
        tried.push(found);
        tried.sort_by(|a, b| b.confidence.total_cmp(&a.confidence));
        tried.truncate(LED_OUTWARD);
        let led = tried.iter().map(|inner| {
            let most = most_oval(view, &inner.arc.disc);
            score(outermost(buckets, inner.arc.clone(), most))
        });
        let outer: Vec<Scored> = led.collect();
        tried.extend(outer);
        select::one_per_container(tried, camera_mm, WORTH_A_TRY).into_iter().take(1)
    });
    select::one_per_container(polished.collect(), camera_mm, LEAST_CONFIDENCE)
}

/// Leaves one of those that are the same, with the best support.
fn distinct(mut arcs: Vec<Arc>) -> Vec<Arc> {
    arcs.sort_by(|a, b| b.coverage.total_cmp(&a.coverage));
    let mut distinct: Vec<Arc> = Vec::new();
    for arc in arcs {
        if !distinct.iter().any(|other| are_same(&arc.disc, &other.disc)) {
            distinct.push(arc);
        }
    }
    distinct
}

/// Whether a fit that starts from one circle may end at another one.
fn are_near(a: &Disc, b: &Disc) -> bool {
    (a.x - b.x).hypot(a.y - b.y) < NEAR * b.radius && (a.radius / b.radius).ln().abs() < NEAR
}

fn are_same(a: &Disc, b: &Disc) -> bool {
    let apart = ((a.x - b.x).powi(2) + (a.y - b.y).powi(2)).sqrt();
    apart + (a.radius - b.radius).abs() < SAME * a.radius
}
