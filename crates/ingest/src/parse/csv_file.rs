//! A CSV file with a line of column names, then one sample per row.

use std::io::{Error, ErrorKind, Read, Result as IoResult};

use model::UtcNs;

use super::{Converter, Fault, decimal};
use crate::profile::TimeColumn;
use crate::sample::Sample;

const BATCH_ROWS: usize = 1024;
/// A row of numbers is far shorter; a block of zeros on a damaged card has no line ends at all.
const LONGEST_ROW_BYTES: usize = 64 * 1024;

/// Columns that a message lists.
const SHOWN_COLUMNS: usize = 30;

/// Streams the samples of a CSV file, a batch of rows at a time. A row in which a value is empty or NaN is a missing
/// sample.
pub struct CsvSamples<R> {
    csv: csv::Reader<RowLimit<R>>,
    row: csv::ByteRecord,
    columns: Option<Columns>,
    time: TimeColumn,
    value_columns: Vec<String>,
    converter: Converter,
    bad_rows: u64,
    first_bad_row: Option<(u64, String)>,
    end: Option<Fault>,
}

/// Where in a row the columns are.
struct Columns {
    time: usize,
    values: Vec<usize>,
}

impl<R: Read> CsvSamples<R> {
    /// The rows in `reader`. `value_columns`: names of the columns for [`Converter::channels`], in that order.
    pub fn new(reader: R, time: TimeColumn, value_columns: Vec<String>, delimiter: u8, converter: Converter) -> Self {
        let csv = csv::ReaderBuilder::new()
            .has_headers(true)
            .delimiter(delimiter)
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(RowLimit { inner: reader, bytes: 0 });
        let row = csv::ByteRecord::new();
        Self { csv, row, columns: None, time, value_columns, converter, bad_rows: 0, first_bad_row: None, end: None }
    }

    /// Appends the samples of the next rows. False when there are no more rows.
    pub fn next_batch(&mut self, out: &mut Vec<Sample>) -> bool {
        let columns = match self.columns.take().map_or_else(|| self.find_columns(), Ok) {
            Ok(columns) => columns,
            Err(fault) => {
                self.end = Some(fault);
                return false;
            }
        };
        let mut more = true;
        for _ in 0..BATCH_ROWS {
            more = match self.csv.read_byte_record(&mut self.row) {
                Ok(more) => more,
                Err(error) => {
                    self.end = Some(fault_of(&error, self.csv.position()));
                    false
                }
            };
            if !more {
                break;
            }
            self.csv.get_mut().bytes = 0;
            match self.sample(&columns) {
                Ok(sample) => out.extend(sample),
                Err(fact) => self.note_bad_row(fact),
            }
        }
        self.columns = Some(columns);
        more
    }

    /// What was wrong with the file, and the reader.
    pub fn finish(self) -> (Vec<Fault>, R) {
        let rows = self.bad_rows;
        let bad_rows = self.first_bad_row.map(|(first_line, first)| Fault::BadRows { rows, first_line, first });
        (bad_rows.into_iter().chain(self.end).collect(), self.csv.into_inner().inner)
    }

    fn find_columns(&mut self) -> Result<Columns, Fault> {
        let header = match self.csv.byte_headers() {
            Ok(header) => header.clone(),
            Err(error) => return Err(fault_of(&error, self.csv.position())),
        };
        let position = |name: &String| {
            header.iter().position(|column| column == name.as_bytes()).ok_or_else(|| Fault::MissingColumn {
                column: name.clone(),
                found: header.iter().take(SHOWN_COLUMNS).map(shown).collect::<Vec<_>>().join(", "),
            })
        };
        let time = position(&self.time.column)?;
        Ok(Columns { time, values: self.value_columns.iter().map(position).collect::<Result<_, _>>()? })
    }

    fn sample(&self, columns: &Columns) -> Result<Option<Sample>, String> {
        let time = self.time_of(columns)?;
        let mut counts = [0.0; 3];
        let mut is_missing = false;
        for ((count, column), name) in counts.iter_mut().zip(&columns.values).zip(&self.value_columns) {
            let field = self.row.get(*column).ok_or_else(|| format!("the row ends before column '{name}'"))?;
            if field.is_empty() {
                is_missing = true;
                continue;
            }
            let value = std::str::from_utf8(field).ok().and_then(|text| text.parse::<f64>().ok());
            *count = value.ok_or_else(|| format!("column '{name}': '{}' is not a number", shown(field)))?;
            is_missing |= !count.is_finite();
        }
        Ok((!is_missing).then(|| self.converter.sample(time, counts)))
    }

    fn time_of(&self, columns: &Columns) -> Result<UtcNs, String> {
        let name = &self.time.column;
        let field = self.row.get(columns.time).ok_or_else(|| format!("the row ends before column '{name}'"))?;
        let time = decimal::utc_ns(field, self.time.unit.power_of_ten_ns());
        time.ok_or_else(|| format!("column '{name}': '{}' is not a time between 1970 and 2262", shown(field)))
    }

    fn note_bad_row(&mut self, fact: String) {
        self.bad_rows += 1;
        let line = self.row.position().map_or(0, csv::Position::line);
        self.first_bad_row.get_or_insert((line, fact));
    }
}

/// Untrusted bytes for a message: printable and short.
fn shown(bytes: &[u8]) -> String {
    String::from_utf8_lossy(&bytes[..bytes.len().min(40)]).escape_debug().to_string()
}

/// `end`: where reading stopped.
fn fault_of(error: &csv::Error, end: &csv::Position) -> Fault {
    match error.kind() {
        csv::ErrorKind::Io(io) if io.kind() == ErrorKind::InvalidData => {
            Fault::LongLine { line: end.line(), limit: LONGEST_ROW_BYTES }
        }
        _ => Fault::Unreadable { offset: end.byte(), message: error.to_string() },
    }
}

/// Refuses to read on when a row does not end, so that a row never fills the memory.
struct RowLimit<R> {
    inner: R,
    /// Bytes read since the last whole row.
    bytes: usize,
}

impl<R: Read> Read for RowLimit<R> {
    fn read(&mut self, buffer: &mut [u8]) -> IoResult<usize> {
        if self.bytes > LONGEST_ROW_BYTES {
            return Err(Error::new(ErrorKind::InvalidData, "row too long"));
        }
        let got = self.inner.read(buffer)?;
        self.bytes += got;
        Ok(got)
    }
}
