//! The results contract: the rows of `results.parquet` and `frames.parquet`.
//!
//! One declaration per column gives the Rust field, its type in the file and its line in the data dictionary
//! (docs/results.md), so the three cannot drift apart.

mod cell;
mod dictionary;
mod level;
mod row;
mod truth;

pub use cell::{Cell, CellError, ColumnType, Value};
pub use dictionary::{dictionary_markdown, ledger_markdown, truth_markdown};
pub use level::Level;
pub use row::{
    Column, FLOW_COLUMNS, FRAME_COLUMNS, FlowRow, FrameRow, RESULT_COLUMNS, RESULTS_SCHEMA_VERSION, ResultRow, Row,
};
pub use truth::{TRUTH_COLUMNS, TRUTH_SCHEMA_VERSION, TruthRow};
