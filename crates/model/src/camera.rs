//! The camera, which maps pixels to rays and back.

use nalgebra::{Matrix2, Matrix3x2, Point2, Vector2, Vector3};

use crate::lens::{LensError, LensModel};

/// A calibrated camera: Eq. (4), with any lens model in place of Eq. (3).
///
/// A pixel is x = fx `x_d` + skew `y_d` + cx, y = fy `y_d` + cy, where (`x_d`, `y_d`) is the normalised distorted point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    size_px: [u32; 2],
    focal_px: [f64; 2],
    principal_px: [f64; 2],
    skew_px: f64,
    lens: LensModel,
}

/// The reason why numbers do not make a camera.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CameraError {
    /// The width or the height is zero.
    #[error("picture size {0} x {1} px: expected both above 0")]
    EmptyPicture(u32, u32),
    /// A focal length is not a positive finite number.
    #[error("focal length {0} px: expected a positive number")]
    BadFocalLength(f64),
    /// Another parameter is not a finite number.
    #[error("{0} is not a finite number")]
    NotFinite(&'static str),
}

impl Camera {
    /// The camera with these parameters. `size_px`: width and height of its pictures. `focal_px`: fx and fy, that is f times
    /// the scales of Eq. (4). `principal_px`: cx and cy. `skew_px`: the paper's second `K_c` (Eq. 4, in px/mm) times f.
    ///
    /// # Errors
    /// [`CameraError`] for an empty picture, a focal length that is not positive, or numbers that are not finite.
    pub fn new(
        size_px: [u32; 2],
        focal_px: [f64; 2],
        principal_px: [f64; 2],
        skew_px: f64,
        lens: LensModel,
    ) -> Result<Self, CameraError> {
        if size_px.contains(&0) {
            return Err(CameraError::EmptyPicture(size_px[0], size_px[1]));
        }
        if let Some(bad) = focal_px.into_iter().find(|f| !f.is_finite() || *f <= 0.0) {
            return Err(CameraError::BadFocalLength(bad));
        }
        if !principal_px.into_iter().all(f64::is_finite) {
            return Err(CameraError::NotFinite("the principal point"));
        }
        if !skew_px.is_finite() {
            return Err(CameraError::NotFinite("the skew"));
        }
        let coefficients = match lens {
            LensModel::None => vec![],
            LensModel::Radial(l) => vec![l.k1],
            LensModel::Division(l) => vec![l.lambda],
            LensModel::PlumbBob(l) => vec![l.k1, l.k2, l.p1, l.p2, l.k3],
            LensModel::Fisheye(l) => vec![l.k1, l.k2, l.k3, l.k4],
        };
        if !coefficients.into_iter().all(f64::is_finite) {
            return Err(CameraError::NotFinite("a lens coefficient"));
        }
        Ok(Self { size_px, focal_px, principal_px, skew_px, lens })
    }

    /// This camera for pictures that were resampled to another size, each axis by itself.
    ///
    /// # Errors
    /// [`CameraError::EmptyPicture`] when a side is zero.
    pub fn resampled(&self, size_px: [u32; 2]) -> Result<Self, CameraError> {
        let [sx, sy] = size_ratios(self.size_px, size_px);
        let [fx, fy] = self.focal_px;
        let principal_px = resampled_px(self.principal_px, self.size_px, size_px);
        // The lens model works in focal lengths, so its coefficients stay the same.
        Self::new(size_px, [fx * sx, fy * sy], principal_px, self.skew_px * sx, self.lens)
    }

    /// Width and height of the camera's pictures.
    #[must_use]
    pub fn size_px(&self) -> [u32; 2] {
        self.size_px
    }

    /// The focal lengths fx and fy.
    #[must_use]
    pub fn focal_px(&self) -> [f64; 2] {
        self.focal_px
    }

    /// The principal point cx and cy.
    #[must_use]
    pub fn principal_px(&self) -> [f64; 2] {
        self.principal_px
    }

    /// The skew of the pixel grid.
    #[must_use]
    pub fn skew_px(&self) -> f64 {
        self.skew_px
    }

    /// The lens model with its coefficients.
    #[must_use]
    pub fn lens(&self) -> &LensModel {
        &self.lens
    }

