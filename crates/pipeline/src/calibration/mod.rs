//! calibration.toml, and its use in a run (docs/calibration.md). The command that learns it is `calibrate`.

mod apply;
mod entries;
mod file;

pub(crate) use apply::{corrected_view, inputs_after, inputs_with, scaled_paper};
pub use entries::{EmpiricalEntry, HeldOutEntry, PhysicalEntry, ProtractorEntry, RefusedEntry};
pub(crate) use entries::{empirical_entry, physical_entry};
pub use file::{CALIBRATION_SCHEMA_VERSION, CalibrationFile, CalibrationFileError};
