//! The study's camera: the AIM-2's field of view on a sensor of any number of pixels.

use model::{Camera, CameraSpec};

use super::CAMERA_FILE;
use crate::error::SimulateError;

/// Focal length and sensor of the AIM-2 (Raju et al., Table I).
const FOCAL_MM: f64 = 2.4;
const SENSOR_MM: [f64; 2] = [3.67, 2.74];

/// The text of the camera file. Its scales in px/mm are the size of the picture over that of the sensor, its principal point is
/// the middle, and it has no distortion.
pub(super) fn camera_toml([width_px, height_px]: [u32; 2]) -> String {
    let [width, height] = [width_px, height_px].map(f64::from);
    format!(
        "# The AIM-2's field of view in pictures of {width_px} x {height_px} px, without distortion.\n\
         schema_version = 1\n\
         name = \"large-camera\"\n\
         width_px = {width_px}\n\
         height_px = {height_px}\n\
         focal_mm = {FOCAL_MM:?}\n\
         scale_px_per_mm = [{:?}, {:?}] # {width_px}/{:?}, {height_px}/{:?}\n\
         principal_px = [{:?}, {:?}]\n\
         \n\
         [lens]\n\
         model = \"none\"\n",
        width / SENSOR_MM[0],
        height / SENSOR_MM[1],
        SENSOR_MM[0],
        SENSOR_MM[1],
        0.5 * width,
        0.5 * height,
    )
}

/// The camera that the text of a camera file describes.
pub(super) fn camera_of(toml: &str) -> Result<Camera, SimulateError> {
    let spec: CameraSpec =
        toml::from_str(toml).map_err(|source| SimulateError::CameraFile { name: CAMERA_FILE, source })?;
    spec.camera().map_err(|source| SimulateError::Camera { name: CAMERA_FILE, source })
}
