//! Puts the blocks of one sensor in order and keeps account of its clock.

use std::collections::VecDeque;
use std::hash::{DefaultHasher, Hash, Hasher};

use model::UtcNs;

use super::account::Account;
use super::block::{Block, Times};
use super::facts::StreamFacts;

/// Blocks that are held back, so that one which was written late finds its place.
const HELD: usize = 8;
/// Blocks that a new one is compared with to find it there twice.
const REMEMBERED: usize = 64;

/// Puts the blocks of one sensor in order.
///
/// A block that begins before the end of the newest one is out of order if the blocks after it go on from the newest, and
/// if it fits between others. Otherwise the clock was set back, and a new stretch of the time line begins.
#[derive(Debug)]
pub struct Line {
    account: Account,
    held: VecDeque<Block>,
    /// Blocks that went back, while it is not known why.
    back: Vec<Block>,
    recent: VecDeque<u64>,
    ready: VecDeque<Block>,
}

impl Line {
    /// An empty time line. `gap_s`: longer steps are gaps.
    pub fn new(nominal_rate_hz: f64, gap_s: f64) -> Self {
        Self {
            account: Account::new(nominal_rate_hz, gap_s),
            held: VecDeque::new(),
            back: Vec::new(),
            recent: VecDeque::new(),
            ready: VecDeque::new(),
        }
    }

    /// What is known so far that is not in the blocks.
    pub fn facts_mut(&mut self) -> &mut StreamFacts {
        &mut self.account.facts
    }

    /// Takes the next block in the order of the file.
    pub fn push(&mut self, block: Block) {
        for block in in_order(block) {
            self.push_ordered(block);
        }
    }

    /// The next block in the order of time, if it is settled.
    pub fn pop(&mut self) -> Option<Block> {
        self.ready.pop_front()
    }

    /// No more blocks come.
    pub fn end(&mut self) {
        self.settle();
        self.release(0);
    }

    /// The account of the whole line.
    pub fn finish(self) -> StreamFacts {
        self.account.finish()
    }

    fn push_ordered(&mut self, block: Block) {
        let print = fingerprint(&block);
        if self.recent.contains(&print) {
            self.account.facts.duplicates += 1;
            return;
        }
        self.recent.push_back(print);
        if self.recent.len() > REMEMBERED {
            self.recent.pop_front();
        }
        let begin = block.times.first();
        if self.newest().is_none_or(|newest| begin >= newest) {
            self.settle_as_late();
            self.held.push_back(block);
            self.release(HELD);
            return;
        }
        self.back.push(block);
        if self.back.len() > HELD {
            self.settle_as_set_back();
        }
    }

    /// Last time of the newest block.
    fn newest(&self) -> Option<UtcNs> {
        self.held.back().map(|block| block.times.last()).or(self.account.newest())
    }

    fn settle(&mut self) {
        self.settle_as_late();
    }

    /// The blocks that went back were written late, if they fit between others; otherwise the clock was set back.
    fn settle_as_late(&mut self) {
        if self.back.is_empty() {
            return;
        }
        if !self.back.iter().all(|block| self.fits(block)) {
            self.settle_as_set_back();
            return;
        }
        for block in std::mem::take(&mut self.back) {
            self.account.facts.reordered += 1;
            let place = self.held.partition_point(|held| held.times.first() <= block.times.first());
            if place == 0 && self.account.newest().is_some_and(|newest| newest > block.times.first()) {
                // Too late to be put in order: the reader does so.
                self.ready.push_back(block.clone());
                self.account.add_late(&block);
            } else {
                self.held.insert(place, block);
            }
        }
    }

    /// Whether a block overlaps none of those held, and lies after what was released, or in one of its holes.
    fn fits(&self, block: &Block) -> bool {
        let (begin, end) = (block.times.first(), block.times.last());
        self.held.iter().all(|held| held.times.last() < begin || end < held.times.first())
            && self.account.has_hole(begin, end)
    }

    fn settle_as_set_back(&mut self) {
        self.release(0);
        self.account.set_back();
        for block in std::mem::take(&mut self.back) {
            if self.newest_of_stretch().is_some_and(|newest| block.times.first() < newest) {
                self.account.set_back();
            }
            self.account.add(&block);
            self.ready.push_back(block);
        }
    }

    fn newest_of_stretch(&self) -> Option<UtcNs> {
        self.account.newest()
    }

    fn release(&mut self, keep: usize) {
        while self.held.len() > keep {
            let Some(block) = self.held.pop_front() else { break };
            self.account.add(&block);
            self.ready.push_back(block);
        }
    }
}

/// The block in pieces whose times never go back.
fn in_order(block: Block) -> Vec<Block> {
    let Times::Each(times) = &block.times else { return if block.times.len() == 0 { vec![] } else { vec![block] } };
    if times.is_sorted() {
        return if times.is_empty() { vec![] } else { vec![block] };
    }
    let breaks = (1..times.len()).filter(|i| times[*i] < times[*i - 1]);
    let edges: Vec<usize> = std::iter::once(0).chain(breaks).chain([times.len()]).collect();
    let cut = |columns: &[Vec<f32>], from: usize, to: usize| columns.iter().map(|c| c[from..to].to_vec()).collect();
    edges
        .windows(2)
        .map(|edge| Block {
            times: Times::Each(times[edge[0]..edge[1]].to_vec()),
            sequence: block.sequence,
            channels: cut(&block.channels, edge[0], edge[1]),
            extra: cut(&block.extra, edge[0], edge[1]),
        })
        .collect()
}

/// Equal for blocks that are there twice.
fn fingerprint(block: &Block) -> u64 {
    let mut hasher = DefaultHasher::new();
    (block.times.first(), block.times.len(), block.sequence).hash(&mut hasher);
    for channel in &block.channels {
        mixed(channel).hash(&mut hasher);
    }
    hasher.finish()
}

/// Values mixed into eight lanes, so that the processor works on all of them at once.
fn mixed(values: &[f32]) -> [u32; 8] {
    let mut lanes = [0_u32; 8];
    let (whole, rest) = values.as_chunks::<8>();
    let mut last = [0.0; 8];
    last[..rest.len()].copy_from_slice(rest);
    for chunk in whole.iter().chain([&last]) {
        for (lane, value) in lanes.iter_mut().zip(chunk) {
            *lane = (lane.rotate_left(5) ^ value.to_bits()).wrapping_mul(0x9e37_79b1);
        }
    }
    lanes
}
