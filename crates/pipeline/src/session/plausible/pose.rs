//! Gravity, angles and ranges of a session that can hardly be.

use model::{FrameReason, ProblemCode, Severity, median};

use super::SetupDoubt;
use super::limits::{
    LEAST_IMAGES, MEDIAN_GRAVITY_G, MEDIAN_PITCH_DEG, MEDIAN_RANGE_MM, MOST_MEDIAN_ROLL_DEG, MOST_OFF_SETUP_DEG,
};
use crate::signals::FrameSignals;
use crate::study::SelectSpec;

/// The numbers of a session's images.
#[derive(Debug, Default)]
pub(super) struct Looked {
    pub gravity_g: Vec<f64>,
    pub pitch_deg: Vec<f64>,
    pub roll_deg: Vec<f64>,
    pub range_mm: Vec<f64>,
    /// The pitches of the images with a pose that could be selected: still, if not at the right pitch.
    pub still_pitch_deg: Vec<f64>,
    pub selected: usize,
}

impl Looked {
    /// The numbers of these images.
    pub fn new(signals: &[&FrameSignals]) -> Self {
        let angles = || signals.iter().filter_map(|one| one.pitch_roll_rad);
        let is_still =
            |one: &&&FrameSignals| matches!(one.reason, FrameReason::Selected | FrameReason::PitchOutsideTarget);
        let still = signals.iter().filter(is_still).filter_map(|one| one.pitch_roll_rad);
        Self {
            gravity_g: signals.iter().filter_map(|one| one.gravity_mg).map(|mg| mg / 1000.0).collect(),
            pitch_deg: angles().map(|(pitch, _)| pitch.to_degrees()).collect(),
            roll_deg: angles().map(|(_, roll)| roll.to_degrees()).collect(),
            range_mm: signals.iter().filter_map(|one| one.range_mm).collect(),
            still_pitch_deg: still.map(|(pitch, _)| pitch.to_degrees()).collect(),
            selected: signals.iter().filter(|one| one.reason == FrameReason::Selected).count(),
        }
    }
}

/// The doubts about a session. Where gravity cannot be, nothing is said of the angles that come of it.
pub(super) fn doubts(
    looked: &Looked,
    select: &SelectSpec,
    setup_pitch_deg: Option<f64>,
    mount_pitch_deg: f64,
) -> Vec<SetupDoubt> {
    let gravity = gravity(looked);
    let angles = match gravity {
        Some(_) => Vec::new(),
        None => angles(looked, select, setup_pitch_deg, mount_pitch_deg),
    };
    gravity.into_iter().chain(angles).chain(range(looked)).collect()
}

/// The median of a session's images; none where there are too few.
fn median_of(values: &[f64]) -> Option<f64> {
    (values.len() >= LEAST_IMAGES).then(|| median(values.to_vec()))
}

fn gravity(looked: &Looked) -> Option<SetupDoubt> {
    let median_g = median_of(&looked.gravity_g).filter(|g| !MEDIAN_GRAVITY_G.contains(g))?;
    let cause = match median_g {
        g if (8.5..=11.0).contains(&g) => {
            "the accelerometer's unit is m/s^2: set g_per_count to 0.101972 times what it is"
        }
        g if g < 1e-6 => "the accelerometer gives nothing but zeros: it was switched off or is broken",
        g if (0.0007..=0.0014).contains(&g) => "g_per_count is 1000 times too small: the unit is g, not mg",
        g if (0.07..=0.14).contains(&g) => "g_per_count is 10 times too small: the unit is g, not m/s^2",
        _ => "correct g_per_count and zero_g_counts in the device profile: the sensor's range may be another one",
    };
    Some(SetupDoubt {
        severity: Severity::Loss,
        code: ProblemCode::ImplausibleGravity,
        fact: format!(
            "gravity has a median length of {median_g:.4} g over {} images; expected 1 g",
            looked.gravity_g.len()
        ),
        cause: cause.to_owned(),
    })
}

fn range(looked: &Looked) -> Option<SetupDoubt> {
    let median_mm = median_of(&looked.range_mm).filter(|mm| !MEDIAN_RANGE_MM.contains(mm))?;
    let (least, most) = (MEDIAN_RANGE_MM.start(), MEDIAN_RANGE_MM.end());
    let cause = if median_mm < *least {
        "the range sensor's unit is cm, not mm: set mm_per_count to 10 times what it is; otherwise something hangs before the sensor"
    } else {
        "the range sensor's unit is smaller than declared, or it does not look at the table: correct mm_per_count"
    };
    Some(SetupDoubt {
        severity: Severity::Loss,
        code: ProblemCode::ImplausibleRange,
        fact: format!(
            "the median range is {median_mm:.0} mm over {} images; expected {least:.0} to {most:.0} mm from a face to a table",
            looked.range_mm.len()
        ),
        cause: cause.to_owned(),
    })
}

