//! The camera that several tests share.

use aim_batch_model::{Camera, LensModel};

/// The raw camera of the AIM-2 (Table I of the paper) with the lens that a test chooses.
pub fn aim2_camera(lens: LensModel) -> Camera {
    let focal_px = [2592.0 / 3.67 * 2.4, 1944.0 / 2.74 * 2.4];
    Camera::new([2592, 1944], focal_px, [1296.0, 972.0], 0.0, lens).expect("a camera")
}
