//! The bodies of boxes and of rectangular plates.

use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::{Point2, Point3, Rotation3, Vector2, Vector3};

use super::ware::Ware;
use crate::world::{Body, Convex, Form, Material};

/// The bodies of a box without a lid: four upright walls and a floor.
pub(super) fn tub(ware: &Ware, at_mm: Point2<f64>, turn_rad: f64, material: &Material) -> Vec<Body> {
    let (x, y, z, t) = (0.5 * ware.diameter_mm, 0.5 * ware.width_mm, 0.5 * ware.height_mm, 0.5 * ware.thickness_mm);
    let parts = [
        ([x - t, 0.0, z], [t, y, z]),
        ([t - x, 0.0, z], [t, y, z]),
        ([0.0, y - t, z], [x, t, z]),
        ([0.0, t - y, z], [x, t, z]),
        ([0.0, 0.0, t], [x, y, t]),
    ];
    parts.map(|(center, half)| cuboid(at_mm, turn_rad, material, center, half)).to_vec()
}

/// The bodies of a plate on a foot: a level well, and a flange that rises from it to the rim, mitred at the corners.
pub(super) fn plate(ware: &Ware, at_mm: Point2<f64>, turn_rad: f64, material: &Material) -> Vec<Body> {
    let (ring, t) = (ware.foot_ring_mm, ware.thickness_mm);
    let flange = 0.5 * (ware.diameter_mm - ware.well_mm);
    let half = Vector2::new(0.5 * ware.diameter_mm, 0.5 * ware.width_mm);
    let well = half.add_scalar(-flange);
    let foot = well.add_scalar(-0.5 * (ware.well_mm - ware.foot_mm));
    let mut bodies = vec![
        cuboid(at_mm, turn_rad, material, [0.0, 0.0, 0.5 * ring], [foot.x, foot.y, 0.5 * ring]),
        cuboid(at_mm, turn_rad, material, [0.0, 0.0, ring + 0.5 * t], [well.x, well.y, 0.5 * t]),
    ];
    // Of each side: the distance of the rim from the middle, and half of the length.
    let sides = [(half.x, half.y), (half.y, half.x), (half.x, half.y), (half.y, half.x)];
    bodies.extend(sides.into_iter().zip(0_u8..).map(|((out, along), quarter)| {
        let turn_rad = turn_rad + f64::from(quarter) * std::f64::consts::FRAC_PI_2;
        // Its own frame begins in its middle, so that the ball that stands for it in the room's light is not that of the whole plate.
        let middle = Vector3::new(out - 0.5 * flange, 0.0, 0.5 * (ring + ware.height_mm));
        let sides = flange_sides([out - flange, out], along, [ring, ware.height_mm - t], t);
        let sides = sides.map(|(normal, offset)| (normal, offset - normal.dot(&middle)));
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), turn_rad);
        let center = Point3::new(at_mm.x, at_mm.y, 0.0) + turn * middle;
        let reach_mm = along.hypot(0.5 * flange).hypot(0.5 * (ware.height_mm - ring));
        Body { form: Form::Convex(Convex { center, turn_rad, sides, reach_mm }), material: material.clone() }
    }));
    bodies
}

/// The planes of one side of a flange. It reaches from `x[0]` at the well to `x[1]` at the rim, and `along` to either side at the
/// rim. Its underside rises from `z[0]` to `z[1]`, and its upright thickness is `t`. All in mm.
fn flange_sides(x: [f64; 2], along: f64, z: [f64; 2], t: f64) -> [(Vector3<f64>, f64); 6] {
    let up = Vector3::new(z[0] - z[1], 0.0, x[1] - x[0]).normalize();
    let through = |normal: Vector3<f64>, point: [f64; 3]| (normal, normal.dot(&Vector3::from(point)));
    let mitre = |side: f64| Vector3::new(-FRAC_1_SQRT_2, side * FRAC_1_SQRT_2, 0.0);
    [
        through(up, [x[1], 0.0, z[1] + t]),
        through(-up, [x[1], 0.0, z[1]]),
        through(Vector3::x(), [x[1], 0.0, 0.0]),
        through(-Vector3::x(), [x[0], 0.0, 0.0]),
        through(mitre(1.0), [x[1], along, 0.0]),
        through(mitre(-1.0), [x[1], -along, 0.0]),
    ]
}

fn cuboid(at_mm: Point2<f64>, turn_rad: f64, material: &Material, center: [f64; 3], half: [f64; 3]) -> Body {
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), turn_rad);
    let center = Point3::new(at_mm.x, at_mm.y, 0.0) + turn * Vector3::from(center);
    Body { form: Form::Cuboid { center, half: Vector3::from(half), turn_rad }, material: material.clone() }
}
