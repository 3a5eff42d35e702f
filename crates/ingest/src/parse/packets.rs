//! One binary packet: a header with a stamp, then the samples of all channels.

use super::possible::PossibleCounts;
use super::raw::{RawBlock, Stamps};
use super::scalar::{read_column, read_float, read_one, read_whole};
use super::{Converter, decimal};
use crate::profile::{Endian, Epoch, PacketLayout, SampleOrder, Scalar, StampAt};

/// Parses packets of one layout.
#[derive(Debug, Clone)]
pub struct PacketParser {
    packet_bytes: usize,
    header_bytes: usize,
    stamp: Field,
    unit_ns: i64,
    /// Whether stamps count from 1970.
    is_absolute: bool,
    /// The counter starts anew after so many ns.
    wrap_ns: Option<i64>,
    at_sample: i32,
    sequence: Option<Field>,
    sample_type: Scalar,
    endian: Endian,
    /// Byte offset of the first value of each used channel.
    channel_offsets: Vec<usize>,
    /// Likewise of each carried channel.
    extra_offsets: Vec<usize>,
    /// Bytes from a channel's value to its next.
    step_bytes: usize,
    samples: usize,
    missing: Option<f64>,
    possible: Option<PossibleCounts>,
    converter: Converter,
}

/// A number in the header.
#[derive(Debug, Clone, Copy)]
struct Field {
    offset: usize,
    scalar: Scalar,
}

/// Why a packet, or a layout, gives no samples.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PacketError {
    /// The stamp is beyond all times.
    #[error("the stamp {0} is no time")]
    Stamp(String),
    /// The layout has no such channel or field, or is beyond all sizes.
    #[error("the layout does not declare {0}")]
    Layout(String),
}

impl PacketParser {
    /// A parser of that layout. `extra`: the channels to carry along.
    ///
    /// # Errors
    /// [`PacketError::Layout`] for a layout that [`Profile::check`](crate::Profile::check) refuses.
    pub fn new(layout: &PacketLayout, extra: &[String], converter: Converter) -> Result<Self, PacketError> {
        let absent = |what: &str| PacketError::Layout(what.to_owned());
        let size = layout.sample_type.bytes();
        let header_bytes: usize = layout.header.iter().map(|field| field.scalar.bytes()).sum();
        let samples_bytes = layout.samples.checked_mul(layout.channels.len()).and_then(|n| n.checked_mul(size));
        let packet_bytes = samples_bytes.and_then(|n| n.checked_add(header_bytes));
        let packet_bytes = packet_bytes.filter(|bytes| *bytes > 0).ok_or_else(|| absent("a possible size"))?;
        let (channel_bytes, step_bytes) = match layout.order {
            SampleOrder::ChannelMajor => (layout.samples * size, size),
            SampleOrder::Interleaved => (size, layout.channels.len() * size),
        };
        let offset_of = |name: &str| {
            let index = layout.channels.iter().position(|channel| channel == name).ok_or_else(|| absent(name))?;
            Ok(header_bytes + index * channel_bytes)
        };
        let last = layout.samples.saturating_sub(1);
        let at_sample = match layout.stamp.at {
            StampAt::First => 0,
            StampAt::Last => last,
            StampAt::End => layout.samples,
        };
        Ok(Self {
            packet_bytes,
            header_bytes,
            stamp: field(layout, "stamp").ok_or_else(|| absent("stamp"))?,
            unit_ns: layout.stamp.unit.ns(),
            is_absolute: layout.stamp.epoch != Epoch::Boot,
            wrap_ns: layout.stamp.wrap_ns().and_then(|ns| i64::try_from(ns).ok()),
            at_sample: i32::try_from(at_sample).map_err(|_| absent("a possible size"))?,
            sequence: field(layout, "sequence"),
            sample_type: layout.sample_type,
            endian: layout.endian,
            channel_offsets: converter.channels().iter().map(|name| offset_of(name)).collect::<Result<_, _>>()?,
            extra_offsets: extra.iter().map(|name| offset_of(name)).collect::<Result<_, _>>()?,
            step_bytes,
            samples: layout.samples,
            missing: layout.missing,
            possible: converter.possible_counts(),
            converter,
        })
    }

    /// Bytes of a packet.
    #[must_use]
    pub fn packet_bytes(&self) -> usize {
        self.packet_bytes
    }

    /// Bytes before its samples.
    #[must_use]
    pub fn header_bytes(&self) -> usize {
        self.header_bytes
    }

    /// Whether stamps count from 1970, so that it can be told which are times.
    pub(super) fn is_absolute(&self) -> bool {
        self.is_absolute
    }

    /// How much later one stamp is than another; of a counter that wraps, the way forward.
    pub(super) fn later_ns(&self, ns: i64, than_ns: i64) -> i64 {
        let later = ns.saturating_sub(than_ns);
        self.wrap_ns.map_or(later, |wrap| later.rem_euclid(wrap))
    }

