//! What the uncertainty of the inputs does to a size: first-order propagation by analytic derivatives.

use nalgebra::{Matrix4, Vector3};

use crate::container::{Container, Method, Quantity};
use crate::doubt::{Doubt, assumes_vertical_wall, wall_doubt, wall_slope};
use crate::marks::ObjectMarks;
use crate::measure::{MeasureError, Measured, Sized, sizes, view_of_method};
use crate::source::{PerSource, Source, SourceCovariance};
use crate::view::View;

/// Standard uncertainties (k = 1) of what goes into a size (docs/uncertainty.md). But for [`Self::learned`] the errors are
/// taken as independent of each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InputSigma {
    /// Pitch of the device: what its accelerometer's zero-g offset does to all pictures of a session alike.
    pub pitch_rad: f64,
    /// Sideways tilt of the device, likewise. Turning about the optical axis moves 'down' by only cos(pitch) per
    /// radian, so the roll is uncertain by this over cos(pitch).
    pub tilt_rad: f64,
    /// Angle of the camera on the device.
    pub mount_rad: f64,
    /// Scale of the range, relative.
    pub range_relative: f64,
    /// Offset of the range.
    pub range_offset_mm: f64,
    /// Focal length, relative; both axes together.
    pub focal_relative: f64,
    /// Each coordinate of the principal point.
    pub principal_px: f64,
    /// The lens at the corner of the picture.
    pub distortion_px: f64,
    /// Pitch and tilt of one picture, about those of its session: what motion leaves in gravity.
    pub turn_noise_rad: f64,
    /// Range of one picture, about that of its session: what noise leaves in the median.
    pub range_noise_mm: f64,
    /// One coordinate of one marked point.
    pub mark_px: f64,
    /// Covariance of [`LEARNED`] sources from a calibration, in place of their uncertainties above.
    pub learned: Option<Matrix4<f64>>,
}

impl Default for InputSigma {
    /// What `[uncertainty]` of a study has when it says nothing; docs/uncertainty.md tells where each number is from.
    fn default() -> Self {
        Self {
            pitch_rad: 1.0_f64.to_radians(), // 17 mg; ADXL362 data sheet: zero-g offset of tens of mg
            tilt_rad: 1.0_f64.to_radians(),  // likewise
            mount_rad: 0.5_f64.to_radians(), // assembly of housing and glasses
            range_relative: 0.03,            // VL53L0X: about 3 % uncalibrated
            range_offset_mm: 3.0,            // VL53L0X: what is left of the offset behind a cover
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

/// The sources that a bench with known sizes can teach about, in the order of [`InputSigma::learned`].
pub const LEARNED: [Source; 4] = [Source::Mount, Source::RangeScale, Source::RangeOffset, Source::Focal];

impl InputSigma {
    /// No uncertainty at all: to start from, in tests and where only some sources matter.
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

    /// Standard uncertainty of one source, without what a calibration says.
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

    /// Covariance of what all pictures of a session share.
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

    /// Variances of what a picture has of its own, by pitch, tilt and range offset.
    #[must_use]
    pub fn noise(&self) -> Vector3<f64> {
        Vector3::new(self.turn_noise_rad, self.turn_noise_rad, self.range_noise_mm).map(|s| s * s)
    }
}

/// Sources whose noise a picture has of its own, in the order of [`InputSigma::noise`].
pub(crate) const NOISY: [Source; 3] = [Source::Pitch, Source::Tilt, Source::RangeOffset];

/// What a size changes by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensitivity {
    /// Derivatives by the sources.
    pub by_source: PerSource,
    /// SD per pixel of SD of each marked coordinate.
    pub marks_mm_per_px: f64,
}

impl Sensitivity {
    /// Its derivatives by what [`InputSigma::noise`] is about.
    #[must_use]
    pub fn by_noise(&self) -> Vector3<f64> {
        Vector3::from(NOISY.map(|source| self.by_source[source.index()]))
    }

    /// What these inputs make of it.
    #[must_use]
    pub fn sigma(&self, inputs: &InputSigma) -> SizeSigma {
        SizeSigma::of_parts(
            &self.by_source,
            &inputs.common(),
            self.by_noise().map(|d| d * d).component_mul(&inputs.noise()),
            self.marks_mm_per_px * inputs.mark_px,
        )
    }
}

/// Standard uncertainty of a size, by source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SizeSigma {
    /// All of it.
    pub total_mm: f64,
    /// What does not shrink with the number of pictures: the part from what a session's pictures share.
    pub common_mm: f64,
    /// From the pitch of the device.
    pub pitch_mm: f64,
    /// From its roll; for [`Method::Paper`] about its assumption of zero roll.
    pub roll_mm: f64,
    /// From the angle of the camera on the device.
    pub mount_mm: f64,
    /// From the range.
    pub range_mm: f64,
    /// From the marks.
    pub marks_mm: f64,
    /// From focal length, principal point and lens.
    pub camera_mm: f64,
}

impl SizeSigma {
    /// With another part from the marks, which is independent of the others.
    #[must_use]
    pub fn with_marks(self, marks_mm: f64) -> Self {
        let others = (self.total_mm.powi(2) - self.marks_mm.powi(2)).max(0.0);
        Self { marks_mm, total_mm: (others + marks_mm.powi(2)).sqrt(), ..self }
    }

