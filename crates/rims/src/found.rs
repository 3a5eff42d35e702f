//! The facts about a rim that was found, besides its points; they go with the points wherever those go.

use model::{Container, Kind, Shape};
use serde::{Deserialize, Serialize};

use crate::rim::Rim;
use crate::rim_height::{RimHeight, as_judged};

/// The facts about a rim that was found. A file of marks keeps them beside the points, so that a rim measures the same when it is read
/// from there.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Found {
    /// The kind that it looks like.
    pub kind: Kind,
    /// The shape of its outline. Files state it for rectangles only.
    #[serde(default = "circle", skip_serializing_if = "is_circle")]
    pub shape: Shape,
    /// From 0 to 1: how sure it is that this is the rim of a container.
    pub confidence: f64,
    /// Length of the rim in the picture, in pixels.
    pub perimeter_px: f64,
    /// The height of the rim above the table, if it is a bowl's.
    pub height: RimHeight,
    /// The height of the rim above the table, if it is a plate's; none in files of versions that took plates to lie on the table.
    #[serde(default)]
    pub plate_height: Option<RimHeight>,
}

fn circle() -> Shape {
    Shape::Circle
}

fn is_circle(shape: &Shape) -> bool {
    *shape == Shape::Circle
}

impl Rim {
    /// Returns the facts about it besides its points, as for its only picture.
    #[must_use]
    pub fn found(&self) -> Found {
        let Self { kind, confidence, perimeter_px, .. } = *self;
        let shape = self.shape();
        let (plate_height, height) = as_judged(self.plate_height, self.height, self.plate_log_odds);
        Found { kind, shape, confidence, perimeter_px, height, plate_height: Some(plate_height) }
    }
}

impl Found {
    /// The container that it looks like; its height and its wall are not known.
    #[must_use]
    pub fn container(&self) -> Container {
        Container { kind: self.kind, shape: self.shape, rim_height_mm: None, wall: None }
    }

    /// Returns the fault of its numbers, if they have one: they may come from a file that somebody edited.
    #[must_use]
    pub fn fault(&self) -> Option<&'static str> {
        let not_negative = |number: f64| number.is_finite() && number >= 0.0;
        if !(0.0..=1.0).contains(&self.confidence) {
            Some("confidence: expected 0 to 1")
        } else if !(self.perimeter_px.is_finite() && self.perimeter_px > 0.0) {
            Some("perimeter_px: expected a positive number")
        } else if ![Some(self.height), self.plate_height]
            .into_iter()
            .flatten()
            .all(|height| not_negative(height.mm) && not_negative(height.sigma_mm))
        {
            Some("height: expected zero or positive numbers")
        } else {
            None
        }
    }
}
