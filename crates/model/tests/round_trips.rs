//! Invariants of the projection, for every lens model and random cameras, poses and planes.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::{FRAC_PI_2, PI};

use aim_batch_model::lens::{Division, Fisheye, PlumbBob, Radial};
use aim_batch_model::{Camera, LensError, LensModel, Pose, View, ViewError};
use nalgebra::{Point2, Rotation2, Vector3};
use proptest::prelude::*;

/// A lens of any model, with mild to strong distortion of both signs.
fn lens() -> impl Strategy<Value = LensModel> {
    prop_oneof![
        Just(LensModel::None),
        (-0.5..0.5).prop_map(|k1| LensModel::Radial(Radial { k1 })),
        (-0.8..0.4).prop_map(|lambda| LensModel::Division(Division { lambda })),
        (-0.5..0.3, -0.3..0.4, -0.005..0.005, -0.005..0.005, -0.2..0.2)
            .prop_map(|(k1, k2, p1, p2, k3)| LensModel::PlumbBob(PlumbBob { k1, k2, p1, p2, k3 })),
        (-0.2..0.4, -0.05..0.2, -0.02..0.1, -0.01..0.05).prop_map(|(k1, k2, k3, k4)| LensModel::Fisheye(Fisheye {
            k1,
            k2,
            k3,
            k4
        })),
    ]
}

prop_compose! {
    fn camera()(
        lens in lens(),
        focal_px in 300.0..3000.0_f64,
        aspect in 0.9..1.1,
        center_px in [800.0..1800.0, 600.0..1400.0],
        skew_px in -5.0..5.0,
    ) -> Camera {
        Camera::new([2592, 1944], [focal_px, focal_px * aspect], center_px, skew_px, lens).unwrap()
    }
}

prop_compose! {
    fn pose()(pitch_rad in 0.05..FRAC_PI_2, roll_rad in -PI..PI, range_mm in 100.0..2000.0) -> Pose {
        Pose::new(pitch_rad, roll_rad, range_mm).unwrap()
    }
}

fn view() -> impl Strategy<Value = View> {
    (camera(), pose()).prop_map(|(camera, pose)| View::new(camera, pose))
}

fn pixel() -> impl Strategy<Value = Point2<f64>> {
    [-200.0..2800.0, -200.0..2200.0].prop_map(Point2::from)
}

/// A point on a level plane: its direction around the point under the camera, and its distance from that point in units of the
/// camera's height above the plane.
fn spot() -> impl Strategy<Value = (f64, f64)> {
    (-PI..PI, 0.01..4.0)
}

