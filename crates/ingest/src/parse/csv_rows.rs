//! The rows of a CSV file, and their fields.
//!
//! Logs of sensors are numbers, so a row without a quote is split at its delimiters and nothing else; the csv crate reads
//! rows that have one. A quoted field does not go on in the next line.

use std::io::{ErrorKind, Read};
use std::ops::Range;

use memchr::{memchr, memchr_iter};

use super::Fault;

/// A row of numbers is far shorter; a block of zeros on a damaged card has no line ends at all.
const LONGEST_ROW_BYTES: usize = 64 * 1024;
const BUFFER_BYTES: usize = 256 * 1024;

/// Reads a file row by row. Rows without any byte are passed over.
pub(super) struct CsvRows<R> {
    reader: R,
    delimiter: u8,
    bytes: Vec<u8>,
    /// The place in `bytes` where the next line begins, and where what has been read ends.
    next: usize,
    end: usize,
    /// The place in the file where `bytes` begins.
    offset: u64,
    at_end: bool,
    lines: u64,
    row: Range<usize>,
    fields: Vec<Range<usize>>,
    /// The row with its quotes taken off; `fields` then point into it.
    unquoted: Option<Vec<u8>>,
}

impl<R: Read> CsvRows<R> {
    pub fn new(reader: R, delimiter: char) -> Self {
        Self {
            reader,
            delimiter: u8::try_from(delimiter).unwrap_or(b','),
            bytes: vec![0; BUFFER_BYTES],
            next: 0,
            end: 0,
            offset: 0,
            at_end: false,
            lines: 0,
            row: 0..0,
            fields: Vec::new(),
            unquoted: None,
        }
    }

    /// Goes to the next row. False at the end of the file.
    pub fn next_row(&mut self) -> Result<bool, Fault> {
        loop {
            let Some(line) = self.next_line()? else { return Ok(false) };
            let is_first = self.lines == 1;
            let bytes = &self.bytes[line.clone()];
            let start = if is_first && bytes.starts_with(b"\xef\xbb\xbf") { line.start + 3 } else { line.start };
            let end = if bytes.ends_with(b"\r") { line.end - 1 } else { line.end };
            if start < end {
                self.row = start..end;
                self.split();
                return Ok(true);
            }
        }
    }

    /// Passes over a line, whatever is in it. False at the end of the file.
    pub fn skip_line(&mut self) -> Result<bool, Fault> {
        self.next_line().map(|line| line.is_some())
    }

    /// Field `i` of the row.
    pub fn get(&self, i: usize) -> Option<&[u8]> {
        self.fields.get(i).map(|field| self.field(field))
    }

    /// All fields of the row.
    pub fn fields(&self) -> impl Iterator<Item = &[u8]> {
        self.fields.iter().map(|field| self.field(field))
    }

    /// Number of the row's line, from 1.
    pub fn line(&self) -> u64 {
        self.lines
    }

    /// Bytes of the row.
    pub fn row_bytes(&self) -> usize {
        self.row.len()
    }

    pub fn into_inner(self) -> R {
        self.reader
    }

    fn field(&self, field: &Range<usize>) -> &[u8] {
        let bytes = self.unquoted.as_deref().unwrap_or(&self.bytes);
        bytes.get(field.clone()).unwrap_or_default()
    }

    fn split(&mut self) {
        self.fields.clear();
        let row = &self.bytes[self.row.clone()];
        self.unquoted = None;
        if memchr(b'"', row).is_some() {
            self.split_quoted();
            return;
        }
        let mut start = self.row.start;
        for delimiter in memchr_iter(self.delimiter, row) {
            let end = self.row.start + delimiter;
            self.fields.push(start..end);
            start = end + 1;
        }
        self.fields.push(start..self.row.end);
    }

    fn split_quoted(&mut self) {
        let row = &self.bytes[self.row.clone()];
        let mut csv = csv::ReaderBuilder::new().has_headers(false).delimiter(self.delimiter).from_reader(row);
        let mut record = csv::ByteRecord::new();
        let is_row = csv.read_byte_record(&mut record).unwrap_or(false);
        let ranges = (0..record.len()).filter_map(|i| record.range(i));
        self.fields.extend(ranges.filter(|_| is_row));
        self.unquoted = Some(record.as_slice().to_vec());
    }

    /// The next line, without its end.
    fn next_line(&mut self) -> Result<Option<Range<usize>>, Fault> {
        let mut searched = self.next;
        loop {
            if let Some(found) = memchr(b'\n', &self.bytes[searched..self.end]) {
                let line = self.next..searched + found;
                if line.len() > LONGEST_ROW_BYTES {
                    return Err(self.long_line());
                }
                self.next = line.end + 1;
                self.lines += 1;
                return Ok(Some(line));
            }
            if self.end - self.next > LONGEST_ROW_BYTES {
                return Err(self.long_line());
            }
            if self.at_end {
                let line = self.next..self.end;
                self.next = self.end;
                self.lines += u64::from(!line.is_empty());
                return Ok((!line.is_empty()).then_some(line));
            }
            searched = self.end - self.next;
            self.read_on()?;
        }
    }

    fn long_line(&mut self) -> Fault {
        Fault::LongLine { line: self.lines + 1, limit: LONGEST_ROW_BYTES }
    }

    /// Moves what is left to the front, and reads behind it.
    fn read_on(&mut self) -> Result<(), Fault> {
        self.bytes.copy_within(self.next..self.end, 0);
        self.offset += self.next as u64;
        self.end -= self.next;
        self.next = 0;
        loop {
            match self.reader.read(&mut self.bytes[self.end..]) {
                Ok(0) => self.at_end = true,
                Ok(got) => self.end += got,
                Err(error) if error.kind() == ErrorKind::Interrupted => continue,
                Err(error) => {
                    let offset = self.offset + self.end as u64;
                    return Err(Fault::Unreadable { offset, message: error.to_string() });
                }
            }
            return Ok(());
        }
    }
}
