//! A CSV file, one sample per row.

use std::borrow::Cow;
use std::io::Read;

use jiff::tz::TimeZone;

use super::csv_columns::{Columns, shown};
use super::csv_rows::CsvRows;
use super::possible::PossibleCounts;
use super::raw::{RawBlock, Stamps};
use super::written_time::{self, WrittenTime};
use super::{Converter, Fault, decimal};
use crate::profile::{CsvFormat, RowTime};

/// Rows per block.
const BATCH_ROWS: usize = 1024;

/// The columns to read from a CSV file, and its form.
#[derive(Debug, Clone)]
pub struct CsvLayout {
    /// The form of the file.
    pub format: CsvFormat,
    /// The source of a row's time.
    pub time: RowTime,
    /// Columns for [`Converter::channels`], in that order.
    pub values: Vec<String>,
    /// Columns to carry along.
    pub extra: Vec<String>,
    /// To physical units.
    pub converter: Converter,
}

/// Streams the samples of a CSV file, a batch of rows at a time. A row in which a value is empty or NaN is a missing
/// sample.
pub struct CsvSamples<R: Read> {
    rows: CsvRows<R>,
    layout: CsvLayout,
    columns: Option<Columns>,
    read: u64,
    bad_rows: u64,
    bad_bytes: u64,
    first_bad_row: Option<(u64, String)>,
    possible: Option<PossibleCounts>,
    impossible: u64,
    first_impossible: Option<String>,
    end: Option<Fault>,
}

/// The content of a row that can be read.
enum Row {
    Sample,
    /// A value is empty or NaN.
    Missing,
    /// Counts that the sensor cannot give.
    Impossible([f64; 3]),
}

/// A batch as it grows.
#[derive(Default)]
struct Batch {
    stamps: Vec<i64>,
    counts: Vec<Vec<f64>>,
    extra: Vec<Vec<f32>>,
    /// Rows taken by number, where there is no time column.
    present: Vec<u32>,
    missing: u64,
}

impl<R: Read> CsvSamples<R> {
    /// The rows in `reader`.
    pub fn new(reader: R, layout: CsvLayout) -> Self {
        let rows = CsvRows::new(reader, layout.format.delimiter);
        Self {
            rows,
            possible: layout.converter.possible_counts(),
            layout,
            columns: None,
            read: 0,
            bad_rows: 0,
            bad_bytes: 0,
            first_bad_row: None,
            impossible: 0,
            first_impossible: None,
            end: None,
        }
    }

    /// The next rows. None when there are no more.
    pub fn next_block(&mut self) -> Option<RawBlock> {
        if self.end.is_some() {
            return None;
        }
        let columns = match self.columns.take().map_or_else(|| Columns::find(&mut self.rows, &self.layout), Ok) {
            Ok(columns) => columns,
            Err(fault) => {
                self.end = Some(fault);
                return None;
            }
        };
        let first = self.read;
        let mut batch = Batch::default();
        batch.counts.resize(columns.values.len(), Vec::with_capacity(BATCH_ROWS));
        batch.extra.resize(columns.extra.len(), Vec::with_capacity(BATCH_ROWS));
        let read = (0..BATCH_ROWS).take_while(|_| self.read_row(&columns, &mut batch)).count();
        self.columns = Some(columns);
        (read > 0).then(|| self.block(batch, first, read))
    }

    /// Returns the faults of the file, and the reader.
    pub fn finish(self) -> (Vec<Fault>, R) {
        let (rows, bytes) = (self.bad_rows, self.bad_bytes);
        let bad_rows = self.first_bad_row.map(|(first_line, first)| Fault::BadRows { rows, bytes, first_line, first });
        let (samples, of) = (self.impossible, self.read);
        let impossible = self.first_impossible.map(|first| Fault::ImpossibleAcceleration { samples, of, first });
        (bad_rows.into_iter().chain(impossible).chain(self.end).collect(), self.rows.into_inner())
    }

    fn block(&self, batch: Batch, first: u64, read: usize) -> RawBlock {
        let has_all = batch.present.len() == read;
        let samples = u32::try_from(read).unwrap_or(u32::MAX);
        let stamps = match self.layout.time.column {
            Some(_) => Stamps::Each(batch.stamps),
            None => Stamps::Counted { first, samples, present: (!has_all).then_some(batch.present) },
        };
        let channels = self.layout.converter.convert(&batch.counts);
        let (extra, missing) = (batch.extra, batch.missing);
        RawBlock { stamps, sequence: None, channels, extra, missing, impossible: None, declared_rate_hz: None }
    }

