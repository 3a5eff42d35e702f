//! Rows that share a stamp, spread over the time until the next stamp.
//!
//! A logger that writes times without decimals gives all rows of a second one stamp; a radio link hands rows over in batches.
//! Where the number of rows per stamp shows the rate, row j of n is at stamp + (j + 1/2) / n of the time until the next
//! stamp: for a clock that cuts its times off, and for one that stamps a batch's first row, that is right to half a row.

use std::collections::BTreeMap;

use crate::parse::{RawBlock, Stamps};

/// Rows that are looked at to learn what one stamp stands for.
pub(crate) const LEARNED_ROWS: u64 = 100_000;
/// Fewer rows per stamp than this, on average, are rows with a time of their own, a few of which are equal.
const FEWEST_ROWS_PER_STAMP: f64 = 1.5;
/// The number of rows of a stamp may be off the usual one by this part, or by [`ODD_ROWS`]: loggers jitter.
const ODD_PART: f64 = 0.05;
const ODD_ROWS: f64 = 1.5;
/// Rows of a batch that is over within this time are spread over it, however many they are.
const SHORT_NS: f64 = 1e8;
/// The next stamp belongs to this one if it is nearer than so many usual distances.
const LONGEST_PART: f64 = 1.5;

/// How rows share stamps in a file.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SharedStamps {
    /// From stamp to stamp, usually, ns.
    pub interval_ns: f64,
    /// Rows of one stamp, usually.
    pub rows: f64,
    /// Rows of one stamp by the rate that the profile declares.
    declared_rows: f64,
    /// Most stamps have about as many rows: the number shows the rate.
    pub is_regular: bool,
}

impl SharedStamps {
    /// The fact for people, and what was done.
    pub fn fact(&self) -> String {
        let (apart_s, rows) = (self.interval_ns / 1e9, self.rows);
        if !self.is_regular {
            return format!(
                "stamps {apart_s} s apart are shared by changing numbers of rows, so that none shows its time"
            );
        }
        let row_s = apart_s / rows;
        format!("{rows:.0} rows each share a stamp, {apart_s} s apart; they are spread evenly, right to {row_s:.3} s")
    }

    /// Whether as many rows share a stamp as usual, or as the declared rate has it.
    fn is_usual(&self, rows: f64, span_ns: f64) -> bool {
        let is_near = |expected: f64| {
            let expected = expected * span_ns / self.interval_ns;
            (rows - expected).abs() <= ODD_ROWS.max(ODD_PART * expected)
        };
        is_near(self.rows) || is_near(self.declared_rows)
    }
}

/// Counts rows of equal stamps.
#[derive(Debug, Default)]
pub(crate) struct StampCounts {
    last: Option<i64>,
    run: u64,
    runs: u64,
    rows: u64,
    by_interval: BTreeMap<i64, u64>,
    by_rows: BTreeMap<u64, u64>,
}

impl StampCounts {
    /// Counts more rows of the file.
    pub fn add(&mut self, stamps: &[i64]) {
        for stamp in stamps {
            self.rows += 1;
            match self.last.filter(|last| last != stamp) {
                None => self.run += 1,
                Some(last) => {
                    self.runs += 1;
                    *self.by_interval.entry(stamp.saturating_sub(last)).or_default() += 1;
                    // The first one is cut off wherever recording began.
                    if self.runs > 1 {
                        *self.by_rows.entry(self.run).or_default() += 1;
                    }
                    self.run = 1;
                }
            }
            self.last = Some(*stamp);
        }
    }

