//! The sources of error that the sizes of a picture share.

use nalgebra::SMatrix;

use crate::codes::coded_enum;

coded_enum! {
    /// A source of error that all marks of a picture share, and that all pictures of a session share but for their noise.
    ///
    /// The derivatives of two sizes by the sources give the covariance of the sizes: an error that both share moves both.
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

/// The number of sources.
pub const SOURCES: usize = Source::ALL.len();

/// One number for each [`Source`], in their order.
pub type PerSource = SMatrix<f64, SOURCES, 1>;

/// The covariance of the [`Source`]s, in their order and units.
pub type SourceCovariance = SMatrix<f64, SOURCES, SOURCES>;

impl Source {
    /// The place of this source in a [`PerSource`].
    #[must_use]
    pub const fn index(self) -> usize {
        self as usize
    }
}
