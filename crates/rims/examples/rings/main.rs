//! Cases for the set `ring` of weights.toml: pairs of edges about one centre on the rendered tables of `bench` and `worn`, and which
//! of the two is the outer edge of a rim (docs/rims-evaluation.md).
//!
//! ```text
//! AIM_BATCH_LAID_CSV=FILE cargo run -p aim-batch-rims --example rings -- SEED [BENCHES [WORN_SESSIONS [IMAGES [WIDTH]]]]
//! ```
//!
//! The arguments, and AIM_BATCH_LAID_PICTURES, are those of the example `laid`. A pair is a case where one of its edges lies along the
//! outer edge of a container's rim, and the other one does not.

#[path = "../laid/pictures.rs"]
mod pictures;

use std::error::Error;

use ingest::Picture;
use model::View;
use rayon::prelude::*;
use simulate::laid::{self, Frame, Truth};

use aim_batch_rims::{RingPair, ring_pairs};

/// An edge lies along the rim where their radii on the plane Z = 0 differ by less than this, in mm: about half a pixel of 720.
const ALONG_MM: f64 = 0.6;
/// The centres of an edge and a rim differ by less than this share of the radius.
const SAME_CENTER: f64 = 0.05;
/// A container is in view if so much of its rim is in the picture and seen.
const IN_VIEW: f64 = 0.6;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize, default: u64| arguments.get(at).map_or(Ok(default), |text| text.parse::<u64>());
    let (seed, benches, sessions, images) = (number(0, 1)?, number(1, 1)?, number(2, 4)?, number(3, 24)?);
    let width = u32::try_from(number(4, 720)?)?;
    let camera = laid::camera([width, width * 3 / 4])?;
    let bench: Vec<Frame> =
        (0..benches).flat_map(|at| laid::bench(seed * 1000 + at, width)).flat_map(|plan| plan.frames).collect();
    let worn = laid::worn(seed, width, usize::try_from(sessions)?, usize::try_from(images)?);
    let worn: Vec<Frame> = worn.into_iter().flat_map(|plan| plan.frames).collect();
    let mut csv = String::new();
    for (name, frames) in [("bench", bench), ("worn", worn)] {
        let examine = |(at, frame): (usize, &Frame)| {
            let view = frame.view(&camera).map_err(|e| e.to_string())?;
            examine(frame, &view, &format!("{name}-{width}-{seed}-{at:03}"))
        };
        csv.extend(frames.par_iter().enumerate().map(examine).collect::<Result<Vec<String>, String>>()?);
    }
    std::fs::write(std::env::var("AIM_BATCH_LAID_CSV").map_err(|_| "set AIM_BATCH_LAID_CSV to a file")?, csv)?;
    Ok(())
}

/// The cases of a picture: a line each.
fn examine(frame: &Frame, view: &View, name: &str) -> Result<String, String> {
    let jpeg = pictures::jpeg(frame, view, name)?;
    let picture = Picture::decode(&jpeg).map_err(|e| e.to_string())?;
    let pairs = ring_pairs(&picture, view).map_err(|e| e.to_string())?;
    let truths = frame.truths(view);
    let case = |pair: &RingPair| {
        let is_outer = truths.iter().find_map(|truth| outer_is_the_rim(pair, truth, view))?;
        let features: Vec<String> = pair.features.iter().map(|feature| format!("{feature:.5}")).collect();
        Some(format!("{name},0,{},{}\n", u8::from(is_outer), features.join(",")))
    };
    Ok(pairs.iter().filter_map(case).collect())
}

/// Whether the outer edge of a pair is the rim's; none where not exactly one of them is.
fn outer_is_the_rim(pair: &RingPair, truth: &Truth, view: &View) -> Option<bool> {
    let radius_mm = 0.5 * truth.true_diameter_mm.filter(|_| truth.rim_seen >= IN_VIEW)?;
    let shrink = 1.0 - truth.rim_level_mm / view.pose().camera_height_mm();
    let off_mm = |([x, y], radius): ([f64; 2], f64)| {
        let apart_mm = (x * shrink - truth.center_x_mm).hypot(y * shrink - truth.center_y_mm);
        (apart_mm < SAME_CENTER * radius_mm).then_some((radius * shrink - radius_mm).abs())
    };
    let (is_inner, is_outer) = (off_mm(pair.inner_mm)? < ALONG_MM, off_mm(pair.outer_mm)? < ALONG_MM);
    (is_inner != is_outer).then_some(is_outer)
}
