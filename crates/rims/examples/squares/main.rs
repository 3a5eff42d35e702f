//! Square and rectangular plates found without marks on rendered tables, against the truth (docs/rims-evaluation.md).
//!
//! ```text
//! cargo run -p aim-batch-rims --example squares -- SEED [TABLES [OTHERS [BENCHES [WORN_SESSIONS [IMAGES [WIDTH]]]]]]
//! ```
//!
//! TABLES have such a plate, OTHERS have mats, napkins, boxes and round plates (three pictures of each); bench and worn are
//! those of the example `laid`. With AIM_BATCH_LAID_PICTURES=DIR every picture is kept there as JPEG, and taken from there if it
//! is there already. With AIM_BATCH_LAID_CSV=FILE, one line per rectangle found: picture, confidence, right or not, what its
//! confidence is worked out from (for the example `weights`).

#[path = "../laid/pictures.rs"]
mod pictures;
mod scenes;
mod tables;

use std::error::Error;
use std::io::Write as _;

use aim_batch_rims::{Rim, RimShape, find_rims_of};
use ingest::Picture;
use model::{Container, InputSigma, Kind, Method, Quantity, Shape, View};
use nalgebra::Point2;
use rayon::prelude::*;
use simulate::laid::{self, Frame, SceneSpec, Truth};

use scenes::Set;
use tables::{Case, Judged, Report};

/// A rectangle is a plate's if sides and centre on its true level are right within this share; one that is wrong by less than the
/// other is neither right nor wrong.
const RIGHT: f64 = 0.05;
const WRONG: f64 = 0.06;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize, default: u64| arguments.get(at).map_or(Ok(default), |text| text.parse::<u64>());
    let (seed, tables, others, benches) = (number(0, 1)?, number(1, 40)?, number(2, 25)?, number(3, 0)?);
    let (sessions, images) = (usize::try_from(number(4, 0)?)?, usize::try_from(number(5, 8)?)?);
    let width = u32::try_from(number(6, 720)?)?;
    let camera = laid::camera([width, width * 3 / 4])?;
    let bench = (0..benches).flat_map(|at| laid::bench(seed * 1000 + at, width)).flat_map(|plan| plan.frames);
    let worn = if sessions > 0 { laid::worn(seed, width, sessions, images) } else { Vec::new() };
    let sets: [(&str, Vec<(String, Frame)>); 4] = [
        ("plates", scenes_of(Set::Plates, seed, tables, width)?),
        ("others", scenes_of(Set::Others, seed, others, width)?),
        ("bench", bench.enumerate().map(|(at, frame)| (format!("{at:03}"), frame)).collect()),
        ("worn", worn.into_iter().flat_map(|p| p.frames).enumerate().map(|(at, f)| (format!("{at:03}"), f)).collect()),
    ];
    let mut out = std::io::stdout().lock();
    let (mut all, mut csv) = (Vec::new(), String::new());
    for (set, frames) in &sets {
        let examine = |(place, frame): &(String, Frame)| {
            let view = frame.view(&camera).map_err(|e| e.to_string())?;
            examine(frame, &view, &format!("{set}-{width}-{seed}-{place}"))
        };
        let reports = frames.par_iter().map(examine).collect::<Result<Vec<Report>, String>>()?;
        write!(out, "{}", tables::summary(set, &reports))?;
        all.extend(reports);
    }
    csv.extend(all.iter().flat_map(|report| report.rims.iter().map(|rim| rim.csv(&report.name))));
    write!(out, "{}", tables::reliability(all.iter().flat_map(|report| &report.rims)))?;
    if let Ok(file) = std::env::var("AIM_BATCH_LAID_CSV") {
        std::fs::write(file, csv)?;
    }
    Ok(())
}

/// The pictures of a set, each with its place in it.
fn scenes_of(set: Set, seed: u64, tables: u64, width: u32) -> Result<Vec<(String, Frame)>, Box<dyn Error>> {
    let mut frames = Vec::new();
    for number in 0..tables {
        let spec: SceneSpec = toml::from_str(&scenes::scene(set, seed, number))?;
        let plans = spec.plans(seed * 100_000 + number, width)?;
        let of_table = plans.into_iter().flat_map(|plan| plan.frames).enumerate();
        frames.extend(of_table.map(|(at, frame)| (format!("{number:03}-{at}"), frame)));
    }
    Ok(frames)
}

