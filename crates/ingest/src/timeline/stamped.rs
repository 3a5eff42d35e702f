//! When each sample was taken, where packets without a gap between them touch.
//!
//! A packet's stamp is the time of one sample. Between two stamps the samples are evenly spaced, so times are
//! interpolated linearly from stamp to stamp, over the blocks' borders: the last sample of a block is one step before
//! the first of the next one. Each block gets the straight line between its borders.

/// How far the rate between two stamps may be off the nominal one before they do not belong together. Recordings of an
/// AX3 and an AX6 are within 1.2 %; a block that is missing makes a difference of half.
const RATE_TOLERANCE: f64 = 0.05;

/// The part of a block that times depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockStamp {
    /// Number of the block, where blocks have one.
    pub sequence: Option<u32>,
    /// Time of the sample [`index`](Self::index), in ns on any time line.
    pub time_ns: i64,
    /// The sample that the stamp is of, counted from the block's first; it may lie outside the block.
    pub index: i32,
    /// Samples in the block.
    pub samples: usize,
    /// The rate that was set, in Hz.
    pub nominal_rate_hz: f64,
}

impl BlockStamp {
    fn nominal_step_ns(&self) -> f64 {
        1e9 / self.nominal_rate_hz
    }

    /// ns from sample to sample between this stamp and that of the next block; none when they do not belong together.
    fn step_ns_to(&self, next: &Self) -> Option<f64> {
        let numbers = self.sequence.zip(next.sequence);
        let follows = numbers.is_none_or(|(this, next)| this.wrapping_add(1) == next);
        let same_rate = (next.nominal_rate_hz - self.nominal_rate_hz).abs() < f64::EPSILON;
        let samples = self.samples as f64 - f64::from(self.index) + f64::from(next.index);
        if !follows || !same_rate || samples < 1.0 {
            return None;
        }
        let step_ns = (i128::from(next.time_ns) - i128::from(self.time_ns)) as f64 / samples;
        is_plausible(step_ns, self.nominal_step_ns(), RATE_TOLERANCE).then_some(step_ns)
    }
}

/// The times of a block's samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockTimes {
    /// Time of the first sample, in ns on the time line of the stamps.
    pub first_sample_time_ns: i64,
    /// From sample to sample, in ns; never negative.
    pub step_ns: f64,
    /// The first sample is one step after the last one of the block before. False for the first block and after a gap;
    /// a logger whose clock was set back then also begins before where the last block ended.
    pub contiguous: bool,
}

impl BlockTimes {
    /// Time of a sample, in ns.
    #[must_use]
    pub fn time_ns(&self, sample: usize) -> i64 {
        after(self.first_sample_time_ns, sample as f64 * self.step_ns)
    }
}

/// Places the samples of blocks in order, one block behind: the next stamp may be needed.
///
/// After a gap, and in the first block, the step is that up to the next stamp; a block without neighbours gets the last
/// step that was measured, or the nominal one.
#[derive(Debug, Clone, Default)]
pub struct SampleTimes {
    waiting: Option<BlockStamp>,
    /// Step between the stamps of the block before and of the waiting one.
    step_before_ns: Option<f64>,
    /// The time at which the block before ends and the waiting one begins.
    border_ns: Option<i64>,
    last_step_ns: Option<f64>,
}

impl SampleTimes {
    /// No block so far.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes the next block, and gives the times of the one before it.
    pub fn push(&mut self, next: BlockStamp) -> Option<BlockTimes> {
        let block = self.waiting.replace(next)?;
        let step_after_ns = block.step_ns_to(&next);
        let (times, end_ns) = self.place(&block, step_after_ns);
        self.border_ns = step_after_ns.map(|_| end_ns);
        self.step_before_ns = step_after_ns;
        self.last_step_ns = step_after_ns.or(self.last_step_ns);
        Some(times)
    }

    /// The times of the last block; the next one pushed is a first one again.
    pub fn finish(&mut self) -> Option<BlockTimes> {
        let block = self.waiting.take()?;
        let (times, _) = self.place(&block, None);
        *self = Self::default();
        Some(times)
    }

    /// The times of a block, and where it ends: the time of the sample after its last.
    fn place(&self, block: &BlockStamp, step_after_ns: Option<f64>) -> (BlockTimes, i64) {
        let nominal_ns = block.nominal_step_ns();
        let measured_ns = self.last_step_ns.filter(|step| is_plausible(*step, nominal_ns, RATE_TOLERANCE));
        let elsewhere_ns = measured_ns.unwrap_or(nominal_ns);
        let to_past_ns = self.step_before_ns.or(step_after_ns).unwrap_or(elsewhere_ns);
        let to_future_ns = step_after_ns.or(self.step_before_ns).unwrap_or(elsewhere_ns);
        let time_of = |sample: f64| {
            let distance = sample - f64::from(block.index);
            after(block.time_ns, distance * if distance <= 0.0 { to_past_ns } else { to_future_ns })
        };
        let samples = block.samples as f64;
        let (own_ns, end_ns) = (time_of(0.0), time_of(samples));
        let step_from = |first_ns: i64| match block.samples {
            0 => to_past_ns,
            _ => (i128::from(end_ns) - i128::from(first_ns)) as f64 / samples,
        };
        // A border far from the block's own stamp would stretch its samples; the stamp then wins, and there is a gap.
        let fits = |border: &i64| is_plausible(step_from(*border), nominal_ns, 2.0 * RATE_TOLERANCE);
        let border_ns = self.border_ns.filter(fits);
        let first_ns = border_ns.unwrap_or(own_ns);
        let end_ns = if block.samples == 0 { first_ns } else { end_ns };
        let contiguous = border_ns.is_some();
        (BlockTimes { first_sample_time_ns: first_ns, step_ns: step_from(first_ns), contiguous }, end_ns)
    }
}

/// Whether the rates of two steps differ by no more than that part.
fn is_plausible(step_ns: f64, nominal_ns: f64, tolerance: f64) -> bool {
    step_ns > 0.0 && (nominal_ns / step_ns - 1.0).abs() <= tolerance
}

fn after(time_ns: i64, distance_ns: f64) -> i64 {
    time_ns.saturating_add(distance_ns.round() as i64)
}
