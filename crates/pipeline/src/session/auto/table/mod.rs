//! The containers of a session by their places on one table.
//!
//! One picture cannot tell how high a rim is unless it sees a foot or a floor, and sizes alone cannot always tell which rims are one. But
//! pictures that show the same features of the table have their places in one frame, and there a container stays where it is: its rims are
//! those at one place, and they move against the table by its height. A table without any features ties nothing, and then nothing is
//! said here.
//!
//! - In: what was seen in each picture: its pose by the sensors, features of the table, and rims.
//! - Out: [`OnTable`]: which rims are one container, and the height of its rim where the pictures were taken from places apart.

mod cluster;
mod looked;

use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;

use model::bundle::{
    BundleInput, BundleRim, BundleShot, BundleSigma, BundleTie, HeightPrior, SolvedBundle, SolvedRim, solve_bundle,
};
use model::{FrameReason, InputSigma};
use nalgebra::Point2;
use rims::RimHeight;
use ties::{Feature, Ties, tie};

use super::appearance::pooled;
use super::named::Seen;
use super::track::Sighting;
use crate::session::frames::Frame;
use cluster::{AtPlace, Candidate, clusters};
pub(super) use looked::{Looked, rays_of};

/// A container at its place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct OnTable {
    /// The numbers of its sightings in images that are measured, in order.
    pub members: Vec<usize>,
    /// The height of its rim, in mm, with its standard uncertainty.
    pub height_mm: (f64, f64),
}

/// A picture keeps its place if as many of its tie points agree with the others.
const LEAST_TIES: usize = 6;
/// A rim that lies this many standard uncertainties (RMS) off its container is not of it, or the container was moved.
const MOST_MISFIT: f64 = 4.0;
/// Tie points that all lie within a smaller angle, as seen from a container, may be of another plane than its table, as those of a floor
/// beyond the edge of a table without any features are.
const LEAST_SECTOR_RAD: f64 = 0.5 * PI;
/// The most pictures by which a table is tied, so that time and memory are bounded: selected ones, and others.
const MOST_SELECTED: usize = 6;
const MOST_OTHERS: usize = 3;
/// The pitch of the others, in degrees: further up nothing of the table is seen, further down little of it.
const PITCH_DEG: RangeInclusive<f64> = 35.0..=75.0;
/// Each picture's own errors: sway of the head, and what stands in the range sensor's cone.
const OWN_RAD: f64 = 0.005;
const OWN_RANGE: f64 = 0.03;
/// The error of the place of a table feature, and of a rim's edge, as angles in radians (about 1.5 and 0.5 pixels of 1300 across).
const TIE_RAD: f64 = 0.0018;
const RIM_RAD: f64 = 0.0006;
const RIM_MM: f64 = 0.7;
/// Before it is solved, a height is a quarter of the diameter, give or take as much: between a plate's and a deep bowl's.
const PRIOR_HEIGHT: f64 = 0.25;
/// What the equations do not know of: rounded lips, inner edges that are taken for a rim, features that lie a little above the table. By the
/// rendered and path-traced tables of docs/rims-evaluation.md, where heights are off by twice what the equations say.
const HEIGHT_SIGMA_MM: f64 = 4.0;
const HEIGHT_SIGMA_SHARE: f64 = 0.1;

/// The numbers of the pictures by which the table is tied together: selected ones, and some that look more steeply or less steeply and so
/// were taken from places further apart. Both are spread over the session. Where nothing is selected, there is nothing to measure.
pub(super) fn pictures_of_table(frames: &[Frame]) -> BTreeSet<usize> {
    let with = |is: fn(&Frame) -> bool| -> Vec<usize> {
        frames.iter().enumerate().filter(|(_, frame)| is(frame)).map(|(number, _)| number).collect()
    };
    let selected = with(|frame| frame.signals.reason == FrameReason::Selected);
    let others = with(|frame| {
        let pitch_deg = frame.signals.pose.map(|pose| pose.pitch_rad().to_degrees());
        frame.signals.reason == FrameReason::PitchOutsideTarget && pitch_deg.is_some_and(|deg| PITCH_DEG.contains(&deg))
    });
    if selected.is_empty() {
        return BTreeSet::new();
    }
    spread(&selected, MOST_SELECTED).chain(spread(&others, MOST_OTHERS)).collect()
}

/// At most so many of some numbers, evenly spread.
fn spread(numbers: &[usize], most: usize) -> impl Iterator<Item = usize> + '_ {
    let taken = numbers.len().min(most);
    (0..taken).filter_map(move |i| numbers.get((2 * i + 1) * numbers.len() / (2 * taken)).copied())
}

