//! objects.csv: the objects of a study, with true sizes where they are known.

use std::collections::BTreeMap;
use std::path::Path;

use ingest::nfc;
use model::{Container, Kind, Quantity, Shape, Wall};
use serde::Deserialize;

use super::StudyError;
use super::csv_file::read_rows;

/// One object of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// The container, with what is known of it before it is measured.
    pub container: Container,
    /// The true sizes. Results are compared with them, never measured with them.
    pub truth_mm: BTreeMap<Quantity, f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    object: String,
    kind: Kind,
    shape: Shape,
    #[serde(default)]
    true_diameter_mm: Option<f64>,
    #[serde(default)]
    true_width_mm: Option<f64>,
    #[serde(default)]
    true_length_mm: Option<f64>,
    #[serde(default)]
    true_height_mm: Option<f64>,
    #[serde(default)]
    rim_height_mm: Option<f64>,
    #[serde(default)]
    wall: Option<Wall>,
}

/// The objects of objects.csv, by name.
pub(super) fn read_objects(path: &Path) -> Result<BTreeMap<String, Object>, StudyError> {
    let mut objects = BTreeMap::new();
    for (line_number, mut line) in read_rows::<Line>(path)? {
        line.object = nfc(line.object);
        let refuse = |fact: String| StudyError::Line { path: path.to_owned(), line: line_number, fact };
        if line.object.is_empty() || line.object.contains(|c: char| c == '/' || c.is_control()) {
            return Err(refuse(format!(
                "object '{}': expected a name, without '/' and line breaks",
                line.object.escape_debug()
            )));
        }
        let sizes = [
            (Quantity::Diameter, line.true_diameter_mm),
            (Quantity::Width, line.true_width_mm),
            (Quantity::Length, line.true_length_mm),
            (Quantity::Height, line.true_height_mm),
        ];
        if let Some(bad) =
            sizes.iter().filter_map(|(_, size)| *size).chain(line.rim_height_mm).find(|size| !is_size(*size))
        {
            return Err(refuse(format!("size {bad} mm of '{}': expected a positive number", line.object)));
        }
        let container =
            Container { kind: line.kind, shape: line.shape, rim_height_mm: line.rim_height_mm, wall: line.wall };
        let truth_mm = sizes.into_iter().filter_map(|(quantity, size)| Some((quantity, size?))).collect();
        if objects.insert(line.object.clone(), Object { container, truth_mm }).is_some() {
            return Err(refuse(format!("object '{}' stands here a second time", line.object)));
        }
    }
    Ok(objects)
}

fn is_size(size_mm: f64) -> bool {
    size_mm.is_finite() && size_mm > 0.0
}
