//! Small cards, written byte by byte.

use std::path::{Path, PathBuf};

use aim_batch_ingest::parse::RawBlock;
use aim_batch_ingest::profile::{Epoch, Step};
use aim_batch_ingest::timeline::{Block, Clock, Stepper};
use aim_batch_ingest::{
    IngestSummary, NoProgress, Profile, Sample, SessionReader, SessionSource, camera, ingest_session,
};
use image::{ExtendedColorType, ImageEncoder};
use jiff::tz::TimeZone;

/// 2025-06-01T12:00:00Z.
pub const NOON_S: i64 = 1_748_779_200;

pub struct Study {
    pub dir: tempfile::TempDir,
    pub source: SessionSource,
}

impl Study {
    /// A study with an empty card, the built-in profile of that name and a camera of 32 x 24 px.
    pub fn new(profile: &str) -> Self {
        let dir = tempfile::tempdir().unwrap();
        let devices = dir.path().join("devices");
        let card_dir = dir.path().join("cards").join("P01");
        std::fs::create_dir_all(&devices).unwrap();
        std::fs::create_dir_all(&card_dir).unwrap();
        let camera = "schema_version = 1\nname = \"small\"\nwidth_px = 32\nheight_px = 24\nfocal_px = [30.0, 31.0]\n\
                      principal_px = [16.0, 12.0]\n[lens]\nmodel = \"radial\"\nk1 = -0.1\n";
        std::fs::write(devices.join("small.toml"), camera).unwrap();
        let source = SessionSource {
            session: "P01".to_owned(),
            card_dir,
            profile: Profile::load(profile, &devices).unwrap(),
            camera_spec: camera::load("small", &devices).unwrap(),
            time_zone: TimeZone::UTC,
            clock_zero_utc: None,
            program: "test 1".to_owned(),
        };
        Self { dir, source }
    }

    pub fn write(&self, name: &str, bytes: &[u8]) {
        let path = self.source.card_dir.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }

    pub fn out(&self) -> PathBuf {
        self.dir.path().join("out").join("P01.mcap")
    }

    pub fn ingest(&self) -> (IngestSummary, SessionReader) {
        let summary = ingest_session(&self.source, &self.out(), &NoProgress).unwrap();
        (summary, SessionReader::open(&self.out()).unwrap())
    }

    /// Codes and places of the problems, in order.
    pub fn problems(&self) -> Vec<(String, String)> {
        let (summary, reader) = self.ingest();
        assert_eq!(reader.metadata().problems, summary.problems);
        summary.problems.into_iter().map(|problem| (problem.code.code().to_owned(), problem.place)).collect()
    }
}

/// The accelerometer's samples, then the range sensor's.
pub fn samples(reader: &mut SessionReader) -> Vec<Sample> {
    let mut samples = Vec::new();
    reader.for_each_sample(|sample| samples.push(sample)).unwrap();
    samples
}

/// Blocks with times of a clock that counts from 1970 UTC.
pub fn timed(blocks: impl IntoIterator<Item = RawBlock>, rate_hz: f64) -> Vec<Block> {
    let mut stepper = Stepper::new(Clock::new(Epoch::Unix, None, TimeZone::UTC), Step::Nominal, rate_hz);
    let mut timed: Vec<Block> = blocks.into_iter().filter_map(|block| stepper.push(block).unwrap()).collect();
    timed.extend(stepper.finish());
    timed
}

/// Times in ns and values of all samples.
pub fn times_and_values(blocks: &[Block]) -> Vec<(i64, Vec<f32>)> {
    let values = |block: &Block, i: usize| block.channels.iter().map(|channel| channel[i]).collect();
    blocks.iter().flat_map(|block| block.times.each().enumerate().map(move |(i, t)| (t.0, values(block, i)))).collect()
}

/// A packet of the built-in profile aim2-packets: stamp, then the channels one after the other, 1022 values each.
pub fn packet(stamp_s: f64, channels: &[&dyn Fn(usize) -> i16]) -> Vec<u8> {
    let mut bytes = stamp_s.to_le_bytes().to_vec();
    for channel in channels {
        bytes.extend((0..1022).flat_map(|i| channel(i).to_le_bytes()));
    }
    bytes
}