fn spot_mm(height_over_plane_mm: f64, (around_rad, distance): (f64, f64)) -> Point2<f64> {
    Point2::new(around_rad.cos(), around_rad.sin()) * (distance * height_over_plane_mm)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// The corner of a picture is the corner of its resampled copy, and so is every place between.
    #[test]
    fn a_resampled_picture_shows_the_same(camera in camera(), pixel in pixel(), size_px in [1..4000_u32, 1..3000_u32]) {
        let small = camera.resampled(size_px).unwrap();
        let [sx, sy] = [0, 1].map(|axis| f64::from(size_px[axis]) / f64::from(camera.size_px()[axis]));
        let there = Point2::new((pixel.x + 0.5) * sx - 0.5, (pixel.y + 0.5) * sy - 0.5);
        if let (Ok(ray), Ok(again)) = (camera.ray_through(pixel), small.ray_through(there)) {
            prop_assert!((ray.normalize() - again.normalize()).norm() < 1e-9);
        }
    }

    /// The place of a pixel on a plane is seen in that pixel, unless the pixel is refused.
    #[test]
    fn pixel_to_plane_to_pixel(view in view(), pixel in pixel(), share in -0.5..0.95) {
        let z_mm = share * view.pose().camera_height_mm();
        if let Ok(on_plane) = view.on_plane(pixel, z_mm) {
            let back = view.pixel_of(on_plane.coords.push(z_mm).into()).unwrap();
            prop_assert!((back - pixel).norm() < 1e-6, "{pixel} -> {on_plane} -> {back}");
        }
    }

    /// The pixel that shows a point has its place at that point, unless the point is refused.
    #[test]
    fn plane_to_pixel_to_plane(view in view(), spot in spot(), share in -0.5..0.95) {
        let z_mm = share * view.pose().camera_height_mm();
        let point_mm = spot_mm(view.pose().camera_height_mm() - z_mm, spot);
        if let Ok(pixel) = view.pixel_of(point_mm.coords.push(z_mm).into()) {
            let back = view.on_plane(pixel, z_mm).unwrap();
            let error = (back - point_mm).norm() / (view.pose().camera_height_mm() - z_mm);
            prop_assert!(error < 1e-6, "{point_mm} -> {pixel} -> {back}");
        }
    }

    /// Lifting a plane is a scaling about the point under the camera: XY(H) = XY(0) (c - H) / c (Eq. 15).
    #[test]
    fn planes_scale_about_the_point_under_the_camera(view in view(), pixel in pixel(), share in -0.5..0.99) {
        if let Ok(on_table) = view.on_plane(pixel, 0.0) {
            let lifted = view.on_plane(pixel, share * view.pose().camera_height_mm()).unwrap();
            prop_assert!((lifted - on_table * (1.0 - share)).norm() <= 1e-12 * on_table.coords.norm());
        }
    }

    /// The world turns with the wearer: a turn of two points about the camera does not change their distance.
    #[test]
    fn yaw_changes_no_distance(view in view(), spots in [spot(), spot()], yaw_rad in -PI..PI) {
        let c_mm = view.pose().camera_height_mm();
        let distance_mm = |turn_rad: f64| -> Result<f64, ViewError> {
            let [a, b] = spots.map(|(around, far)| spot_mm(c_mm, (around + turn_rad, far)));
            let on_table = |p: Point2<f64>| view.on_plane(view.pixel_of(p.coords.push(0.0).into())?, 0.0);
            Ok((on_table(a)? - on_table(b)?).norm())
        };
        if let (Ok(before), Ok(after)) = (distance_mm(0.0), distance_mm(yaw_rad)) {
            prop_assert!((before - after).abs() < 2e-6 * c_mm, "{before} mm, turned {after} mm");
        }
    }

    /// Turning the camera about its axis turns the picture about the principal point the other way, and nothing else.
    #[test]
    fn roll_turns_the_picture(k1 in -0.3..0.3, pose in pose(), pixel in pixel()) {
        let camera = Camera::new([2592, 1944], [1700.0; 2], [1296.0, 972.0], 0.0, LensModel::Radial(Radial { k1 })).unwrap();
        let center = Point2::from(camera.principal_px());
        let upright = center + Rotation2::new(pose.roll_rad()) * (pixel - center);
        let rolled = View::new(camera, pose).on_plane(pixel, 0.0);
        let straight = View::new(camera, pose.without_roll()).on_plane(upright, 0.0);
        if let (Ok(rolled), Ok(straight)) = (rolled, straight) {
            // Near the horizon a rounding of the pixel amounts to millimetres, so directions are compared, not places.
            let error = (rolled - straight).norm() / straight.coords.norm_squared().max(1.0);
            prop_assert!(error * pose.camera_height_mm() < 1e-9, "{rolled} {straight}");
        }
    }

    /// The image point of a ray gives that ray back, up to the very end of the monotone range.
    #[test]
    fn lenses_invert(lens in lens(), around_rad in -PI..PI, ray_angle_rad in 0.0..3.0) {
        let (sin, cos) = f64::sin_cos(ray_angle_rad);
        let ray = Vector3::new(sin * around_rad.cos(), sin * around_rad.sin(), cos);
        if let Ok(shown) = lens.distorted_of_ray(&ray) {
            let back = lens.ray_of_distorted(shown).unwrap().normalize();
            prop_assert!((back - ray).norm() < 1e-6, "{ray} -> {shown} -> {back}");
        }
    }

    /// Beyond the fold of Eq. (3) there is no ideal point, and no image point beyond what the lens shows.
    #[test]
    fn the_radial_lens_refuses_what_lies_beyond_its_fold(k1 in -2.0..-1e-6, beyond in 1e-9..10.0, around_rad in -PI..PI) {
        let radial = Radial { k1 };
        let lens = LensModel::Radial(radial);
        let direction = Point2::new(around_rad.cos(), around_rad.sin());
        let ideal = direction * (radial.ideal_limit() * (1.0 + beyond));
        let refused = lens.distorted_of_ray(&ideal.coords.push(1.0));
        prop_assert!(matches!(refused, Err(LensError::IdealBeyondRange { .. })), "{refused:?}");
        let largest_shown = radial.ideal_limit() * 2.0 / 3.0; // r (1 + k1 r^2) at r^2 = -1 / (3 k1)
        let refused = lens.ray_of_distorted(direction * (largest_shown * (1.0 + beyond)));
        prop_assert!(matches!(refused, Err(LensError::ImageBeyondRange { .. })), "{refused:?}");
    }

    /// At the fold itself the cubic has a double root: half the digits are lost there, and no more.
    #[test]
    fn the_radial_inverse_holds_at_its_very_limit(k1 in -2.0..-1e-6, around_rad in -PI..PI) {
        let radial = Radial { k1 };
        let lens = LensModel::Radial(radial);
        let ideal = Point2::new(around_rad.cos(), around_rad.sin()) * radial.ideal_limit();
        let shown = lens.distorted_of_ray(&ideal.coords.push(1.0)).unwrap();
        let back = lens.ray_of_distorted(shown).unwrap();
        prop_assert!((back.xy() - ideal.coords).norm() < 1e-7 * radial.ideal_limit(), "{ideal} -> {shown} -> {back}");
    }

    /// No number leads to a panic, and all answers are finite.
    #[test]
    fn any_number_is_answered_or_refused(
        lens in lens(),
        numbers in proptest::array::uniform6(any::<f64>()),
        wild in prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, f64::MAX, f64::MIN_POSITIVE, 5e-324]),
        position in 0..6_usize,
    ) {
        let mut n = numbers;
        n[position] = wild;
        let camera = Camera::new([2592, 1944], [1700.0, 1690.0], [1296.0, 972.0], 0.0, lens).unwrap();
        let pose = Pose::new(n[0], n[1], n[2]).unwrap_or_else(|_| Pose::new(0.9, 0.1, 500.0).unwrap());
        let view = View::new(camera, pose);
        if let Ok(on_plane) = view.on_plane(Point2::new(n[3], n[4]), n[5]) {
            prop_assert!(on_plane.iter().all(|c| c.is_finite()), "{on_plane}");
        }
        if let Ok(pixel) = view.pixel_of([n[3], n[4], n[5]].into()) {
            prop_assert!(pixel.iter().all(|c| c.is_finite()), "{pixel}");
        }
        if let Ok((pitch_rad, roll_rad)) = Pose::pitch_roll_of_down(&Vector3::new(n[0], n[1], n[2])) {
            prop_assert!(pitch_rad.is_finite() && roll_rad.is_finite());
        }
    }

    /// Lens coefficients from a file may be any finite numbers.
    #[test]
    fn any_coefficients_are_answered_or_refused(k in proptest::array::uniform5(any::<f64>()), pixel in pixel()) {
        let [k1, k2, p1, p2, k3] = k;
        for lens in [
            LensModel::Radial(Radial { k1 }),
            LensModel::Division(Division { lambda: k1 }),
            LensModel::PlumbBob(PlumbBob { k1, k2, p1, p2, k3 }),
            LensModel::Fisheye(Fisheye { k1, k2, k3, k4: p1 }),
        ] {
            let Ok(camera) = Camera::new([2592, 1944], [1700.0; 2], [1296.0, 972.0], 0.0, lens) else { continue };
            if let Ok(ray) = camera.ray_through(pixel) {
                prop_assert!(ray.iter().all(|c| c.is_finite()), "{lens:?}: {ray}");
            }
            if let Ok(seen) = camera.pixel_of(&Vector3::new(0.3, -0.2, 1.0)) {
                prop_assert!(seen.iter().all(|c| c.is_finite()), "{lens:?}: {seen}");
            }
        }
    }
}

