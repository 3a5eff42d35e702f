//! The contents of a CWA file, and the losses.

use super::{BlockError, Header};

/// The contents of a CWA file, and the losses.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CwaFacts {
    /// The header; none when the file does not begin with one.
    pub header: Option<Header>,
    /// Blocks used.
    pub blocks: u64,
    /// Blocks not used, by kind, in order of their first.
    pub bad_blocks: Vec<BadBlocks>,
    /// Bytes that are neither of the header nor of a block used.
    pub bytes_lost: u64,
    /// The block that the file ends in.
    pub truncated: Option<TruncatedBlock>,
    /// The number of times that a block's number was not the one to be expected.
    pub sequence_jumps: u64,
    /// The first ones of them, at most [`CwaFacts::JUMPS_KEPT`].
    pub first_jumps: Vec<SequenceJump>,
    /// Why the rest of the file was not read.
    pub unreadable: Option<ReadFailure>,
}

/// Blocks not used, of one kind.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BadBlocks {
    /// The number of them. A stretch without the beginning of a block counts once.
    pub blocks: u64,
    /// The place in the file where the first one begins.
    pub first_offset: u64,
    /// The fault of the first one.
    pub first: BlockError,
}

/// The file ends inside a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TruncatedBlock {
    /// The place in the file where it begins.
    pub offset: u64,
    /// Bytes there are, of [`super::BLOCK_BYTES`].
    pub got: usize,
}

/// A block whose number is not the one to be expected: blocks are missing or doubled, or the logger started anew.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SequenceJump {
    /// The place in the file where the block begins.
    pub offset: u64,
    /// The number that follows, damaged blocks in between included.
    pub expected: u32,
    /// Its number.
    pub got: u32,
}

/// The system cannot read on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadFailure {
    /// The place in the file where reading stopped.
    pub offset: u64,
    /// The message of the operating system.
    pub message: String,
}

impl CwaFacts {
    /// Jumps told one by one; more are only counted, so that a damaged file cannot fill the memory.
    pub const JUMPS_KEPT: usize = 100;

    pub(super) fn add_bad_block(&mut self, offset: u64, error: BlockError) {
        match self.bad_blocks.iter_mut().find(|bad| bad.first.code() == error.code()) {
            Some(bad) => bad.blocks += 1,
            None => self.bad_blocks.push(BadBlocks { blocks: 1, first_offset: offset, first: error }),
        }
    }

    pub(super) fn add_jump(&mut self, jump: SequenceJump) {
        self.sequence_jumps += 1;
        if self.first_jumps.len() < Self::JUMPS_KEPT {
            self.first_jumps.push(jump);
        }
    }
}
