//! Settings from the first bytes of an input, and the rest of it as a file.

use std::io::{Error, ErrorKind, Read, Result};

/// Takes numbers off the front of an input; zeros when it is at its end.
pub(crate) struct Cursor<'b> {
    rest: &'b [u8],
}

impl<'b> Cursor<'b> {
    pub fn new(bytes: &'b [u8]) -> Self {
        Self { rest: bytes }
    }

    pub fn bytes<const N: usize>(&mut self) -> [u8; N] {
        let mut taken = [0; N];
        let n = N.min(self.rest.len());
        let (front, rest) = self.rest.split_at(n);
        taken[..n].copy_from_slice(front);
        self.rest = rest;
        taken
    }

    pub fn u8(&mut self) -> u8 {
        self.bytes::<1>()[0]
    }

    pub fn u16(&mut self) -> u16 {
        u16::from_le_bytes(self.bytes())
    }

    pub fn i16(&mut self) -> i16 {
        i16::from_le_bytes(self.bytes())
    }

    pub fn i64(&mut self) -> i64 {
        i64::from_le_bytes(self.bytes())
    }

    /// One of `choices`, by a byte.
    pub fn pick<T: Clone>(&mut self, choices: &[T]) -> T {
        choices[usize::from(self.u8()) % choices.len()].clone()
    }

    pub fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    /// The bytes that are left.
    pub fn rest(self) -> &'b [u8] {
        self.rest
    }
}

/// A file as a slow disk gives it: in pieces, and interrupted by signals.
pub(crate) struct Pieces<'b> {
    rest: &'b [u8],
    piece: usize,
    reads: usize,
}

impl<'b> Pieces<'b> {
    /// `fineness`: 0 for all at once, else pieces of its square.
    pub fn new(rest: &'b [u8], fineness: u8) -> Self {
        let piece = if fineness == 0 { usize::MAX } else { usize::from(fineness).pow(2) };
        Self { rest, piece, reads: 0 }
    }
}

impl Read for Pieces<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        self.reads += 1;
        if self.piece != usize::MAX && self.reads.is_multiple_of(3) {
            return Err(Error::from(ErrorKind::Interrupted));
        }
        let n = self.piece.min(buffer.len()).min(self.rest.len());
        let (now, later) = self.rest.split_at(n);
        buffer[..n].copy_from_slice(now);
        self.rest = later;
        Ok(n)
    }
}
