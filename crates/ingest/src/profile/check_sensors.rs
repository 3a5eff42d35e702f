//! Whether what a profile says of its sensors makes sense.

use super::check::{Wrong, check_files, check_positive, wrong};
use super::{Anchor, Axis, CsvFormat, Epoch, NoTarget, PacketLayout, Profile, RangeStream, RowTime, Scalar};
use crate::parse::{image_time, written_time};

/// A packet is read whole; this keeps a mistyped `samples` from asking for all memory.
const LARGEST_PACKET_BYTES: usize = 16 * 1024 * 1024;
/// A counter narrower than this starts anew within a second of milliseconds.
const WRAP_BITS: std::ops::RangeInclusive<u32> = 10..=63;

pub(super) fn check(profile: &Profile) -> Result<(), Wrong> {
    if let Some(stream) = &profile.acceleration {
        check_stream("acceleration", &stream.files, stream.rate_hz, stream.gap_s)?;
        check_positive("acceleration.g_per_count", stream.g_per_count)?;
        if !stream.zero_g_counts.iter().all(|count| count.is_finite()) {
            let remedy = "give the counts at 0 g, [0, 0, 0] if unknown";
            return wrong("acceleration.zero_g_counts", "not finite numbers", remedy);
        }
        stream.full_scale_g.map_or(Ok(()), |full| check_positive("acceleration.full_scale_g", full))?;
        check_axes(&stream.axes)?;
        let csv = stream.csv.as_ref().map(|csv| (csv.format(), &csv.time));
        check_one("acceleration", [stream.packets.is_some(), csv.is_some(), stream.cwa.is_some()])?;
        check_layouts("acceleration", profile, (stream.packets.as_ref(), &["x", "y", "z"]), &stream.extra, csv)?;
    }
    if let Some(stream) = &profile.range {
        check_stream("range", &stream.files, stream.rate_hz, stream.gap_s)?;
        check_positive("range.mm_per_count", stream.mm_per_count)?;
        check_no_target(stream)?;
        let csv = stream.csv.as_ref().map(|csv| (csv.format(), &csv.time));
        check_one("range", [stream.packets.is_some(), csv.is_some(), false])?;
        check_layouts("range", profile, (stream.packets.as_ref(), &["range"]), &stream.extra, csv)?;
    }
    match profile.clock.as_ref().map(|clock| &clock.anchor) {
        Some(Anchor::Name { pattern }) => image_time::check_pattern(pattern).or_else(|fact| {
            wrong("clock.anchor.pattern", fact, "use strptime directives; docs/devices.md has examples")
        }),
        _ => Ok(()),
    }
}

fn check_stream(stream: &str, files: &[String], rate_hz: f64, gap_s: Option<f64>) -> Result<(), Wrong> {
    check_files(&format!("{stream}.files"), files)?;
    check_positive(&format!("{stream}.rate_hz"), rate_hz)?;
    gap_s.map_or(Ok(()), |gap_s| check_positive(&format!("{stream}.gap_s"), gap_s))
}

fn check_no_target(stream: &RangeStream) -> Result<(), Wrong> {
    for code in stream.no_target.iter().flatten() {
        match code {
            NoTarget::Number(number) if !number.is_finite() => {
                let remedy = "give a finite number, or the word that stands in the file, between quotes";
                return wrong("range.no_target", format!("{number} is not a finite number"), remedy);
            }
            NoTarget::Word(word) if stream.packets.is_some() && code.number().is_none() => {
                let fact = format!("packets cannot hold the word '{word}'");
                return wrong("range.no_target", fact, "give the numbers that the packets hold");
            }
            _ => {}
        }
    }
    Ok(())
}

fn check_axes(axes: &[Axis; 3]) -> Result<(), Wrong> {
    let mut indices = axes.map(Axis::index);
    indices.sort_unstable();
    if indices == [0, 1, 2] {
        return Ok(());
    }
    wrong("acceleration.axes", "a sensor axis is used twice", "name x, y and z once each, with their signs")
}

fn check_one(stream: &str, given: [bool; 3]) -> Result<(), Wrong> {
    match given.iter().filter(|given| **given).count() {
        1 => Ok(()),
        0 => wrong(stream, "no layout: neither packets nor csv nor cwa is given", "add one of these tables"),
        _ => wrong(stream, "more than one of packets, csv and cwa is given", "keep the one that the files have"),
    }
}

fn check_layouts(
    stream: &str,
    profile: &Profile,
    (packets, needed): (Option<&PacketLayout>, &[&str]),
    extra: &[String],
    csv: Option<(CsvFormat, &RowTime)>,
) -> Result<(), Wrong> {
    if let Some(layout) = packets {
        let key = format!("{stream}.packets");
        check_packets(&key, layout, needed)?;
        check_extra(stream, layout, extra)?;
        check_wrap(&format!("{key}.stamp.wrap_bits"), layout.stamp.wrap_bits)?;
        check_anchor(&format!("{key}.stamp.epoch"), layout.stamp.epoch, profile)?;
    }
    let Some((format, time)) = csv else { return Ok(()) };
    let key = format!("{stream}.csv");
    if format.decimal_comma && format.delimiter == ',' {
        let fact = "the comma is both delimiter and decimal comma";
        return wrong(format!("{key}.delimiter"), fact, "give the delimiter that the file has, such as \";\"");
    }
    let delimiter = format.delimiter;
    if !delimiter.is_ascii() || matches!(delimiter, '"' | '\n' | '\r') {
        return wrong(format!("{key}.delimiter"), "not a delimiter", "give one ASCII character");
    }
    check_row_time(&format!("{key}.time"), time, profile)
}

