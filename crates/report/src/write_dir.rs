//! Writes all tables into a folder.

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

use crate::atomic::{self, FileError};
use crate::parquet::Results;
use crate::render::{csv, latex, markdown};
use crate::table::Table;
use crate::tables::{
    accuracy, error_by_height, error_by_pitch, flow, left_out, methods, rater_agreement, sizes, tables,
};

/// Why the tables could not be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The folder cannot be made.
    #[error("cannot make the folder for the tables: {}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// Two tables would have the same file.
    #[error(
        "two tables would both be written to '{stem}.csv'; give each table of study.toml its own id (upper and lower case alone do not tell them apart)"
    )]
    SameFile {
        /// Name of the file, without extension.
        stem: String,
    },
    /// An id that cannot be part of a file's name.
    #[error("expected a table id of letters, digits, '-', '_' and '.', got '{id}'; change it in study.toml")]
    Id {
        /// The id.
        id: String,
    },
    /// A figure of an earlier run, which this run does not draw, could not be removed.
    #[error("this run has no data for a figure that an earlier one wrote, and its file cannot be removed; remove it: {}", path.display())]
    OldFigure {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// A file could not be written.
    #[error(transparent)]
    File(#[from] FileError),
}

/// Writes every table as .csv, .md and .tex, and all of them as `tables.md`: `table_II.csv`, ..., `sizes.csv`,
/// `error_by_pitch.csv`, `error_by_height.csv`, then `accuracy.csv`, `rater_agreement.csv` and `methods.csv` where there is
/// something to compare, and `flow.csv` and `left_out.csv` where the ledger was read. Makes the folder where there is none;
/// every file is written aside and renamed.
///
/// # Errors
/// [`WriteError`]. Ids are checked before anything is written.
pub fn write_dir(results: &Results, dir: &Path) -> Result<(), WriteError> {
    write_tables(results, &every_table(results), dir)
}

/// Writes `tables`, which are those of [`every_table`].
pub(crate) fn write_tables(results: &Results, tables: &[Table], dir: &Path) -> Result<(), WriteError> {
    check_names(results, tables)?;
    std::fs::create_dir_all(dir).map_err(|source| WriteError::Folder { path: dir.to_owned(), source })?;
    for table in tables {
        let file = |extension: &str| dir.join(format!("{}.{extension}", table.stem));
        atomic::write(&file("csv"), csv(table).as_bytes())?;
        atomic::write(&file("md"), markdown(table).as_bytes())?;
        atomic::write(&file("tex"), latex(table).as_bytes())?;
    }
    Ok(atomic::write(&dir.join("tables.md"), all_markdown(tables, results).as_bytes())?)
}

/// All tables of a run: those of the study, the sizes, the errors by pitch and by height, the validation, and the flow of
/// images.
pub(crate) fn every_table(results: &Results) -> Vec<Table> {
    let mut tables = tables(results);
    tables.extend([sizes(results), error_by_pitch(results), error_by_height(results)]);
    let validation = [accuracy(results), rater_agreement(results), methods(results)];
    tables.extend(validation.into_iter().filter(|table| !table.rows.is_empty()));
    tables.extend([flow(results), left_out(results)].into_iter().flatten());
    tables
}

fn check_names(results: &Results, tables: &[Table]) -> Result<(), WriteError> {
    for spec in &results.metadata.tables {
        let fits = |character: char| character.is_alphanumeric() || matches!(character, '-' | '_' | '.');
        if spec.id.is_empty() || !spec.id.chars().all(fits) {
            return Err(WriteError::Id { id: spec.id.clone() });
        }
    }
    let mut seen = BTreeSet::new();
    match tables.iter().find(|table| !seen.insert(table.stem.to_lowercase())) {
        Some(table) => Err(WriteError::SameFile { stem: table.stem.clone() }),
        None => Ok(()),
    }
}

/// All tables as one Markdown document, with the study's statement once, at its head.
fn all_markdown(tables: &[Table], results: &Results) -> String {
    let bare = |table: &Table| Table { statement: None, ..table.clone() };
    let texts: Vec<String> = tables.iter().map(|table| markdown(&bare(table))).collect();
    let title = crate::render::markdown_text(&format!("Tables of {}", results.metadata.study));
    let statement = results.metadata.statement.as_deref().map(crate::render::markdown_text);
    let mut parts = vec![format!("# {title}\n")];
    parts.extend(statement.map(|statement| format!("{statement}\n")));
    parts.extend(texts);
    parts.join("\n")
}
