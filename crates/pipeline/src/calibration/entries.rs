//! The entries of calibration.toml.

use model::calibrate::empirical::{Empirical, Row};
use model::calibrate::held_out::HeldOut;
use model::calibrate::physical::{Correction, Physical, prior_sd};
use model::calibrate::protractor::Protractor;
use model::{InputSigma, Kind, LEARNED, Source};
use nalgebra::Matrix4;
use serde::{Deserialize, Serialize};

use crate::signals::RangeCone;

/// The errors of the sizes that were left out of a fit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeldOutEntry {
    /// The number of sizes.
    pub n: usize,
    /// The number of objects or setups that were left out in turn.
    pub folds: usize,
    /// The root mean square error without the correction, in per cent.
    pub before_rmse_pct: f64,
    /// The root mean square error with the correction, in per cent; missing where a fold left too little to fit.
    #[serde(default)]
    pub after_rmse_pct: Option<f64>,
}

impl From<HeldOut> for HeldOutEntry {
    fn from(h: HeldOut) -> Self {
        Self { n: h.n, folds: h.folds, before_rmse_pct: h.before_rmse_pct, after_rmse_pct: h.after_rmse_pct }
    }
}

impl HeldOutEntry {
    /// Whether the errors are smaller with the correction than without.
    #[must_use]
    pub fn is_better(&self) -> bool {
        self.after_rmse_pct.is_some_and(|after| after < self.before_rmse_pct)
    }
}

/// A parameter that the data do not determine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RefusedEntry {
    /// The source of error that the parameter corrects.
    pub source: Source,
    /// The SD from the data alone, where they say anything; in rad, mm or as a share.
    #[serde(default)]
    pub sd: Option<f64>,
    /// The SD that was known beforehand.
    pub prior_sd: f64,
}

/// `[physical]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PhysicalEntry {
    /// The angle that is added to the camera's angle on the device.
    pub mount_deg: f64,
    /// Its SD.
    pub mount_sd_deg: f64,
    /// The scale of the range: true range = reading (1 + this / 100) + `range_offset_mm`.
    pub range_scale_pct: f64,
    /// Its SD.
    pub range_scale_sd_pct: f64,
    /// The offset of the range; see `range_scale_pct`.
    pub range_offset_mm: f64,
    /// Its SD.
    pub range_offset_sd_mm: f64,
    /// The scale of the focal length: true focal length = the camera's (1 + this / 100).
    pub focal_pct: f64,
    /// Its SD.
    pub focal_sd_pct: f64,
    /// Whether the range is corrected for the sensor's cone before.
    pub range_cone: RangeCone,
    /// The parameters that the data determine.
    pub determined: Vec<Source>,
    /// The error beyond what corrected sizes claim, in per cent, of setups that were left out. Its cause is not known, and
    /// the sizes of a session share it, so a run adds it to the range's uncertainty.
    #[serde(default)]
    pub unexplained_pct: f64,
    /// The covariance of mount (rad), range scale (share), range offset (mm) and focal length (share).
    pub covariance: [[f64; 4]; 4],
    /// The parameters that the data do not determine.
    #[serde(default)]
    pub refused: Vec<RefusedEntry>,
    /// The errors with each object left out in turn.
    pub without_object: HeldOutEntry,
    /// The errors with each setup left out in turn.
    pub without_setup: HeldOutEntry,
}

impl PhysicalEntry {
    /// The values in the units of the mathematics.
    #[must_use]
    pub fn correction(&self) -> Correction {
        Correction {
            mount_rad: self.mount_deg.to_radians(),
            range_scale: self.range_scale_pct / 100.0,
            range_offset_mm: self.range_offset_mm,
            focal_share: self.focal_pct / 100.0,
        }
    }

    /// The values in the units of the mathematics.
    #[must_use]
    pub fn covariance(&self) -> Matrix4<f64> {
        Matrix4::from_fn(|i, j| self.covariance[i][j])
    }
}

