//! The samples that the tests' writer writes come back.

use aim_batch_ingest::parse::cwa::{Block, BlockError, Hardware, Header};
use proptest::prelude::*;

use super::read;
use super::writer::{BlockSpec, RATE_100_HZ, Samples, header, seal};

pub fn spec(samples: Samples) -> BlockSpec {
    BlockSpec {
        sequence: 7,
        stamp_s: 40_000.75,
        index: 125,
        has_fraction: true,
        rate_code: RATE_100_HZ,
        scales: (0, 0),
        samples,
    }
}

fn close(left: [f32; 3], right: [f32; 3]) -> bool {
    left.iter().zip(right).all(|(left, right)| (left - right).abs() < 1e-6 * (1.0 + right.abs()))
}

proptest! {
    #[test]
    fn packed(samples in prop::collection::vec((prop::array::uniform3(-512_i16..512), 0_u32..4), 0..=120)) {
        let block = Block::parse(&spec(Samples::Packed(samples.clone())).bytes()).unwrap();
        prop_assert_eq!(block.samples.len(), samples.len());
        for (got, (values, exponent)) in block.samples.iter().zip(samples) {
            prop_assert!(close(*got, values.map(|value| f32::from(value) * 2_f32.powi(exponent as i32) / 256.0)));
        }
        prop_assert!(block.gyro_deg_per_s.is_none());
    }

    #[test]
    fn accel(samples in prop::collection::vec(any::<[i16; 3]>(), 0..=80), scale in 0_u16..8) {
        let spec = BlockSpec { scales: (scale, 0), ..spec(Samples::Accel(samples.clone())) };
        let block = Block::parse(&spec.bytes()).unwrap();
        prop_assert_eq!(block.samples.len(), samples.len());
        for (got, values) in block.samples.iter().zip(samples) {
            prop_assert!(close(*got, values.map(|value| f32::from(value) / 2_f32.powi(8 + i32::from(scale)))));
        }
    }

    #[test]
    fn gyro_accel(samples in prop::collection::vec(any::<[i16; 6]>(), 0..=40), gyro_scale in 2_u16..7) {
        let spec = BlockSpec { scales: (4, gyro_scale), ..spec(Samples::GyroAccel(samples.clone())) };
        let block = Block::parse(&spec.bytes()).unwrap();
        let gyro = block.gyro_deg_per_s.unwrap();
        prop_assert_eq!((block.samples.len(), gyro.len()), (samples.len(), samples.len()));
        let full_scale = 8000.0 / 2_f32.powi(i32::from(gyro_scale));
        for ((accel, gyro), [gx, gy, gz, x, y, z]) in block.samples.iter().zip(gyro).zip(samples) {
            prop_assert!(close(*accel, [x, y, z].map(|value| f32::from(value) / 4096.0)));
            prop_assert!(close(gyro, [gx, gy, gz].map(|value| f32::from(value) / 32768.0 * full_scale)));
        }
    }

    #[test]
    fn stamps(stamp_s in 0.0_f64..86_400.0, index in -500_i16..500, rate in 5_u8..=15, has_fraction in any::<bool>()) {
        let stamp_s = (stamp_s * 32768.0).floor() / 32768.0;
        let spec = BlockSpec { stamp_s, index, rate_code: rate, has_fraction, ..spec(Samples::Accel(Vec::new())) };
        let block = Block::parse(&spec.bytes()).unwrap();
        let since_midnight = block.stamp.duration_since(jiff::civil::date(2024, 5, 17).at(0, 0, 0, 0)).as_secs_f64();
        let expected_s = if has_fraction { stamp_s } else { stamp_s.floor() };
        prop_assert!((since_midnight - expected_s).abs() < 1e-9);
        prop_assert_eq!(block.stamp_index, i32::from(index));
    }
}

#[test]
fn headers() {
    let bytes = header(0x64);
    let header = Header::parse(bytes.first_chunk().unwrap()).unwrap();
    assert_eq!((header.hardware, header.device_id, header.session_id), (Hardware::Ax6, 39434, 26));
    assert_eq!((header.range_g, header.firmware), (8, 44));
    assert_eq!(header.logging_start.unwrap().to_string(), "2024-05-17T10:00:00");
    assert_eq!(header.logging_end, None);
    assert_eq!(read(&bytes).1.header, Some(header));
    assert_eq!(Header::parse(&[0; 1024]), None);
}

/// Each kind of bad block says what it found.
#[test]
fn refusals() {
    let good = spec(Samples::Packed(vec![([1, 2, 3], 0); 120])).bytes();
    let altered = |at: usize, value: &[u8]| {
        let mut bytes = good;
        bytes[at..at + value.len()].copy_from_slice(value);
        seal(&mut bytes);
        Block::parse(&bytes)
    };
    let got = [b'A', b'Y', 0xfc, 0x01];
    assert_eq!(altered(0, b"AY"), Err(BlockError::NotADataBlock { got }));
    assert_eq!(altered(14, &[0; 4]), Err(BlockError::Date { stamp: 0 }));
    assert_eq!(altered(24, &[0x40]), Err(BlockError::Rate { code: 0x40 }));
    assert_eq!(altered(25, &[0x60]), Err(BlockError::Layout { axes: 6, packing: 0 }));
    assert_eq!(altered(28, &[121, 0]), Err(BlockError::SampleCount { count: 121, room: 120 }));
    assert_eq!(altered(25, &[0x92]), Err(BlockError::SampleCount { count: 120, room: 26 }));
    let mut bytes = good;
    bytes[100] = bytes[100].wrapping_add(1);
    assert_eq!(Block::parse(&bytes), Err(BlockError::Checksum { sum: 1 }));
}
