//! The pose of the camera: its pitch, its roll and its range to the table.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Matrix3, Vector3};

/// The pose of the camera above the table.
///
/// Yaw cannot be observed and is not needed: the world frame turns with the wearer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    pitch_rad: f64,
    roll_rad: f64,
    range_mm: f64,
}

/// The reason why numbers do not make a pose.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PoseError {
    /// The optical axis never meets the table.
    #[error(
        "pitch {pitch_deg} degrees: expected a depression above 0 and at most 90 degrees (at 0 or less the optical axis \
         never meets the table)"
    )]
    NotBelowHorizon {
        /// The pitch that was given.
        pitch_deg: f64,
    },
    /// The roll is outside [-180, 180] degrees.
    #[error("roll {roll_deg:.2} degrees: expected -180 to 180")]
    Roll {
        /// The roll that was given.
        roll_deg: f64,
    },
    /// The range is not a positive finite number.
    #[error("range {range_mm} mm: expected a positive number")]
    Range {
        /// The range that was given.
        range_mm: f64,
    },
    /// The gravity vector has no length, or is not finite.
    #[error("gravity has no direction: all components are zero or not finite")]
    NoGravity,
}

impl Pose {
    /// The pose with these angles and this range. `pitch_rad`: depression of the optical axis below the horizontal, in
    /// (0, pi/2]. `roll_rad`: in [-pi, pi], positive clockwise as the wearer sees it. `range_mm`: distance to the table along
    /// the optical axis, above 0.
    ///
    /// # Errors
    /// [`PoseError`] when a number is outside its range.
    pub fn new(pitch_rad: f64, roll_rad: f64, range_mm: f64) -> Result<Self, PoseError> {
        // The arcsine of a rounded vector may exceed pi/2 by one ulp.
        if !(pitch_rad > 0.0 && pitch_rad <= FRAC_PI_2 + 1e-12) {
            return Err(PoseError::NotBelowHorizon { pitch_deg: pitch_rad.to_degrees() });
        }
        if !(-PI - 1e-12..=PI + 1e-12).contains(&roll_rad) {
            return Err(PoseError::Roll { roll_deg: roll_rad.to_degrees() });
        }
        if !(range_mm > 0.0 && range_mm.is_finite()) {
            return Err(PoseError::Range { range_mm });
        }
        Ok(Self { pitch_rad, roll_rad, range_mm })
    }

    /// Pitch and roll, in radians, of a camera in whose frame the vector `down` points down. It may have any length.
    ///
    /// # Errors
    /// [`PoseError::NoGravity`] when the vector has no direction.
    pub fn pitch_roll_of_down(down: &Vector3<f64>) -> Result<(f64, f64), PoseError> {
        let length = down.norm();
        if !(length > 0.0 && length.is_finite()) {
            return Err(PoseError::NoGravity);
        }
        Ok(((down.z / length).clamp(-1.0, 1.0).asin(), down.x.atan2(down.y)))
    }

    /// Depression of the optical axis below the horizontal, in (0, pi/2].
    #[must_use]
    pub fn pitch_rad(&self) -> f64 {
        self.pitch_rad
    }

    /// Roll about the optical axis, in [-pi, pi], positive clockwise as the wearer sees it.
    #[must_use]
    pub fn roll_rad(&self) -> f64 {
        self.roll_rad
    }

    /// Distance to the table along the optical axis, the paper's `d_tof`.
    #[must_use]
    pub fn range_mm(&self) -> f64 {
        self.range_mm
    }

    /// This pose with the roll taken as zero, as the paper takes it.
    #[must_use]
    pub fn without_roll(self) -> Self {
        Self { roll_rad: 0.0, ..self }
    }

    /// Height of the camera above the table: c = range sin(pitch).
    #[must_use]
    pub fn camera_height_mm(&self) -> f64 {
        self.range_mm * self.pitch_rad.sin()
    }

    /// The unit vector that points down, in the camera frame.
    #[must_use]
    pub fn down_in_camera(&self) -> Vector3<f64> {
        let (sin_pitch, cos_pitch) = self.pitch_rad.sin_cos();
        let (sin_roll, cos_roll) = self.roll_rad.sin_cos();
        Vector3::new(sin_roll * cos_pitch, cos_roll * cos_pitch, sin_pitch)
    }

    /// The rotation that takes a direction in the camera frame to the world frame. Its rows are the world's axes (right,
    /// forward and up) in the camera frame. For a camera looking straight down (pitch = 90 degrees), forward is towards the
    /// top of the picture.
    #[must_use]
    pub fn world_from_camera(&self) -> Matrix3<f64> {
        let (sin_pitch, cos_pitch) = self.pitch_rad.sin_cos();
        let (sin_roll, cos_roll) = self.roll_rad.sin_cos();
        Matrix3::new(
            cos_roll,
            -sin_roll,
            0.0, // right
            -sin_roll * sin_pitch,
            -cos_roll * sin_pitch,
            cos_pitch, // forward
            -sin_roll * cos_pitch,
            -cos_roll * cos_pitch,
            -sin_pitch, // up
        )
    }
}
