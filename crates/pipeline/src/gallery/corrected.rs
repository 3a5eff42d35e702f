//! The picture as a camera without distortion would have taken it (Fig. 9 of the paper).

use ingest::Picture;
use model::{Camera, LensModel};
use nalgebra::{Point2, Vector3};

use super::carried_marks::{MarkedPicture, carried};
use super::resample::resample;
use super::small::SIDE_PX;
use crate::session::ShownImage;

/// A wide lens is cut rather than shown smaller than this beside the picture as it was taken.
const LEAST_ZOOM: f64 = 0.5;

/// The corrected picture with its marks; none where the camera shows nothing in front of it.
pub(super) fn undistort(source: &Picture, camera: &Camera, shown: &ShownImage) -> Option<MarkedPicture> {
    let straight = straight(camera)?;
    let picture = resample(source, straight.size_px(), |x, y| {
        camera.pixel_of(&straight.ray_through(Point2::new(x, y)).ok()?).ok()
    });
    let marks = carried(shown, |[x, y]| {
        let ray = camera.ray_through(Point2::new(x, y)).ok().filter(|ray| ray.z > 0.0)?;
        straight.pixel_of(&ray).ok().map(|point| [point.x, point.y])
    });
    Some(MarkedPicture { picture, marks })
}

/// A camera without distortion whose picture holds the middles of the borders.
fn straight(camera: &Camera) -> Option<Camera> {
    let [width, height] = camera.size_px();
    let reduced = f64::from(SIDE_PX.min(width.max(height))) / f64::from(width.max(height));
    let size_px = [width, height].map(|side| (f64::from(side) * reduced).round().max(1.0));
    let (center_x, center_y) = (0.5 * f64::from(width) - 0.5, 0.5 * f64::from(height) - 0.5);
    let ends = [
        (Point2::new(-0.5, center_y), 0),
        (Point2::new(f64::from(width) - 0.5, center_y), 0),
        (Point2::new(center_x, -0.5), 1),
        (Point2::new(center_x, f64::from(height) - 0.5), 1),
    ];
    let slope = |(end, axis): (Point2<f64>, usize)| {
        let ray: Vector3<f64> = camera.ray_through(end).ok().filter(|ray| ray.z > 0.0)?;
        Some(0.5 * size_px[axis] / (ray[axis] / ray.z).abs())
    };
    let as_taken_px = camera.focal_px()[0] * reduced;
    let focal_px = ends.into_iter().filter_map(slope).fold(as_taken_px, f64::min).max(LEAST_ZOOM * as_taken_px);
    let principal_px = size_px.map(|side| 0.5 * side - 0.5);
    Camera::new(size_px.map(whole), [focal_px, focal_px], principal_px, 0.0, LensModel::None).ok()
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a side of at most 640 pixels")]
fn whole(side: f64) -> u32 {
    side as u32
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use model::lens::{Division, Fisheye};

    use super::*;

    #[test]
    fn straight_lines_in_space_are_straight_in_the_picture() {
        for lens in [
            LensModel::Division(Division { lambda: -0.35 }),
            LensModel::Fisheye(Fisheye { k1: -0.01, k2: 0.001, k3: 0.0, k4: 0.0 }),
        ] {
            let camera = Camera::new([1600, 1200], [760.0, 760.0], [810.0, 590.0], 0.0, lens).unwrap();
            let straight = straight(&camera).unwrap();
            assert_eq!(straight.size_px(), [640, 480]);
            // A line in space, seen by one camera and carried to the other's picture.
            let carried: Vec<Point2<f64>> = (-4..=4)
                .map(|i| {
                    let seen = camera.pixel_of(&Vector3::new(0.1 * f64::from(i), 0.3, 1.0)).unwrap();
                    straight.pixel_of(&camera.ray_through(seen).unwrap()).unwrap()
                })
                .collect();
            assert!(carried.iter().all(|point| (point.y - carried[0].y).abs() < 1e-6), "{carried:?}");
            let border = straight.pixel_of(&camera.ray_through(Point2::new(-0.5, 599.5)).unwrap()).unwrap();
            assert!(border.x > -0.6 && border.x < 200.0, "the border is in it: {border}");
        }
    }
}
