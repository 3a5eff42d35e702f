//! Rectangles: the search from edges on the plane Z = 0 to those that are rims.

use ingest::Picture;
use model::{Kind, View};
use nalgebra::{Point2, Point3};

use super::corners;
use super::evidence::evidence;
use super::follow::{Followed, follow};
use super::levels::Levels;
use super::pieces::pieces;
use super::quad::Quad;
use super::support::Support;
use crate::edges::GroundEdge;
use crate::evidence::SquareEvidence;
use crate::rim::Rim;
use crate::rim_height::{HeightSource, RimHeight};

/// Edges so far around a rectangle are looked at, in mm.
const AROUND_MM: f64 = 36.0;
/// Rectangles whose neighbours stand less upright on each other, or whose opposite sides differ by more, are none.
const MOST_SKEW: f64 = 0.1;
/// A side with less edge along it is not seen, and all of them have this much in the mean.
const LEAST_SIDE: f64 = 0.2;
const LEAST_COVERAGE: f64 = 0.55;
/// Lines that go on beyond the corners by more than this share are a table's, or a cloth's.
const MOST_BEYOND: f64 = 0.35;
/// Chance shows fewer than a hundredth of such rectangles in a picture.
const MOST_FALSE_ALARMS_LOG10: f64 = -2.0;
/// Lines within that are below the rim are seen along so much more of the sides than lines on its level would be: else they are
/// a printed border.
const LEAST_RAISED: f64 = 0.05;
/// As many, the likeliest, are followed through the full picture.
const MOST_FOLLOWED: usize = 24;
/// Fits whose corners are nearer to each other than this share of half the way across are one.
const SAME: f64 = 0.012;
/// Rectangles less likely than this are not told.
const LEAST_CONFIDENCE: f64 = 0.02;

/// A rectangle that was found.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Square {
    pub confidence: f64,
    pub evidence: SquareEvidence,
    /// On the plane Z = 0, in mm, in order.
    pub corners_mm: [Point2<f64>; 4],
    /// In the full picture.
    pub corners_px: [Point2<f64>; 4],
    pub center_px: Point2<f64>,
    /// Length of its sides in the full picture.
    pub perimeter_px: f64,
}

/// The rectangles in a picture, the likeliest first. `edges` are in the order of their chains; `factor`: pixels of the full
/// picture per pixel of theirs.
pub(crate) fn squares(picture: &Picture, view: &View, edges: &[GroundEdge], factor: usize) -> Vec<Square> {
    #[expect(clippy::cast_precision_loss, reason = "a small factor")]
    let factor = factor as f64;
    let likely = corners::quads(&pieces(edges));
    let mut scored = distinct(likely.iter().filter_map(|quad| scored(edges, quad)).collect());
    scored.truncate(MOST_FOLLOWED);
    let mut found: Vec<Square> = scored.iter().filter_map(|scored| in_full(picture, view, scored, factor)).collect();
    found.retain(|square| square.confidence >= LEAST_CONFIDENCE);
    one_per_container(found)
}

/// A rectangle of the reduced picture with what speaks for it.
#[derive(Debug, Clone)]
struct Scored {
    quad: Quad,
    evidence: SquareEvidence,
    confidence: f64,
}

fn scored(edges: &[GroundEdge], quad: &Quad) -> Option<Scored> {
    let near = near(edges, quad);
    let quad = quad.fitted(&near)?;
    let [a, b] = quad.extent();
    let is_size = [a, b].iter().all(|side| (corners::SIDES_MM[0]..corners::SIDES_MM[1]).contains(side));
    if !is_size || quad.skew() > MOST_SKEW {
        return None;
    }
    let support = Support::of(&quad, &near);
    let mean = support.coverage.iter().sum::<f64>() / 4.0;
    let is_seen = mean >= LEAST_COVERAGE && support.coverage.iter().all(|side| *side >= LEAST_SIDE);
    if !is_seen || support.beyond > MOST_BEYOND {
        return None;
    }
    let evidence = evidence(&support, &Levels::of(&quad, &near));
    let is_raised = evidence.below >= evidence.level.max(evidence.above) + LEAST_RAISED;
    (is_raised && evidence.false_alarms_log10 < MOST_FALSE_ALARMS_LOG10).then_some(Scored {
        quad,
        evidence,
        confidence: evidence.confidence(),
    })
}