fn examine(frame: &Frame, view: &View, name: &str) -> Result<Report, String> {
    let picture = Picture::decode(&pictures::jpeg(frame, view, name)?).map_err(|e| e.to_string())?;
    let rims = find_rims_of(&picture, view, &[RimShape::Rectangle]).map_err(|e| e.to_string())?;
    let truths: Vec<Truth> = frame.truths(view).into_iter().filter(|truth| truth.shape != Shape::Circle).collect();
    let off = |rim: &Rim, kind: Kind| {
        let of_kind = truths.iter().filter(move |truth| truth.kind == kind);
        of_kind.map(|truth| off(rim, truth, view)).fold(f64::INFINITY, f64::min)
    };
    let judged = rims.iter().filter_map(|rim| {
        let off_plate = off(rim, Kind::Plate);
        let is_clear = !(RIGHT..WRONG).contains(&off_plate);
        is_clear.then_some(Judged {
            confidence: rim.confidence,
            features: rim.square?.features(),
            is_right: off_plate < RIGHT,
        })
    });
    let rims_judged = judged.collect();
    let plates = truths.iter().filter(|truth| truth.kind == Kind::Plate && truth.rim_in_picture > 0.999);
    let cases = plates.map(|truth| {
        let best = rims.iter().find(|rim| off(rim, Kind::Plate) < RIGHT && rim.confidence >= tables::LEAST_CONFIDENCE);
        Case { pitch_deg: frame.head.pitch_deg, errors: best.and_then(|rim| errors(rim, truth, view)) }
    });
    Ok(Report { name: name.to_owned(), cases: cases.collect(), rims: rims_judged, is_bare: truths.is_empty() })
}

/// Width and length of a rectangle in mm, on a plane, and its middle there.
fn on_level(rim: &Rim, view: &View, z_mm: f64) -> Option<([f64; 2], Point2<f64>)> {
    let corners: Vec<Point2<f64>> = rim.points_px.iter().filter_map(|p| view.on_plane(*p, z_mm).ok()).collect();
    let &[a, b, c, d] = corners.as_slice() else { return None };
    let sides = [0.5 * ((b - a).norm() + (d - c).norm()), 0.5 * ((c - b).norm() + (a - d).norm())];
    Some(([sides[0].min(sides[1]), sides[0].max(sides[1])], nalgebra::center(&a, &c)))
}

/// The largest share by which a rectangle is off a container's: of its sides, and its middle.
fn off(rim: &Rim, truth: &Truth, view: &View) -> f64 {
    let (Some(([width, length], middle)), Some(wide)) = (on_level(rim, view, truth.rim_level_mm), truth.true_width_mm)
    else {
        return f64::INFINITY;
    };
    let long = truth.true_length_mm.unwrap_or(wide);
    let apart = (middle - Point2::new(truth.center_x_mm, truth.center_y_mm)).norm() / long;
    (width / wide - 1.0).abs().max((length / long - 1.0).abs()).max(apart)
}

/// Errors of width and length as shares: with the level of the rim given, and with nothing given; and those in standard
/// uncertainties.
fn errors(rim: &Rim, truth: &Truth, view: &View) -> Option<[tables::SizeError; 2]> {
    let truth_mm = [truth.true_width_mm?, truth.true_length_mm.or(truth.true_width_mm)?];
    let sizes = |rim_height_mm: Option<f64>| {
        let container = Container { kind: Kind::Plate, shape: Shape::Rectangle, rim_height_mm, wall: None };
        rim.sizes(view, Method::Ray, &container, &InputSigma::NONE)
    };
    let (given, alone) = (sizes(Some(truth.rim_level_mm)), sizes(None));
    let error = |quantity: Quantity, truth_mm: f64| {
        let of = |sizes: &[(Quantity, Result<model::Estimate, model::MeasureError>)]| {
            let size = sizes.iter().find(|(other, _)| *other == quantity)?.1.as_ref().ok()?;
            Some((size.measured.predicted_mm, size.sigma.total_mm))
        };
        let ((given_mm, _), (alone_mm, sigma_mm)) = (of(&given)?, of(&alone)?);
        Some(tables::SizeError {
            given: given_mm / truth_mm - 1.0,
            alone: alone_mm / truth_mm - 1.0,
            sigmas: (alone_mm - truth_mm) / sigma_mm,
        })
    };
    Some([error(Quantity::Width, truth_mm[0])?, error(Quantity::Length, truth_mm[1])?])
}