    /// The samples of one packet. Of a packet that is cut off, those of which all channels are there.
    ///
    /// # Errors
    /// [`PacketError::Stamp`] when the stamp is no time.
    pub fn parse(&self, packet: &[u8]) -> Result<RawBlock, PacketError> {
        let ns = self.stamp_ns(packet)?;
        let counts: Vec<Vec<f64>> = self.channel_offsets.iter().map(|offset| self.column(packet, *offset)).collect();
        let extra: Vec<Vec<f64>> = self.extra_offsets.iter().map(|offset| self.column(packet, *offset)).collect();
        let whole = counts.iter().map(Vec::len).min().unwrap_or(0);
        let (present, impossible) = self.present(&counts, whole);
        let carried = |column: &Vec<f64>| self.carried(column, whole, present.as_deref());
        let extra = extra.iter().map(carried).collect();
        let channels = self.converter.convert(&kept(counts, whole, present.as_deref()));
        let absent = present.as_ref().map_or(0, |present| whole - present.len()) as u64;
        let missing = absent - impossible.as_ref().map_or(0, |(samples, _)| *samples);
        Ok(RawBlock {
            stamps: Stamps::Packet {
                ns,
                at_sample: self.at_sample,
                samples: u32::try_from(self.samples).unwrap_or(u32::MAX),
                present: match present {
                    None if whole < self.samples => Some((0..u32::try_from(whole).unwrap_or(u32::MAX)).collect()),
                    present => present,
                },
            },
            sequence: self.sequence.and_then(|field| self.whole(packet, field)).and_then(|n| u32::try_from(n).ok()),
            channels,
            extra,
            missing,
            impossible,
            declared_rate_hz: None,
        })
    }

    /// The stamp in ns since the clock's epoch.
    ///
    /// # Errors
    /// [`PacketError::Stamp`] when it is no time.
    pub fn stamp_ns(&self, packet: &[u8]) -> Result<i64, PacketError> {
        let layout = (self.stamp.scalar, self.endian);
        let text = || PacketError::Stamp(read_one(packet, layout, self.stamp.offset).to_string());
        self.known_stamp_ns(packet).ok_or_else(text)
    }

    /// Reads a packet likewise, without an error text: for callers that try many places.
    pub(super) fn known_stamp_ns(&self, packet: &[u8]) -> Option<i64> {
        let ns = match self.whole(packet, self.stamp) {
            Some(units) => units.checked_mul(self.unit_ns),
            None => {
                let units = read_float(packet, (self.stamp.scalar, self.endian), self.stamp.offset);
                decimal::ns_of(units, self.unit_ns)
            }
        };
        ns.filter(|ns| *ns >= 0)
    }

    fn whole(&self, packet: &[u8], field: Field) -> Option<i64> {
        read_whole(packet, (field.scalar, self.endian), field.offset)
    }

    fn column(&self, packet: &[u8], offset: usize) -> Vec<f64> {
        let mut column = Vec::with_capacity(self.samples);
        read_column(packet, (self.sample_type, self.endian), (offset, self.step_bytes, self.samples), &mut column);
        column
    }

    /// The numbers of those of the first `whole` samples that are there; none where all are. One is missing where all its channels
    /// say so, or one is not finite. Also the number of those that no sensor gives, and the first of them.
    fn present(&self, counts: &[Vec<f64>], whole: usize) -> (Option<Vec<u32>>, Option<(u64, String)>) {
        let is_missing = |value: f64| self.missing.is_some_and(|missing| (value - missing).abs() < f64::EPSILON);
        // Whole columns without a branch, so that the common case, where nothing is missing, is vectorised.
        let mut all_missing = vec![true; whole];
        let mut finite = vec![true; whole];
        for column in counts {
            for ((all_missing, finite), value) in all_missing.iter_mut().zip(&mut finite).zip(column) {
                *all_missing &= is_missing(*value);
                *finite &= value.is_finite();
            }
        }
        let is_there = |i: usize| finite[i] && !all_missing[i];
        let impossible: Vec<usize> = self.impossible(counts, whole).into_iter().filter(|i| is_there(*i)).collect();
        let here = (0..whole).filter(|i| is_there(*i)).count() - impossible.len();
        let is_kept = |i: &usize| is_there(*i) && impossible.binary_search(i).is_err();
        let present =
            (here < whole).then(|| (0..whole).filter(is_kept).filter_map(|i| u32::try_from(i).ok()).collect());
        let first = impossible.first().map(|i| {
            let values: Vec<f64> = counts.iter().filter_map(|column| column.get(*i).copied()).collect();
            (impossible.len() as u64, format!("sample {i}: {values:?}"))
        });
        (present, first)
    }

    /// The numbers of the samples, from 0, whose counts no sensor gives, in order.
    fn impossible(&self, counts: &[Vec<f64>], whole: usize) -> Vec<usize> {
        let Some(possible) = &self.possible else { return Vec::new() };
        if counts.iter().enumerate().all(|(axis, column)| possible.are_usual(axis, column)) {
            return Vec::new();
        }
        let sample = |i: usize| counts.iter().filter_map(move |column| column.get(i).copied());
        (0..whole).filter(|i| !possible.contain(sample(*i))).collect()
    }

    #[expect(clippy::cast_possible_truncation, reason = "24 bits hold every count of a 16-bit sensor")]
    fn carried(&self, column: &[f64], whole: usize, present: Option<&[u32]>) -> Vec<f32> {
        let value = |i: usize| match column.get(i) {
            Some(value) if self.missing != Some(*value) => *value as f32,
            _ => f32::NAN,
        };
        match present {
            None => (0..whole).map(value).collect(),
            Some(present) => present.iter().map(|i| value(*i as usize)).collect(),
        }
    }
}

/// The columns without what is missing, all of one length.
fn kept(mut counts: Vec<Vec<f64>>, whole: usize, present: Option<&[u32]>) -> Vec<Vec<f64>> {
    for column in &mut counts {
        match present {
            None => column.truncate(whole),
            Some(present) => *column = present.iter().map(|i| column[*i as usize]).collect(),
        }
    }
    counts
}

fn field(layout: &PacketLayout, name: &str) -> Option<Field> {
    let mut offset = 0;
    for field in &layout.header {
        if field.field == name {
            return Some(Field { offset, scalar: field.scalar });
        }
        offset += field.scalar.bytes();
    }
    None
}
