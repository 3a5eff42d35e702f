//! One line of JSON per round container of a picture, for looking at what went wrong.

use model::{Kind, View};
use nalgebra::{Point2, Point3};
use serde_json::{Value, json};
use simulate::laid::Truth;

use aim_batch_rims::{Rim, fitted_sets};

use crate::{Case, Report};

/// Places of a circle that is to be drawn.
const PLACES: u32 = 180;

/// The drawing of a container: the true circle in the picture, and the points that were found along it.
pub struct Drawing {
    true_px: Vec<[f64; 2]>,
    /// Centre (world X, Y) and radius of the circle that the rim appears as on the plane Z = 0, in mm.
    true_on_table_mm: ([f64; 2], f64),
    found: Option<Value>,
}

impl Drawing {
    pub fn new(rim: Option<&Rim>, truth: &Truth, view: &View) -> Self {
        let radius = 0.5 * truth.true_diameter_mm.unwrap_or(0.0);
        let circle =
            (0..PLACES).map(|i| f64::from(i) / f64::from(PLACES) * std::f64::consts::TAU).filter_map(|angle| {
                let (x, y) = (truth.center_x_mm + radius * angle.cos(), truth.center_y_mm + radius * angle.sin());
                view.pixel_of(Point3::new(x, y, truth.rim_level_mm)).ok()
            });
        let pair = |p: &Point2<f64>| [(10.0 * p.x).round() / 10.0, (10.0 * p.y).round() / 10.0];
        let found = rim.map(|rim| {
            json!({
                "points_px": rim.points_px.iter().map(pair).collect::<Vec<_>>(),
                "confidence": rim.confidence,
                "is_plate": rim.kind == Kind::Plate,
                "height": rim.height,
                "plate_height": rim.plate_height,
                "on_table_mm": rim.on_table_mm,
            })
        });
        let shrink = 1.0 - truth.rim_level_mm / view.pose().camera_height_mm();
        Self {
            true_px: circle.map(|p| pair(&p)).collect(),
            true_on_table_mm: ([truth.center_x_mm / shrink, truth.center_y_mm / shrink], radius / shrink),
            found,
        }
    }
}

/// The lines of a picture.
pub fn lines(report: &Report) -> impl Iterator<Item = String> {
    report.cases.iter().filter(|case| case.in_view).map(|case| format!("{}\n", line(case, &report.name)))
}

/// A line per container that was found: picture, 0, whether it is a plate, and the logarithm of the odds that it is, as large as it
/// was before the weight of the set `kind` of weights.toml.
pub fn kinds(report: &Report) -> impl Iterator<Item = String> {
    let too_sure = fitted_sets()["kind"].weights[0];
    let line = move |case: &Case| {
        let is_plate = u8::from(case.kind == Kind::Plate);
        Some(format!("{},0,{is_plate},{:.5}\n", report.name, case.found?.plate_log_odds * too_sure))
    };
    report.cases.iter().filter(|case| case.in_view).filter_map(line)
}

fn line(case: &Case, picture: &str) -> Value {
    json!({
        "picture": picture,
        "object": &*case.object,
        "is_plate": case.kind == Kind::Plate,
        "pitch_deg": case.pitch_deg,
        "shows_foot": case.shows_foot,
        "rim_level_mm": case.rim_level_mm,
        "diameter_error": case.found.map(|found| found.diameter),
        "diameter_error_alone": case.found.map(|found| found.diameter_alone),
        "height_error": case.found.map(|found| found.height),
        "height_sigmas": case.found.map(|found| found.height_sigmas),
        "true_px": case.drawing.true_px,
        "true_on_table_mm": case.drawing.true_on_table_mm,
        "found": case.drawing.found,
    })
}
