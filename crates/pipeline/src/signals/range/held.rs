//! Records that repeat a reading, because the sensor measures more slowly than it is logged.

use model::{UtcNs, median};

/// A value that stands in one or more equal records.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Reading {
    /// The value, which may be a code.
    pub mm: f64,
    /// The number of readings of the sensor that the records stand for.
    pub count: usize,
}

/// Equal values across a longer step are two readings.
const LONGEST_STEP_S: f64 = 0.25;
/// With fewer runs the sensor's own period cannot be told from them.
const MIN_RUNS: usize = 4;

/// A run of two readings is twice as long as a run of one. Times are those of whole records, so some room is left in
/// between.
const SHORT: f64 = 1.5;

struct Run {
    mm: f64,
    records: usize,
    first: UtcNs,
    last: UtcNs,
}

/// The readings behind `samples` (in the order of time), for a sensor that needs at least `update_s` for each.
///
/// A run of equal records is one reading, or several that happened to be equal: at least one, at most one per record, and
/// one per update period in between, rounded. The period is `update_s` or, if longer, the length of the short runs: chance
/// repeats only lengthen runs, so the short ones show how long this sensor really holds a value.
pub(super) fn readings(samples: &[(UtcNs, f64)], update_s: f64) -> Vec<Reading> {
    let runs = runs(samples);
    let steps = samples.windows(2).map(|pair| pair[1].0.seconds_since(pair[0].0)).collect();
    let record_s = Some(median(steps)).filter(|s| s.is_finite()).unwrap_or(0.0);
    let lengths_s: Vec<f64> = runs.iter().map(|run| run.last.seconds_since(run.first) + record_s).collect();
    let period_s = update_s.max(shortest_hold_s(&lengths_s));
    let reading = |(run, length_s): (&Run, &f64)| Reading { mm: run.mm, count: in_run(run, *length_s, period_s) };
    runs.iter().zip(&lengths_s).map(reading).collect()
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the number of records")]
fn in_run(run: &Run, length_s: f64, period_s: f64) -> usize {
    ((length_s / period_s).round() as usize).clamp(1, run.records)
}

fn runs(samples: &[(UtcNs, f64)]) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for (time, mm) in samples {
        match runs.last_mut() {
            // Values come from whole counts, so a held one is equal to the bit.
            Some(run) if run.mm.to_bits() == mm.to_bits() && time.seconds_since(run.last) <= LONGEST_STEP_S => {
                run.records += 1;
                run.last = *time;
            }
            _ => runs.push(Run { mm: *mm, records: 1, first: *time, last: *time }),
        }
    }
    runs
}

/// The mean length of the runs that are no longer than [`SHORT`] times their lower quartile. Only runs inside the window
/// count, since the first and the last may be cut off by it. (The mean is taken because lengths are whole numbers of
/// records.)
#[expect(clippy::cast_precision_loss, reason = "a window holds some thousand records at most")]
fn shortest_hold_s(lengths_s: &[f64]) -> f64 {
    let Some(inner) = lengths_s.get(1..lengths_s.len().saturating_sub(1)).filter(|inner| inner.len() >= MIN_RUNS)
    else {
        return 0.0;
    };
    let mut sorted = inner.to_vec();
    sorted.sort_by(f64::total_cmp);
    let longest_s = SHORT * sorted[sorted.len() / 4];
    let short: Vec<f64> = sorted.into_iter().take_while(|s| *s <= longest_s).collect();
    short.iter().sum::<f64>() / short.len().max(1) as f64
}