    /// Reads a row into the batch. False at the end of the file.
    fn read_row(&mut self, columns: &Columns, batch: &mut Batch) -> bool {
        match self.rows.next_row() {
            Ok(true) => {}
            Ok(false) => return false,
            Err(fault) => {
                self.end = Some(fault);
                return false;
            }
        }
        let number = u32::try_from(self.read % BATCH_ROWS as u64).unwrap_or(0);
        self.read += 1;
        match self.sample(columns, batch) {
            Ok(Row::Sample) => batch.present.push(number),
            Ok(Row::Missing) => batch.missing += 1,
            Ok(Row::Impossible(counts)) => self.note_impossible(counts),
            Err(fact) => self.note_bad_row(fact),
        }
        true
    }

    /// Appends the row, if it holds a sample.
    fn sample(&self, columns: &Columns, batch: &mut Batch) -> Result<Row, String> {
        columns.check_width(&self.rows)?;
        let stamp = columns.time.map(|column| self.stamp(column)).transpose()?;
        let mut counts = [0.0; 3];
        for ((count, column), name) in counts.iter_mut().zip(&columns.values).zip(&self.layout.values) {
            let field = self.rows.get(*column).ok_or_else(|| format!("the row ends before column '{name}'"))?;
            *count = self.count(field).ok_or_else(|| format!("column '{name}': '{}' is not a number", shown(field)))?;
        }
        if counts.iter().any(|count| count.is_nan()) {
            return Ok(Row::Missing);
        }
        if self.possible.is_some_and(|possible| !possible.contain(counts)) {
            return Ok(Row::Impossible(counts));
        }
        batch.stamps.extend(stamp);
        for (column, count) in batch.counts.iter_mut().zip(counts) {
            column.push(count);
        }
        for (values, column) in batch.extra.iter_mut().zip(&columns.extra) {
            let value = self.rows.get(*column).and_then(|field| self.number(field)).unwrap_or(f64::NAN);
            #[expect(clippy::cast_possible_truncation, reason = "carried, not used")]
            values.push(value as f32);
        }
        Ok(Row::Sample)
    }

    /// The count in a field, words for 'no target' included. NaN where there is none; none for anything else.
    fn count(&self, field: &[u8]) -> Option<f64> {
        let number = self.number(field).filter(|number| number.is_finite());
        number.or_else(|| {
            let word = self.layout.converter.count_of_word(field.trim_ascii());
            word.or_else(|| self.number(field).map(|_| f64::NAN))
        })
    }

    /// A decimal number; NaN for an empty field. None for anything else.
    fn number(&self, field: &[u8]) -> Option<f64> {
        let field = field.trim_ascii();
        if field.is_empty() {
            return Some(f64::NAN);
        }
        fast_float2::parse(&*self.with_point(field)).ok()
    }

    /// The number with a point where the file has a comma.
    fn with_point<'f>(&self, field: &'f [u8]) -> Cow<'f, [u8]> {
        if !self.layout.format.decimal_comma {
            return Cow::Borrowed(field);
        }
        let point = |byte: &u8| if *byte == b',' { b'.' } else { *byte };
        field.iter().map(point).collect()
    }

    fn stamp(&self, column: usize) -> Result<i64, String> {
        let RowTime { column: name, unit, format, .. } = &self.layout.time;
        let name = name.as_deref().unwrap_or_default();
        let field = self.rows.get(column).ok_or_else(|| format!("the row ends before column '{name}'"))?.trim_ascii();
        if let Some(format) = format {
            let wrong = |why: String| format!("column '{name}': '{}' does not fit '{format}': {why}", shown(field));
            return civil_ns(field, format).map_err(wrong);
        }
        let power = unit.unwrap_or_default().power_of_ten_ns();
        decimal::ns(&self.with_point(field), power)
            .ok_or_else(|| format!("column '{name}': '{}' is no time", shown(field)))
    }

    fn note_impossible(&mut self, counts: [f64; 3]) {
        self.impossible += 1;
        let line = self.rows.line();
        self.first_impossible.get_or_insert_with(|| format!("in line {line}: {counts:?}"));
    }

    fn note_bad_row(&mut self, fact: String) {
        self.bad_rows += 1;
        self.bad_bytes += self.rows.row_bytes() as u64;
        let line = self.rows.line();
        self.first_bad_row.get_or_insert((line, fact));
    }
}

/// A date and time as text: with an offset in ns since 1970 UTC, without one in ns since 1970-01-01 on the wall clock.
fn civil_ns(field: &[u8], format: &str) -> Result<i64, String> {
    let timestamp = match written_time::parse(field, format, false)? {
        WrittenTime::Utc(timestamp) => timestamp,
        WrittenTime::InZone(civil, zone) => {
            let zoned = zone.to_ambiguous_zoned(civil).unambiguous().map_err(|error| error.to_string())?;
            zoned.timestamp()
        }
        WrittenTime::Local(civil) => TimeZone::UTC.to_timestamp(civil).map_err(|error| error.to_string())?,
    };
    i64::try_from(timestamp.as_nanosecond()).map_err(|error| error.to_string())
}