/// An accelerometer packet at rest, z counting the samples.
pub fn acceleration_packet(stamp_s: f64) -> Vec<u8> {
    packet(stamp_s, &[&|_| 10, &|_| -1000, &|i| i as i16, &|_| 7])
}

pub fn range_packet(stamp_s: f64, mm: i16) -> Vec<u8> {
    packet(stamp_s, &[&|_| mm])
}

pub fn jpeg(width: u32, height: u32, shade: u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    let pixels = vec![shade; (width * height * 3) as usize];
    let encoder = image::codecs::jpeg::JpegEncoder::new(&mut bytes);
    encoder.write_image(&pixels, width, height, ExtendedColorType::Rgb8).unwrap();
    bytes
}

/// A JPEG of noise: as many bytes as a picture of that size can have.
pub fn noisy_jpeg(width: u32, height: u32) -> Vec<u8> {
    let mut state = 1_u32;
    let mut noise = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 24) as u8
    };
    let pixels: Vec<u8> = (0..width * height * 3).map(|_| noise()).collect();
    let mut bytes = Vec::new();
    let encoder = image::codecs::jpeg::JpegEncoder::new(&mut bytes);
    encoder.write_image(&pixels, width, height, ExtendedColorType::Rgb8).unwrap();
    bytes
}

pub fn png(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let pixels = vec![100; (width * height * 3) as usize];
    let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
    encoder.write_image(&pixels, width, height, ExtendedColorType::Rgb8).unwrap();
    bytes
}

/// A JPEG with EXIF times: DateTimeOriginal, SubSecTimeOriginal, OffsetTimeOriginal.
pub fn jpeg_with_exif(time: Option<&str>, subsec: Option<&str>, offset: Option<&str>) -> Vec<u8> {
    let fields = [(0x9003, time), (0x9011, offset), (0x9291, subsec)];
    let given: Vec<_> = fields.into_iter().filter_map(|(tag, text)| text.map(|text| (tag, text))).collect();
    jpeg_with_exif_fields(&given)
}

/// A JPEG of 32 x 24 px with text fields in its EXIF directory, by ascending tag.
pub fn jpeg_with_exif_fields(fields: &[(u16, &str)]) -> Vec<u8> {
    let fields: Vec<(u16, Vec<u8>)> =
        fields.iter().map(|(tag, text)| (*tag, [text.as_bytes(), &[0]].concat())).collect();
    let exif_ifd = 8 + 2 + 12 + 4;
    let mut tiff = b"II*\0\x08\0\0\0\x01\0".to_vec();
    tiff.extend(entry(0x8769, 4, 1, (exif_ifd as u32).to_le_bytes()));
    tiff.extend([0; 4]);
    tiff.extend((fields.len() as u16).to_le_bytes());
    let mut data_at = exif_ifd + 2 + 12 * fields.len() + 4;
    let mut data: Vec<u8> = Vec::new();
    for (tag, text) in &fields {
        let mut value = [0; 4];
        if text.len() <= 4 {
            value[..text.len()].copy_from_slice(text);
        } else {
            value = (data_at as u32).to_le_bytes();
            data_at += text.len();
            data.extend(text);
        }
        tiff.extend(entry(*tag, 2, text.len() as u32, value));
    }
    tiff.extend([0; 4]);
    tiff.extend(data);
    let plain = jpeg(32, 24, 90);
    let length = (2 + 6 + tiff.len()) as u16;
    [&plain[..2], &[0xff, 0xe1], &length.to_be_bytes(), b"Exif\0\0", &tiff, &plain[2..]].concat()
}

fn entry(tag: u16, kind: u16, count: u32, value: [u8; 4]) -> Vec<u8> {
    [&tag.to_le_bytes()[..], &kind.to_le_bytes(), &count.to_le_bytes(), &value].concat()
}

/// Every file below a folder, for tests that nothing is left behind.
pub fn files_in(dir: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        std::fs::read_dir(dir).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}
