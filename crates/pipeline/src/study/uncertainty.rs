//! `[uncertainty]` of study.toml.

use model::InputSigma;
use serde::{Deserialize, Serialize};

/// `[uncertainty]`: standard uncertainties (k = 1); docs/uncertainty.md says where the defaults are from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct UncertaintySpec {
    /// The pitch of the device.
    pub pitch_deg: f64,
    /// The sideways tilt of the device; the roll is uncertain by this over cos(pitch).
    pub tilt_deg: f64,
    /// The angle of the camera on the device.
    pub mount_deg: f64,
    /// The scale of the range, in per cent.
    pub range_pct: f64,
    /// The offset of the range.
    pub range_offset_mm: f64,
    /// The focal length, in per cent.
    pub focal_pct: f64,
    /// Each coordinate of the principal point.
    pub principal_px: f64,
    /// The displacement by the lens at the corner of the picture.
    pub distortion_px: f64,
    /// The pitch and tilt of a still image about those of its session.
    pub turn_noise_deg: f64,
    /// The share of an image's RMS motion that is taken to reach its gravity.
    pub motion_share: f64,
    /// The range of an image about that of its session, besides what the readings' own scatter says.
    pub range_noise_mm: f64,
    /// One coordinate of a mark set by hand.
    pub mark_px: f64,
}

impl Default for UncertaintySpec {
    /// The values of [`InputSigma::default`] in this file's units.
    fn default() -> Self {
        Self {
            pitch_deg: 1.0,
            tilt_deg: 1.0,
            mount_deg: 0.5,
            range_pct: 3.0,
            range_offset_mm: 3.0,
            focal_pct: 0.5,
            principal_px: 5.0,
            distortion_px: 2.0,
            turn_noise_deg: 0.2,
            motion_share: 0.33, // a low-pass of 0.5 s over motion that keeps its direction for 0.2 s
            range_noise_mm: 2.0,
            mark_px: 2.0,
        }
    }
}

impl UncertaintySpec {
    /// The uncertainties in the units of the mathematics, for a still image whose range readings agree.
    #[must_use]
    pub fn inputs(&self) -> InputSigma {
        InputSigma {
            pitch_rad: self.pitch_deg.to_radians(),
            tilt_rad: self.tilt_deg.to_radians(),
            mount_rad: self.mount_deg.to_radians(),
            range_relative: self.range_pct / 100.0,
            range_offset_mm: self.range_offset_mm,
            focal_relative: self.focal_pct / 100.0,
            principal_px: self.principal_px,
            distortion_px: self.distortion_px,
            turn_noise_rad: self.turn_noise_deg.to_radians(),
            range_noise_mm: self.range_noise_mm,
            mark_px: self.mark_px,
            learned: None,
        }
    }

    /// The uncertainties for an image with this RMS motion and this standard error of its median range.
    #[must_use]
    pub fn inputs_of_image(&self, motion_mg: f64, range_error_mm: f64) -> InputSigma {
        let still = self.inputs();
        // A sideways acceleration of 1 g turns gravity by about a radian.
        let by_motion_rad = self.motion_share * motion_mg / 1000.0;
        InputSigma {
            turn_noise_rad: still.turn_noise_rad.hypot(by_motion_rad),
            range_noise_mm: still.range_noise_mm.hypot(range_error_mm),
            ..still
        }
    }

    /// Every key with its value, for checks that none is negative.
    pub(super) fn keys(&self) -> [(&'static str, f64); 12] {
        [
            ("uncertainty.pitch_deg", self.pitch_deg),
            ("uncertainty.tilt_deg", self.tilt_deg),
            ("uncertainty.mount_deg", self.mount_deg),
            ("uncertainty.range_pct", self.range_pct),
            ("uncertainty.range_offset_mm", self.range_offset_mm),
            ("uncertainty.focal_pct", self.focal_pct),
            ("uncertainty.principal_px", self.principal_px),
            ("uncertainty.distortion_px", self.distortion_px),
            ("uncertainty.turn_noise_deg", self.turn_noise_deg),
            ("uncertainty.motion_share", self.motion_share),
            ("uncertainty.range_noise_mm", self.range_noise_mm),
            ("uncertainty.mark_px", self.mark_px),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_the_models() {
        assert_eq!(UncertaintySpec::default().inputs(), InputSigma::default());
    }

    #[test]
    fn motion_and_unsteady_range_make_an_image_less_sure() {
        let spec = UncertaintySpec::default();
        let (still, moving) = (spec.inputs_of_image(0.0, 0.0), spec.inputs_of_image(50.0, 6.0));
        assert_eq!(still, spec.inputs());
        assert!((moving.turn_noise_rad - 0.2_f64.to_radians().hypot(0.33 * 0.05)).abs() < 1e-12);
        assert!((moving.range_noise_mm - 2.0_f64.hypot(6.0)).abs() < 1e-12);
    }
}