    /// Rows so far.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// What the rows of one stamp are. None where rows have stamps of their own.
    pub fn shared(&self, declared_rate_hz: f64) -> Option<SharedStamps> {
        if self.rows == 0 || self.rows as f64 / (self.runs + 1) as f64 <= FEWEST_ROWS_PER_STAMP {
            return None;
        }
        let forward = self.by_interval.iter().filter(|(interval, _)| **interval > 0);
        let interval_ns = forward.max_by_key(|(_, count)| **count).map(|(interval, _)| *interval as f64);
        // All rows have one stamp, or two: nothing shows what it stands for but the declared rate.
        let interval_ns = interval_ns.unwrap_or(self.rows as f64 * 1e9 / declared_rate_hz);
        let declared_rows = interval_ns * declared_rate_hz / 1e9;
        let rows = median(&self.by_rows).map_or(declared_rows, |rows| rows as f64);
        let mut shared = SharedStamps { interval_ns, rows, declared_rows, is_regular: true };
        let usual: Vec<_> =
            self.by_rows.iter().filter(|(rows, _)| shared.is_usual(**rows as f64, interval_ns)).collect();
        let runs: u64 = usual.iter().map(|(_, runs)| **runs).sum();
        shared.is_regular = 2 * runs >= self.by_rows.values().sum();
        if runs > 0 {
            let rows: u64 = usual.iter().map(|(rows, runs)| **rows * **runs).sum();
            shared.rows = rows as f64 / runs as f64;
        }
        Some(shared)
    }
}

/// The middle one of counted numbers.
fn median(counts: &BTreeMap<u64, u64>) -> Option<u64> {
    let total: u64 = counts.values().sum();
    let mut before = 0;
    let middle = counts.iter().find(|(_, count)| {
        before += **count;
        2 * before > total
    });
    middle.map(|(number, _)| *number)
}

/// Gives rows that share stamps a time each; rows of which the count does not show when they were taken are left out.
#[derive(Debug)]
pub(crate) struct Spreader {
    shared: SharedStamps,
    /// The rows of the last stamp, of which more may come.
    held: Option<RawBlock>,
    /// Rows of the last stamp that are not held, since they are far too many.
    beyond: usize,
    /// The rows of the last stamp go on from those before.
    goes_on: bool,
    /// Rows left out.
    pub left_out: u64,
    /// How many rows shared the first stamp of which they were left out, and its ns.
    pub first_left_out: Option<(usize, i64)>,
}

impl Spreader {
    pub fn new(shared: SharedStamps) -> Self {
        Self { shared, held: None, beyond: 0, goes_on: false, left_out: 0, first_left_out: None }
    }

    /// Takes the next rows; gives those whose times are known now.
    pub fn push(&mut self, block: RawBlock) -> RawBlock {
        let mut all = match self.held.take() {
            Some(held) => joined(held, block),
            None => block,
        };
        let Stamps::Each(stamps) = &all.stamps else { return all };
        let stamps = stamps.clone();
        let last_run = stamps.iter().rposition(|stamp| Some(stamp) != stamps.last()).map_or(0, |before| before + 1);
        let mut held = split_off(&mut all, last_run);
        let times = self.times(&stamps[..last_run], stamps.get(last_run).copied());
        set_times(&mut all, &times);
        let most = self.most_rows();
        if held.len() > most {
            self.beyond += held.len() - most;
            split_off(&mut held, most);
        }
        self.held = Some(held);
        all
    }

    /// The rows of the last stamp.
    pub fn finish(&mut self) -> Option<RawBlock> {
        let mut held = self.held.take()?;
        let Stamps::Each(stamps) = &held.stamps else { return Some(held) };
        let times = self.times(&stamps.clone(), None);
        set_times(&mut held, &times);
        Some(held)
    }

