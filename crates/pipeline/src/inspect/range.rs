//! The range sensor: how far the table was.

use ingest::timeline::StreamFacts;
use ingest::{ReadError, SessionReader};
use jiff::tz::TimeZone;
use serde::Serialize;

use super::clock::ClockFacts;
use super::histogram::Histogram;
use crate::signals::NO_TARGET_MM;

/// Bins of the range: 0 to 2000 mm.
const RANGE_BIN_MM: f64 = 100.0;
const RANGE_BINS: u32 = 20;

/// What the range sensor recorded.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RangeFacts {
    /// Its clock.
    pub clock: ClockFacts,
    /// Samples that say 'no target' (codes 8190 and 8191).
    pub no_target_samples: u64,
    /// Readings in mm, the codes left out.
    pub range_mm: Histogram,
}

/// Streams the range sensor's samples. None where the profile declares none.
pub(super) fn read(
    reader: &mut SessionReader,
    facts: Option<&StreamFacts>,
    zone: &TimeZone,
) -> Result<Option<RangeFacts>, ReadError> {
    let Some(facts) = facts else { return Ok(None) };
    let mut range_mm = Histogram::new(0.0, RANGE_BIN_MM, RANGE_BINS);
    let mut no_target_samples = 0;
    reader.for_each_range(|_, mm| {
        let mm = f64::from(mm);
        if NO_TARGET_MM.contains(&mm) {
            no_target_samples += 1;
        } else {
            range_mm.add(mm);
        }
    })?;
    Ok(Some(RangeFacts { clock: ClockFacts::new(facts, zone), no_target_samples, range_mm }))
}
