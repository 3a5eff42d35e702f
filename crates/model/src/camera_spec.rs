//! The camera as people write it down: the fields of a camera file.

use serde::{Deserialize, Serialize};

use crate::camera::{Camera, CameraError};
use crate::lens::{Division, Fisheye, LensModel, PlumbBob, Radial};

/// The version of the camera file that this program reads.
const CAMERA_SCHEMA_VERSION: u32 = 1;

/// The contents of a camera file. It gives either `focal_px`, or `focal_mm` with `scale_px_per_mm`; unknown keys are refused.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraSpec {
    /// Version of the file's layout: 1.
    pub schema_version: u32,
    /// Name of the camera, for people.
    pub name: String,
    /// Width of the picture.
    pub width_px: u32,
    /// Height of the picture.
    pub height_px: u32,
    /// Focal lengths fx and fy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub focal_px: Option<[f64; 2]>,
    /// Focal length f (Table I of the paper: 2.4 mm).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub focal_mm: Option<f64>,
    /// Pixels per millimetre of the sensor in x and in y: the scales of Eq. (4).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale_px_per_mm: Option<[f64; 2]>,
    /// Principal point cx and cy.
    pub principal_px: [f64; 2],
    /// Skew of the pixel grid; zero where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub skew_px: Option<f64>,
    /// The lens model with its coefficients.
    pub lens: LensSpec,
}

/// The `[lens]` table of a camera file.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "model", rename_all = "snake_case", deny_unknown_fields)]
pub enum LensSpec {
    /// No distortion.
    None {},
    /// Eq. (3), with the coefficient either as the paper's `K_c` or normalised.
    Radial {
        /// The paper's `K_c`, for radii in mm on the sensor; needs `focal_mm`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        k_per_mm2: Option<f64>,
        /// The same coefficient for radii in focal lengths.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        k1: Option<f64>,
    },
    /// The division model.
    Division {
        /// The coefficient for radii in focal lengths.
        lambda: f64,
    },
    /// Brown-Conrady, with the coefficients of OpenCV's `distCoeffs`.
    PlumbBob {
        /// Radial coefficient of r^2.
        k1: f64,
        /// Radial coefficient of r^4.
        #[serde(default)]
        k2: f64,
        /// Tangential coefficient, with 2 x y in x.
        #[serde(default)]
        p1: f64,
        /// Tangential coefficient, with 2 x y in y.
        #[serde(default)]
        p2: f64,
        /// Radial coefficient of r^6.
        #[serde(default)]
        k3: f64,
    },
    /// Kannala-Brandt, as in OpenCV's `cv::fisheye`; t is the angle of a ray from the optical axis, in radians.
    Fisheye {
        /// Coefficient of t^3.
        k1: f64,
        /// Coefficient of t^5.
        #[serde(default)]
        k2: f64,
        /// Coefficient of t^7.
        #[serde(default)]
        k3: f64,
        /// Coefficient of t^9.
        #[serde(default)]
        k4: f64,
    },
}

/// The reason why a camera file does not describe a camera.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CameraSpecError {
    /// The file has a version that this program does not read.
    #[error("schema_version = {0}: this program reads version {CAMERA_SCHEMA_VERSION}")]
    Version(u32),
    /// The focal length is given in neither of the two ways, in both, or only in part.
    #[error("expected either focal_px = [fx, fy], or focal_mm with scale_px_per_mm = [sx, sy]; got {0}")]
    FocalLength(&'static str),
    /// The radial coefficient is given in neither of the two ways, or in both.
    #[error("lens model 'radial': expected either k_per_mm2 or k1; got {0}")]
    RadialCoefficient(&'static str),
    /// `k_per_mm2` is given without a focal length in mm.
    #[error("lens model 'radial': k_per_mm2 needs focal_mm with scale_px_per_mm; with focal_px give the normalised k1")]
    NoMillimetres,
    /// The numbers do not make a camera.
    #[error(transparent)]
    Camera(#[from] CameraError),
}

impl CameraSpec {
    /// The camera file that describes `camera`, with lengths in pixels.
    #[must_use]
    pub fn from_camera(name: &str, camera: &Camera) -> Self {
        let lens = match *camera.lens() {
            LensModel::None => LensSpec::None {},
            LensModel::Radial(Radial { k1 }) => LensSpec::Radial { k_per_mm2: None, k1: Some(k1) },
            LensModel::Division(Division { lambda }) => LensSpec::Division { lambda },
            LensModel::PlumbBob(PlumbBob { k1, k2, p1, p2, k3 }) => LensSpec::PlumbBob { k1, k2, p1, p2, k3 },
            LensModel::Fisheye(Fisheye { k1, k2, k3, k4 }) => LensSpec::Fisheye { k1, k2, k3, k4 },
        };
        let [width_px, height_px] = camera.size_px();
        Self {
            schema_version: CAMERA_SCHEMA_VERSION,
            name: name.to_owned(),
            width_px,
            height_px,
            focal_px: Some(camera.focal_px()),
            focal_mm: None,
            scale_px_per_mm: None,
            principal_px: camera.principal_px(),
            skew_px: Some(camera.skew_px()),
            lens,
        }
    }

    /// The camera that this file describes.
    ///
    /// # Errors
    /// [`CameraSpecError`] when the file has another version, contradicts itself or leaves something open.
    pub fn camera(&self) -> Result<Camera, CameraSpecError> {
        if self.schema_version != CAMERA_SCHEMA_VERSION {
            return Err(CameraSpecError::Version(self.schema_version));
        }
        let focal_px = match (self.focal_px, self.focal_mm, self.scale_px_per_mm) {
            (Some(focal_px), None, None) => focal_px,
            (None, Some(focal_mm), Some(scale)) => scale.map(|s| s * focal_mm),
            (Some(_), _, _) => return Err(CameraSpecError::FocalLength("both")),
            (None, None, None) => return Err(CameraSpecError::FocalLength("neither")),
            (None, Some(_), None) => return Err(CameraSpecError::FocalLength("focal_mm without scale_px_per_mm")),
            (None, None, Some(_)) => return Err(CameraSpecError::FocalLength("scale_px_per_mm without focal_mm")),
        };
        let size_px = [self.width_px, self.height_px];
        let skew_px = self.skew_px.unwrap_or(0.0);
        Ok(Camera::new(size_px, focal_px, self.principal_px, skew_px, self.lens_model()?)?)
    }

    fn lens_model(&self) -> Result<LensModel, CameraSpecError> {
        Ok(match self.lens {
            LensSpec::None {} => LensModel::None,
            LensSpec::Radial { k_per_mm2, k1 } => LensModel::Radial(Radial {
                k1: match (k_per_mm2, k1, self.focal_mm) {
                    (None, Some(k1), _) => k1,
                    (Some(k), None, Some(focal_mm)) => k * focal_mm * focal_mm,
                    (Some(_), None, None) => return Err(CameraSpecError::NoMillimetres),
                    (Some(_), Some(_), _) => return Err(CameraSpecError::RadialCoefficient("both")),
                    (None, None, _) => return Err(CameraSpecError::RadialCoefficient("neither")),
                },
            }),
            LensSpec::Division { lambda } => LensModel::Division(Division { lambda }),
            LensSpec::PlumbBob { k1, k2, p1, p2, k3 } => LensModel::PlumbBob(PlumbBob { k1, k2, p1, p2, k3 }),
            LensSpec::Fisheye { k1, k2, k3, k4 } => LensModel::Fisheye(Fisheye { k1, k2, k3, k4 }),
        })
    }
}
