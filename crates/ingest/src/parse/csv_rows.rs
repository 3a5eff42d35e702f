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
    /// The byte at which lines end, once it is known.
    line_end: Option<u8>,
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
            line_end: None,
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
        let line_end = match self.line_end {
            Some(line_end) => line_end,
            None => self.learn_line_end()?,
        };
        let mut searched = self.next;
        loop {
            if let Some(found) = memchr(line_end, &self.bytes[searched..self.end]) {
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

    /// The byte at which the lines of the file end: a carriage return alone, as old systems and some loggers write it, only
    /// where no line of a whole buffer ends otherwise. Refuses text of two bytes per character.
    fn learn_line_end(&mut self) -> Result<u8, Fault> {
        while !self.at_end && self.end < self.bytes.len() && memchr(b'\n', &self.bytes[..self.end]).is_none() {
            self.read_on()?;
        }
        let bytes = &self.bytes[..self.end];
        if is_utf16(bytes) {
            return Err(Fault::Utf16);
        }
        let has_only_returns = memchr(b'\n', bytes).is_none() && memchr(b'\r', bytes).is_some();
        let line_end = if has_only_returns { b'\r' } else { b'\n' };
        self.line_end = Some(line_end);
        Ok(line_end)
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

/// Whether bytes are UTF-16 text: by its mark, or by the zeros that it has where other text has none.
fn is_utf16(bytes: &[u8]) -> bool {
    let has_mark = bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff");
    let is_text = |a: u8, b: u8| a == 0 && b != 0;
    let looks_so = |first: [u8; 4]| {
        let [a, b, c, d] = first;
        (is_text(a, b) && is_text(c, d)) || (is_text(b, a) && is_text(d, c))
    };
    has_mark || bytes.first_chunk().is_some_and(|first| looks_so(*first))
}
