//! Food in containers.

use std::f64::consts::TAU;

use nalgebra::{Point2, Point3, Vector3};
use rand::Rng;

use crate::laid::ware::Ware;
use crate::world::{Body, Form, Material, Rgb, Texture, Turned};

/// Colours of food.
const FOODS: [[Rgb; 2]; 6] = [
    [[0.62, 0.1, 0.04], [0.8, 0.35, 0.1]],
    [[0.75, 0.65, 0.4], [0.85, 0.8, 0.65]],
    [[0.12, 0.3, 0.06], [0.3, 0.5, 0.1]],
    [[0.28, 0.13, 0.05], [0.5, 0.28, 0.12]],
    [[0.8, 0.5, 0.1], [0.85, 0.7, 0.3]],
    [[0.8, 0.78, 0.7], [0.6, 0.5, 0.35]],
];

/// Random food in a container of which it fills a `share`, from 0 to 1: soup or porridge in a bowl, heaps and pieces on a plate.
pub(in crate::laid) fn food(random: &mut impl Rng, ware: &Ware, at: Point2<f64>, share: f64) -> Vec<Body> {
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
