//! How a data block stores its samples.

use super::block::{BLOCK_BYTES, BlockError};
use super::fields::{bytes_at, u32_at};

/// The place where the samples begin.
const SAMPLES_OFFSET: usize = 30;

/// Bytes for samples in a block.
const SAMPLES_BYTES: usize = 480;

/// Full scale of the gyroscope, in degrees per second, when the block does not give it.
const DEFAULT_GYRO_RANGE: f32 = 2000.0;

/// Acceleration in g and, with a gyroscope, angular rate in degrees per second.
type Values = (Vec<[f32; 3]>, Option<Vec<[f32; 3]>>);

/// How samples are stored, and their scales.
#[derive(Debug, Clone, Copy)]
pub(super) struct Layout {
    storage: Storage,
    g_per_count: f32,
    deg_per_s_per_count: f32,
}

#[derive(Debug, Clone, Copy)]
enum Storage {
    /// One word of 32 bits: 10 bits each of x, y and z, the least first, and a common exponent of 2 bits.
    Packed,
    /// 16 bits for each of x, y, z.
    Accel,
    /// 16 bits for each axis: those of the gyroscope, of the accelerometer, and of others.
    GyroAccel { axes: usize },
}

impl Layout {
    /// `scales`: 3 bits of the accelerometer's scale, 3 of the gyroscope's, and 10 of the light sensor.
    pub(super) fn new(axes_and_packing: u8, scales: u16) -> Result<Self, BlockError> {
        let (axes, packing) = (axes_and_packing >> 4, axes_and_packing & 0x0f);
        let storage = match (axes, packing) {
            (3, 0) => Storage::Packed,
            (3, 2) => Storage::Accel,
            (6 | 9, 2) => Storage::GyroAccel { axes: usize::from(axes) },
            _ => return Err(BlockError::Layout { axes, packing }),
        };
        let gyro_range = match (scales >> 10) & 0x07 {
            0 => DEFAULT_GYRO_RANGE,
            halvings => 8000.0 / f32::from(1_u16 << halvings),
        };
        Ok(Self {
            storage,
            g_per_count: 1.0 / f32::from(256_u16 << (scales >> 13)),
            deg_per_s_per_count: gyro_range / 32768.0,
        })
    }

    /// The first `count` samples.
    pub(super) fn read(self, block: &[u8; BLOCK_BYTES], count: u16) -> Result<Values, BlockError> {
        let room = SAMPLES_BYTES / self.sample_bytes();
        if usize::from(count) > room {
            return Err(BlockError::SampleCount { count, room });
        }
        let at = |i: u16| SAMPLES_OFFSET + usize::from(i) * self.sample_bytes();
        let accel_at = |i| match self.storage {
            Storage::Packed => unpack(u32_at(block, at(i))),
            Storage::Accel => triple(block, at(i)),
            Storage::GyroAccel { .. } => triple(block, at(i) + 6),
        };
        let samples = (0..count).map(|i| accel_at(i).map(|count| f32::from(count) * self.g_per_count)).collect();
        let gyro_at = |i| triple(block, at(i)).map(|count| f32::from(count) * self.deg_per_s_per_count);
        let has_gyro = matches!(self.storage, Storage::GyroAccel { .. });
        Ok((samples, has_gyro.then(|| (0..count).map(gyro_at).collect())))
    }

    fn sample_bytes(self) -> usize {
        match self.storage {
            Storage::Packed => 4,
            Storage::Accel => 6,
            Storage::GyroAccel { axes } => 2 * axes,
        }
    }
}

fn triple(block: &[u8; BLOCK_BYTES], at: usize) -> [i16; 3] {
    [at, at + 2, at + 4].map(|at| i16::from_le_bytes(bytes_at(block, at)))
}

fn unpack(word: u32) -> [i16; 3] {
    let exponent = word >> 30;
    [0, 10, 20].map(|shift| {
        let bits = ((word >> shift) & 0x3ff) as i16;
        let signed = (bits << 6) >> 6; // the 10th bit is the sign
        signed << exponent
    })
}
