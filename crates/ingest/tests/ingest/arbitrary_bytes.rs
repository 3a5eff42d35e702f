//! No parser panics, whatever the bytes.

use aim_batch_ingest::parse::{
    Converter, CsvLayout, CsvSamples, PacketParser, PacketSamples, image_header, image_time,
};
use aim_batch_ingest::profile::{CsvFormat, RowTime, TimeUnit};
use aim_batch_ingest::{Profile, SessionReader, config};
use jiff::tz::TimeZone;
use proptest::prelude::*;
use std::io::Write;
use std::path::Path;

use crate::support::{jpeg, jpeg_with_exif, timed, times_and_values};

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

fn csv_layout(unit: TimeUnit) -> CsvLayout {
    CsvLayout {
        format: CsvFormat::default(),
        time: RowTime { column: Some("t".to_owned()), unit: Some(unit), ..RowTime::default() },
        values: vec!["range".to_owned()],
        extra: vec![],
        converter: Converter::Range { mm_per_count: 1.0 },
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn packets(bytes in prop::collection::vec(any::<u8>(), 0..400), samples in 1_usize..20) {
        let profile = Profile::load("aim2-packets", Path::new("none")).unwrap();
        let stream = profile.acceleration.unwrap();
        let layout = aim_batch_ingest::profile::PacketLayout { samples, ..stream.packets.clone().unwrap() };
        let parser = PacketParser::new(&layout, &stream.extra, Converter::from(&stream)).unwrap();
        let most = bytes.len() / 6; // x, y, z
        let mut packets = PacketSamples::new(bytes.as_slice(), parser, true);
        let read: usize = std::iter::from_fn(|| packets.next_block()).map(|block| block.len()).sum();
        prop_assert!(read <= most);
    }

    #[test]
    fn csv(bytes in prop::collection::vec(any::<u8>(), 0..400), header in any::<bool>()) {
        let text = if header { [b"t,range\n", bytes.as_slice()].concat() } else { bytes };
        let mut csv = CsvSamples::new(text.as_slice(), csv_layout(TimeUnit::Us));
        let read: usize = std::iter::from_fn(|| csv.next_block()).map(|block| block.len()).sum();
        prop_assert!(read <= text.len());
    }

    #[test]
    fn csv_of_digits(text in "t,range\n([0-9.,\"\r\n-]{0,200})") {
        let mut csv = CsvSamples::new(text.as_bytes(), csv_layout(TimeUnit::S));
        let blocks: Vec<_> = std::iter::from_fn(|| csv.next_block()).collect();
        prop_assert!(times_and_values(&timed(blocks, 128.0)).iter().all(|(ns, _)| *ns >= 0));
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
