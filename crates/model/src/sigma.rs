//! The uncertainties of inputs, the derivatives of a size by them, and the uncertainty of the size that follows.

use nalgebra::{Matrix4, Vector3};

use crate::source::{PerSource, Source, SourceCovariance};

/// Standard uncertainties (k = 1) of the inputs of a size (docs/uncertainty.md). Except for [`Self::learned`] the errors are
/// taken as independent of each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InputSigma {
    /// Pitch of the device: the effect of its accelerometer's zero-g offset, the same for all pictures of a session.
    pub pitch_rad: f64,
    /// Sideways tilt of the device, likewise. A turn about the optical axis moves 'down' by only cos(pitch) per radian, so the
    /// uncertainty of the roll is this over cos(pitch).
    pub tilt_rad: f64,
    /// Angle of the camera on the device.
    pub mount_rad: f64,
    /// Scale of the range, as a share of the range.
    pub range_relative: f64,
    /// Offset of the range.
    pub range_offset_mm: f64,
    /// Focal length, as a share of it, of both axes together.
    pub focal_relative: f64,
    /// Each coordinate of the principal point.
    pub principal_px: f64,
    /// Displacement by the lens at the corner of the picture.
    pub distortion_px: f64,
    /// Pitch and tilt of one picture about those of its session, from the motion that remains in the estimate of gravity.
    pub turn_noise_rad: f64,
    /// Range of one picture about that of its session, from the noise that remains in the median of the readings.
    pub range_noise_mm: f64,
    /// Each coordinate of one marked point.
    pub mark_px: f64,
    /// Covariance of the [`LEARNED`] sources from a calibration, which replaces their uncertainties above.
    pub learned: Option<Matrix4<f64>>,
}

impl Default for InputSigma {
    /// The uncertainties of a study that states none in `[uncertainty]`. docs/uncertainty.md gives the origin of each number.
    fn default() -> Self {
        Self {
            pitch_rad: 1.0_f64.to_radians(), // 17 mg; ADXL362 data sheet: zero-g offset of tens of mg
            tilt_rad: 1.0_f64.to_radians(),  // likewise
            mount_rad: 0.5_f64.to_radians(), // assembly of housing and glasses
            range_relative: 0.03,            // VL53L0X: about 3 % uncalibrated
            range_offset_mm: 3.0,            // VL53L0X: the rest of the offset behind a cover
            focal_relative: 0.005,           // scatter of board calibrations
            principal_px: 5.0,               // likewise
            distortion_px: 2.0,              // residual of a one-parameter lens model at the corner
            turn_noise_rad: 0.2_f64.to_radians(), // sway of a head at rest
            range_noise_mm: 2.0,             // VL53L0X: drift between moments, beyond the readings' scatter
            mark_px: 2.0,                    // repeated clicks on one edge
            learned: None,
        }
    }
}

/// The sources that can be calibrated on a bench with known sizes, in the order of [`InputSigma::learned`].
pub const LEARNED: [Source; 4] = [Source::Mount, Source::RangeScale, Source::RangeOffset, Source::Focal];

impl InputSigma {
    /// No uncertainty at all, to start from in tests and where only some sources matter.
    pub const NONE: Self = Self {
        pitch_rad: 0.0,
        tilt_rad: 0.0,
        mount_rad: 0.0,
        range_relative: 0.0,
        range_offset_mm: 0.0,
        focal_relative: 0.0,
        principal_px: 0.0,
        distortion_px: 0.0,
        turn_noise_rad: 0.0,
        range_noise_mm: 0.0,
        mark_px: 0.0,
        learned: None,
    };

    /// The standard uncertainty of one source, in its own unit, without the covariance from a calibration.
    #[must_use]
    pub fn sigma_of(&self, source: Source) -> f64 {
        match source {
            Source::Pitch => self.pitch_rad,
            Source::Tilt => self.tilt_rad,
            Source::Mount => self.mount_rad,
            Source::RangeScale => self.range_relative,
            Source::RangeOffset => self.range_offset_mm,
            Source::Focal => self.focal_relative,
            Source::PrincipalX | Source::PrincipalY => self.principal_px,
            Source::Distortion => self.distortion_px,
        }
    }

    /// The covariance of the sources, which all pictures of a session share.
    #[must_use]
    pub fn common(&self) -> SourceCovariance {
        let mut covariance = SourceCovariance::zeros();
        for source in Source::ALL {
            covariance[(source.index(), source.index())] = self.sigma_of(*source).powi(2);
        }
        if let Some(learned) = &self.learned {
            for (i, a) in LEARNED.iter().enumerate() {
                for (j, b) in LEARNED.iter().enumerate() {
                    covariance[(a.index(), b.index())] = learned[(i, j)];
                }
            }
        }
        covariance
    }

    /// The variances of pitch, tilt and range that are one picture's own, in rad^2, rad^2 and mm^2.
    #[must_use]
    pub fn noise(&self) -> Vector3<f64> {
        Vector3::new(self.turn_noise_rad, self.turn_noise_rad, self.range_noise_mm).map(|s| s * s)
    }
}

/// The sources that have noise of their own in each picture, in the order of [`InputSigma::noise`].
pub(crate) const NOISY: [Source; 3] = [Source::Pitch, Source::Tilt, Source::RangeOffset];

