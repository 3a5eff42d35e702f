//! Whether the values of a profile make sense together.

use super::{Axis, ImageTime, Images, PROFILE_SCHEMA_VERSION, PacketLayout, Profile, Scalar};
use crate::card::Patterns;
use crate::parse::image_time;

/// A packet is read whole; this keeps a mistyped `samples` from asking for all memory.
const LARGEST_PACKET_BYTES: usize = 16 * 1024 * 1024;

pub(super) struct Wrong {
    pub key: String,
    pub fact: String,
    pub remedy: &'static str,
}

fn wrong<T>(key: impl Into<String>, fact: impl Into<String>, remedy: &'static str) -> Result<T, Wrong> {
    Err(Wrong { key: key.into(), fact: fact.into(), remedy })
}

pub(super) fn check(profile: &Profile) -> Result<(), Wrong> {
    if profile.schema_version != PROFILE_SCHEMA_VERSION {
        let fact = format!("version {} of another program", profile.schema_version);
        return wrong("schema_version", fact, "this program reads schema_version = 1");
    }
    if !profile.mount_pitch_deg.is_finite() {
        return wrong("mount_pitch_deg", "not a finite number", "give the angle in degrees");
    }
    if let Some(stream) = &profile.acceleration {
        check_files("acceleration.files", &stream.files)?;
        check_positive("acceleration.rate_hz", stream.rate_hz)?;
        check_positive("acceleration.g_per_count", stream.g_per_count)?;
        if !stream.zero_g_counts.iter().all(|count| count.is_finite()) {
            return wrong(
                "acceleration.zero_g_counts",
                "not finite numbers",
                "give the counts at 0 g, [0, 0, 0] if unknown",
            );
        }
        check_axes(&stream.axes)?;
        check_layout(
            "acceleration",
            stream.packets.as_ref(),
            &["x", "y", "z"],
            stream.csv.as_ref().map(|c| c.delimiter),
        )?;
    }
    if let Some(stream) = &profile.range {
        check_files("range.files", &stream.files)?;
        check_positive("range.rate_hz", stream.rate_hz)?;
        check_positive("range.mm_per_count", stream.mm_per_count)?;
        check_layout("range", stream.packets.as_ref(), &["range"], stream.csv.as_ref().map(|c| c.delimiter))?;
    }
    if let Some(images) = &profile.images {
        check_images(images)?;
    }
    if profile.acceleration.is_none() && profile.range.is_none() && profile.images.is_none() {
        let remedy = "declare at least one of [acceleration], [range] and [images]";
        return wrong("acceleration", "the profile declares no files at all", remedy);
    }
    Ok(())
}

fn check_images(images: &Images) -> Result<(), Wrong> {
    check_files("images.files", &images.files)?;
    if let Some(Err(fact)) = images.time.pattern().map(image_time::check_pattern) {
        return wrong("images.time.pattern", fact, "use strptime directives; docs/devices.md has examples");
    }
    match images.time {
        ImageTime::Both { tolerance_s, .. } if !(tolerance_s.is_finite() && tolerance_s >= 0.0) => {
            let fact = format!("{tolerance_s} is not a time in seconds");
            wrong("images.time.tolerance_s", fact, "give how far name and EXIF may be apart: 0 or more seconds")
        }
        _ => Ok(()),
    }
}

fn check_files(key: &str, files: &[String]) -> Result<(), Wrong> {
    if files.is_empty() {
        return wrong(key, "no patterns", "give at least one pattern, such as \"SENSORS/*.BIN\"");
    }
    match Patterns::new(files) {
        Ok(_) => Ok(()),
        Err(error) => wrong(key, error.to_string(), "correct the pattern; * stays within a folder, ** does not"),
    }
}

fn check_positive(key: &str, value: f64) -> Result<(), Wrong> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    wrong(key, format!("{value} is not a positive number"), "give a positive number; signs belong in axes")
}

fn check_axes(axes: &[Axis; 3]) -> Result<(), Wrong> {
    let mut indices = axes.map(Axis::index);
    indices.sort_unstable();
    if indices == [0, 1, 2] {
        return Ok(());
    }
    wrong("acceleration.axes", "a sensor axis is used twice", "name x, y and z once each, with their signs")
}

fn check_layout(
    stream: &str,
    packets: Option<&PacketLayout>,
    needed: &[&str],
    delimiter: Option<char>,
) -> Result<(), Wrong> {
    match (packets, delimiter) {
        (Some(_), Some(_)) => wrong(stream, "both packets and csv are given", "keep the one that the files have"),
        (None, None) => wrong(stream, "neither packets nor csv is given", "add one of the two tables"),
        (Some(layout), None) => check_packets(&format!("{stream}.packets"), layout, needed),
        (None, Some(delimiter)) if delimiter.is_ascii() && !matches!(delimiter, '"' | '\n' | '\r') => Ok(()),
        (None, Some(_)) => wrong(format!("{stream}.csv.delimiter"), "not a delimiter", "give one ASCII character"),
    }
}

fn check_packets(key: &str, layout: &PacketLayout, needed: &[&str]) -> Result<(), Wrong> {
    let stamps: Vec<_> = layout.header.iter().filter(|field| field.field == "stamp").collect();
    let [stamp] = stamps[..] else {
        return wrong(
            format!("{key}.header"),
            format!("{} fields named stamp", stamps.len()),
            "name exactly one field stamp",
        );
    };
    if !matches!(stamp.scalar, Scalar::F64 | Scalar::U32 | Scalar::U64 | Scalar::I64) {
        let remedy = "a stamp in seconds is f64, u32, u64 or i64 (an f32 is 128 s coarse today)";
        return wrong(format!("{key}.header"), "the stamp's type cannot hold a time of today", remedy);
    }
    for name in needed {
        let count = layout.channels.iter().filter(|channel| channel == name).count();
        if count != 1 {
            return wrong(
                format!("{key}.channels"),
                format!("{count} channels named {name}"),
                "name each exactly once",
            );
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
