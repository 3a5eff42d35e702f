//! The data dictionary, docs/results.md, made from the columns.

use std::fmt::Write as _;

use super::{Column, ColumnType, FRAME_COLUMNS, RESULT_COLUMNS, RESULTS_SCHEMA_VERSION};

/// Markdown of the data dictionary. A test holds docs/results.md against it.
#[must_use]
pub fn dictionary_markdown() -> String {
    let mut text = format!(
        "# Results: the data dictionary\n\n\
         Made from the schema in `crates/model/src/results/`; `cargo test` compares, \
         `AIM_BATCH_UPDATE=1 cargo test -p aim-batch-model --test dictionary` rewrites it.\n\n\
         Schema version {RESULTS_SCHEMA_VERSION}. It rises when a column is removed or renamed, or changes its type, unit \
         or meaning; a new column at the end does not raise it.\n\
         Rows are in a defined order: by session, then by time, object, rater, quantity, method and level as the program \
         met them. The key-value metadata `aim_batch.run` of both files is a JSON object with program version, resolved \
         settings, tables, status of every session and SHA-256 of every input.\n"
    );
    section(
        &mut text,
        "results.parquet",
        "One row per session, object, rater, quantity, method and level.",
        RESULT_COLUMNS,
    );
    section(&mut text, "frames.parquet", "One row per image of the study, kept or dropped.", FRAME_COLUMNS);
    text
}

fn section(text: &mut String, file: &str, about: &str, columns: &[Column]) {
    let _ = write!(text, "\n## {file}\n\n{about}\n\n| column | type | empty | meaning |\n|---|---|---|---|\n");
    for column in columns {
        let type_name = match column.column_type {
            ColumnType::Text => "text",
            ColumnType::Float => "float64",
            ColumnType::Count => "uint32",
            ColumnType::Flag => "bool",
            ColumnType::TimeUtc => "timestamp[ns, UTC]",
        };
        let empty = if column.nullable { "may be" } else { "never" };
        let _ = writeln!(text, "| `{}` | {type_name} | {empty} | {} |", column.name, column.meaning);
    }
}