/// A case from proptest. The radial terms alone never fold, but come so near to it (slope 0.005 at a radius of 0.95) that small
/// tangential terms make the model fold and show two rays in one place. No point beyond that is answered.
#[test]
fn tangential_terms_can_fold_what_radial_ones_do_not() {
    let (k1, k2, k3) = (-0.35809246236988074, -0.24492171498151447, 0.18913402082401448);
    let radial = PlumbBob { k1, k2, k3, ..PlumbBob::default() };
    let decentred = PlumbBob { p2: -0.004073436861165243, ..radial };
    assert!(radial.ideal_limit() > 99.0);
    assert!((0.85..0.95).contains(&decentred.ideal_limit()), "{}", decentred.ideal_limit());
    let shown = |lens, x: f64| LensModel::PlumbBob(lens).distorted_of_ray(&Vector3::new(x, 0.0, 1.0));
    assert!(shown(radial, 1.2).is_ok() && shown(decentred, 0.8).is_ok());
    assert!(matches!(shown(decentred, 1.2), Err(LensError::IdealBeyondRange { .. })));
}

/// The round trips above skip points without an answer. This test asserts that most points have one.
#[test]
fn most_pixels_have_an_answer() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let mut runner = TestRunner::deterministic();
    let strategy = (view(), pixel());
    let answered = (0..2000).filter(|_| {
        let (view, pixel) = strategy.new_tree(&mut runner).unwrap().current();
        view.on_plane(pixel, 0.0).is_ok()
    });
    let answered = answered.count();
    assert!(answered > 1000, "{answered} of 2000");
}
