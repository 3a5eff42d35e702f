//! The results contract: the rows of `results.parquet` and `frames.parquet`.
//!
//! One declaration per column gives the Rust field, its type in the file and its line in the data dictionary
//! (docs/results.md), so the three cannot drift apart.

mod cell;
mod dictionary;
mod row;

pub use cell::{Cell, CellError, ColumnType, Value};
pub use dictionary::{dictionary_markdown, ledger_markdown};
pub use row::{Column, FRAME_COLUMNS, FrameRow, Level, RESULT_COLUMNS, RESULTS_SCHEMA_VERSION, ResultRow, Row};