    /// The ray through a pixel: a direction in the camera frame, of any length.
    ///
    /// # Errors
    /// [`LensError`] when the lens shows nothing there.
    pub fn ray_through(&self, pixel: Point2<f64>) -> Result<Vector3<f64>, LensError> {
        // This is the exact inverse of Eq. (4). The paper's Eq. (9) is misprinted: it has a '+' for a product, and the skew
        // transposed.
        self.lens.ray_of_distorted(self.normalised(pixel))
    }

    /// The normalised distorted point of a pixel.
    fn normalised(&self, pixel: Point2<f64>) -> Point2<f64> {
        let y = (pixel.y - self.principal_px[1]) / self.focal_px[1];
        let x = (pixel.x - self.principal_px[0] - self.skew_px * y) / self.focal_px[0];
        Point2::new(x, y)
    }

    /// [`Self::ray_through`] with its derivative by the pixel, in closed form.
    ///
    /// # Errors
    /// [`LensError`] when the lens shows nothing there, or when its model folds there.
    pub fn ray_and_derivative(&self, pixel: Point2<f64>) -> Result<(Vector3<f64>, Matrix3x2<f64>), LensError> {
        let (ray, by_normalised) = self.lens.ray_and_derivative(self.normalised(pixel))?;
        let [fx, fy] = self.focal_px;
        let by_pixel = Matrix2::new(1.0 / fx, -self.skew_px / (fx * fy), 0.0, 1.0 / fy);
        Ok((ray, by_normalised * by_pixel))
    }

    /// How far the mark at `pixel` must move to have the same effect as focal lengths that are larger by a small share, per
    /// that share, in px.
    pub(crate) fn pixel_by_focal_share(&self, pixel: Point2<f64>) -> Vector2<f64> {
        let normalised = self.normalised(pixel);
        -Vector2::new(self.focal_px[0] * normalised.x, self.focal_px[1] * normalised.y)
    }

    /// How far the mark at `pixel` must move to have the same effect as a lens that shows the corners of the picture further
    /// out, per px of that shift. Like a radial distortion, it shifts other points by the cube of their distance from the
    /// principal point.
    pub(crate) fn pixel_by_corner_px(&self, pixel: Point2<f64>) -> Vector2<f64> {
        let from_axis = pixel.coords - Vector2::from(self.principal_px);
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[x, y]| {
            let corner = Vector2::new(x * f64::from(self.size_px[0]), y * f64::from(self.size_px[1]));
            (corner - Vector2::from(self.principal_px)).norm()
        });
        let farthest = corners.into_iter().fold(1.0, f64::max);
        -from_axis * (from_axis.norm_squared() / farthest.powi(3))
    }

    /// The pixel that shows a point or a direction given in the camera frame. It may lie outside the picture.
    ///
    /// # Errors
    /// [`LensError`] when the lens does not show that direction.
    pub fn pixel_of(&self, in_camera: &Vector3<f64>) -> Result<Point2<f64>, LensError> {
        let distorted = self.lens.distorted_of_ray(in_camera)?;
        let pixel = Point2::new(
            self.focal_px[0] * distorted.x + self.skew_px * distorted.y + self.principal_px[0], // Eq. (4)
            self.focal_px[1] * distorted.y + self.principal_px[1],
        );
        if pixel.iter().all(|c| c.is_finite()) { Ok(pixel) } else { Err(LensError::NotFinite) }
    }
}

/// The place, in a copy resampled to the size `to_px`, of a point of a picture of the size `from_px`; each axis by itself.
///
/// (0, 0) is the centre of the first pixel. The corner of the picture, half a pixel before it, stays the corner.
#[must_use]
pub fn resampled_px(point_px: [f64; 2], from_px: [u32; 2], to_px: [u32; 2]) -> [f64; 2] {
    let ratios = size_ratios(from_px, to_px);
    [0, 1].map(|axis| (point_px[axis] + 0.5) * ratios[axis] - 0.5)
}

/// The factors by which width and height change between two sizes of a picture.
fn size_ratios(from_px: [u32; 2], to_px: [u32; 2]) -> [f64; 2] {
    [0, 1].map(|axis| f64::from(to_px[axis]) / f64::from(from_px[axis]))
}
