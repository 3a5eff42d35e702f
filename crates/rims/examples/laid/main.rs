//! Rims found without marks on the rendered tables of `bench` and `worn`, against the truth (docs/rims-evaluation.md).
//!
//! ```text
//! cargo run -p aim-batch-rims --example laid -- SEED [BENCHES [WORN_SESSIONS [IMAGES [WIDTH]]]]
//! ```
//!
//! Prints tables. With AIM_BATCH_LAID_PICTURES=DIR every picture is kept there as JPEG, and taken from there if it is there
//! already. With AIM_BATCH_LAID_CSV=FILE, one line per rim found, drinking glasses' left out: picture, confidence, right or
//! not, what its confidence is worked out from (for the example `weights`). With AIM_BATCH_LAID_KINDS=FILE, one line likewise per container found: whether it is a plate, and the
//! logarithm of the odds that it is, as large as it was before the weight of the set `kind`. With AIM_BATCH_LAID_CASES=FILE, one line of JSON
//! per container in view: errors, the true circle in the picture, and what was found of it.

mod cases;
mod pictures;
mod tables;

use std::error::Error;
use std::io::Write as _;
use std::sync::Arc;

use ingest::Picture;
use model::{Container, InputSigma, Kind, Method, Quantity, Shape, View};
use nalgebra::{Point2, Point3};
use rayon::prelude::*;
use simulate::laid::{self, Frame, Truth};

use aim_batch_rims::{FEATURES, HeightSource, LEAST_DIAMETER_MM, Rim, find_rims};

/// A rim is found from this confidence on.
const LEAST_CONFIDENCE: f64 = 0.5;
/// A rim is a container's if its centre and radius on its true level are right within this share of the radius.
const RIGHT: f64 = 0.12;
/// A container is in view if so much of its rim is in the picture and seen.
const IN_VIEW: f64 = 0.6;
/// A foot shows if so much of its circle is seen; of as many places.
const FOOT_SEEN: f64 = 0.15;
const PLACES: u32 = 72;

/// One round container of a picture, and what was found of it.
struct Case {
    object: Arc<str>,
    kind: Kind,
    pitch_deg: f64,
    in_view: bool,
    /// Whether some of the foot is seen below the rim.
    shows_foot: bool,
    found: Option<Found>,
    /// Height of the rim above the table.
    rim_level_mm: f64,
    drawing: cases::Drawing,
}

/// Sizes of a found rim against the truth, as shares of the truth.
#[derive(Clone, Copy)]
struct Found {
    /// With the rim's true level given.
    diameter: f64,
    /// With nothing given: plates on the table, bowls at the height found.
    diameter_alone: f64,
    /// Height of the rim.
    height: f64,
    /// The same in its standard uncertainties.
    height_sigmas: f64,
    /// Not only what is common.
    is_height_seen: bool,
    /// Logarithm of the odds of a plate against a bowl.
    plate_log_odds: f64,
}

/// A rim found.
struct Judged {
    confidence: f64,
    features: [f64; FEATURES],
    is_right: bool,
    /// Too narrow for a run to keep it.
    is_cup: bool,
}

