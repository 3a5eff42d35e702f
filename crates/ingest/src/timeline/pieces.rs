//! Blocks cut, and mended, where the order of their rows is not that of time.

use std::hash::{DefaultHasher, Hash, Hasher};

use model::UtcNs;

use super::block::{Block, Times};

/// Rows that are out of order by no more than this are sorted: a logger that writes two things at once. More is a clock
/// that was set, or a wrong stamp.
const DISORDER_S: f64 = 1.0;

/// A block cut where it must be.
#[derive(Debug, Default)]
pub(super) struct Pieces {
    /// Their times never go back, and hold no gap.
    pub blocks: Vec<Block>,
    /// Whether rows had to be sorted.
    pub sorted: bool,
    /// Rows that were there twice, and are there once.
    pub twice: u64,
}

/// Cuts a block at gaps and where its times go back; sorts rows that are a little out of order.
pub(super) fn pieces(mut block: Block, gap_s: f64) -> Pieces {
    if block.times.is_empty() {
        return Pieces::default();
    }
    let is_break = |pair: &[UtcNs]| !(0.0..=gap_s).contains(&pair[1].seconds_since(pair[0]));
    let mut pieces = Pieces::default();
    match &block.times {
        Times::Each(times) if times.windows(2).any(is_break) => {
            if !times.is_sorted() && disorder_s(times) <= DISORDER_S {
                (block, pieces.twice) = once(sorted(block));
                pieces.sorted = true;
            }
        }
        _ => {
            pieces.blocks.push(block);
            return pieces;
        }
    }
    if let Times::Each(times) = &block.times {
        let breaks = (1..times.len()).filter(|i| is_break(&times[*i - 1..=*i]));
        let edges: Vec<usize> = std::iter::once(0).chain(breaks).chain([times.len()]).collect();
        pieces.blocks = edges.windows(2).map(|edge| part(&block, times, edge[0], edge[1])).collect();
    }
    pieces
}

/// The block without rows that are, in time and all channels, the row before; and how many those were.
fn once(mut block: Block) -> (Block, u64) {
    let Times::Each(times) = &block.times else { return (block, 0) };
    let same = |i: usize| {
        times[i] == times[i - 1] && block.channels.iter().all(|column| column[i].to_bits() == column[i - 1].to_bits())
    };
    let keep: Vec<bool> = (0..times.len()).map(|i| i == 0 || !same(i)).collect();
    let twice = keep.iter().filter(|keep| !**keep).count() as u64;
    for column in block.channels.iter_mut().chain(&mut block.extra) {
        let mut keep = keep.iter();
        column.retain(|_| keep.next().copied().unwrap_or(true));
    }
    let mut kept = keep.iter();
    if let Times::Each(times) = &mut block.times {
        times.retain(|_| kept.next().copied().unwrap_or(true));
    }
    (block, twice)
}

/// Where a block of rows begins a little before the newest one ends, moves the rows behind its beginning over to it, in
/// order. Whether it did.
pub(super) fn mend_border(newest: &mut Block, block: &mut Block) -> bool {
    let (Times::Each(before), Times::Each(times)) = (&newest.times, &block.times) else { return false };
    let (Some(last), Some(begin)) = (before.last(), times.first()) else { return false };
    let overlap_s = last.seconds_since(*begin);
    let keep = before.partition_point(|time| time <= begin);
    if overlap_s <= 0.0 || overlap_s > DISORDER_S || keep == 0 {
        return false;
    }
    let mut joined = part(newest, before, keep, before.len());
    *newest = part(newest, before, 0, keep);
    if let (Times::Each(to), Times::Each(from)) = (&mut joined.times, &block.times) {
        to.extend(from);
    }
    let columns = joined.channels.iter_mut().chain(&mut joined.extra);
    for (to, from) in columns.zip(block.channels.iter().chain(&block.extra)) {
        to.extend(from);
    }
    *block = sorted(joined);
    true
}

/// By how much the row that is most out of order comes too late, in seconds.
fn disorder_s(times: &[UtcNs]) -> f64 {
    let mut newest = UtcNs(i64::MIN);
    let late = times.iter().map(|time| {
        newest = newest.max(*time);
        newest.seconds_since(*time)
    });
    late.fold(0.0, f64::max)
}

fn sorted(mut block: Block) -> Block {
    let Times::Each(times) = &mut block.times else { return block };
    let mut order: Vec<usize> = (0..times.len()).collect();
    order.sort_by_key(|i| times[*i]);
    *times = order.iter().map(|i| times[*i]).collect();
    for column in block.channels.iter_mut().chain(&mut block.extra) {
        *column = order.iter().filter_map(|i| column.get(*i).copied()).collect();
    }
    block
}

fn part(block: &Block, times: &[UtcNs], from: usize, to: usize) -> Block {
    let cut = |columns: &[Vec<f32>]| columns.iter().map(|column| column[from..to].to_vec()).collect();
    Block {
        times: Times::Each(times[from..to].to_vec()),
        sequence: block.sequence,
        channels: cut(&block.channels),
        extra: cut(&block.extra),
    }
}

/// Equal for blocks that are there twice.
pub(super) fn fingerprint(block: &Block) -> u64 {
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
