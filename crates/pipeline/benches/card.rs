//! Cards of the built-in profile aim2-packets, of any length.

use std::io::Write;
use std::path::Path;

use ingest::{Profile, SessionSource, camera};
use jiff::tz::TimeZone;

/// 2026-03-01T09:00:00Z.
pub const START_S: i64 = 1_772_355_600;
const PACKET_S: i64 = 8;
const PACKET_SAMPLES: usize = 1022;

/// Sensor files for so many seconds: a head that nods slowly, 0.5 m above a table.
pub fn sensors(card: &Path, seconds: i64) {
    std::fs::create_dir_all(card.join("SENSORS")).unwrap();
    let create = |name: &str| std::io::BufWriter::new(std::fs::File::create(card.join("SENSORS").join(name)).unwrap());
    let (mut acceleration, mut range) = (create("ACC00000.BIN"), create("RNG00000.BIN"));
    for packet in 0..seconds / PACKET_S {
        let stamp = ((START_S + packet * PACKET_S) as f64).to_le_bytes();
        acceleration.write_all(&stamp).unwrap();
        let (sin, cos) = (34.0 + 10.0 * (packet as f64 / 40.0).sin()).to_radians().sin_cos();
        let noise = |i: usize| ((i * 7919 + packet as usize * 104_729) % 9) as f64 - 4.0;
        for channel in [0.0, -1000.0 * cos, -1000.0 * sin, 300.0] {
            let counts = (0..PACKET_SAMPLES).flat_map(|i| ((channel + noise(i)) as i16).to_le_bytes());
            acceleration.write_all(&counts.collect::<Vec<u8>>()).unwrap();
        }
        range.write_all(&stamp).unwrap();
        let readings = (0..PACKET_SAMPLES).flat_map(|i| ((580.0 + noise(i / 4)) as i16).to_le_bytes());
        range.write_all(&readings.collect::<Vec<u8>>()).unwrap();
    }
}

/// One picture of 5 MP every 10 s; all look alike and none has the bytes of another.
pub fn images(card: &Path, count: i64) {
    let folder = card.join("IMAGES");
    std::fs::create_dir_all(&folder).unwrap();
    let picture = picture();
    for i in 0..count {
        let time = jiff::Timestamp::from_second(START_S + 10 * i).unwrap();
        let name = time.strftime("%Y%m%dT%H%M%S.000Z.JPG").to_string();
        let comment = [&[0xff, 0xfe, 0, 10][..], &i.to_le_bytes()].concat();
        std::fs::write(folder.join(name), [&picture[..2], &comment, &picture[2..]].concat()).unwrap();
    }
}

/// A textured table in daylight, about 390 kB.
fn picture() -> Vec<u8> {
    let noise = |x: u32, y: u32| ((x.wrapping_mul(2_654_435_761) ^ y.wrapping_mul(40_503)) >> 27) as u8;
    let pixels =
        image::GrayImage::from_fn(2592, 1944, |x, y| image::Luma([100 + (x / 40) as u8 + noise(x / 3, y / 3) / 6]));
    let mut bytes = Vec::new();
    let encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 80);
    image::DynamicImage::from(pixels).to_rgb8().write_with_encoder(encoder).unwrap();
    bytes
}

pub fn source(card: &Path) -> SessionSource {
    let devices = Path::new("no-devices");
    SessionSource {
        session: "card".to_owned(),
        card_dir: card.to_owned(),
        profile: Profile::load("aim2-packets", devices).unwrap(),
        camera_spec: camera::load("aim2-raw", devices).unwrap(),
        time_zone: TimeZone::UTC,
        clock_zero_utc: None,
        program: "benchmark".to_owned(),
    }
}

/// Bytes of all files below a folder.
pub fn bytes_in(folder: &Path) -> u64 {
    let entries = std::fs::read_dir(folder).unwrap().map(Result::unwrap);
    entries
        .map(|entry| if entry.path().is_dir() { bytes_in(&entry.path()) } else { entry.metadata().unwrap().len() })
        .sum()
}