pub(crate) fn physical_entry(fitted: &Physical, range_cone: RangeCone, prior: &InputSigma) -> PhysicalEntry {
    let [mount, scale, offset, focal] = fitted.correction.values();
    let sd = |i: usize| fitted.covariance[(i, i)].sqrt();
    let refused = |(i, source): (usize, &Source)| RefusedEntry {
        source: *source,
        sd: fitted.sd[i],
        prior_sd: prior_sd(prior, *source),
    };
    let numbered = || LEARNED.iter().enumerate();
    PhysicalEntry {
        unexplained_pct: 0.0,
        mount_deg: mount.to_degrees(),
        mount_sd_deg: sd(0).to_degrees(),
        range_scale_pct: 100.0 * scale,
        range_scale_sd_pct: 100.0 * sd(1),
        range_offset_mm: offset,
        range_offset_sd_mm: sd(2),
        focal_pct: 100.0 * focal,
        focal_sd_pct: 100.0 * sd(3),
        range_cone,
        determined: numbered().filter(|(i, _)| fitted.determined[*i]).map(|(_, source)| *source).collect(),
        covariance: std::array::from_fn(|i| std::array::from_fn(|j| fitted.covariance[(i, j)])),
        refused: numbered().filter(|(i, _)| !fitted.determined[*i]).map(refused).collect(),
        without_object: fitted.without_object.into(),
        without_setup: fitted.without_setup.into(),
    }
}

/// `[[empirical]]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EmpiricalEntry {
    /// The kind of container.
    pub kind: Kind,
    /// Whether it is for heights; else for what is measured across the mouth.
    pub height: bool,
    /// The line is predicted = true (a + b tan(pitch)).
    pub a: f64,
    /// The slope of the line; see `a`.
    pub b: f64,
    /// The covariance of a and b.
    pub covariance: [[f64; 2]; 2],
    /// The robust SD of the factors about the line.
    pub scatter: f64,
    /// Whether setups that were left out are better with it than without. Only then it is used.
    pub used: bool,
    /// The errors with each object left out in turn.
    pub without_object: HeldOutEntry,
    /// The errors with each setup left out in turn.
    pub without_setup: HeldOutEntry,
    /// The rows that look like a slip of the decimal point: OBJECT in SESSION. They are kept as they are.
    #[serde(default)]
    pub slips: Vec<String>,
    /// The errors with each object left out in turn, with the slips mended.
    #[serde(default)]
    pub mended_without_object: Option<HeldOutEntry>,
    /// The errors with each setup left out in turn, with the slips mended.
    #[serde(default)]
    pub mended_without_setup: Option<HeldOutEntry>,
}

pub(crate) fn empirical_entry(
    kind: Kind,
    height: bool,
    rows: &[Row],
    fitted: &Empirical,
    mended: Option<&Empirical>,
) -> EmpiricalEntry {
    let c = &fitted.scale.covariance;
    EmpiricalEntry {
        kind,
        height,
        a: fitted.scale.a,
        b: fitted.scale.b,
        covariance: [[c[(0, 0)], c[(0, 1)]], [c[(1, 0)], c[(1, 1)]]],
        scatter: fitted.scale.scatter,
        used: HeldOutEntry::from(fitted.without_setup).is_better(),
        without_object: fitted.without_object.into(),
        without_setup: fitted.without_setup.into(),
        slips: fitted.slips.iter().map(|s| format!("{} in {}", rows[s.row].object, rows[s.row].setup)).collect(),
        mended_without_object: mended.map(|m| m.without_object.into()),
        mended_without_setup: mended.map(|m| m.without_setup.into()),
    }
}

/// `[protractor]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProtractorEntry {
    /// The number of images.
    pub n: usize,
    /// The slope of measured against declared pitch.
    pub slope: f64,
    /// The measured pitch at a declared pitch of zero.
    pub offset_deg: f64,
    /// The mean of measured minus declared pitch.
    pub mean_difference_deg: f64,
    /// The sample SD of these differences.
    pub sd_difference_deg: f64,
}

impl From<Protractor> for ProtractorEntry {
    fn from(p: Protractor) -> Self {
        Self {
            n: p.n,
            slope: p.slope,
            offset_deg: p.offset,
            mean_difference_deg: p.mean_difference,
            sd_difference_deg: p.sd_difference,
        }
    }
}
