//! The camera that several tests use.

use aim_batch_model::{Camera, LensModel};

/// The AIM-2 raw camera (Table I of the paper), with a lens of the test's choice.
pub fn aim2_camera(lens: LensModel) -> Camera {
    let focal_px = [2592.0 / 3.67 * 2.4, 1944.0 / 2.74 * 2.4];
    Camera::new([2592, 1944], focal_px, [1296.0, 972.0], 0.0, lens).expect("a camera")
}
