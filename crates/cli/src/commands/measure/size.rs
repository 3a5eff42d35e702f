//! A size, as JSON and as a line of text.

use std::fmt::Write as _;

use model::{Container, Doubt, Estimate, InputSigma, Kind, MeasureError, Method, Quantity, Shape};
use serde::Serialize;

/// A size as it stands in JSON, or the reason why there is none (`problem`).
#[derive(Serialize)]
pub struct Size {
    pub object: String,
    pub kind: Kind,
    pub shape: Shape,
    pub quantity: Quantity,
    pub method: Method,
    pub predicted_mm: Option<f64>,
    pub sigma_mm: Option<f64>,
    pub sigma_pitch_mm: Option<f64>,
    pub sigma_roll_mm: Option<f64>,
    pub sigma_range_mm: Option<f64>,
    pub sigma_marks_mm: Option<f64>,
    pub sigma_camera_mm: Option<f64>,
    pub sigma_mount_mm: Option<f64>,
    pub plane_z_mm: Option<f64>,
    pub wall_slope: Option<f64>,
    pub doubts: Vec<Doubt>,
    pub marks: usize,
    pub problem: Option<String>,
    /// The rim that was measured, where it was found and not marked.
    #[serde(flatten)]
    pub found: Option<Found>,
}

/// A found rim as it stands in JSON.
#[derive(Serialize, Clone)]
pub struct Found {
    pub confidence: f64,
    pub center_px: [f64; 2],
    pub rim_px: Vec<[f64; 2]>,
    /// The source of the height of the rim's plane: given, foot, floor or common.
    pub rim_height_from: &'static str,
}

/// The size of an object, as it is printed.
pub fn describe(
    object: &str,
    container: &Container,
    quantity: Quantity,
    method: Method,
    size: &Result<Estimate, MeasureError>,
) -> Size {
    let measured = size.as_ref().ok().map(|estimate| estimate.measured);
    let sigma = size.as_ref().ok().map(|estimate| estimate.sigma);
    Size {
        object: object.to_owned(),
        kind: container.kind,
        shape: container.shape,
        quantity,
        method,
        predicted_mm: measured.map(|m| m.predicted_mm),
        sigma_mm: sigma.map(|s| s.total_mm),
        sigma_pitch_mm: sigma.map(|s| s.pitch_mm),
        sigma_roll_mm: sigma.map(|s| s.roll_mm),
        sigma_range_mm: sigma.map(|s| s.range_mm),
        sigma_marks_mm: sigma.map(|s| s.marks_mm),
        sigma_camera_mm: sigma.map(|s| s.camera_mm),
        sigma_mount_mm: sigma.map(|s| s.mount_mm),
        plane_z_mm: measured.map(|m| m.plane_z_mm),
        wall_slope: size.as_ref().ok().and_then(|estimate| estimate.wall_slope),
        doubts: size.as_ref().map(|estimate| estimate.doubts.clone()).unwrap_or_default(),
        marks: measured.map_or(0, |m| m.marks),
        problem: size.as_ref().err().map(ToString::to_string),
        found: None,
    }
}

/// A table of the sizes as text, with the assumed uncertainties of the inputs below it.
pub fn text(sizes: &[Size], inputs: &InputSigma) -> String {
    let mut text = String::new();
    let sure = sizes.iter().any(|size| size.found.is_some());
    let width = sizes.iter().map(|size| size.object.chars().count()).max().unwrap_or(0).max("object".len());
    let head = if sure { "  confidence" } else { "" };
    let _ =
        writeln!(text, "{:width$}  quantity  method     size, mm   sigma, mm  on plane Z, mm{head}  doubts", "object");
    for size in sizes {
        let number = |value: Option<f64>, digits| value.map_or("-".to_owned(), |v| format!("{v:.digits$}"));
        let confidence = size.found.as_ref().map_or(String::new(), |found| format!("  {:>10.2}", found.confidence));
        let line = format!(
            "{:width$}  {:8}  {:7}  {:>10}  {:>10}  {:>14}{confidence}  {}",
            size.object,
            size.quantity,
            size.method,
            number(size.predicted_mm, 2),
            number(size.sigma_mm, 2),
            number(size.plane_z_mm, 1),
            size.doubts.iter().map(|doubt| doubt.code()).collect::<Vec<_>>().join(","),
        );
        let _ = writeln!(text, "{}", line.trim_end());
    }
    let _ = writeln!(
        text,
        "sigma: k = 1, for {:.1} degrees of pitch and sideways tilt, {:.1} of the mount, {:.1} % and {:.0} mm of range, {:.1} px of\n       marks, {:.1} % of focal length, {:.0} px of principal point (docs/uncertainty.md)",
        inputs.pitch_rad.to_degrees(),
        inputs.mount_rad.to_degrees(),
        100.0 * inputs.range_relative,
        inputs.range_offset_mm,
        inputs.mark_px,
        100.0 * inputs.focal_relative,
        inputs.principal_px,
    );
    text
}
