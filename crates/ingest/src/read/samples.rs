//! Sensor samples in order of time.

use std::fs::File;
use std::path::Path;

use super::chunk;
use super::error::{Damage, ReadError};
use super::summary::{ChunkAt, Index};
use crate::mcap_file::messages::{Acceleration, Range};
use crate::mcap_file::topic;
use crate::sample::Sample;

/// All samples of a session in order of time. Holds the chunks that overlap in time: one, unless files overlapped.
pub struct Samples<'a> {
    path: &'a Path,
    file: &'a File,
    index: &'a Index,
    /// Chunks not yet opened, the latest start first.
    waiting: Vec<ChunkAt>,
    open: Vec<OpenChunk>,
    failed: bool,
}

/// The samples of one chunk, sorted by time.
struct OpenChunk {
    offset: u64,
    samples: Vec<Sample>,
    next: usize,
}

impl OpenChunk {
    fn peek(&self) -> Option<Sample> {
        self.samples.get(self.next).copied()
    }
}

impl<'a> Samples<'a> {
    pub(super) fn new(path: &'a Path, file: &'a File, index: &'a Index) -> Self {
        let mut waiting = index.sensor_chunks();
        waiting.reverse();
        Self { path, file, index, waiting, open: Vec::new(), failed: false }
    }

    fn next_sample(&mut self) -> Result<Option<Sample>, Damage> {
        loop {
            let earliest = (0..self.open.len())
                .filter_map(|i| self.open[i].peek().map(|sample| (sample.time(), self.open[i].offset, i)))
                .min();
            // A chunk that may hold an earlier sample is opened first.
            let opens_next = match (self.waiting.last(), earliest) {
                (Some(waiting), Some((time, ..))) => waiting.start <= time,
                (Some(_), None) => true,
                (None, _) => false,
            };
            if opens_next && let Some(waiting) = self.waiting.pop() {
                let opened = self.open_chunk(&waiting)?;
                self.open.extend((!opened.samples.is_empty()).then_some(opened));
                continue;
            }
            let Some((_, _, i)) = earliest else { return Ok(None) };
            let sample = self.open[i].peek();
            self.open[i].next += 1;
            if self.open[i].peek().is_none() {
                self.open.swap_remove(i);
            }
            return Ok(sample);
        }
    }

    fn open_chunk(&self, at: &ChunkAt) -> Result<OpenChunk, Damage> {
        let mut samples = Vec::new();
        chunk::for_each_message(self.file, at, |header, data| {
            let time = chunk::time_of(header)?;
            match self.index.topic(header.channel_id) {
                Some(topic::ACCELERATION) => {
                    let Acceleration { x_g, y_g, z_g } = prost::Message::decode(data)?;
                    samples.push(Sample::Acceleration { time, g: [x_g, y_g, z_g] });
                }
                Some(topic::RANGE) => {
                    let Range { range_mm } = prost::Message::decode(data)?;
                    samples.push(Sample::Range { time, mm: range_mm });
                }
                _ => {}
            }
            Ok(())
        })?;
        samples.sort_by_key(Sample::time);
        Ok(OpenChunk { offset: at.offset, samples, next: 0 })
    }
}

impl Iterator for Samples<'_> {
    type Item = Result<Sample, ReadError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let next = self.next_sample().map_err(|damage| ReadError::new(self.path, damage));
        self.failed = next.is_err();
        next.transpose()
    }
}
