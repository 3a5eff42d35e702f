//! Random tables, their light, and the camera's exposure.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Point2, Point3, Vector2};
use rand::Rng;
use rand_distr::{Distribution, StandardNormal};

use super::ware::Ware;
use crate::world::photo::Exposure;
use crate::world::{Light, Material, Rgb, Texture, World};

/// Colours of wood, between the grain and in it.
const WOODS: [[Rgb; 2]; 4] = [
    [[0.5, 0.33, 0.18], [0.36, 0.21, 0.1]],
    [[0.25, 0.13, 0.07], [0.14, 0.07, 0.04]],
    [[0.65, 0.53, 0.38], [0.52, 0.39, 0.25]],
    [[0.4, 0.2, 0.1], [0.26, 0.12, 0.05]],
];
/// Colours of cloths and of their stripes.
const CLOTHS: [[Rgb; 2]; 4] = [
    [[0.75, 0.73, 0.68], [0.5, 0.1, 0.1]],
    [[0.2, 0.27, 0.4], [0.65, 0.65, 0.62]],
    [[0.6, 0.55, 0.42], [0.35, 0.3, 0.2]],
    [[0.22, 0.32, 0.2], [0.6, 0.58, 0.4]],
];
/// Colours of stone and of its speckles.
const STONES: [[Rgb; 2]; 3] = [
    [[0.62, 0.61, 0.59], [0.3, 0.3, 0.3]],
    [[0.08, 0.08, 0.09], [0.4, 0.4, 0.4]],
    [[0.42, 0.4, 0.36], [0.6, 0.58, 0.55]],
];
/// Colours of the ground of tableware.
const GLAZES: [Rgb; 7] = [
    [0.82, 0.81, 0.78],
    [0.8, 0.77, 0.7],
    [0.78, 0.8, 0.83],
    [0.35, 0.5, 0.52],
    [0.62, 0.2, 0.14],
    [0.16, 0.2, 0.3],
    [0.6, 0.55, 0.42],
];
const PRINTS: [Rgb; 4] = [[0.1, 0.18, 0.45], [0.45, 0.3, 0.08], [0.12, 0.3, 0.15], [0.4, 0.08, 0.1]];

/// A random table with nothing on it.
pub(super) fn bare(random: &mut impl Rng) -> World {
    let seed = random.random();
    let table = match random.random_range(0..5) {
        0 | 1 => {
            let colours = WOODS[random.random_range(0..WOODS.len())];
            let texture = Texture::Wood { colours, board_mm: random.random_range(70.0..160.0), seed };
            Material { gloss: random.random_range(0.0..0.06), ..Material::matt(texture) }
        }
        2 | 3 => Material::matt(Texture::Cloth {
            colours: CLOTHS[random.random_range(0..CLOTHS.len())],
            stripe_mm: random.random_range(18.0..70.0),
            checks: random.random(),
            seed,
        }),
        _ => {
            let colours = STONES[random.random_range(0..STONES.len())];
            Material::glazed(Texture::Speckled { colours, grain_mm: random.random_range(1.5..5.0), share: 0.3, seed })
        }
    };
    World { table, table_mm: ([620.0, 480.0], Point2::new(0.0, 330.0)), bodies: Vec::new(), light: light(random) }
}

fn light(random: &mut impl Rng) -> Light {
    let lamp = random.random_range(0.35..0.75);
    let warm = random.random_range(0.0..0.12);
    Light {
        lamp_mm: Point3::new(
            random.random_range(-700.0..700.0),
            random.random_range(-100.0..900.0),
            random.random_range(800.0..1600.0),
        ),
        lamp_half_mm: [random.random_range(30.0..260.0), random.random_range(30.0..260.0)],
        lamp: [lamp * (1.0 + warm), lamp, lamp * (1.0 - 1.5 * warm)],
        room: [0.38, 0.39, 0.41].map(|c| c * random.random_range(0.8..1.2)),
        window_rad: FRAC_PI_2 + random.random_range(-0.5 * PI..0.5 * PI),
    }
}

/// A random glaze of a container: plain, speckled, or with printed rings and motifs.
pub(super) fn glaze(random: &mut impl Rng, ware: &Ware) -> Material {
    let ground = GLAZES[random.random_range(0..GLAZES.len())];
    let print = PRINTS[random.random_range(0..PRINTS.len())];
    let rim_mm = 0.5 * ware.diameter_mm;
    let texture = match random.random_range(0..4) {
        0 if ware.is_round() => {
            let inner = random.random_range(0.72..0.86) * rim_mm;
            Texture::Printed {
                colours: [ground, print],
                rings_mm: [[inner, inner + 2.5], [0.94 * rim_mm, 0.94 * rim_mm + random.random_range(1.0..4.0)]],
                motifs: (random.random_range(0..16), 0.9 * rim_mm, 0.05 * rim_mm),
            }
        }
        1 => Texture::Speckled {
            colours: [ground, ground.map(|c| 0.5 * c)],
            grain_mm: 1.6,
            share: 0.15,
            seed: random.random(),
        },
        _ => Texture::Plain(ground),
    };
    Material::glazed(texture)
}

/// A random exposure of a picture that is `width_px` wide. `motion` is the SD of the head's motion while the picture is taken, as
/// a share of the width.
pub(super) fn exposure(random: &mut impl Rng, width_px: u32, motion: f64) -> Exposure {
    let width = f64::from(width_px);
    let mut normal = || -> f64 { StandardNormal.sample(random) };
    let motion_px = Vector2::new(normal(), normal()) * (motion * width);
    let balance = [1.0 + 0.05 * normal(), 1.0, 1.0 + 0.05 * normal()];
    Exposure {
        gain: random.random_range(0.6..1.15),
        balance,
        vignetting: random.random_range(0.1..0.4),
        motion_px,
        blur_px: random.random_range(0.5..0.8) * (width / 1296.0).max(0.6),
        read_noise: random.random_range(0.001..0.004),
        full_well: random.random_range(2500.0..8000.0),
    }
}
