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
    /// Samples with the value of the one before: a sensor that is read more often than it measures, or a still target.
    pub repeated_samples: u64,
    /// Mean of the readings, the codes left out.
    pub mean_mm: Option<f64>,
    /// Their sample SD.
    pub sd_mm: Option<f64>,
    /// The shortest of them.
    pub least_mm: Option<f64>,
    /// The longest of them.
    pub greatest_mm: Option<f64>,
    /// Readings in mm, the codes left out.
    pub range_mm: Histogram,
}

/// Mean and SD of values that pass by (Welford 1962).
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

/// Streams the range sensor's samples. None where the profile declares none.
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