/// The rims that were found in one picture.
struct Report {
    cases: Vec<Case>,
    name: String,
    /// Each rim that is not a drinking glass's, and whether it is one of a container.
    rims: Vec<Judged>,
    /// Drinking glasses found, and those of them that a run would keep.
    glasses: [usize; 2],
    /// No container at all.
    is_bare: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize, default: u64| arguments.get(at).map_or(Ok(default), |text| text.parse::<u64>());
    let (seed, benches, sessions, images) = (number(0, 1)?, number(1, 1)?, number(2, 4)?, number(3, 24)?);
    let width = u32::try_from(number(4, 960)?)?;
    let camera = laid::camera([width, width * 3 / 4])?;
    let mut out = std::io::stdout().lock();
    let bench: Vec<Frame> =
        (0..benches).flat_map(|at| laid::bench(seed * 1000 + at, width)).flat_map(|plan| plan.frames).collect();
    let worn = laid::worn(seed, width, usize::try_from(sessions)?, usize::try_from(images)?);
    let worn: Vec<Frame> = worn.into_iter().flat_map(|plan| plan.frames).collect();
    let (mut rims, mut csv, mut lines, mut kinds) = (Vec::new(), String::new(), String::new(), String::new());
    for (name, frames) in [("bench", bench), ("worn", worn)] {
        let examine = |(at, frame): (usize, &Frame)| {
            let view = frame.view(&camera).map_err(|e| e.to_string())?;
            examine(frame, &view, &format!("{name}-{width}-{seed}-{at:03}"))
        };
        let reports = frames.par_iter().enumerate().map(examine).collect::<Result<Vec<Report>, String>>()?;
        write!(out, "{}", tables::summary(name, &reports))?;
        csv.extend(reports.iter().flat_map(|report| report.rims.iter().map(|rim| rim.csv(&report.name))));
        lines.extend(reports.iter().flat_map(cases::lines));
        kinds.extend(reports.iter().flat_map(cases::kinds));
        rims.extend(reports.into_iter().flat_map(|report| report.rims));
    }
    write!(out, "{}", tables::reliability(&rims))?;
    if let Ok(file) = std::env::var("AIM_BATCH_LAID_CSV") {
        std::fs::write(file, csv)?;
    }
    if let Ok(file) = std::env::var("AIM_BATCH_LAID_KINDS") {
        std::fs::write(file, kinds)?;
    }
    if let Ok(file) = std::env::var("AIM_BATCH_LAID_CASES") {
        std::fs::write(file, lines)?;
    }
    Ok(())
}

fn examine(frame: &Frame, view: &View, name: &str) -> Result<Report, String> {
    let jpeg = pictures::jpeg(frame, view, name)?;
    let picture = Picture::decode(&jpeg).map_err(|e| e.to_string())?;
    let rims = find_rims(&picture, view).map_err(|e| e.to_string())?;
    let truths = frame.truths(view);
    let (others, glasses): (Vec<&Rim>, Vec<&Rim>) =
        rims.iter().partition(|rim| truths.iter().any(|t| is_of(rim, t, view)) || !is_of_glass(rim, frame, view));
    let is_cup = |rim: &Rim| rim.diameter_mm(view) < LEAST_DIAMETER_MM;
    let sure = || glasses.iter().filter(|rim| rim.confidence >= LEAST_CONFIDENCE);
    let glasses = [sure().count(), sure().filter(|rim| !is_cup(rim)).count()];
    let judged = others.iter().map(|rim| Judged {
        confidence: rim.confidence,
        features: rim.evidence.features(),
        is_right: truths.iter().any(|truth| is_of(rim, truth, view)),
        is_cup: is_cup(rim),
    });
    let judged = judged.collect();
    let cases = truths.iter().filter(|truth| truth.kind != Kind::Box).map(|truth| {
        let sure = rims.iter().filter(|rim| rim.confidence >= LEAST_CONFIDENCE && is_of(rim, truth, view));
        let best = sure.max_by(|a, b| a.confidence.total_cmp(&b.confidence));
        Case {
            object: truth.object.clone(),
            kind: truth.kind,
            pitch_deg: frame.head.pitch_deg,
            in_view: truth.rim_seen >= IN_VIEW,
            shows_foot: foot_seen(frame, &truth.object, view) >= FOOT_SEEN,
            found: best.and_then(|rim| found(rim, truth, view)),
            rim_level_mm: truth.rim_level_mm,
            drawing: cases::Drawing::new(best, truth, view),
        }
    });
    Ok(Report { name: name.to_owned(), cases: cases.collect(), rims: judged, glasses, is_bare: truths.is_empty() })
}

