//! Rows to Parquet files and back. The columns come from the schema in crate `model`, never from a list here.

mod columns;
mod read;
mod row_file;
mod sink;

pub use read::{ReadError, Results, read_frames};
pub use sink::{ParquetSink, SinkError};

/// Key of the schema's version in the key-value metadata.
const VERSION_KEY: &str = "aim_batch.schema_version";
/// Key of the run's metadata, as JSON.
const RUN_KEY: &str = "aim_batch.run";
