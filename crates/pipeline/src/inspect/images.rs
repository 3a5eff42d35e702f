//! The facts of the images of a session, from their list alone.

use std::collections::BTreeMap;

use ingest::{DroppedImage, ImageEntry};
use jiff::tz::TimeZone;
use model::{FrameReason, median};
use serde::Serialize;

use super::local_time::LocalSpan;

/// The facts of the images of a session.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ImageFacts {
    /// The number of images that can be used.
    pub count: usize,
    /// The bytes of their files.
    pub bytes: u64,
    /// The time from the first to the last.
    pub recorded: Option<LocalSpan>,
    /// The median of the times between them.
    pub median_period_s: Option<f64>,
    /// The longest time between two of them.
    pub longest_period_s: Option<f64>,
    /// The images that cannot be used, by reason.
    pub dropped: Vec<DroppedImages>,
}

/// Images that cannot be used for one reason.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct DroppedImages {
    /// The reason (docs/ledger.md).
    pub reason: FrameReason,
    /// The number of images.
    pub count: usize,
    /// The bytes of their files.
    pub bytes: u64,
}

impl ImageFacts {
    /// The facts of `images`, which must be in the order of time.
    pub(super) fn new(images: &[ImageEntry], dropped: &[DroppedImage], zone: &TimeZone) -> Self {
        let periods_s: Vec<f64> = images.windows(2).map(|pair| pair[1].time.seconds_since(pair[0].time)).collect();
        let ends = images.first().zip(images.last());
        Self {
            count: images.len(),
            bytes: images.iter().map(|image| image.bytes).sum(),
            recorded: ends.map(|(first, last)| LocalSpan::new(first.time, last.time, zone)),
            longest_period_s: periods_s.iter().copied().max_by(f64::total_cmp),
            median_period_s: (!periods_s.is_empty()).then(|| median(periods_s)),
            dropped: by_reason(dropped),
        }
    }
}

fn by_reason(dropped: &[DroppedImage]) -> Vec<DroppedImages> {
    let mut counts: BTreeMap<FrameReason, (usize, u64)> = BTreeMap::new();
    for image in dropped {
        let (count, bytes) = counts.entry(image.reason).or_default();
        *count += 1;
        *bytes += image.bytes;
    }
    counts.into_iter().map(|(reason, (count, bytes))| DroppedImages { reason, count, bytes }).collect()
}
