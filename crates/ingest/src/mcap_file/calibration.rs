//! The camera as foxglove.CameraCalibration.

use foxglove::messages::CameraCalibration;
use model::{Camera, LensModel, UtcNs};

use super::CAMERA_FRAME;
use super::timestamp;

/// K, D, R, P. R is the identity and P the same as K: one camera, not rectified.
pub(super) fn calibration(camera: &Camera, time: UtcNs) -> CameraCalibration {
    let [fx, fy] = camera.focal_px();
    let [cx, cy] = camera.principal_px();
    let skew = camera.skew_px();
    let [width, height] = camera.size_px();
    let (distortion_model, d) = distortion(camera.lens());
    CameraCalibration {
        timestamp: timestamp(time),
        frame_id: CAMERA_FRAME.to_owned(),
        width,
        height,
        distortion_model: distortion_model.to_owned(),
        d,
        k: vec![fx, skew, cx, 0.0, fy, cy, 0.0, 0.0, 1.0],
        r: vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        p: vec![fx, skew, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0],
    }
}

/// Names as Foxglove has them; it has none for the division model.
fn distortion(lens: &LensModel) -> (&'static str, Vec<f64>) {
    match lens {
        LensModel::None => ("", vec![]),
        LensModel::Radial(lens) => ("plumb_bob", vec![lens.k1, 0.0, 0.0, 0.0, 0.0]), // the same model
        LensModel::Division(lens) => ("division", vec![lens.lambda]),
        LensModel::PlumbBob(lens) => ("plumb_bob", vec![lens.k1, lens.k2, lens.p1, lens.p2, lens.k3]),
        LensModel::Fisheye(lens) => ("kannala_brandt", vec![lens.k1, lens.k2, lens.k3, lens.k4]),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

    use super::*;
    use model::lens::{Division, Fisheye, Radial};

    #[test]
    fn lens_models_have_the_names_that_foxglove_knows() {
        let named = |lens: LensModel| {
            let camera = Camera::new([640, 480], [500.0, 510.0], [320.0, 240.0], 0.5, lens).unwrap();
            let calibration = calibration(&camera, UtcNs(1_500_000_000));
            assert_eq!(calibration.k, [500.0, 0.5, 320.0, 0.0, 510.0, 240.0, 0.0, 0.0, 1.0]);
            assert_eq!(calibration.p[..4], [500.0, 0.5, 320.0, 0.0]);
            (calibration.distortion_model, calibration.d)
        };
        assert_eq!(named(LensModel::None), (String::new(), vec![]));
        assert_eq!(
            named(LensModel::Radial(Radial { k1: -0.2 })),
            ("plumb_bob".to_owned(), vec![-0.2, 0.0, 0.0, 0.0, 0.0])
        );
        assert_eq!(named(LensModel::Division(Division { lambda: -0.3 })), ("division".to_owned(), vec![-0.3]));
        let fisheye = LensModel::Fisheye(Fisheye { k1: 0.1, k2: 0.2, k3: 0.3, k4: 0.4 });
        assert_eq!(named(fisheye), ("kannala_brandt".to_owned(), vec![0.1, 0.2, 0.3, 0.4]));
    }
}
