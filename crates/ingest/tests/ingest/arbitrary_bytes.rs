//! No parser panics, whatever the bytes.

use aim_batch_ingest::parse::{Converter, CsvSamples, PacketParser, PacketSamples, image_header, image_time};
use aim_batch_ingest::profile::{TimeColumn, TimeUnit};
use aim_batch_ingest::{Profile, SessionReader, config};
use jiff::tz::TimeZone;
use proptest::prelude::*;
use std::io::Write;
use std::path::Path;

use crate::support::{jpeg, jpeg_with_exif};

/// Bytes with some of them altered: gets deeper into a parser than noise.
fn altered(bytes: Vec<u8>) -> impl Strategy<Value = Vec<u8>> {
    let length = bytes.len();
    prop::collection::vec((0..length, any::<u8>()), 0..8).prop_map(move |changes| {
        let mut bytes = bytes.clone();
        for (at, byte) in changes {
            bytes[at] = byte;
        }
        bytes
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn packets(bytes in prop::collection::vec(any::<u8>(), 0..400), samples in 1_usize..20, rate_hz in 1e-9_f64..1e9) {
        let profile = Profile::load("aim2-packets", Path::new("none")).unwrap();
        let stream = profile.acceleration.unwrap();
        let layout = aim_batch_ingest::profile::PacketLayout { samples, ..stream.packets.clone().unwrap() };
        let parser = PacketParser::new(&layout, rate_hz, Converter::from(&stream)).unwrap();
        let whole = bytes.len() / parser.packet_bytes();
        let mut packets = PacketSamples::new(bytes.as_slice(), parser);
        let mut out = Vec::new();
        while packets.next_batch(&mut out) {}
        prop_assert!(out.len() <= whole * samples);
    }

    #[test]
    fn csv(bytes in prop::collection::vec(any::<u8>(), 0..400), header in any::<bool>()) {
        let text = if header { [b"t,range\n", bytes.as_slice()].concat() } else { bytes };
        let time = TimeColumn { column: "t".to_owned(), unit: TimeUnit::Us };
        let converter = Converter::Range { mm_per_count: 1.0 };
        let mut csv = CsvSamples::new(text.as_slice(), time, vec!["range".to_owned()], b',', converter);
        let mut out = Vec::new();
        while csv.next_batch(&mut out) {}
        prop_assert!(out.len() <= text.len());
    }

    #[test]
    fn csv_of_digits(text in "t,range\n([0-9.,\"\r\n-]{0,200})") {
        let time = TimeColumn { column: "t".to_owned(), unit: TimeUnit::S };
        let converter = Converter::Range { mm_per_count: 1.0 };
        let mut csv = CsvSamples::new(text.as_bytes(), time, vec!["range".to_owned()], b',', converter);
        let mut out = Vec::new();
        while csv.next_batch(&mut out) {}
        prop_assert!(out.iter().all(|sample| sample.time().0 >= 0));
    }

    #[test]
    fn image_headers(bytes in altered(jpeg(32, 24, 9)), end in 0_usize..800) {
        let bytes = &bytes[..end.min(bytes.len())];
        if let Ok(header) = image_header::read(bytes) {
            prop_assert!(header.width_px > 0);
        }
    }

    #[test]
    fn exif(bytes in altered(jpeg_with_exif(Some("2025:06:01 12:00:00"), Some("123456"), Some("+01:00")))) {
        if let Ok(time) = image_time::from_exif(&bytes, &TimeZone::UTC) {
            prop_assert!(time.0 >= 0);
        }
    }

    #[test]
    fn names_and_patterns(name in "\\PC{0,40}", pattern in "[%a-zA-Z0-9.:_-]{0,20}") {
        let _ = image_time::check_pattern(&pattern);
        if let Ok(time) = image_time::from_name(&name, &pattern, &TimeZone::UTC) {
            prop_assert!(time.0 >= 0);
        }
    }

    #[test]
    fn configuration(text in "(\\[?[a-z_.]{0,12}\\]?( = [0-9\"\\[\\]a-z{}]{0,8})?\n){0,6}") {
        if let Err(error) = config::parse_toml::<Profile>(&text, Path::new("x.toml")) {
            prop_assert!(error.to_string().starts_with("x.toml:"));
        }
    }

    #[test]
    fn mcap(noise in prop::collection::vec(any::<u8>(), 0..300), summary_start in 0_u64..400) {
        // Noise with the frame of an MCAP file, so that the reader looks inside.
        let footer = [&[2_u8][..], &20_u64.to_le_bytes(), &summary_start.to_le_bytes(), &[0; 12]].concat();
        let bytes = [mcap::MAGIC, &noise, &footer, mcap::MAGIC].concat();
        let mut file = tempfile::NamedTempFile::new().unwrap();
        file.write_all(&bytes).unwrap();
        prop_assert!(SessionReader::open(file.path()).is_err());
    }
}