/// The containers that are seen in two pictures or more of one table. `helping`: what was seen in pictures in which nothing is measured.
pub(super) fn on_one_table(looked: &[Looked], seen: &[Seen], helping: &[Seen], inputs: &InputSigma) -> Vec<OnTable> {
    let pictures: Vec<Vec<Feature>> = looked.iter().map(|looked| looked.features.clone()).collect();
    let ties = tie(&pictures);
    tracing::debug!(points = ties.points.len(), pairs = ?ties.registered, "ties between pictures");
    let Some(table) = Tied::new(looked, &ties, bundle_sigma(inputs)) else { return Vec::new() };
    let (misfit, rejected) = (table.solved.tie_misfit, table.solved.rejected.len());
    tracing::debug!(images = ?table.images, misfit, rejected, "pictures of one table");
    let all = seen.iter().chain(helping).enumerate();
    let candidates: Vec<Candidate> = all.filter_map(|(n, seen)| table.candidate(n, seen)).collect();
    let mut groups: Vec<Vec<usize>> = clusters(&candidates);
    // What does not fit its container is taken out, and the rest is solved again.
    for _ in 0..3 {
        let Some(solved) = table.with_rims(&candidates, &groups) else { return Vec::new() };
        for (group, rim) in groups.iter().zip(&solved.rims) {
            let members: Vec<usize> = group.iter().map(|member| candidates[*member].sighting).collect();
            tracing::debug!(?members, height_mm = rim.height_mm, sigma_mm = rim.sigma_height_mm, misfits = ?rim.misfits, "a container");
        }
        if !drop_misfits(&mut groups, &candidates, &solved) {
            let told = table.told(&groups, &candidates, &solved, seen.len(), inputs);
            return if is_believable(&told, seen) { told } else { Vec::new() };
        }
        groups.retain(|group| group.len() > 1);
    }
    Vec::new()
}

fn bundle_sigma(inputs: &InputSigma) -> BundleSigma {
    BundleSigma {
        common_rad: inputs.pitch_rad.hypot(inputs.mount_rad),
        own_rad: inputs.turn_noise_rad.hypot(OWN_RAD),
        own_range: OWN_RANGE,
        tie_rad: TIE_RAD,
        rim_rad: RIM_RAD,
        rim_mm: RIM_MM,
    }
}

/// The pictures that hang together, with their solved poses.
struct Tied {
    input: BundleInput,
    /// The numbers of the images in the session.
    images: Vec<usize>,
    solved: SolvedBundle,
}

impl Tied {
    fn new(looked: &[Looked], ties: &Ties, sigma: BundleSigma) -> Option<Self> {
        let mut kept: Vec<usize> = (0..looked.len()).filter(|i| ties.placed[*i].is_some()).collect();
        // A picture whose ties contradict the others may take further ones with it.
        for _ in 0..looked.len() {
            let input = input_of(looked, ties, &kept, sigma);
            let solved = solve_bundle(&input).ok()?;
            let good = |shot: usize| {
                let of_shot = input.ties.iter().enumerate().filter(|(_, tie)| tie.shot == shot);
                of_shot.filter(|(i, _)| !solved.rejected.contains(i)).count()
            };
            let agreeing: Vec<usize> =
                kept.iter().enumerate().filter(|(shot, _)| good(*shot) >= LEAST_TIES).map(|(_, i)| *i).collect();
            if agreeing.len() < 2 {
                return None;
            }
            if agreeing.len() == kept.len() {
                let images = kept.iter().map(|i| looked[*i].image).collect();
                return Some(Self { input, images, solved });
            }
            kept = agreeing;
        }
        None
    }

    /// A rim with its circle on Z = 0 in the common frame; none where its picture is not tied, or it is not round.
    fn candidate(&self, sighting: usize, seen: &Seen) -> Option<Candidate> {
        let shot = self.images.iter().position(|image| *image == seen.sighting.image)?;
        if seen.sighting.narrowness.is_some() {
            return None;
        }
        let at_place = AtPlace::new(&self.solved.shots[shot], &seen.rays)?;
        Some(Candidate { sighting, shot, rays: seen.rays.clone(), at_place })
    }

    fn with_rims(&self, candidates: &[Candidate], groups: &[Vec<usize>]) -> Option<SolvedBundle> {
        let mut input = self.input.clone();
        for (container, group) in groups.iter().enumerate() {
            let mut diameter_mm = 0.0;
            for member in group {
                let Candidate { shot, rays, at_place, .. } = &candidates[*member];
                input.rims.push(BundleRim { shot: *shot, container, rays: rays.clone() });
                diameter_mm = 2.0 * at_place.radius_mm;
            }
            let mm = PRIOR_HEIGHT * diameter_mm;
            input.heights.push(HeightPrior { mm, sigma_mm: mm });
        }
        solve_bundle(&input).ok()
    }

