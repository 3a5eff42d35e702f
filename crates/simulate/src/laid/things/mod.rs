//! Other things on a table: glasses, cutlery, hands, napkins, a telephone, food. Each has a form that follows from its sizes, and
//! a function that draws a random one.

mod cutlery;
mod flat;
mod food;
mod glass;
mod hand;

pub(super) use cutlery::{Cutlery, Utensil};
pub(super) use flat::{Napkin, Telephone};
pub(super) use food::food;
pub use glass::Vessel;
pub(super) use glass::{Glass, WATER};
pub(super) use hand::Hand;

use std::f64::consts::{PI, TAU};

use nalgebra::{Point2, Point3};
use rand::Rng;

/// Lays up to `most` random things around a container, clear of it.
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
                let glass = Glass::random(random, away(70.0));
                vessels.push(glass.vessel);
                glass.bodies()
            }
            1 => Napkin::random(random, away(125.0)).bodies(),
            2 => Telephone::random(random, away(105.0)).bodies(),
            _ => {
                let spot = away(30.0);
                // It lies along a tangent, so that it does not reach into the container.
                let turn = angle + 0.5 * PI;
                let back = nalgebra::Vector2::new(turn.cos(), turn.sin()) * -80.0;
                Cutlery::random(random, Point3::new(spot.x + back.x, spot.y + back.y, 0.0), turn, 0.0).bodies()
            }
        };
        world.bodies.extend(bodies);
    }
    vessels
}
