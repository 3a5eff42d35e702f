//! Documents that are made from the code: the data dictionary, the ledger's reasons and the columns of the truth.

use std::fmt::Write as _;

use crate::flow::flow_markdown;
use crate::frame_log::FrameFlag;

use super::{Column, ColumnType, FRAME_COLUMNS, RESULT_COLUMNS, RESULTS_SCHEMA_VERSION, TRUTH_COLUMNS};

/// The Markdown of the data dictionary. A test compares docs/results.md with it.
#[must_use]
pub fn dictionary_markdown() -> String {
    let mut text = format!(
        "# Results: the data dictionary\n\n\
         Made from the schema in `crates/model/src/results/`; `cargo test` compares, \
         `AIM_BATCH_UPDATE=1 cargo test -p aim-batch-model --test dictionary` rewrites it.\n\n\
         Schema version {RESULTS_SCHEMA_VERSION}. It rises when a column is removed or renamed, or changes its type, unit \
         or meaning; a new column at the end does not raise it.\n\
         Rows of results.parquet are ordered by session; in it first those of level frame by time, image, object, rater, \
         quantity and method, then the fused ones by object, rater, quantity and method, then those of level consensus likewise. Rows of frames.parquet are ordered \
         by session, then by time, with the images that could not be used last. The key-value metadata `aim_batch.run` of both files is a JSON object with program version, commit, resolved \
         settings, tables, status of every session and SHA-256 of the inputs: of each file of the study, and of each card one \
         (`cards/SESSION`) over the lines `sha256  path` of its files, which the recording's `aim_batch.inputs` lists. \
         `run.json` beside them holds the same, and the times.\n"
    );
    section(
        &mut text,
        "results.parquet",
        "One row per session, object, rater, quantity, method and level; for level frame one per image.",
        RESULT_COLUMNS,
    );
    section(&mut text, "frames.parquet", "One row per image of the study, kept or dropped.", FRAME_COLUMNS);
    text
}

/// The Markdown of the ledger's reasons. A test compares docs/ledger.md with it.
#[must_use]
pub fn ledger_markdown() -> String {
    let mut text = "# The ledger: why an image was kept or dropped\n\n\
                    Every image of a study has one row in frames.parquet with one reason: the first that applies, in this \
                    order. Images with a pose (the last three) are measured where they are marked; only `selected` ones \
                    count for fused sizes.\n\n\
                    Made from `FrameReason` in `crates/model/src/frame_log.rs` and `FlowStep` in `flow.rs`; `cargo test` compares, \
                    `AIM_BATCH_UPDATE=1 cargo test -p aim-batch-model --test dictionary` rewrites it.\n\n"
        .to_owned();
    text.push_str(&flow_markdown());
    text.push_str(
        "\n## Flags\n\nWarnings about an image's signals (docs/signals.md). A flag drops nothing: it stands in the column \
         `flags` of the image and of the sizes measured on it. Made from `FrameFlag` in the same file.\n\n\
         | flag | meaning |\n|---|---|\n",
    );
    for flag in FrameFlag::ALL {
        let _ = writeln!(text, "| `{}` | {} |", flag.code(), flag.meaning());
    }
    section(&mut text, "The columns of frames.parquet", "As in docs/results.md.", FRAME_COLUMNS);
    text
}

/// The Markdown of the columns of `truth.parquet`. A test compares docs/simulate.md with it.
#[must_use]
pub fn truth_markdown() -> String {
    let mut text = String::new();
    columns_table(&mut text, TRUTH_COLUMNS);
    text
}

fn section(text: &mut String, file: &str, about: &str, columns: &[Column]) {
    let _ = write!(text, "\n## {file}\n\n{about}\n\n");
    columns_table(text, columns);
}

fn columns_table(text: &mut String, columns: &[Column]) {
    text.push_str("| column | type | empty | meaning |\n|---|---|---|---|\n");
    for column in columns {
        let type_name = match column.column_type {
            ColumnType::Text => "text",
            ColumnType::Float => "float64",
            ColumnType::Count => "uint32",
            ColumnType::Flag => "bool",
            ColumnType::TimeUtc => "timestamp[us, UTC]",
        };
        let empty = if column.nullable { "may be" } else { "never" };
        let _ = writeln!(text, "| `{}` | {type_name} | {empty} | {} |", column.name, column.meaning);
    }
}
