//! Consecutive samples of one sensor, with their true times.

use model::UtcNs;

/// Consecutive samples of one sensor, in order of time.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// The time at which they were taken.
    pub times: Times,
    /// Number of the packet, where it has one.
    pub sequence: Option<u32>,
    /// One list per channel: x, y, z in g (device frame), or the range in mm.
    pub channels: Vec<Vec<f32>>,
    /// One list per carried channel.
    pub extra: Vec<Vec<f32>>,
}

/// Times of the samples of a block.
#[derive(Debug, Clone, PartialEq)]
pub enum Times {
    /// The first one, and so many ns from each to the next.
    Even {
        /// Time of the first sample.
        first: UtcNs,
        /// From each to the next, ns; positive.
        step_ns: f64,
        /// The number of them.
        samples: usize,
    },
    /// Each its own, in order.
    Each(Vec<UtcNs>),
}

impl Times {
    /// Whether there are none: never, as a parser makes them.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number of them.
    pub fn len(&self) -> usize {
        match self {
            Self::Even { samples, .. } => *samples,
            Self::Each(times) => times.len(),
        }
    }

    /// Time of sample `i`.
    pub fn time_at(&self, i: usize) -> Option<UtcNs> {
        match self {
            Self::Even { first, step_ns, samples } => (i < *samples).then(|| after(*first, *step_ns, i)),
            Self::Each(times) => times.get(i).copied(),
        }
    }

    /// All of them.
    pub fn each(&self) -> impl Iterator<Item = UtcNs> + '_ {
        (0..self.len()).filter_map(|i| self.time_at(i))
    }

    /// The first.
    pub fn first(&self) -> UtcNs {
        self.time_at(0).unwrap_or(UtcNs(0))
    }

    /// The last.
    pub fn last(&self) -> UtcNs {
        self.time_at(self.len().saturating_sub(1)).unwrap_or(UtcNs(0))
    }
}

/// `i` steps after a time, to the nearest ns.
#[expect(clippy::cast_possible_truncation, reason = "a block is far shorter than 292 years")]
#[expect(clippy::cast_precision_loss, reason = "a block has far fewer than 2^53 samples")]
pub(crate) fn after(first: UtcNs, step_ns: f64, i: usize) -> UtcNs {
    UtcNs(first.0.saturating_add((i as f64 * step_ns).round() as i64))
}
