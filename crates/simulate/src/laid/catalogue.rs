//! The eight containers of the presets `bench` and `worn`.

use model::{Kind, Shape};

use super::ware::{Wall, Ware};

/// Names and sizes. Plates and bowls differ in everything that changes the look of a rim: flange or none, well, wall, foot and
/// thickness.
pub(super) const WARES: [(&str, Ware); 8] = [
    ("dinner plate", plate(268.0, 24.0, 150.0, 184.0)),
    ("side plate", plate(192.0, 19.0, 108.0, 128.0)),
    ("coupe plate", plate(226.0, 23.0, 130.0, 226.0)),
    ("deep plate", plate(232.0, 36.0, 112.0, 150.0)),
    ("straight bowl", bowl(150.0, 58.0, 84.0, Wall::Straight)),
    ("rice bowl", bowl(118.0, 62.0, 52.0, Wall::Curved(0.9))),
    ("salad bowl", bowl(208.0, 82.0, 104.0, Wall::Curved(0.6))),
    (
        "lunch box",
        Ware {
            kind: Kind::Box,
            shape: Shape::Rectangle,
            width_mm: 120.0,
            thickness_mm: 3.0,
            ..bowl(180.0, 54.0, 120.0, Wall::Straight)
        },
    ),
];

const fn plate(diameter_mm: f64, height_mm: f64, foot_mm: f64, well_mm: f64) -> Ware {
    Ware::plate(Shape::Circle, [diameter_mm, diameter_mm], height_mm, foot_mm, well_mm)
}

const fn bowl(diameter_mm: f64, height_mm: f64, foot_mm: f64, wall: Wall) -> Ware {
    Ware::bowl(diameter_mm, height_mm, foot_mm, wall)
}