fn check_row_time(key: &str, time: &RowTime, profile: &Profile) -> Result<(), Wrong> {
    let given = [time.column.is_some(), time.rows_per_s.is_some(), time.rows_over_s.is_some()];
    if given.iter().filter(|given| **given).count() != 1 {
        let remedy = "give the column with the time, or rows_per_s or rows_over_s where there is none";
        return wrong(key, "expected exactly one of column, rows_per_s and rows_over_s", remedy);
    }
    for (name, value) in [("rows_per_s", time.rows_per_s), ("rows_over_s", time.rows_over_s)] {
        value.map_or(Ok(()), |value| check_positive(&format!("{key}.{name}"), value))?;
    }
    if time.column.is_none() {
        return check_anchor(key, Epoch::Boot, profile);
    }
    if time.unit.is_some() == time.format.is_some() {
        return wrong(key, "expected either unit or format", "unit for numbers (s, ms, us, ns), format for texts");
    }
    if let Some(Err(fact)) = time.format.as_deref().map(|format| written_time::check_pattern(format, false)) {
        return wrong(format!("{key}.format"), fact, "use strptime directives; docs/devices.md has examples");
    }
    check_wrap(&format!("{key}.wrap_bits"), time.wrap_bits)?;
    check_anchor(&format!("{key}.epoch"), time.epoch, profile)
}

/// A clock that counts from the device's start needs to be told when that was.
fn check_anchor(key: &str, epoch: Epoch, profile: &Profile) -> Result<(), Wrong> {
    if epoch != Epoch::Boot || profile.clock.is_some() {
        return Ok(());
    }
    let remedy = "add [clock] anchor = { from = \"session\" } or { from = \"name\", pattern = \"...\" }";
    wrong(key, "the time counts from when the device was started, and nothing says when that was", remedy)
}

fn check_wrap(key: &str, bits: Option<u32>) -> Result<(), Wrong> {
    match bits {
        Some(bits) if !WRAP_BITS.contains(&bits) => {
            wrong(key, format!("{bits} bits"), "give the width of the counter, 10 to 63 bits")
        }
        _ => Ok(()),
    }
}

fn check_extra(stream: &str, layout: &PacketLayout, extra: &[String]) -> Result<(), Wrong> {
    match extra.iter().find(|name| !layout.channels.contains(name)) {
        None => Ok(()),
        Some(name) => {
            wrong(format!("{stream}.extra"), format!("no channel named {name}"), "name channels of the packets")
        }
    }
}

fn check_packets(key: &str, layout: &PacketLayout, needed: &[&str]) -> Result<(), Wrong> {
    let stamps: Vec<_> = layout.header.iter().filter(|field| field.field == "stamp").collect();
    let [stamp] = stamps[..] else {
        let fact = format!("{} fields named stamp", stamps.len());
        return wrong(format!("{key}.header"), fact, "name exactly one field stamp");
    };
    check_stamp(key, layout, stamp.scalar)?;
    for name in needed {
        let count = layout.channels.iter().filter(|channel| channel == name).count();
        if count != 1 {
            let fact = format!("{count} channels named {name}");
            return wrong(format!("{key}.channels"), fact, "name each exactly once");
        }
    }
    let header: usize = layout.header.iter().map(|field| field.scalar.bytes()).sum();
    let samples =
        layout.samples.checked_mul(layout.channels.len()).and_then(|n| n.checked_mul(layout.sample_type.bytes()));
    match samples.and_then(|n| n.checked_add(header)) {
        _ if layout.samples == 0 => wrong(format!("{key}.samples"), "0 samples", "give the samples per packet"),
        Some(bytes) if bytes <= LARGEST_PACKET_BYTES => Ok(()),
        _ => wrong(format!("{key}.samples"), "a packet of more than 16 MiB", "correct samples or channels"),
    }
}

/// Whether the stamp's type can hold a time of today, if it counts from 1970.
fn check_stamp(key: &str, layout: &PacketLayout, scalar: Scalar) -> Result<(), Wrong> {
    let is_wide = match scalar {
        Scalar::F64 | Scalar::U64 | Scalar::I64 => true,
        Scalar::U32 | Scalar::I32 => layout.stamp.unit == super::TimeUnit::S || layout.stamp.wrap_bits.is_some(),
        _ => false,
    };
    if is_wide || layout.stamp.epoch == Epoch::Boot {
        return Ok(());
    }
    let remedy = "a stamp since 1970 is f64, u64 or i64, or u32 in seconds (an f32 is 128 s coarse today)";
    wrong(format!("{key}.header"), "the stamp's type cannot hold a time of today", remedy)
}
