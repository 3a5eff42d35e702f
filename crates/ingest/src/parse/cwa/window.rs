//! The next bytes of a reader, in bounded memory.

use std::io::{ErrorKind, Read};

use super::ReadFailure;

const BUFFER_BYTES: usize = 1 << 16;

/// Bytes read but not yet consumed.
pub(super) struct Window<R> {
    reader: R,
    buffer: Vec<u8>,
    start: usize,
    end: usize,
    /// The place where `start` is in the file.
    offset: u64,
    is_at_end: bool,
    failure: Option<ReadFailure>,
}

impl<R: Read> Window<R> {
    pub(super) fn new(reader: R) -> Self {
        let buffer = vec![0; BUFFER_BYTES];
        Self { reader, buffer, start: 0, end: 0, offset: 0, is_at_end: false, failure: None }
    }

    /// The place where the next byte is in the file.
    pub(super) fn offset(&self) -> u64 {
        self.offset
    }

    /// The bytes at hand: at least `wanted` of them unless the file ends before, or cannot be read on.
    pub(super) fn peek(&mut self, wanted: usize) -> &[u8] {
        if self.start + wanted > self.buffer.len() {
            self.buffer.copy_within(self.start..self.end, 0);
            self.end -= self.start;
            self.start = 0;
        }
        while self.end - self.start < wanted && !self.is_at_end {
            match self.reader.read(&mut self.buffer[self.end..]) {
                Ok(0) => self.is_at_end = true,
                Ok(read) => self.end += read,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => {
                    let offset = self.offset + (self.end - self.start) as u64;
                    self.failure = Some(ReadFailure { offset, message: error.to_string() });
                    self.is_at_end = true;
                }
            }
        }
        &self.buffer[self.start..self.end]
    }

    /// Steps over `bytes`, which [`Self::peek`] has shown.
    pub(super) fn consume(&mut self, bytes: usize) {
        let bytes = bytes.min(self.end - self.start);
        self.start += bytes;
        self.offset += bytes as u64;
    }

    pub(super) fn failure(&self) -> Option<ReadFailure> {
        self.failure.clone()
    }

    pub(super) fn into_reader(self) -> R {
        self.reader
    }
}
