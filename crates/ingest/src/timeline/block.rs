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

impl Block {
    /// The block in parts, each of which spans less than `most_ns` (at least 1), in order; all but the last are as long as that allows.
    /// Every sample keeps its time, to 1 ns where they are even.
    pub fn parts(mut self, most_ns: u64) -> Vec<Self> {
        let starts = self.times.starts(most_ns);
        // From the end, so that the time of each part is worked out from that of the whole.
        let mut parts: Vec<Self> = starts.into_iter().rev().map(|at| self.split_off(at)).collect();
        parts.push(self);
        parts.reverse();
        parts
    }

    /// Takes off all samples from number `at` on.
    fn split_off(&mut self, at: usize) -> Self {
        let of_columns = |columns: &mut Vec<Vec<f32>>| columns.iter_mut().map(|column| column.split_off(at)).collect();
        Self {
            times: self.times.split_off(at),
            sequence: self.sequence,
            channels: of_columns(&mut self.channels),
            extra: of_columns(&mut self.extra),
        }
    }
}

impl Times {
    /// The numbers of the samples at which parts of less than `most_ns` begin, but for the first.
    fn starts(&self, most_ns: u64) -> Vec<usize> {
        let next = |begin: usize| {
            let first = self.time_at(begin)?;
            let is_within = |number: usize| self.time_at(number).is_some_and(|time| time.0.abs_diff(first.0) < most_ns);
            let (mut within, mut beyond) = (begin, self.len()); // times are in order, so the border is found by halves
            while beyond - within > 1 {
                let middle = within.midpoint(beyond);
                *(if is_within(middle) { &mut within } else { &mut beyond }) = middle;
            }
            (beyond < self.len()).then_some(beyond)
        };
        std::iter::successors(next(0), |begin| next(*begin)).collect()
    }

    fn split_off(&mut self, at: usize) -> Self {
        match self {
            Self::Even { first, step_ns, samples } => {
                let rest = Self::Even {
                    first: after(*first, *step_ns, at),
                    step_ns: *step_ns,
                    samples: samples.saturating_sub(at),
                };
                *samples = at.min(*samples);
                rest
            }
            Self::Each(times) => Self::Each(times.split_off(at)),
        }
    }
}

/// `i` steps after a time, to the nearest ns.
#[expect(clippy::cast_possible_truncation, reason = "a block is far shorter than 292 years")]
#[expect(clippy::cast_precision_loss, reason = "a block has far fewer than 2^53 samples")]
pub(crate) fn after(first: UtcNs, step_ns: f64, i: usize) -> UtcNs {
    UtcNs(first.0.saturating_add((i as f64 * step_ns).round() as i64))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const SECOND_NS: u64 = 1_000_000_000;

    /// A block whose values are the numbers of its samples.
    fn block(times: Times) -> Block {
        let numbers: Vec<f32> = (0_u16..).take(times.len()).map(f32::from).collect();
        Block { times, sequence: Some(7), channels: vec![numbers.clone(); 3], extra: vec![numbers] }
    }

    fn times() -> impl Strategy<Value = Times> {
        let even = (0..i64::MAX / 4, 1e5..3e9_f64, 1..2000_usize).prop_map(|(first, step_ns, samples)| Times::Even {
            first: UtcNs(first),
            step_ns,
            samples,
        });
        let each = prop::collection::vec(0..4_000_000_000_i64, 1..500).prop_map(|steps| {
            let add = |time: &mut i64, step: i64| {
                *time += step;
                Some(UtcNs(*time))
            };
            Times::Each(steps.into_iter().scan(0, add).collect())
        });
        prop_oneof![even, each]
    }

    proptest! {
        #[test]
        fn parts_hold_the_samples_of_the_whole(times in times()) {
            let whole = block(times);
            let parts = whole.clone().parts(SECOND_NS);
            let joined = |column: fn(&Block) -> &Vec<f32>| parts.iter().flat_map(column).copied().collect::<Vec<_>>();
            prop_assert_eq!(joined(|part| &part.channels[2]), whole.channels[2].clone());
            prop_assert_eq!(joined(|part| &part.extra[0]), whole.extra[0].clone());
            let of_parts: Vec<UtcNs> = parts.iter().flat_map(|part| part.times.each()).collect();
            prop_assert_eq!(of_parts.len(), whole.times.len());
            for (part, whole) in of_parts.iter().zip(whole.times.each()) {
                prop_assert!(part.0.abs_diff(whole.0) <= 1, "{part:?} {whole:?}");
            }
            for (part, next) in parts.iter().zip(parts.iter().skip(1)) {
                prop_assert!(next.times.first().0.abs_diff(part.times.first().0) >= SECOND_NS, "no shorter than it may be");
            }
            for part in &parts {
                prop_assert!(part.times.last().0.abs_diff(part.times.first().0) < SECOND_NS);
                prop_assert!(!part.times.is_empty() && part.channels.iter().all(|column| column.len() == part.times.len()));
            }
        }
    }
}
