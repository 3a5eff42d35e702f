//! calibration.toml, read, checked and written.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::entries::{EmpiricalEntry, PhysicalEntry, ProtractorEntry};

/// The version of calibration.toml that this program writes and reads.
pub const CALIBRATION_SCHEMA_VERSION: u32 = 1;

/// calibration.toml (docs/calibration.md). Unknown keys are refused.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CalibrationFile {
    /// The version of this layout: 1.
    pub schema_version: u32,
    /// The program that wrote it, and its version.
    pub program: String,
    /// The study that it was learned from.
    pub study: String,
    /// Notes: what could not be determined, and what else to know.
    #[serde(default)]
    pub notes: Vec<String>,
    /// The corrections of readings, for every method but `paper`.
    #[serde(default)]
    pub physical: Option<PhysicalEntry>,
    /// The declared angles against the measured ones.
    #[serde(default)]
    pub protractor: Option<ProtractorEntry>,
    /// The factors on the sizes of method `paper`.
    #[serde(default)]
    pub empirical: Vec<EmpiricalEntry>,
}

/// The reason why a calibration.toml is refused.
#[derive(Debug, thiserror::Error)]
pub enum CalibrationFileError {
    /// It cannot be read, or is not such a file.
    #[error(transparent)]
    Config(#[from] ingest::ConfigError),
    /// It cannot be written as TOML.
    #[error("cannot write the calibration: {0}")]
    Toml(#[from] toml::ser::Error),
    /// It has a version that this program does not read.
    #[error("calibration.toml: schema_version = {0}: this program reads version {CALIBRATION_SCHEMA_VERSION}")]
    Version(u32),
    /// A number is not finite, or a correction is beyond all sense.
    #[error(
        "calibration.toml: {0}: expected finite numbers, a mount within 20 degrees, scales within 50 % and variances above 0"
    )]
    Number(&'static str),
}

impl CalibrationFile {
    pub(crate) fn empty(program: &str, study: &str) -> Self {
        Self {
            schema_version: CALIBRATION_SCHEMA_VERSION,
            program: program.to_owned(),
            study: study.to_owned(),
            notes: Vec::new(),
            physical: None,
            protractor: None,
            empirical: Vec::new(),
        }
    }

    /// The calibration in a file, checked.
    ///
    /// # Errors
    /// [`CalibrationFileError`].
    pub fn read(path: &Path) -> Result<Self, CalibrationFileError> {
        let file: Self = ingest::config::read_toml(path)?;
        file.check()?;
        Ok(file)
    }

    /// The text of the file.
    ///
    /// # Errors
    /// [`CalibrationFileError::Toml`].
    pub fn to_toml(&self) -> Result<String, CalibrationFileError> {
        Ok(toml::to_string(self)?)
    }

    fn check(&self) -> Result<(), CalibrationFileError> {
        if self.schema_version != CALIBRATION_SCHEMA_VERSION {
            return Err(CalibrationFileError::Version(self.schema_version));
        }
        if let Some(p) = &self.physical {
            let sane = p.mount_deg.abs() <= 20.0
                && p.range_scale_pct.abs() <= 50.0
                && p.focal_pct.abs() <= 50.0
                && p.range_offset_mm.is_finite()
                && (0.0..=100.0).contains(&p.unexplained_pct)
                && p.covariance.iter().flatten().all(|c| c.is_finite())
                && (0..4).all(|i| p.covariance[i][i] >= 0.0);
            if !sane {
                return Err(CalibrationFileError::Number("physical"));
            }
        }
        let finite = |e: &EmpiricalEntry| e.a.is_finite() && e.b.is_finite();
        if self.empirical.iter().all(finite) { Ok(()) } else { Err(CalibrationFileError::Number("empirical")) }
    }
}