    /// The containers whose place the table fixes; `measured` is the number of sightings that are measured, which come first.
    fn told(
        &self,
        groups: &[Vec<usize>],
        candidates: &[Candidate],
        solved: &SolvedBundle,
        measured: usize,
        inputs: &InputSigma,
    ) -> Vec<OnTable> {
        let one = |(group, rim): (&Vec<usize>, &SolvedRim)| {
            let by_range_mm = inputs.range_relative * rim.height_mm;
            let unmodelled_mm = HEIGHT_SIGMA_MM.hypot(HEIGHT_SIGMA_SHARE * rim.height_mm);
            let sigma_mm = rim.sigma_height_mm.hypot(unmodelled_mm).hypot(by_range_mm);
            let of_group = group.iter().map(|member| candidates[*member].sighting);
            let mut members: Vec<usize> = of_group.filter(|sighting| *sighting < measured).collect();
            members.sort_unstable();
            let is_surrounded = self.sector_rad(rim.center_mm) >= LEAST_SECTOR_RAD;
            (is_surrounded && !members.is_empty()).then_some(OnTable { members, height_mm: (rim.height_mm, sigma_mm) })
        };
        groups.iter().zip(&solved.rims).filter_map(one).collect()
    }

    /// The angle, seen from a point of the table, within which all tie points lie that agree with each other.
    fn sector_rad(&self, from_mm: Point2<f64>) -> f64 {
        let agreeing = self.input.ties.iter().enumerate().filter(|(i, _)| !self.solved.rejected.contains(i));
        let places = agreeing.filter_map(|(_, tie)| self.solved.shots[tie.shot].on_level(&tie.ray, 0.0));
        let mut directions: Vec<f64> = places.map(|at| at - from_mm).map(|away| away.y.atan2(away.x)).collect();
        directions.sort_by(f64::total_cmp);
        let gaps = directions.windows(2).map(|two| two[1] - two[0]);
        let around = directions.first().zip(directions.last()).map(|(first, last)| first + TAU - last);
        TAU - gaps.chain(around).fold(0.0, f64::max)
    }
}

fn input_of(looked: &[Looked], ties: &Ties, kept: &[usize], sigma: BundleSigma) -> BundleInput {
    let shots = kept.iter().filter_map(|i| {
        let placed = ties.placed[*i]?;
        Some(BundleShot { sensed: *looked[*i].view.pose(), turn_rad: placed.turn_rad, foot_mm: placed.foot_mm })
    });
    let tie = |point: &ties::TiePoint| {
        let shot = kept.iter().position(|i| *i == point.picture)?;
        let ray = looked[point.picture].view.camera().ray_through(point.pixel).ok()?;
        Some(BundleTie { shot, feature: point.feature, ray })
    };
    let ties = ties.points.iter().filter_map(tie).collect();
    BundleInput { shots: shots.collect(), ties, rims: Vec::new(), heights: Vec::new(), sigma }
}

/// Takes the rims out of their groups that do not fit; says whether there were any.
fn drop_misfits(groups: &mut [Vec<usize>], candidates: &[Candidate], solved: &SolvedBundle) -> bool {
    let mut any = false;
    for (group, rim) in groups.iter_mut().zip(&solved.rims) {
        let fits = |shot: usize| rim.misfits.iter().any(|(of, misfit)| *of == shot && *misfit <= MOST_MISFIT);
        let before = group.len();
        group.retain(|member| fits(candidates[*member].shot));
        any |= group.len() < before;
    }
    any
}

/// Whether the heights can be those of rims above the table. Features of another plane than the table tie pictures as well: of a floor, or of a
/// window that a polished table mirrors. They move less than the table, so that everything on it seems to be far too high, and higher than
/// single pictures show by foot or floor.
fn is_believable(told: &[OnTable], seen: &[Seen]) -> bool {
    told.iter().all(|OnTable { members, height_mm: (mm, sigma_mm) }| {
        let sightings: Vec<&Sighting> =
            members.iter().filter_map(|member| Some(&seen.get(*member)?.sighting)).collect();
        let widest_mm = sightings.iter().map(|one| one.across_mm * (1.0 - mm / one.camera_mm)).fold(0.0, f64::max);
        let Some(alone) = pooled(sightings.iter().map(|one| &one.appearance)) else { return true };
        let alone = alone.height(alone.kind());
        let allowed_mm = MOST_APART * sigma_mm.hypot(ALONE_SHARE * alone.mm).hypot(ALONE_MM);
        mm - alone.mm <= allowed_mm && mm - 2.0 * sigma_mm <= HIGHEST * widest_mm
    })
}

/// A height by a single picture errs by this share and this much (the median error on rendered and real bowls is 15 to 29 %).
const ALONE_SHARE: f64 = 0.3;
const ALONE_MM: f64 = 5.0;
/// Heights that are further apart, in standard uncertainties, contradict each other.
const MOST_APART: f64 = 3.0;
/// Bowls, plates and cups that are wide enough to be measured are lower than this share of their diameter.
const HIGHEST: f64 = 0.9;

impl OnTable {
    /// The height as that of a rim.
    pub fn rim_height(&self) -> RimHeight {
        let (mm, sigma_mm) = self.height_mm;
        RimHeight { mm, sigma_mm, source: rims::HeightSource::Session }
    }
}
