//! Method joint: bowls that are seen in several images at different pitches. Height and wall slope are solved together, and
//! the mouth is measured on that plane.

use std::collections::BTreeMap;

use model::{
    Container, FrameReason, Fused, JointHeight, Kind, Level, Method, Part, Quantity, ResultRow, Shape, Share, Sights,
    SizeSigma, combined_sigma, estimate, fuse as fuse_shares, joint_height, sights,
};

use super::{Row, fused_row, with_sigma};
use crate::session::marked::Marked;
use crate::session::measurement::Measurement;
use crate::session::row::error_pct;

/// The rows of method joint, for every object and rater with height lines on two or more still images.
///
/// The images need different pitches, so those outside the target window count as well. Where they do not determine a
/// height, there is no row: the other methods stand.
pub(super) fn rows(marked: &[Marked<'_>], measurements: &[Measurement]) -> Vec<Row> {
    let mut bowls: BTreeMap<(&str, &str), Vec<&Marked<'_>>> = BTreeMap::new();
    for m in marked {
        let still = matches!(m.frame.signals.reason, FrameReason::Selected | FrameReason::PitchOutsideTarget);
        if still && m.object.container.kind == Kind::Bowl && m.object.container.shape == Shape::Circle {
            bowls.entry((&m.marks.object, m.rater)).or_default().push(m);
        }
    }
    bowls.values().filter_map(|pictures| of_bowl(pictures, measurements)).flatten().collect()
}

fn of_bowl(marked: &[&Marked<'_>], measurements: &[Measurement]) -> Option<Vec<Row>> {
    let seen: Vec<_> = marked
        .iter()
        .filter_map(|m| {
            let walls = sights(&m.view(Method::Joint)?, m.marks, &m.inputs).ok().filter(|walls| !walls.is_empty())?;
            Some((*m, Sights { walls, inputs: m.inputs, picture: m.number }))
        })
        .collect();
    let (pictures, sights): (Vec<&Marked<'_>>, Vec<_>) = seen.into_iter().unzip();
    let height = joint_height(&sights).ok()?;
    let templates: Vec<&ResultRow> = pictures.iter().filter_map(|m| template(m, measurements)).collect();
    let mut rows = vec![height_row(&templates, &height)?];
    rows.extend(diameter_row(&pictures, &templates, &height));
    Some(rows)
}

/// A row of the same image, object and rater, from which the fused row takes what all rows have in common.
fn template<'a>(marked: &Marked<'_>, measurements: &'a [Measurement]) -> Option<&'a ResultRow> {
    let same = |m: &&Measurement| {
        m.picture == marked.number
            && m.row.object == marked.marks.object
            && m.row.rater == marked.rater
            && m.row.quantity == Quantity::Height
    };
    measurements.iter().find(same).map(|m| &m.row)
}

fn height_row(templates: &[&ResultRow], height: &JointHeight) -> Option<Row> {
    let fused = Fused {
        value_mm: height.height_mm,
        sigma: height.sigma,
        spread_mm: None,
        weights: Vec::new(),
        outliers: Vec::new(),
        consistency: None,
    };
    let row = fused_row(templates, &fused, Level::Fused, &[])?;
    Some(finished(row, height, &fused.sigma, height.parts.clone()))
}

/// The row of the mouth on the plane that the images give together.
fn diameter_row(pictures: &[&Marked<'_>], templates: &[&ResultRow], height: &JointHeight) -> Option<Row> {
    let (mut shares, mut camera_heights_mm) = (Vec::new(), Vec::new());
    for m in pictures {
        let view = m.view(Method::Joint)?;
        let known = Container { rim_height_mm: Some(height.height_mm), ..m.object.container };
        let sizes = estimate(&view, Method::Ray, &known, m.marks, &m.inputs);
        let diameter = sizes.into_iter().find(|(quantity, _)| *quantity == Quantity::Diameter);
        let Some((_, Ok(diameter))) = diameter else { continue };
        let part = Part { sensitivity: diameter.sensitivity, inputs: m.inputs, picture: m.number };
        shares.push(Share::of_picture(diameter.measured.predicted_mm, part, 1.0));
        camera_heights_mm.push(view.pose().camera_height_mm());
    }
    let fused = fuse_shares(&shares)?;
    let parts = height.parts_on_plane(&shares, &fused.weights, &camera_heights_mm);
    let sigma = combined_sigma(&parts).with_disagreement(fused.sigma.disagreement_mm);
    let fused = Fused { sigma, consistency: None, ..fused };
    let row = fused_row(templates, &fused, Level::Fused, &[])?;
    let truth_mm = pictures.first()?.object.truth_mm.get(&Quantity::Diameter).copied();
    let row = ResultRow {
        quantity: Quantity::Diameter,
        plane_z_mm: Some(height.height_mm),
        truth_mm,
        error_pct: error_pct(Some(fused.value_mm), truth_mm),
        frames: u32::try_from(shares.len()).unwrap_or(u32::MAX),
        ..row
    };
    Some(finished(row, height, &fused.sigma, parts))
}

fn finished(row: ResultRow, height: &JointHeight, sigma: &SizeSigma, parts: Vec<Part>) -> Row {
    let row = ResultRow {
        method: Method::Joint,
        method_used: Some(Method::Joint),
        wall_slope: Some(height.overhang_mm / height.height_mm),
        flags: String::new(),
        ..row
    };
    Row {
        row: with_sigma(row, sigma),
        sigma: *sigma,
        doubts: Vec::new(),
        weights: Vec::new(),
        parts,
        shared: Vec::new(),
    }
}
