//! What else lies on a table: glasses, cutlery, hands, napkins, a telephone, food.

use std::f64::consts::{PI, TAU};

use nalgebra::{Point2, Point3, Rotation3, Vector3};
use rand::Rng;

use super::ware::Ware;
use crate::world::{Body, Form, Material, Rgb, Texture, Turned};

/// A drinking glass: not one of the containers, but round, and higher than wide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vessel {
    /// Where its axis meets the table.
    pub at_mm: Point2<f64>,
    /// Of foot and rim.
    pub diameters_mm: [f64; 2],
    /// From the table to its rim.
    pub height_mm: f64,
}

const STEEL: Rgb = [0.5, 0.5, 0.52];

/// A drinking glass with water, seen through.
fn glass(random: &mut impl Rng, at: Point2<f64>) -> (Vec<Body>, Vessel) {
    let (top, foot) = (random.random_range(30.0..42.0), random.random_range(24.0..30.0));
    let height = random.random_range(85.0..140.0);
    let clear = |colour: Rgb| Material { texture: Texture::Plain(colour), gloss: 0.06, clear: 0.9, glows: false };
    let outside =
        Turned::new(at, &[[0.0, 0.0], [foot, 0.0], [top, height], [top - 2.0, height], [foot - 2.0, 6.0], [0.0, 6.0]]);
    let drink = random.random_range(0.3..0.8);
    let [z, r] = [6.0 + drink * (height - 6.0), foot - 2.5 + drink * (top - foot)];
    let colour = if random.random_bool(0.5) { [0.97, 0.99, 1.0] } else { [0.9, 0.55, 0.15] };
    let bodies = vec![
        Body { form: Form::Turned(outside), material: clear([0.96, 0.98, 0.98]) },
        Body { form: Form::Turned(Turned::new(at, &[[foot - 2.5, 6.5], [r, z], [0.0, z]])), material: clear(colour) },
    ];
    (bodies, Vessel { at_mm: at, diameters_mm: [2.0 * foot, 2.0 * top], height_mm: height })
}

/// Knife, fork or spoon: a handle that lies on what is below it, with a blade, prongs or a hollow.
pub(super) fn cutlery(random: &mut impl Rng, at: Point3<f64>, turn_rad: f64, rise_rad: f64) -> Vec<Body> {
    let steel = Material { texture: Texture::Plain(STEEL), gloss: 0.55, clear: 0.0, glows: false };
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), turn_rad)
        * Rotation3::from_axis_angle(&Vector3::y_axis(), -rise_rad);
    let place = |x: f64, y: f64, z: f64| at + turn * Vector3::new(x, y, z);
    let rod = |a: Point3<f64>, b: Point3<f64>, radius: f64| Body {
        form: Form::Capsule { ends: [a, b], radius },
        material: steel.clone(),
    };
    let mut bodies = vec![rod(place(0.0, 0.0, 4.0), place(110.0, 0.0, 4.0), 3.5)];
    match random.random_range(0..3) {
        0 => bodies.push(Body {
            form: Form::Ellipsoid { center: place(130.0, 0.0, 4.0), half: Vector3::new(27.0, 17.0, 4.0), turn_rad },
            material: steel.clone(),
        }),
        1 => bodies.extend((0..4).map(|prong| {
            let y = f64::from(prong) * 6.0 - 9.0;
            rod(place(118.0, y, 4.5), place(165.0, y, 4.5), 1.5)
        })),
        _ => bodies.push(Body {
            form: Form::Cuboid { center: place(150.0, 0.0, 4.0), half: Vector3::new(45.0, 9.0, 1.0), turn_rad },
            material: steel.clone(),
        }),
    }
    bodies
}

