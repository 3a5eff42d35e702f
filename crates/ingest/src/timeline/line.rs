//! Puts the blocks of one sensor in order and keeps account of its clock.

use std::collections::{HashSet, VecDeque};

use model::UtcNs;

use super::account::Account;
use super::block::Block;
use super::facts::StreamFacts;
use super::pieces::{fingerprint, mend_border, pieces};

/// Blocks that are held back, so that one which was written late finds its place.
const HELD: usize = 8;
/// Blocks that a new one is compared with to find it there twice: nine days of packets of 8 s, in 2 MB.
const REMEMBERED: usize = 100_000;
/// Two blocks of fewer samples, without numbers, may be alike by chance: a held reading under a coarse stamp.
const FEWEST_TO_COMPARE: usize = 8;
/// A block that is later than this was not written late: its stamp is wrong.
const LATEST_S: f64 = 600.0;

/// Puts the blocks of one sensor in order.
///
/// A block that begins before the end of the newest one is out of order if the blocks after it go on from the newest, and
/// if it fits between others. If the blocks after it go on from where the line was before the newest one, that one has a
/// wrong stamp, and is left out. Otherwise the clock was set back, and a new stretch of the time line begins.
#[derive(Debug)]
pub struct Line {
    account: Account,
    held: VecDeque<Block>,
    /// Blocks that went back, while it is not known why.
    back: Vec<Block>,
    recent: VecDeque<u64>,
    known: HashSet<u64>,
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
            known: HashSet::new(),
            ready: VecDeque::new(),
        }
    }

    /// The facts so far that are not in the blocks.
    pub fn facts_mut(&mut self) -> &mut StreamFacts {
        &mut self.account.facts
    }

    /// Takes the next block in the order of the file.
    pub fn push(&mut self, block: Block) {
        let pieces = pieces(block, self.account.facts.gap_s);
        self.account.facts.reordered += u64::from(pieces.sorted);
        self.account.facts.duplicates += pieces.twice;
        for block in pieces.blocks {
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
        if self.is_known(&block) {
            self.account.facts.duplicates += 1;
            return;
        }
        self.place(block);
    }

    /// Whether the block was there before; remembers it.
    fn is_known(&mut self, block: &Block) -> bool {
        if block.sequence.is_none() && block.times.len() < FEWEST_TO_COMPARE {
            return false;
        }
        let print = fingerprint(block);
        if !self.known.insert(print) {
            return true;
        }
        self.recent.push_back(print);
        if self.recent.len() > REMEMBERED
            && let Some(oldest) = self.recent.pop_front()
        {
            self.known.remove(&oldest);
        }
        false
    }

    fn place(&mut self, mut block: Block) {
        if self.back.is_empty()
            && let Some(newest) = self.held.back_mut()
        {
            self.account.facts.reordered += u64::from(mend_border(newest, &mut block));
        }
        let begin = block.times.first();
        let goes_on = |line: &Self| line.newest().is_none_or(|newest| begin >= newest);
        if goes_on(self) {
            self.settle();
        }
        // Where the clock turns out to have been set back, another block is the newest now.
        if goes_on(self) {
            self.held.push_back(block);
            self.release(HELD);
            return;
        }
        self.back.push(block);
        if self.back.len() > HELD && !self.leave_out_newest() {
            self.settle_as_set_back();
        }
    }

    /// Last time of the newest block.
    fn newest(&self) -> Option<UtcNs> {
        self.held.back().map(|block| block.times.last()).or(self.account.newest())
    }

    /// The blocks that went back were written late, if they fit between others; otherwise the clock was set back.
    fn settle(&mut self) {
        if self.back.is_empty() {
            return;
        }
        self.leave_out_misplaced();
        let mut back: Vec<&Block> = self.back.iter().collect();
        back.sort_by_key(|block| block.times.first());
        let overlap = |pair: &[&Block]| pair[1].times.first() <= pair[0].times.last();
        if back.windows(2).any(overlap) || !back.iter().all(|block| self.fits(block)) {
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

    /// Blocks that went back much too far, while the line goes on, have a wrong stamp.
    fn leave_out_misplaced(&mut self) {
        let Some(newest) = self.newest() else { return };
        let is_late = |block: &Block| newest.seconds_since(block.times.last()) <= LATEST_S;
        for block in self.back.iter().filter(|block| !is_late(block)) {
            self.account.leave_out(block);
        }
        self.back.retain(is_late);
    }

    /// If the blocks that went back go on from where the line was before the newest ones jumped ahead, those have a wrong
    /// stamp: they are fewer. Leaves them out, and goes on with the others.
    fn leave_out_newest(&mut self) -> bool {
        let Some(begin) = self.back.first().map(|block| block.times.first()) else { return false };
        let before = self.held.partition_point(|held| held.times.last() <= begin);
        let last = before.checked_sub(1).map(|i| self.held[i].times.last()).or(self.account.newest());
        let (Some(last), Some(ahead)) = (last, self.held.get(before)) else { return false };
        let goes_on = begin >= last && begin.seconds_since(last) <= ahead.times.first().seconds_since(last);
        if !goes_on || ahead.times.first().seconds_since(last) <= self.account.facts.gap_s {
            return false;
        }
        for block in self.held.drain(before..) {
            self.account.leave_out(&block);
        }
        for block in std::mem::take(&mut self.back) {
            self.place(block);
        }
        true
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
            if self.account.newest().is_some_and(|newest| block.times.first() < newest) {
                self.account.set_back();
            }
            self.account.add(&block);
            self.ready.push_back(block);
        }
    }

    fn release(&mut self, keep: usize) {
        while self.held.len() > keep {
            let Some(block) = self.held.pop_front() else { break };
            self.account.add(&block);
            self.ready.push_back(block);
        }
    }
}
