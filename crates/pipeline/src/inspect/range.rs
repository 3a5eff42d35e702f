//! The facts of the range sensor: the distances of the table.

use ingest::timeline::StreamFacts;
use ingest::{ReadError, SessionReader};
use jiff::tz::TimeZone;
use serde::Serialize;

use super::clock::ClockFacts;
use super::histogram::Histogram;
use crate::signals::NO_TARGET_MM;

/// The bins of the range: 0 to 2000 mm.
const RANGE_BIN_MM: f64 = 100.0;
const RANGE_BINS: u32 = 20;

/// The facts of a range sensor's recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RangeFacts {
    /// The facts of its clock.
    pub clock: ClockFacts,
    /// The number of samples that say 'no target' (codes 8190 and 8191).
    pub no_target_samples: u64,
    /// The number of samples with the value of the one before: the sensor is read more often than it measures, or the target
    /// is still.
    pub repeated_samples: u64,
    /// The mean of the readings, without the codes.
    pub mean_mm: Option<f64>,
    /// Their sample SD.
    pub sd_mm: Option<f64>,
    /// The shortest reading.
    pub least_mm: Option<f64>,
    /// The longest reading.
    pub greatest_mm: Option<f64>,
    /// The readings in mm, without the codes.
    pub range_mm: Histogram,
}

/// The mean and the SD of values that pass by (Welford 1962).
#[derive(Debug, Default)]
struct Moments {
    n: f64,
    mean: f64,
    squares: f64,
    extremes: Option<(f64, f64)>,
}

impl Moments {
    fn add(&mut self, value: f64) {
        self.n += 1.0;
        let from_mean = value - self.mean;
        self.mean += from_mean / self.n;
        self.squares += from_mean * (value - self.mean);
        let (least, greatest) = self.extremes.unwrap_or((value, value));
        self.extremes = Some((least.min(value), greatest.max(value)));
    }
}

/// The facts of the range sensor's samples, streamed. None where the profile declares no range sensor.
pub(super) fn read(
    reader: &mut SessionReader,
    facts: Option<&StreamFacts>,
    zone: &TimeZone,
) -> Result<Option<RangeFacts>, ReadError> {
    let Some(facts) = facts else { return Ok(None) };
    let mut range_mm = Histogram::new(0.0, RANGE_BIN_MM, RANGE_BINS);
    let (mut no_target_samples, mut repeated_samples) = (0, 0);
    let mut moments = Moments::default();
    let mut last = None;
    reader.for_each_range(|_, mm| {
        let mm = f64::from(mm);
        repeated_samples += u64::from(last.replace(mm) == Some(mm));
        if NO_TARGET_MM.contains(&mm) {
            no_target_samples += 1;
        } else {
            range_mm.add(mm);
            moments.add(mm);
        }
    })?;
    Ok(Some(RangeFacts {
        clock: ClockFacts::new(facts, zone),
        no_target_samples,
        repeated_samples,
        mean_mm: moments.extremes.map(|_| moments.mean),
        sd_mm: (moments.n > 1.0).then(|| (moments.squares / (moments.n - 1.0)).sqrt()),
        least_mm: moments.extremes.map(|(least, _)| least),
        greatest_mm: moments.extremes.map(|(_, greatest)| greatest),
        range_mm,
    }))
}
