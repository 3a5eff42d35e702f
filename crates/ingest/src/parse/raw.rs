//! The output of a parser for one packet or some rows: values in physical units, times as the device wrote them.

/// Consecutive samples as they stand in a file.
#[derive(Debug, Clone, PartialEq)]
pub struct RawBlock {
    /// The time at which they were taken, on the device's clock.
    pub stamps: Stamps,
    /// Number of the packet, where its header has one.
    pub sequence: Option<u32>,
    /// One per used channel: x, y, z in g (device frame), or the range in mm. As many values as samples.
    pub channels: Vec<Vec<f32>>,
    /// One per carried channel, as counted by the device; NaN where missing.
    pub extra: Vec<Vec<f32>>,
    /// Samples that the file marks as missing.
    pub missing: u64,
    /// The number of samples of a packet that no sensor gives, which are left out, and the first of them.
    pub impossible: Option<(u64, String)>,
    /// The rate that the file itself declares, Hz.
    pub declared_rate_hz: Option<f64>,
}

/// The times of a block on the device's clock, in ns since its epoch.
#[derive(Debug, Clone, PartialEq)]
pub enum Stamps {
    /// One stamp for a packet.
    Packet {
        /// The stamp.
        ns: i64,
        /// The sample that it is the time of, from 0; it may lie outside of the packet.
        at_sample: i32,
        /// Samples in the packet, missing ones included.
        samples: u32,
        /// A flag for each of them that is true where it is there; none where all are.
        present: Option<Vec<u32>>,
    },
    /// One stamp per sample.
    Each(Vec<i64>),
    /// There is no stamp: samples count from the first one of the file, and this many come before the first one here. Which are
    /// there is given as above.
    Counted {
        /// Number of the first sample.
        first: u64,
        /// Samples, missing ones included.
        samples: u32,
        /// A flag for each of them that is true where it is there; none where all are.
        present: Option<Vec<u32>>,
    },
}

impl RawBlock {
    /// The number of samples that it has.
    #[must_use]
    pub fn len(&self) -> usize {
        self.channels.first().map_or(0, Vec::len)
    }

    /// Whether it has none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
