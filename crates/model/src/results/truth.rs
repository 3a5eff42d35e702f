//! The truth of a simulated study: the rows of `truth.parquet`.

use serde::{Deserialize, Serialize};

use super::cell::{Cell, CellError, Value};
use super::row::{Column, Row, schema};
use crate::container::{Kind, Shape};
use crate::time::UtcNs;

/// Version of the schema of `truth.parquet`. It rises by the same rule as that of the results.
pub const TRUTH_SCHEMA_VERSION: u32 = 2;

schema! {
    /// One row of `truth.parquet`: a container in an image of a simulated study, or an image without one.
    TruthRow, TRUTH_COLUMNS {
        session: String = "name of the session: its folder below cards/",
        participant: Option<String> = "who wore the camera; empty on a bench",
        image: String = "file of the image, relative to the card",
        time_utc: UtcNs = "when the image was taken",
        pitch_deg: f64 = "depression of the optical axis below the horizontal",
        roll_deg: f64 = "roll, positive clockwise as the wearer sees it",
        range_mm: f64 = "distance to the table along the optical axis",
        range_seen_mm: Option<f64> = "what the range sensor's cone would read there without noise, over everything that stands in it; empty where the sensor is not modelled so",
        object: Option<String> = "name of the container, as in objects.csv; empty for an image without one",
        kind: Option<Kind> = "plate, bowl or box",
        shape: Option<Shape> = "circle, square or rectangle",
        true_diameter_mm: Option<f64> = "largest diameter of a round rim",
        true_width_mm: Option<f64> = "side of a square, short side of a rectangle",
        true_length_mm: Option<f64> = "long side of a rectangle",
        true_height_mm: Option<f64> = "from the table to the top; empty for a plate that is drawn flat",
        rim_level_mm: Option<f64> = "height at which the rim is widest: half a rounded edge's thickness below the top",
        center_x_mm: Option<f64> = "where the axis meets the table: to the right of the point under the camera",
        center_y_mm: Option<f64> = "where the axis meets the table: away from the wearer, from the point under the camera",
        turn_deg: Option<f64> = "turn of the long side from the direction to the right towards that away from the wearer; 0 for round containers",
        rim_in_picture: Option<f64> = "share of the rim inside the picture, 0 to 1",
        rim_seen: Option<f64> = "share of the rim inside the picture and not hidden by hands or other things",
        marked: bool = "whether the study has marks of it on this image",
    }
}

impl TruthRow {
    /// The row of an image without a container.
    #[must_use]
    pub fn of_image(session: &str, image: &str, time_utc: UtcNs, [pitch_deg, roll_deg, range_mm]: [f64; 3]) -> Self {
        Self {
            session: session.to_owned(),
            participant: None,
            image: image.to_owned(),
            time_utc,
            pitch_deg,
            roll_deg,
            range_mm,
            range_seen_mm: None,
            object: None,
            kind: None,
            shape: None,
            true_diameter_mm: None,
            true_width_mm: None,
            true_length_mm: None,
            true_height_mm: None,
            rim_level_mm: None,
            center_x_mm: None,
            center_y_mm: None,
            turn_deg: None,
            rim_in_picture: None,
            rim_seen: None,
            marked: false,
        }
    }
}