fn angles(looked: &Looked, select: &SelectSpec, setup_pitch_deg: Option<f64>, mount_pitch_deg: f64) -> Vec<SetupDoubt> {
    let (Some(pitch_deg), Some(roll_deg)) = (median_of(&looked.pitch_deg), median_of(&looked.roll_deg)) else {
        return Vec::new();
    };
    let images = looked.pitch_deg.len();
    let doubt = |code, fact: String, cause| vec![SetupDoubt { severity: Severity::Loss, code, fact, cause }];
    if roll_deg.abs() > MOST_MEDIAN_ROLL_DEG {
        let fact =
            format!("the median roll is {roll_deg:.0} degrees over {images} images; no wearer holds the head so");
        return doubt(ProblemCode::ImplausiblePose, fact, cause_of_roll(roll_deg));
    }
    let cause = cause_of_pitch(looked, select, setup_pitch_deg, mount_pitch_deg);
    if let Some(setup_deg) = setup_pitch_deg.filter(|setup_deg| (setup_deg - pitch_deg).abs() > MOST_OFF_SETUP_DEG) {
        let fact =
            format!("the median pitch is {pitch_deg:.0} degrees over {images} images; session.toml says {setup_deg}");
        return doubt(ProblemCode::ImplausiblePose, fact, cause);
    }
    if !MEDIAN_PITCH_DEG.contains(&pitch_deg) {
        let (least, most) = (MEDIAN_PITCH_DEG.start(), MEDIAN_PITCH_DEG.end());
        let fact = format!(
            "the median pitch is {pitch_deg:.0} degrees over {images} images; expected {least:.0} to {most:.0} for a wearer at a table"
        );
        return doubt(ProblemCode::ImplausiblePose, fact, cause);
    }
    if looked.selected > 0 || setup_pitch_deg.is_some() || looked.still_pitch_deg.len() < LEAST_IMAGES {
        return Vec::new();
    }
    let still_deg = median(looked.still_pitch_deg.clone());
    let fact = format!(
        "none of {} still images with a pose is selected: their median pitch is {still_deg:.0} degrees, and [select] takes {} +- {}",
        looked.still_pitch_deg.len(),
        select.target_pitch_deg,
        select.pitch_tolerance_deg
    );
    // Who sets the window knows that some sessions may lie outside of it.
    let severity = if is_usual_window(select) { Severity::Loss } else { Severity::Note };
    vec![SetupDoubt { severity, code: ProblemCode::NoImageSelected, fact, cause }]
}

fn is_usual_window(select: &SelectSpec) -> bool {
    let usual = SelectSpec::default();
    let is_same = |a: f64, b: f64| (a - b).abs() < 1e-9;
    is_same(select.target_pitch_deg, usual.target_pitch_deg)
        && is_same(select.pitch_tolerance_deg, usual.pitch_tolerance_deg)
}

fn cause_of_roll(roll_deg: f64) -> String {
    if roll_deg.abs() > 135.0 {
        return "the down axis has the wrong sign, or the camera sits upside down: reverse right and down in axes"
            .to_owned();
    }
    "the axes right and down are swapped, or the camera sits on its side: correct axes of the device profile".to_owned()
}

/// The mistake by which most images would be selected, or a bench's pitch be right; a list where none would.
fn cause_of_pitch(looked: &Looked, select: &SelectSpec, setup_pitch_deg: Option<f64>, mount_pitch_deg: f64) -> String {
    let (target_deg, tolerance_deg) = match setup_pitch_deg {
        Some(setup_deg) => (setup_deg, MOST_OFF_SETUP_DEG / 2.0),
        None => (select.target_pitch_deg, select.pitch_tolerance_deg),
    };
    let good = |change: &dyn Fn(f64) -> f64| {
        looked.pitch_deg.iter().filter(|pitch_deg| (change(**pitch_deg) - target_deg).abs() <= tolerance_deg).count()
    };
    let images = looked.pitch_deg.len();
    let mount = good(&|pitch_deg| pitch_deg - 2.0 * mount_pitch_deg);
    let swapped = good(&|pitch_deg| 90.0 - (pitch_deg - mount_pitch_deg) + mount_pitch_deg);
    let up = good(&|pitch_deg| 2.0 * mount_pitch_deg - pitch_deg);
    if mount_pitch_deg != 0.0 && 2 * mount > images {
        let right = -mount_pitch_deg;
        return format!(
            "the mount offset has the wrong sign: with {right} instead of {mount_pitch_deg} degrees, {mount} of {images} images would fit"
        );
    }
    if 2 * swapped > images {
        return format!(
            "the axes down and forward are swapped in the device profile: otherwise {swapped} of {images} images would fit"
        );
    }
    if 2 * up > images {
        return format!(
            "the forward axis has the wrong sign in the device profile: otherwise {up} of {images} images would fit"
        );
    }
    "check the mount offset and its sign, the signs and order of axes in the device profile, and target_pitch_deg of [select]".to_owned()
}