/// Leaves one of those that are the same after their fit, the likeliest first.
fn distinct(mut found: Vec<Scored>) -> Vec<Scored> {
    found.sort_by(|a, b| b.confidence.total_cmp(&a.confidence));
    let mut distinct: Vec<Scored> = Vec::new();
    for one in found {
        if !distinct.iter().any(|other| one.quad.apart(&other.quad) < SAME * one.quad.reach()) {
            distinct.push(one);
        }
    }
    distinct
}

/// The edges about a rectangle.
fn near(edges: &[GroundEdge], quad: &Quad) -> Vec<GroundEdge> {
    let (center, reach) = (quad.center(), quad.reach() + AROUND_MM);
    let is_near = |e: &&GroundEdge| {
        let (dx, dy) = (f64::from(e.x) - center.x, f64::from(e.y) - center.y);
        dx * dx + dy * dy < reach * reach
    };
    edges.iter().filter(is_near).copied().collect()
}

/// Of rectangles that overlap the likeliest one.
fn one_per_container(mut found: Vec<Square>) -> Vec<Square> {
    found.sort_by(|a, b| b.confidence.total_cmp(&a.confidence));
    let mut kept: Vec<Square> = Vec::new();
    for one in found {
        if !kept.iter().any(|other| overlap(&one.quad(), &other.quad())) {
            kept.push(one);
        }
    }
    kept
}

/// Whether the centre of one lies within the other.
fn overlap(a: &Quad, b: &Quad) -> bool {
    holds(a, b.center()) || holds(b, a.center())
}

fn holds(quad: &Quad, point: Point2<f64>) -> bool {
    quad.sides().iter().all(|side| side.place(point).1 < 0.0)
}

impl Square {
    fn quad(&self) -> Quad {
        Quad { corners: self.corners_mm }
    }

    /// As a rim among others.
    pub(crate) fn rim(self, view: &View) -> Rim {
        let quad = self.quad();
        let (center, [a, b]) = (quad.center(), quad.extent());
        let camera_mm = view.pose().camera_height_mm();
        Rim {
            confidence: self.confidence,
            kind: Kind::Plate,
            plate_log_odds: PLATE_LOG_ODDS,
            center_px: self.center_px,
            points_px: self.corners_px.to_vec(),
            perimeter_px: self.perimeter_px,
            evidence: self.evidence.as_of_a_rim(),
            height: common_height(BOWLS, [a, b], camera_mm),
            plate_height: common_height(PLATES, [a, b], camera_mm),
            on_table_mm: ([center.x, center.y], 0.25 * (a + b)),
            square: Some(self.evidence),
        }
    }
}

/// What has a well below a straight rim is a plate or a tray, whatever it looks like in other images; boxes are not told from them.
const PLATE_LOG_ODDS: f64 = 10.0;
/// Height over side of plates and bowls, by the square root of their area: mean and standard deviation. Estimates of our own, as
/// those of round ones.
const PLATES: (f64, f64) = (0.1, 0.035);
const BOWLS: (f64, f64) = (0.38, 0.12);

/// What is common, for sides as they appear on Z = 0: H = q D and D = d (1 - H / c).
fn common_height((ratio, spread): (f64, f64), [a, b]: [f64; 2], camera_mm: f64) -> RimHeight {
    let side_mm = (a * b).sqrt();
    let side_mm = side_mm / (1.0 + ratio * side_mm / camera_mm);
    RimHeight { mm: ratio * side_mm, sigma_mm: spread * side_mm, source: HeightSource::Common }
}

/// A rectangle followed through the full picture; none where a corner lies outside of it.
fn in_full(picture: &Picture, view: &View, scored: &Scored, factor: f64) -> Option<Square> {
    let followed = follow(picture, view, &scored.quad, factor)?;
    let pixel = |p: Point2<f64>| view.pixel_of(Point3::new(p.x, p.y, 0.0)).ok();
    let [a, b, c, d] = followed.quad.corners;
    let corners_px = [pixel(a)?, pixel(b)?, pixel(c)?, pixel(d)?];
    let [width, height] = view.camera().size_px().map(f64::from);
    if !corners_px.iter().all(|p| (0.0..width).contains(&p.x) && (0.0..height).contains(&p.y)) {
        return None;
    }
    let Followed { sharp, rough_in, rough_out, unlike, .. } = followed;
    let evidence = SquareEvidence { sharp, rough_in, rough_out, unlike, ..scored.evidence };
    Some(Square {
        confidence: evidence.confidence(),
        evidence,
        corners_mm: followed.quad.corners,
        corners_px,
        center_px: pixel(followed.quad.center())?,
        perimeter_px: (0..4).map(|k| (corners_px[(k + 1) % 4] - corners_px[k]).norm()).sum(),
    })
}
