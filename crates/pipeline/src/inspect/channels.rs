//! The facts of channels that are carried along and not used.

use ingest::profile::Profile;
use ingest::{ReadError, SessionReader};
use jiff::tz::TimeZone;
use model::UtcNs;
use serde::Serialize;

use super::local_time::LocalSpan;

/// A channel that is carried along. Its clock is that of the sensor whose files it stands in.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExtraFacts {
    /// The name, as the profile declares it; the topic is /extra/NAME.
    pub name: String,
    /// The sensor whose files it stands in: `acceleration` or `range`.
    pub sensor: Option<&'static str>,
    /// The number of samples, including those without a value.
    pub samples: u64,
    /// The number of samples without a value.
    pub missing_samples: u64,
    /// The time from the first sample to the last.
    pub recorded: Option<LocalSpan>,
    /// The least value, as the device counts it.
    pub least: Option<f64>,
    /// The mean value, as the device counts it.
    pub mean: Option<f64>,
    /// The greatest value, as the device counts it.
    pub greatest: Option<f64>,
}

/// The facts of each channel that is carried along, streamed one after the other.
pub(super) fn read(reader: &mut SessionReader, zone: &TimeZone) -> Result<Vec<ExtraFacts>, ReadError> {
    let names = reader.extra_channels();
    names.into_iter().map(|name| read_one(reader, name, zone)).collect()
}

fn read_one(reader: &mut SessionReader, name: String, zone: &TimeZone) -> Result<ExtraFacts, ReadError> {
    let mut values = Values::default();
    reader.for_each_extra(&name, |time, value| values.add(time, f64::from(value)))?;
    let with_value = values.samples - values.missing;
    #[expect(clippy::cast_precision_loss, reason = "2^53 samples are two million years")]
    let mean = (with_value > 0).then(|| values.sum / with_value as f64);
    Ok(ExtraFacts {
        sensor: sensor_of(&reader.metadata().profile, &name),
        samples: values.samples,
        missing_samples: values.missing,
        recorded: values.span.map(|(from, to)| LocalSpan::new(from, to, zone)),
        least: values.range.map(|(least, _)| least),
        mean,
        greatest: values.range.map(|(_, greatest)| greatest),
        name,
    })
}

fn sensor_of(profile: &Profile, name: &str) -> Option<&'static str> {
    let has = |extra: &[String]| extra.iter().any(|declared| declared == name);
    if profile.acceleration.as_ref().is_some_and(|stream| has(&stream.extra)) {
        return Some("acceleration");
    }
    profile.range.as_ref().is_some_and(|stream| has(&stream.extra)).then_some("range")
}

#[derive(Default)]
struct Values {
    samples: u64,
    missing: u64,
    span: Option<(UtcNs, UtcNs)>,
    range: Option<(f64, f64)>,
    sum: f64,
}

impl Values {
    fn add(&mut self, time: UtcNs, value: f64) {
        self.samples += 1;
        self.span = Some(self.span.map_or((time, time), |(from, to)| (from.min(time), to.max(time))));
        if !value.is_finite() {
            self.missing += 1;
            return;
        }
        self.sum += value;
        self.range = Some(self.range.map_or((value, value), |(least, most)| (least.min(value), most.max(value))));
    }
}
