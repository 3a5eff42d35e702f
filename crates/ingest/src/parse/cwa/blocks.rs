//! The blocks of a file, damage stepped over.

use std::io::Read;

use super::block::{BLOCK_BYTES, Block, BlockError, MAGIC};
use super::facts::{CwaFacts, SequenceJump, TruncatedBlock};
use super::header::{HEADER_BYTES, Header};
use super::window::Window;

/// Streams the blocks of a CWA file.
///
/// After damage it goes on at the next block whose checksum holds, wherever that begins: bytes may have been lost or
/// added in between.
pub struct CwaBlocks<R> {
    window: Window<R>,
    facts: CwaFacts,
    is_header_read: bool,
    /// The next block is not where the last one ended.
    is_lost: bool,
    /// Bytes passed over since the last block used.
    passed_over: u64,
    last_sequence: Option<u32>,
}

impl<R: Read> CwaBlocks<R> {
    /// The blocks in `reader`, which stands at the start of the file. No need to buffer it.
    pub fn new(reader: R) -> Self {
        Self {
            window: Window::new(reader),
            facts: CwaFacts::default(),
            is_header_read: false,
            is_lost: false,
            passed_over: 0,
            last_sequence: None,
        }
    }

    /// The next block that can be used; none at the end of the file.
    pub fn next_block(&mut self) -> Option<Block> {
        if !self.is_header_read {
            self.read_header();
        }
        loop {
            let offset = self.window.offset();
            let Some(bytes) = self.window.peek(BLOCK_BYTES).first_chunk() else {
                self.end();
                return None;
            };
            match Block::parse(bytes) {
                Ok(block) => {
                    self.accept(offset, block.sequence);
                    return Some(block);
                }
                Err(error) if error.is_whole_block() => {
                    self.facts.add_bad_block(offset, error);
                    self.pass_over(BLOCK_BYTES);
                    self.is_lost = false;
                }
                Err(error) => self.search(offset, error),
            }
        }
    }

    /// The facts of the blocks read so far.
    pub fn facts(&self) -> &CwaFacts {
        &self.facts
    }

    /// Returns the facts of all blocks, and the reader.
    pub fn finish(self) -> (CwaFacts, R) {
        (self.facts, self.window.into_reader())
    }

    fn read_header(&mut self) {
        self.is_header_read = true;
        self.facts.header = self.window.peek(HEADER_BYTES).first_chunk().and_then(Header::parse);
        if self.facts.header.is_some() {
            self.window.consume(HEADER_BYTES);
        } else {
            self.is_lost = true; // a damaged header is no bad block
        }
    }

    fn accept(&mut self, offset: u64, got: u32) {
        self.window.consume(BLOCK_BYTES);
        // What was passed over counts as the whole blocks nearest to it: damage also adds or takes away single bytes.
        let lost_blocks = (self.passed_over + BLOCK_BYTES as u64 / 2) / BLOCK_BYTES as u64;
        if let Some(last) = self.last_sequence {
            let expected = last.wrapping_add(1).wrapping_add(lost_blocks as u32);
            if got != expected {
                self.facts.add_jump(SequenceJump { offset, expected, got });
            }
        }
        self.last_sequence = Some(got);
        self.facts.blocks += 1;
        self.passed_over = 0;
        self.is_lost = false;
    }

    /// Steps over what is no whole block, to where the next one may begin.
    fn search(&mut self, offset: u64, error: BlockError) {
        if !self.is_lost || matches!(error, BlockError::Checksum { .. }) {
            self.facts.add_bad_block(offset, error);
        }
        self.is_lost = true;
        let bytes = self.window.peek(BLOCK_BYTES);
        let rest = bytes.get(1..).unwrap_or_default();
        // The last bytes may be the beginning of a beginning.
        let step = find_magic(rest).unwrap_or(rest.len().saturating_sub(MAGIC.len() - 1)) + 1;
        self.pass_over(step);
    }

    fn pass_over(&mut self, bytes: usize) {
        self.window.consume(bytes);
        self.facts.bytes_lost += bytes as u64;
        self.passed_over += bytes as u64;
    }

    /// Takes the bytes after the last whole block.
    fn end(&mut self) {
        let offset = self.window.offset();
        let tail = self.window.peek(BLOCK_BYTES);
        let got = tail.len();
        let is_beginning = !self.is_lost && got > 0 && MAGIC.starts_with(tail);
        let beginning = find_magic(tail).or(is_beginning.then_some(0));
        self.pass_over(got);
        self.facts.unreadable = self.window.failure();
        if let (Some(at), None) = (beginning, &self.facts.unreadable) {
            self.facts.truncated = Some(TruncatedBlock { offset: offset + at as u64, got: got - at });
        }
    }
}

fn find_magic(bytes: &[u8]) -> Option<usize> {
    bytes.windows(MAGIC.len()).position(|window| window == MAGIC)
}