/// The derivatives of a size by everything that it depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensitivity {
    /// Derivatives by the sources, in mm per the source's unit.
    pub by_source: PerSource,
    /// SD of the size per pixel of SD of each marked coordinate.
    pub marks_mm_per_px: f64,
}

impl Sensitivity {
    /// The derivatives of `factor` times the size.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self { by_source: self.by_source * factor, marks_mm_per_px: self.marks_mm_per_px * factor.abs() }
    }

    /// The derivatives by pitch, tilt and range offset, in the order of [`InputSigma::noise`].
    #[must_use]
    pub fn by_noise(&self) -> Vector3<f64> {
        Vector3::from(NOISY.map(|source| self.by_source[source.index()]))
    }

    /// The standard uncertainty of the size that follows from those of the inputs.
    #[must_use]
    pub fn sigma(&self, inputs: &InputSigma) -> SizeSigma {
        SizeSigma::from_parts(
            &self.by_source,
            &inputs.common(),
            self.by_noise().map(|d| d * d).component_mul(&inputs.noise()),
            self.marks_mm_per_px * inputs.mark_px,
        )
    }
}

/// The standard uncertainty of a size (k = 1), in total and by source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SizeSigma {
    /// The total.
    pub total_mm: f64,
    /// The part from errors that all pictures of a session share, which does not shrink with their number.
    pub common_mm: f64,
    /// The part from the pitch of the device.
    pub pitch_mm: f64,
    /// The part from its roll; for [`Method::Paper`] about the zero roll that it assumes.
    pub roll_mm: f64,
    /// The part from the angle of the camera on the device.
    pub mount_mm: f64,
    /// The part from the range.
    pub range_mm: f64,
    /// The part from the marks.
    pub marks_mm: f64,
    /// The part from focal length, principal point and lens.
    pub camera_mm: f64,
    /// The part from the disagreement of the sizes that were fused, beyond what the parts above allow; 0 for one picture.
    pub disagreement_mm: f64,
}

impl SizeSigma {
    /// This uncertainty with another part from the marks, which is independent of the other parts.
    #[must_use]
    pub fn with_marks(self, marks_mm: f64) -> Self {
        let others = (self.total_mm.powi(2) - self.marks_mm.powi(2)).max(0.0);
        Self { marks_mm, total_mm: (others + marks_mm.powi(2)).sqrt(), ..self }
    }

    /// This uncertainty with another part from disagreement, which is independent of the other parts.
    #[must_use]
    pub fn with_disagreement(self, disagreement_mm: f64) -> Self {
        let others = (self.total_mm.powi(2) - self.disagreement_mm.powi(2)).max(0.0);
        Self { disagreement_mm, total_mm: (others + disagreement_mm.powi(2)).sqrt(), ..self }
    }

    /// The total, in mm, for a size of `to_mm` instead of one of `from_mm`: the parts from pose, range and camera are in proportion
    /// to the size, those from marks and disagreement are not.
    #[must_use]
    pub fn total_at(&self, from_mm: f64, to_mm: f64) -> f64 {
        let fixed = self.marks_mm.powi(2) + self.disagreement_mm.powi(2);
        let proportional = (self.total_mm.powi(2) - fixed).max(0.0);
        (fixed + proportional * proportion(from_mm, to_mm).powi(2)).sqrt()
    }

    /// The uncertainty from the derivatives by the sources, the sources' covariance, the variances (in mm^2) from the noise of
    /// pitch, tilt and range, and the part from the marks. With a learned covariance the parts are correlated, and the total is
    /// not their sum in quadrature.
    pub(crate) fn from_parts(
        by_source: &PerSource,
        covariance: &SourceCovariance,
        noise: Vector3<f64>,
        marks_mm: f64,
    ) -> Self {
        let variance = |wanted: &[Source]| {
            let sum = |a: &Source| -> f64 {
                let term = |b: &Source| by_source[b.index()] * covariance[(a.index(), b.index())];
                by_source[a.index()] * wanted.iter().map(term).sum::<f64>()
            };
            wanted.iter().map(sum).sum::<f64>().max(0.0)
        };
        let common = variance(Source::ALL);
        Self {
            total_mm: (common + noise.sum() + marks_mm * marks_mm).sqrt(),
            common_mm: common.sqrt(),
            pitch_mm: (variance(&[Source::Pitch]) + noise.x).sqrt(),
            roll_mm: (variance(&[Source::Tilt]) + noise.y).sqrt(),
            mount_mm: variance(&[Source::Mount]).sqrt(),
            range_mm: (variance(&[Source::RangeScale, Source::RangeOffset]) + noise.z).sqrt(),
            marks_mm,
            camera_mm: variance(&[Source::Focal, Source::PrincipalX, Source::PrincipalY, Source::Distortion]).sqrt(),
            disagreement_mm: 0.0,
        }
    }
}

/// The factor by which an error that is proportional to the size grows from a size of `from_mm` to one of `to_mm`; 1 where the
/// sizes have no proportion.
pub(crate) fn proportion(from_mm: f64, to_mm: f64) -> f64 {
    let factor = to_mm / from_mm;
    if from_mm > 0.0 && to_mm > 0.0 && factor.is_finite() { factor } else { 1.0 }
}
