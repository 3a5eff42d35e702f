//! Where the errors of a size come from.

use nalgebra::SMatrix;

use crate::codes::coded_enum;

coded_enum! {
    /// What all marks of a picture, and but for its noise all pictures of a session, are wrong by together.
    ///
    /// A size's derivatives by these make its covariance with any other size: an error that two sizes share moves both.
    Source {
        Pitch = "pitch": "pitch of the device from its accelerometer, in rad",
        Tilt = "tilt": "sideways tilt of the device about the horizontal direction of sight, in rad; the roll changes by it over cos(pitch)",
        Mount = "mount": "angle of the camera on the device, about the camera's x axis, in rad",
        RangeScale = "range_scale": "scale of the range, relative",
        RangeOffset = "range_offset": "offset of the range, in mm",
        Focal = "focal": "focal length, relative, both axes together",
        PrincipalX = "principal_x": "column of the principal point, in px",
        PrincipalY = "principal_y": "row of the principal point, in px",
        Distortion = "distortion": "displacement by the lens at the corner of the picture, growing with the cube of the radius, in px",
    }
}

/// How many sources there are.
pub const SOURCES: usize = Source::ALL.len();

/// One number per [`Source`], in their order.
pub type PerSource = SMatrix<f64, SOURCES, 1>;

/// Covariance of the [`Source`]s.
pub type SourceCovariance = SMatrix<f64, SOURCES, SOURCES>;

impl Source {
    /// Its place in a [`PerSource`].
    #[must_use]
    pub const fn index(self) -> usize {
        self as usize
    }
}