    /// From derivatives by the sources, their covariance, the variances that noise of pitch, tilt and range gives, and the
    /// marks' part. With a learned covariance the parts are correlated, and the total is not their sum in quadrature.
    pub(crate) fn of_parts(
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
        }
    }
}

/// A size with its uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// The method behind it.
    pub method: Method,
    /// The size.
    pub measured: Measured,
    /// What it changes by.
    pub sensitivity: Sensitivity,
    /// Its uncertainty.
    pub sigma: SizeSigma,
    /// Radius of a round rim less that of its base, per height, where the method tells it.
    pub wall_slope: Option<f64>,
    /// Which of the method's assumptions may not hold; without any, the uncertainty is claimed to be all there is.
    pub doubts: Vec<Doubt>,
}

/// [`measure`](crate::measure()) with uncertainties: by the derivatives of every step, so that a rim plane's own uncertainty
/// reaches the diameter measured on it, with all correlations through the common pose and the common marks.
#[must_use]
pub fn estimate(
    view: &View,
    method: Method,
    container: &Container,
    marks: &ObjectMarks,
    inputs: &InputSigma,
) -> Vec<(Quantity, Result<Estimate, MeasureError>)> {
    let found = sizes(&view_of_method(view, method), method, container, marks);
    let exact = if method == Method::Paper { sizes(view, Method::Ray, container, marks) } else { Vec::new() };
    let slope = assumes_vertical_wall(method).then(|| wall_slope(view, container, marks)).flatten();
    let estimated = |size: Sized| {
        let sensitivity = Sensitivity { by_source: size.number.by_source, marks_mm_per_px: size.number.by_mark.norm() };
        let sigma = sensitivity.sigma(inputs);
        let quantity = size.measured.quantity;
        let mut doubts = Vec::new();
        let differs = |exact_mm: f64| (exact_mm - size.measured.predicted_mm).abs() > NEGLIGIBLE * sigma.total_mm;
        if method == Method::Paper && size_mm(&exact, quantity).is_none_or(differs) {
            doubts.push(Doubt::PaperApproximation);
        }
        doubts.extend(wall_doubt(method, container, quantity, slope));
        Estimate { method, measured: size.measured, sensitivity, sigma, wall_slope: size.wall_slope, doubts }
    };
    found.into_iter().map(|(quantity, size)| (quantity, size.map(estimated))).collect()
}

/// A bias of this share of the standard uncertainty lowers the coverage of a 95 % interval by 1 percentage point.
const NEGLIGIBLE: f64 = 0.3;
fn size_mm(sizes: &[(Quantity, Result<Sized, MeasureError>)], wanted: Quantity) -> Option<f64> {
    let (_, size) = sizes.iter().find(|(quantity, _)| *quantity == wanted)?;
    Some(size.as_ref().ok()?.measured.predicted_mm)
}

/// The estimate for `method = "best"`: of those without doubts the one with the smallest uncertainty; where all have
/// doubts, the one with the fewest, and of those the smallest uncertainty. None of none.
#[must_use]
pub fn best_of<'a>(estimates: impl IntoIterator<Item = &'a Estimate>) -> Option<&'a Estimate> {
    estimates
        .into_iter()
        .min_by(|a, b| a.doubts.len().cmp(&b.doubts.len()).then(a.sigma.total_mm.total_cmp(&b.sigma.total_mm)))
}
