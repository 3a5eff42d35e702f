//! Tests that bodies are where they say that they are.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use nalgebra::{Point2, Point3, Vector3};

use super::*;

fn body(form: Form) -> Body {
    Body { form, material: Material::matt(Texture::Plain([0.5; 3])) }
}

/// A ball as an ellipsoid, as a capsule of no length, and as a turned profile: rays from everywhere meet all three at the same
/// place.
#[test]
fn a_ball_is_a_ball_whatever_makes_it() {
    let center = Point3::new(10.0, -20.0, 60.0);
    let arc = (0..=400).map(|i| f64::from(i) / 400.0 * std::f64::consts::PI);
    let profile: Vec<[f64; 2]> = arc.map(|a| [50.0 * a.sin(), 60.0 - 50.0 * a.cos()]).collect();
    let forms = [
        body(Form::Ellipsoid { center, half: Vector3::repeat(50.0), turn_rad: 0.4 }),
        body(Form::Capsule { ends: [center, center], radius: 50.0 }),
        body(Form::Turned(Turned::new(center.xy(), &profile))),
    ];
    for i in 0..200_u64 {
        let unit = |salt: u64| 2.0 * chance::share(i * 8 + salt) - 1.0;
        let origin = center + Vector3::new(unit(0), unit(1), unit(2)).normalize() * 300.0;
        let target = center + Vector3::new(unit(3), unit(4), unit(5)) * 25.0;
        let ray = Ray { origin, direction: (target - origin).normalize() };
        let met: Vec<_> = forms.iter().map(|form| form.touch(&ray, 0.0).unwrap()).collect();
        let radius = (ray.point_at(met[0].distance) - center).norm();
        assert!((radius - 50.0).abs() < 1e-9);
        for other in &met[1..] {
            assert!((other.distance - met[0].distance).abs() < 0.02, "{met:?}");
            assert!(other.normal.dot(&met[0].normal).abs() > 0.999, "{met:?}");
        }
    }
}

#[test]
fn a_box_is_met_at_its_faces() {
    let form =
        body(Form::Cuboid { center: Point3::new(0.0, 0.0, 5.0), half: Vector3::new(20.0, 10.0, 5.0), turn_rad: 1.0 });
    let down = Ray { origin: Point3::new(0.0, 0.0, 100.0), direction: -Vector3::z() };
    let touch = form.touch(&down, 0.0).unwrap();
    assert!((touch.distance - 90.0).abs() < 1e-9 && touch.normal.z > 0.999);
    let beside = Ray { origin: Point3::new(20.0 * 1.0_f64.cos() * 1.1, 20.0 * 1.0_f64.sin() * 1.1, 100.0), ..down };
    assert!(form.touch(&beside, 0.0).is_none());
}

#[test]
fn shadows_are_soft_and_lie_away_from_the_lamp() {
    let light = Light {
        lamp_mm: Point3::new(-1000.0, 0.0, 1000.0),
        lamp_half_mm: [100.0; 2],
        lamp: [0.6; 3],
        room: [0.3; 3],
        window_rad: 0.0,
    };
    let ball =
        body(Form::Ellipsoid { center: Point3::new(0.0, 0.0, 200.0), half: Vector3::repeat(60.0), turn_rad: 0.0 });
    let table = Material::matt(Texture::Plain([0.5; 3]));
    let world = World { table, table_mm: ([2000.0; 2], Point2::origin()), bodies: vec![ball], light };
    let seen = |x: f64| {
        let ray = Ray { origin: Point3::new(x, -2000.0, 2000.0), direction: Vector3::new(0.0, 1.0, -1.0) };
        let lit = (0..100)
            .map(|i| [f64::from(i % 10) / 9.0, f64::from(i / 10) / 9.0])
            .filter(|at| world.sight(&ray, *at).is_lit);
        lit.count()
    };
    // The shadow's middle is at x = 250 (the lamp's ray through the ball's middle meets the table there).
    assert_eq!((seen(-300.0), seen(250.0), seen(600.0)), (100, 0, 100));
    // Its edge is about 120 mm from there, and some 50 mm wide.
    let edge = [350.0, 360.0, 370.0, 380.0, 390.0].map(seen);
    assert!(edge.is_sorted() && edge.iter().any(|lit| (1..100).contains(lit)), "{edge:?}");
}