/// A hand with an arm behind it: palm, four fingers of three bones each, a thumb. `reach` is where the fingertips are;
/// `from` where the elbow is.
pub(super) fn hand(random: &mut impl Rng, reach: Point3<f64>, from: Point3<f64>, skin: Rgb) -> Vec<Body> {
    let skin = Material::matt(Texture::Speckled {
        colours: [skin, skin.map(|c| 0.85 * c)],
        grain_mm: 5.0,
        share: 0.3,
        seed: random.random(),
    });
    let along = (reach - from).normalize();
    let aside = along.cross(&Vector3::z()).normalize();
    let rod = |a: Point3<f64>, b: Point3<f64>, radius: f64| Body {
        form: Form::Capsule { ends: [a, b], radius },
        material: skin.clone(),
    };
    let wrist = reach - along * 165.0 + Vector3::z() * 18.0;
    let mut bodies = vec![rod(from, wrist, 33.0)];
    let curl = random.random_range(0.1..0.5);
    for finger in 0..4 {
        let y = f64::from(finger) * 19.0 - 28.0;
        let length = [66.0, 80.0, 84.0, 72.0][finger as usize];
        let knuckle = reach - along * 85.0 + aside * y + Vector3::z() * 22.0;
        bodies.push(rod(wrist + aside * (0.6 * y), knuckle, 14.0));
        let mut joint = knuckle;
        for (bone, share) in [0.45, 0.3, 0.25].into_iter().enumerate() {
            #[expect(clippy::cast_precision_loss, reason = "three bones")]
            let bend = curl * (bone as f64 + 0.5);
            let next = joint + (along * bend.cos() - Vector3::z() * bend.sin()) * (share * length);
            bodies.push(rod(joint, next, 9.5 - 0.8 * f64::from(u8::try_from(bone).unwrap_or(0))));
            joint = next;
        }
    }
    let thumb = reach - along * 120.0 - aside * 40.0 + Vector3::z() * 12.0;
    bodies.extend([rod(wrist - aside * 15.0, thumb, 14.0), rod(thumb, thumb + along * 55.0 + aside * 12.0, 11.0)]);
    bodies
}

/// A folded napkin.
pub(super) fn napkin(random: &mut impl Rng, at: Point2<f64>) -> Vec<Body> {
    let colour: Rgb = [[0.85, 0.83, 0.8], [0.55, 0.12, 0.12], [0.2, 0.3, 0.5]][random.random_range(0..3)];
    let texture = Texture::Cloth {
        colours: [colour, colour.map(|c| 0.8 * c)],
        stripe_mm: 22.0,
        checks: true,
        seed: random.random(),
    };
    let half = Vector3::new(random.random_range(50.0..85.0), random.random_range(50.0..85.0), 2.0);
    vec![Body {
        form: Form::Cuboid { center: Point3::new(at.x, at.y, 2.0), half, turn_rad: random.random_range(0.0..PI) },
        material: Material::matt(texture),
    }]
}

/// A telephone with a lit screen.
pub(super) fn telephone(random: &mut impl Rng, at: Point2<f64>) -> Vec<Body> {
    let turn_rad = random.random_range(-0.7..0.7);
    let slab = |z: f64, half: Vector3<f64>, material| Body {
        form: Form::Cuboid { center: Point3::new(at.x, at.y, z), half, turn_rad },
        material,
    };
    let screen = Material { glows: true, ..Material::glazed(Texture::Screen { seed: random.random() }) };
    vec![
        slab(4.0, Vector3::new(37.0, 76.0, 4.0), Material::glazed(Texture::Plain([0.03; 3]))),
        slab(8.0, Vector3::new(33.0, 70.0, 0.3), screen),
    ]
}

/// Colours of food.
const FOODS: [[Rgb; 2]; 6] = [
    [[0.62, 0.1, 0.04], [0.8, 0.35, 0.1]],
    [[0.75, 0.65, 0.4], [0.85, 0.8, 0.65]],
    [[0.12, 0.3, 0.06], [0.3, 0.5, 0.1]],
    [[0.28, 0.13, 0.05], [0.5, 0.28, 0.12]],
    [[0.8, 0.5, 0.1], [0.85, 0.7, 0.3]],
    [[0.8, 0.78, 0.7], [0.6, 0.5, 0.35]],
];