    /// A time for each row, none for those that are left out. `next`: the stamp behind them.
    fn times(&mut self, stamps: &[i64], next: Option<i64>) -> Vec<Option<i64>> {
        let mut times = Vec::with_capacity(stamps.len());
        let mut runs = stamps.chunk_by(|a, b| a == b).peekable();
        while let Some(run) = runs.next() {
            let stamp = run[0];
            let next = runs.peek().map(|run| run[0]).or(next);
            let rows = run.len() + std::mem::take(&mut self.beyond);
            let until_ns = next.map(|next| next.saturating_sub(stamp) as f64);
            let until_ns = until_ns.filter(|ns| *ns > 0.0 && *ns < LONGEST_PART * self.shared.interval_ns);
            match self.place(rows, until_ns) {
                Some((first_ns, step_ns)) => {
                    let time = |j: usize| stamp.saturating_add((first_ns + j as f64 * step_ns).round() as i64);
                    times.extend((0..run.len()).map(|j| Some(time(j))));
                }
                None => {
                    times.resize(times.len() + run.len(), None);
                    self.left_out += rows as u64;
                    self.first_left_out.get_or_insert((rows, stamp));
                }
            }
            self.goes_on = until_ns.is_some();
        }
        times
    }

    /// From a stamp to its first row, and from row to row, ns. `until_ns`: to the next stamp, if it goes on there.
    fn place(&self, rows: usize, until_ns: Option<f64>) -> Option<(f64, f64)> {
        let count = rows as f64;
        let usual_step_ns = self.shared.interval_ns / self.shared.rows;
        let span_ns = until_ns.unwrap_or(self.shared.interval_ns);
        let is_short = span_ns <= SHORT_NS && rows <= self.most_rows();
        if !self.shared.is_regular && !is_short {
            return None;
        }
        let is_part = count < self.shared.rows * span_ns / self.shared.interval_ns - ODD_ROWS;
        match (self.goes_on, until_ns) {
            // The recording begins within the stamp: its rows reach to the next one.
            (false, Some(until_ns)) if is_part => Some((until_ns - (count - 0.5) * usual_step_ns, usual_step_ns)),
            // It ends within the stamp: its rows begin there.
            (true, None) if is_part => Some((usual_step_ns / 2.0, usual_step_ns)),
            _ if self.shared.is_usual(count, span_ns) || is_short => Some((span_ns / count / 2.0, span_ns / count)),
            _ => None,
        }
    }

    /// More rows of one stamp are none that can be spread.
    fn most_rows(&self) -> usize {
        (4.0 * self.shared.rows.max(self.shared.declared_rows)) as usize + 1024
    }
}

/// Rows of two blocks of one file as one block.
fn joined(mut first: RawBlock, second: RawBlock) -> RawBlock {
    if let (Stamps::Each(stamps), Stamps::Each(more)) = (&mut first.stamps, &second.stamps) {
        stamps.extend(more);
    }
    let columns = first.channels.iter_mut().chain(&mut first.extra);
    for (column, more) in columns.zip(second.channels.into_iter().chain(second.extra)) {
        column.extend(more);
    }
    first.missing += second.missing;
    first
}

/// Takes the rows from `row` on out of the block. Missing ones stay with the block.
fn split_off(block: &mut RawBlock, row: usize) -> RawBlock {
    let stamps = match &mut block.stamps {
        Stamps::Each(stamps) => Stamps::Each(stamps.split_off(row.min(stamps.len()))),
        other => other.clone(),
    };
    let cut = |columns: &mut Vec<Vec<f32>>| -> Vec<Vec<f32>> {
        columns.iter_mut().map(|column| column.split_off(row.min(column.len()))).collect()
    };
    let (channels, extra) = (cut(&mut block.channels), cut(&mut block.extra));
    RawBlock { stamps, channels, extra, missing: 0, impossible: None, ..*block }
}

/// Replaces the stamps of rows; rows without a time are left out.
fn set_times(block: &mut RawBlock, times: &[Option<i64>]) {
    for column in block.channels.iter_mut().chain(&mut block.extra) {
        let mut kept = times.iter().map(Option::is_some);
        column.retain(|_| kept.next().unwrap_or(false));
    }
    block.stamps = Stamps::Each(times.iter().copied().flatten().collect());
}

#[cfg(test)]
mod tests;
