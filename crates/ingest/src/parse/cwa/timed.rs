//! Blocks with the times of their samples.

use std::io::Read;

use jiff::civil::DateTime;

use super::{Block, BlockStamp, BlockTimes, CwaBlocks, CwaFacts, SampleTimes};

/// Streams the blocks of a CWA file with the times of their samples, one block behind the reading.
pub struct TimedBlocks<R, F> {
    blocks: CwaBlocks<R>,
    time_ns: F,
    times: SampleTimes,
    waiting: Option<Block>,
}

impl<R: Read, F: FnMut(DateTime) -> i64> TimedBlocks<R, F> {
    /// `time_ns` turns the logger's clock into ns on the caller's time line. It must not jump: the logger's clock knows
    /// no summer time, so a fixed offset it is.
    pub fn new(blocks: CwaBlocks<R>, time_ns: F) -> Self {
        Self { blocks, time_ns, times: SampleTimes::new(), waiting: None }
    }

    /// The next block that can be used; none at the end of the file.
    pub fn next_block(&mut self) -> Option<(Block, BlockTimes)> {
        while let Some(block) = self.blocks.next_block() {
            let times = self.times.push(BlockStamp::new(&block, (self.time_ns)(block.stamp)));
            let before = self.waiting.replace(block);
            if let Some(timed) = before.zip(times) {
                return Some(timed);
            }
        }
        self.waiting.take().zip(self.times.finish())
    }

    /// What there was, and the reader.
    pub fn finish(self) -> (CwaFacts, R) {
        self.blocks.finish()
    }
}
