//! Samples of one sensor in order of time.

use std::fs::File;

use model::UtcNs;

use super::chunk;
use super::error::Damage;
use super::summary::{ChunkAt, Index};
use crate::mcap_file::messages::{AccelerationBlock, ExtraBlock, RangeBlock};
use crate::timeline::Times;

/// A sensor, as its messages are read.
pub(super) trait Sensor {
    /// One sample.
    type Value: Copy;

    /// Appends the samples of one message.
    fn decode(time: UtcNs, data: &[u8], out: &mut Vec<(UtcNs, Self::Value)>) -> Result<(), Damage>;
}

/// Specific force in g, device frame.
pub(super) struct Acceleration;
/// Range in mm, as the sensor gave it.
pub(super) struct Range;
/// A channel that is carried along, as the device counts it.
pub(super) struct Extra;

impl Sensor for Acceleration {
    type Value = [f32; 3];

    fn decode(time: UtcNs, data: &[u8], out: &mut Vec<(UtcNs, [f32; 3])>) -> Result<(), Damage> {
        let AccelerationBlock { step_ns, offset_ns, x_g, y_g, z_g } = prost::Message::decode(data)?;
        let samples = x_g.len();
        if [y_g.len(), z_g.len()] != [samples; 2] {
            return Err(Damage::Lengths);
        }
        let values = x_g.into_iter().zip(y_g).zip(z_g).map(|((x, y), z)| [x, y, z]);
        timed(time, (step_ns, offset_ns), samples, values, out)
    }
}

impl Sensor for Range {
    type Value = f32;

    fn decode(time: UtcNs, data: &[u8], out: &mut Vec<(UtcNs, f32)>) -> Result<(), Damage> {
        let RangeBlock { step_ns, offset_ns, range_mm } = prost::Message::decode(data)?;
        timed(time, (step_ns, offset_ns), range_mm.len(), range_mm.into_iter(), out)
    }
}

impl Sensor for Extra {
    type Value = f32;

    fn decode(time: UtcNs, data: &[u8], out: &mut Vec<(UtcNs, f32)>) -> Result<(), Damage> {
        let ExtraBlock { step_ns, offset_ns, value } = prost::Message::decode(data)?;
        timed(time, (step_ns, offset_ns), value.len(), value.into_iter(), out)
    }
}

fn timed<V>(
    first: UtcNs,
    (step_ns, offset_ns): (f64, Vec<u64>),
    samples: usize,
    values: impl Iterator<Item = V>,
    out: &mut Vec<(UtcNs, V)>,
) -> Result<(), Damage> {
    if step_ns > 0.0 {
        out.extend(Times::Even { first, step_ns, samples }.each().zip(values));
        return Ok(());
    }
    if offset_ns.len() != samples {
        return Err(Damage::Lengths);
    }
    let time = |offset: u64| i64::try_from(offset).ok().and_then(|offset| first.0.checked_add(offset)).map(UtcNs);
    let times: Option<Vec<UtcNs>> = offset_ns.into_iter().map(time).collect();
    out.extend(times.ok_or(Damage::Lengths)?.into_iter().zip(values));
    Ok(())
}

/// Calls `each` with all samples of a topic in order of time; at equal times in the order of the file. Holds the chunks
/// that overlap in time: one, unless the clock was set back.
pub(super) fn for_each<S: Sensor>(
    file: &File,
    index: &Index,
    topic: &str,
    mut each: impl FnMut(UtcNs, S::Value),
) -> Result<(), Damage> {
    let mut waiting = index.sensor_chunks(topic).into_iter().peekable();
    let mut open: Vec<Open<S>> = Vec::new();
    loop {
        let earliest = (0..open.len()).min_by_key(|i| (open[*i].time(), open[*i].offset));
        let opens_next = waiting.peek().is_some_and(|next| {
            // A chunk that may hold an earlier sample is opened first.
            earliest.is_none_or(|i| next.start <= open[i].time())
        });
        if opens_next {
            let Some(at) = waiting.next() else { continue };
            open.extend(Open::read(file, index, topic, &at)?);
            continue;
        }
        let Some(i) = earliest else { return Ok(()) };
        let until = next_time(&open, i, waiting.peek());
        let chunk = &mut open[i];
        let samples = &chunk.samples[chunk.next..];
        // At least one, since it is the earliest.
        let n = until.map_or(samples.len(), |until| samples.partition_point(|(time, _)| *time < until)).max(1);
        samples[..n].iter().for_each(|(time, value)| each(*time, *value));
        chunk.next += n;
        if chunk.next >= chunk.samples.len() {
            open.remove(i);
        }
    }
}

/// Until when chunk `i` may be read on without looking at the others.
fn next_time<S: Sensor>(open: &[Open<S>], i: usize, waiting: Option<&ChunkAt>) -> Option<UtcNs> {
    let others = open.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, chunk)| chunk.time());
    others.chain(waiting.map(|next| next.start)).min()
}

/// The samples of one chunk, sorted by time; never at its end.
struct Open<S: Sensor> {
    offset: u64,
    samples: Vec<(UtcNs, S::Value)>,
    next: usize,
}

impl<S: Sensor> Open<S> {
    fn read(file: &File, index: &Index, topic: &str, at: &ChunkAt) -> Result<Option<Self>, Damage> {
        let mut samples = Vec::new();
        chunk::for_each_message(file, at, |header, data| {
            if index.topic(header.channel_id) == Some(topic) {
                S::decode(chunk::time_of(header)?, data, &mut samples)?;
            }
            Ok(())
        })?;
        if !samples.is_sorted_by_key(|(time, _)| *time) {
            samples.sort_by_key(|(time, _)| *time);
        }
        if samples.first().is_some_and(|(time, _)| *time < at.start) {
            // Earlier samples of other chunks may be out already.
            return Err(Damage::Unexpected { expected: "chunk that begins when the index says", offset: at.offset });
        }
        Ok((!samples.is_empty()).then_some(Self { offset: at.offset, samples, next: 0 }))
    }

    fn time(&self) -> UtcNs {
        self.samples[self.next].0
    }
}
