//! The objects of the bench: their kinds, their colours, and their sizes as the paper gives them.

use model::{Container, Kind, Quantity, Shape};
use serde::Serialize;

use super::tables::{Published, SetupRow, Table};
use crate::scene::Colour;

/// A row of objects.csv.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct ObjectRow {
    object: String,
    kind: Kind,
    shape: Shape,
    true_diameter_mm: Option<f64>,
    true_width_mm: Option<f64>,
    true_length_mm: Option<f64>,
    true_height_mm: Option<f64>,
}

impl ObjectRow {
    fn new(object: &str) -> Self {
        let container = container_of(object);
        Self {
            object: object.to_owned(),
            kind: container.kind,
            shape: container.shape,
            true_diameter_mm: None,
            true_width_mm: None,
            true_length_mm: None,
            true_height_mm: None,
        }
    }

    fn with(mut self, quantity: Quantity, size_cm: f64) -> Self {
        let size_mm = Some((size_cm * 10.0 * 1e6).round() / 1e6); // 0.1 mm is not a binary fraction
        match quantity {
            Quantity::Diameter => self.true_diameter_mm = size_mm,
            Quantity::Width => self.true_width_mm = size_mm,
            Quantity::Length => self.true_length_mm = size_mm,
            Quantity::Height => self.true_height_mm = size_mm,
        }
        self
    }
}

/// The container of an object, from its published name ('circular plate (small)', 'white box', 'pink bowl').
pub(super) fn container_of(object: &str) -> Container {
    let kind = match object {
        name if name.contains("plate") => Kind::Plate,
        name if name.contains("box") => Kind::Box,
        _ => Kind::Bowl,
    };
    let shape = match kind {
        Kind::Box => Shape::Rectangle,
        Kind::Plate if object.starts_with("square") => Shape::Square,
        Kind::Plate | Kind::Bowl => Shape::Circle,
    };
    Container { kind, shape, rim_height_mm: None, wall: None }
}

/// The size across that is marked on an object.
pub(super) fn span_of(container: &Container) -> Quantity {
    match container.shape {
        Shape::Circle => Quantity::Diameter,
        Shape::Square => Quantity::Width,
        Shape::Rectangle => Quantity::Length,
    }
}

/// The colour that an object is drawn in. The paper names those of the worn sessions.
pub(super) fn colour_of(object: &str) -> Colour {
    match object {
        "white box" => [238.0, 238.0, 235.0],
        "pink bowl" => [232.0, 150.0, 172.0],
        "green bowl" => [128.0, 186.0, 122.0],
        name if name.contains("bowl") => [196.0, 214.0, 226.0],
        name if name.starts_with("square") => [226.0, 230.0, 236.0],
        _ => [238.0, 234.0, 224.0],
    }
}

/// All objects, in the order of the tables.
pub(super) fn objects(published: &Published) -> Vec<ObjectRow> {
    let original_cm = |table: &Table<SetupRow>, object: &str| {
        table.rows.iter().find(|row| row.object == object).map(|row| row.original_cm)
    };
    let mut objects = Vec::new();
    for object in published.plates.objects() {
        let row = ObjectRow::new(object);
        objects.push(match original_cm(&published.plates, object) {
            Some(size_cm) => row.with(span_of(&container_of(object)), size_cm),
            None => row,
        });
    }
    for (height, object) in
        published.bowl_heights.objects().into_iter().map(|o| (original_cm(&published.bowl_heights, o), o))
    {
        let mut row = ObjectRow::new(object);
        if let Some(size_cm) = height {
            row = row.with(Quantity::Height, size_cm);
        }
        if let Some(size_cm) = original_cm(&published.bowl_diameters, object) {
            row = row.with(Quantity::Diameter, size_cm);
        }
        objects.push(row);
    }
    for (size, height) in published.container_sizes.rows.iter().zip(&published.container_heights.rows) {
        let row = ObjectRow::new(&size.object).with(size.quantity, size.implied_truth_cm);
        objects.push(row.with(height.quantity, height.implied_truth_cm));
    }
    objects
}
