//! Marked points on level planes, with their derivatives by everything that they were computed from.

use nalgebra::{Matrix2, Point2, SMatrix, Vector2, Vector3};

use crate::source::{SOURCES, Source};
use crate::view::{View, ViewError};

/// Derivatives of a point on a plane by the [`Source`]s, with one column for each source.
pub(crate) type BySource = SMatrix<f64, 2, SOURCES>;

/// The place of a marked point on a level plane, with its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Located {
    /// World X and Y, in mm.
    pub point_mm: Point2<f64>,
    /// Derivatives by the sources that all marks of a picture share.
    pub by_source: BySource,
    /// Derivatives by the point's own pixel, in mm per px.
    pub by_pixel: Matrix2<f64>,
    /// Derivatives by the height of the plane, in mm per mm.
    pub by_plane_z: Vector2<f64>,
}

impl Located {
    /// The place of `pixel` on the plane at the height `plane_z_mm`.
    ///
    /// With r the ray in the world frame, q = -r.z and h the camera's height above the plane, the place is P = r.xy h / q. A
    /// small turn of the camera turns r, and a change of pitch or range changes h as well. Derivatives of rotations are cross
    /// products.
    pub(crate) fn on_plane(view: &View, pixel: Point2<f64>, plane_z_mm: f64) -> Result<Self, ViewError> {
        let point_mm = view.on_plane(pixel, plane_z_mm)?;
        let (ray_in_camera, ray_by_pixel) = view.camera().ray_and_derivative(pixel)?;
        let pose = view.pose();
        let world_from_camera = pose.world_from_camera();
        let ray = world_from_camera * ray_in_camera;
        let (q, above_mm) = (-ray.z, pose.camera_height_mm() - plane_z_mm);
        // The derivative of P by r is h / q [I2, r.xy / q].
        let by_ray = |turn: Vector3<f64>| (turn.xy() + ray.xy() * (turn.z / q)) * (above_mm / q);
        let by_height = ray.xy() / q;
        let columns = world_from_camera * ray_by_pixel;
        let by_pixel = Matrix2::from_columns(&[by_ray(columns.column(0).into()), by_ray(columns.column(1).into())]);
        let (sin_pitch, cos_pitch) = pose.pitch_rad().sin_cos();
        let (sin_roll, cos_roll) = pose.roll_rad().sin_cos();
        // Pitching down turns the forward direction down: the ray (x, y, -q) changes by (0, -q, -y).
        let by_pitch = by_ray(Vector3::new(0.0, -q, -ray.y)) + by_height * (pose.range_mm() * cos_pitch);
        // Tilting to the right turns the right-hand direction down: the ray (x, y, -q) changes by (-q, 0, -x).
        let by_tilt = by_ray(Vector3::new(-q, 0.0, -ray.x));
        let by_range = by_height * sin_pitch;
        let mut by_source = BySource::zeros();
        let mut set = |source: Source, column: Vector2<f64>| by_source.set_column(source.index(), &column);
        set(Source::Pitch, by_pitch);
        set(Source::Tilt, by_tilt);
        // The mount turns the camera about its x axis: d pitch = cos(roll) d mount and d tilt = cos(pitch) d roll
        // = sin(roll) sin(pitch) d mount.
        set(Source::Mount, by_pitch * cos_roll + by_tilt * (sin_roll * sin_pitch));
        set(Source::RangeScale, by_range * pose.range_mm());
        set(Source::RangeOffset, by_range);
        set(Source::Focal, by_pixel * view.camera().pixel_by_focal_share(pixel));
        set(Source::PrincipalX, -by_pixel.column(0));
        set(Source::PrincipalY, -by_pixel.column(1));
        set(Source::Distortion, by_pixel * view.camera().pixel_by_corner_px(pixel));
        Ok(Self { point_mm, by_source, by_pixel, by_plane_z: -by_height })
    }
}