/// Share of the foot's circle on the table that is seen.
fn foot_seen(frame: &Frame, object: &str, view: &View) -> f64 {
    let Some(placed) = frame.placed.iter().find(|placed| *placed.object == *object) else { return 0.0 };
    let (stand, up) = (frame.stand.0, view.pose().camera_height_mm());
    let places = (0..PLACES).map(|i| f64::from(i) / f64::from(PLACES) * std::f64::consts::TAU);
    let seen = places.filter(|angle| {
        let out = 0.5 * placed.ware.foot_mm;
        let at = Point3::new(placed.at_mm.x + out * angle.cos(), placed.at_mm.y + out * angle.sin(), 0.5);
        frame.world.is_seen(Point3::new(stand.x, stand.y, up), at, 2.0)
    });
    seen.count() as f64 / f64::from(PLACES)
}

/// Whether a rim is a level circle of a drinking glass: its rim, its foot, or what it holds.
fn is_of_glass(rim: &Rim, frame: &Frame, view: &View) -> bool {
    let camera_mm = view.pose().camera_height_mm();
    let ([x, y], radius) = rim.on_table_mm;
    frame.vessels.iter().any(|vessel| {
        let at = frame.in_view(vessel.at_mm);
        [0.0, 0.25, 0.5, 0.75, 1.0].into_iter().any(|share| {
            let shrink = 1.0 - share * vessel.height_mm / camera_mm;
            let wide = vessel.diameters_mm[0] + share * (vessel.diameters_mm[1] - vessel.diameters_mm[0]);
            let apart = (Point2::new(x * shrink, y * shrink) - at).norm();
            apart < 0.35 * wide && (2.0 * radius * shrink / wide - 1.0).abs() < 0.3
        })
    })
}

/// Whether a rim is that of a container, its outer edge or the inner one.
fn is_of(rim: &Rim, truth: &Truth, view: &View) -> bool {
    let Some(diameter_mm) = truth.true_diameter_mm else { return false };
    let shrink = 1.0 - truth.rim_level_mm / view.pose().camera_height_mm();
    let ([x, y], radius) = rim.on_table_mm;
    let center = Point2::new(x * shrink, y * shrink);
    let apart = (center - Point2::new(truth.center_x_mm, truth.center_y_mm)).norm();
    let off = (2.0 * radius * shrink / diameter_mm - 1.0).abs();
    apart.max(off * 0.5 * diameter_mm) < RIGHT * 0.5 * diameter_mm
}

fn found(rim: &Rim, truth: &Truth, view: &View) -> Option<Found> {
    let truth_mm = truth.true_diameter_mm?;
    let size_mm = |rim_height_mm: Option<f64>| {
        let container = Container { kind: truth.kind, shape: Shape::Circle, rim_height_mm, wall: None };
        let sizes = rim.sizes(view, Method::Ray, &container, &InputSigma::NONE);
        let diameter = sizes.into_iter().find(|(quantity, _)| *quantity == Quantity::Diameter)?;
        Some(diameter.1.ok()?.measured.predicted_mm)
    };
    let container = Container { kind: truth.kind, shape: Shape::Circle, rim_height_mm: None, wall: None };
    let height = rim.height_as(&container);
    Some(Found {
        diameter: size_mm(Some(truth.rim_level_mm))? / truth_mm - 1.0,
        diameter_alone: size_mm(None)? / truth_mm - 1.0,
        height: height.mm / truth.rim_level_mm - 1.0,
        height_sigmas: (height.mm - truth.rim_level_mm) / height.sigma_mm,
        is_height_seen: height.source != HeightSource::Common,
        plate_log_odds: rim.plate_log_odds,
    })
}

impl Judged {
    fn csv(&self, picture: &str) -> String {
        let features: Vec<String> = self.features.iter().map(|feature| format!("{feature:.5}")).collect();
        format!("{picture},{:.5},{},{}\n", self.confidence, u8::from(self.is_right), features.join(","))
    }
}
