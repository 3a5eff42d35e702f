//! Reads expected tables from their files.

use std::io;
use std::path::{Path, PathBuf};

/// Name of the optional column of expected files that holds the row's own tolerance.
const TOLERANCE: &str = "tolerance_pct";

/// Why a comparison could not be made.
#[derive(Debug, thiserror::Error)]
pub enum CompareError {
    /// The tolerance is not a number from 0 up.
    #[error("expected a tolerance of 0 per cent or more, got {got}")]
    Tolerance {
        /// The tolerance that was given.
        got: String,
    },
    /// The folder or a file cannot be read.
    #[error("cannot read the expected tables; check the name and your rights: {}", path.display())]
    Read {
        /// The folder or the file.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// There is no CSV file in the folder.
    #[error("no expected tables: expected files like table_II.csv, as 'aim-batch report' writes them, in {}", path.display())]
    NoFiles {
        /// The folder.
        path: PathBuf,
    },
    /// There is not a single number in all files.
    #[error("nothing to compare: the expected tables hold no numbers, in {}", path.display())]
    NothingToCompare {
        /// The folder.
        path: PathBuf,
    },
    /// A file is not CSV.
    #[error("not a CSV table with the same number of cells in every row: {}", path.display())]
    Csv {
        /// The file.
        path: PathBuf,
        /// The error of the CSV reader, with the line.
        source: csv::Error,
    },
    /// A cell does not hold a number.
    #[error("line {line}, column '{column}': expected a number or nothing, got '{got}'; correct it: {}", path.display())]
    Number {
        /// The file.
        path: PathBuf,
        /// Number of the line, counted from 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// The content of the cell.
        got: String,
    },
}

/// The CSV files of a folder, ordered by name.
pub(super) fn csv_files(dir: &Path) -> Result<Vec<PathBuf>, CompareError> {
    let unreadable = |source| CompareError::Read { path: dir.to_owned(), source };
    let entries: Vec<_> = std::fs::read_dir(dir).and_then(Iterator::collect::<Result<_, _>>).map_err(unreadable)?;
    let mut files: Vec<PathBuf> = entries
        .iter()
        .map(std::fs::DirEntry::path)
        .filter(|path| path.extension().is_some_and(|extension| extension == "csv"))
        .collect();
    files.sort();
    if files.is_empty() { Err(CompareError::NoFiles { path: dir.to_owned() }) } else { Ok(files) }
}

/// A file of an expected table.
pub(super) struct ExpectedFile {
    path: PathBuf,
    /// The file's name without extension.
    pub(super) stem: String,
    header: Vec<String>,
    pub(super) rows: Vec<ExpectedRow>,
}

/// A row of an expected table.
pub(super) struct ExpectedRow {
    line: u64,
    cells: csv::StringRecord,
}

impl ExpectedRow {
    pub(super) fn cell(&self, column: usize) -> &str {
        self.cells.get(column).unwrap_or_default()
    }
}

impl ExpectedFile {
    /// The table of a CSV file. Fails where the file cannot be read, or is no CSV with rows of equal length.
    pub(super) fn read(path: &Path) -> Result<Self, CompareError> {
        let bytes = std::fs::read(path).map_err(|source| CompareError::Read { path: path.to_owned(), source })?;
        // Spreadsheets begin UTF-8 files with a byte order mark.
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
        let bad = |source| CompareError::Csv { path: path.to_owned(), source };
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(bytes);
        let header = reader.headers().map_err(bad)?.iter().map(str::to_owned).collect();
        let rows = reader
            .records()
            .map(|record| {
                let cells = record.map_err(bad)?;
                Ok(ExpectedRow { line: cells.position().map_or(0, csv::Position::line), cells })
            })
            .collect::<Result<_, _>>()?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Self { path: path.to_owned(), stem, header, rows })
    }

    pub(super) fn name(&self) -> String {
        format!("{}.csv", self.stem)
    }

    /// The columns, without that of tolerances, with their indices.
    pub(super) fn columns(&self) -> impl Iterator<Item = (usize, &str)> {
        self.header
            .iter()
            .enumerate()
            .filter(|(_, name)| *name != TOLERANCE)
            .map(|(index, name)| (index, name.as_str()))
    }

    /// The number in a cell; none where the cell is empty. Fails where it holds anything else.
    pub(super) fn number(&self, row: &ExpectedRow, column: usize, name: &str) -> Result<Option<f64>, CompareError> {
        let text = row.cell(column);
        if text.is_empty() {
            return Ok(None);
        }
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(Some(number)),
            _ => Err(self.not_a_number(row, name, text)),
        }
    }

    /// The row's own tolerance; none where it has none. Fails where it is no number from 0 up.
    pub(super) fn tolerance(&self, row: &ExpectedRow) -> Result<Option<f64>, CompareError> {
        let Some(column) = self.header.iter().position(|name| name == TOLERANCE) else { return Ok(None) };
        match self.number(row, column, TOLERANCE)? {
            Some(tolerance) if tolerance < 0.0 => Err(self.not_a_number(row, TOLERANCE, row.cell(column))),
            tolerance => Ok(tolerance),
        }
    }

    fn not_a_number(&self, row: &ExpectedRow, column: &str, got: &str) -> CompareError {
        CompareError::Number { path: self.path.clone(), line: row.line, column: column.to_owned(), got: got.to_owned() }
    }
}