/// Food in a container, filled so far (from 0 to 1): soup or porridge in a bowl, heaps and pieces on a plate.
pub(super) fn food(random: &mut impl Rng, ware: &Ware, at: Point2<f64>, share: f64) -> Vec<Body> {
    let [z, radius] = ware.filled_mm(share);
    let mut stuff = || {
        let colours = FOODS[random.random_range(0..FOODS.len())];
        Material {
            gloss: 0.02,
            ..Material::matt(Texture::Food { colours, grain_mm: random.random_range(3.0..14.0), seed: random.random() })
        }
    };
    let mut bodies = Vec::new();
    match ware.kind {
        model::Kind::Bowl => {
            let heap = 0.1 * radius;
            let top = Turned::new(
                at,
                &[
                    [radius + 1.0, z - 1.0],
                    [0.8 * radius, z + 0.6 * heap],
                    [0.4 * radius, z + heap],
                    [0.0, z + 1.1 * heap],
                ],
            );
            bodies.push(Body { form: Form::Turned(top), material: stuff() });
        }
        model::Kind::Plate => {
            bodies.extend([stuff(), stuff()].into_iter().zip([-0.3, 0.35]).map(|(material, x)| Body {
                form: Form::Ellipsoid {
                    center: Point3::new(at.x + x * radius, at.y - x * 0.5 * radius, 6.0),
                    half: Vector3::new(0.5 * radius, 0.38 * radius, 8.0 + 22.0 * share),
                    turn_rad: 3.0 * x,
                },
                material,
            }))
        }
        model::Kind::Box => {}
    }
    let material = stuff();
    let pieces = random.random_range(4..10);
    let reach = if ware.kind == model::Kind::Box { 0.3 * ware.width_mm } else { 0.75 * radius };
    let low = if ware.kind == model::Kind::Bowl { z } else { 8.0 };
    bodies.extend((0..pieces).map(|_| {
        let (turn, away) = (random.random_range(0.0..TAU), reach * random.random_range(0.0_f64..1.0).sqrt());
        Body {
            form: Form::Ellipsoid {
                center: Point3::new(at.x + away * turn.cos(), at.y + away * turn.sin(), low + 4.0),
                half: Vector3::new(
                    random.random_range(6.0..16.0),
                    random.random_range(5.0..11.0),
                    random.random_range(4.0..9.0),
                ),
                turn_rad: turn,
            },
            material: material.clone(),
        }
    }));
    bodies
}

/// Lays up to so many things around a container, clear of it.
pub(super) fn beside(
    random: &mut impl Rng,
    world: &mut crate::world::World,
    at: Point2<f64>,
    radius: f64,
    most: usize,
) -> Vec<Vessel> {
    let mut vessels = Vec::new();
    let number = random.random_range(0..=most);
    let first = random.random_range(0.0..TAU);
    for place in 0..number {
        #[expect(clippy::cast_precision_loss, reason = "a few things")]
        let angle = first + TAU * (place as f64 + random.random_range(-0.2..0.2)) / number as f64;
        let away = |clear: f64| at + nalgebra::Vector2::new(angle.cos(), angle.sin()) * (radius + clear);
        let bodies = match random.random_range(0..5) {
            0 => {
                let (bodies, vessel) = glass(random, away(70.0));
                vessels.push(vessel);
                bodies
            }
            1 => napkin(random, away(125.0)),
            2 => telephone(random, away(105.0)),
            _ => {
                let spot = away(30.0);
                // Along a tangent, so that it does not reach into the container.
                let turn = angle + 0.5 * PI;
                let back = nalgebra::Vector2::new(turn.cos(), turn.sin()) * -80.0;
                cutlery(random, Point3::new(spot.x + back.x, spot.y + back.y, 0.0), turn, 0.0)
            }
        };
        world.bodies.extend(bodies);
    }
    vessels
}
