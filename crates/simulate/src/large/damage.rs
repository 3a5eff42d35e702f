//! Damage to cards and marks, and the problems that `aim-batch run` reports for it (docs/devices.md, docs/simulate.md).

use model::ProblemCode;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

use crate::sensors::{PACKET_PERIOD_S, SAMPLES_PER_PACKET};

/// Where pictures are harmed, one in so many is, beginning with the first one, which is marked.
const PICTURES_HARMED_EVERY: usize = 3;

/// Number of bytes of a stamp.
const STAMP_BYTES: usize = 8;
/// Number of bytes of a packet of the accelerometer, with 4 channels of 16 bit.
const ACCELERATION_PACKET_BYTES: usize = STAMP_BYTES + 4 * 2 * SAMPLES_PER_PACKET;
/// Number of bytes of a packet of the range sensor.
const RANGE_PACKET_BYTES: usize = STAMP_BYTES + 2 * SAMPLES_PER_PACKET;

/// A kind of damage. Each kind makes a run report a loss, for any seed and any number of images.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Damage {
    /// The accelerometer's last file ends inside a packet.
    CutAcceleration,
    /// Every third picture ends half way through its scan.
    CutPictures,
    /// The file session.toml ends inside a value.
    BadSessionToml,
    /// The range sensor's files are nothing but zeros.
    ZeroRange,
    /// The card has none of the accelerometer's files.
    NoAcceleration,
    /// The files of marks end half way.
    CutMarks,
    /// A packet of the accelerometer is random bytes.
    GarbagePacket,
    /// The card's folder is empty.
    EmptyCard,
    /// The pictures are not of the camera's size.
    WrongSize,
    /// The clock of both sensors was set back between their two files.
    ClockSetBack,
    /// Every third picture is nothing but zeros.
    ZeroPictures,
    /// Bytes are missing inside a packet of the range sensor.
    LostBytes,
    /// The card has no pictures.
    NoPictures,
    /// The labels of marks name an object that objects.csv does not have.
    UnknownObject,
}

/// A sensor. Its record is stored in two files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sensor {
    Acceleration,
    Range,
}

/// A file of a session, before it is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SessionFile {
    Toml,
    Packets { sensor: Sensor, is_last: bool },
    Picture { at: usize },
    Marks,
}

impl Damage {
    /// All kinds, in the order in which damaged sessions get them.
    pub const ALL: [Self; 14] = [
        Self::CutAcceleration,
        Self::CutPictures,
        Self::BadSessionToml,
        Self::ZeroRange,
        Self::NoAcceleration,
        Self::CutMarks,
        Self::GarbagePacket,
        Self::EmptyCard,
        Self::WrongSize,
        Self::ClockSetBack,
        Self::ZeroPictures,
        Self::LostBytes,
        Self::NoPictures,
        Self::UnknownObject,
    ];

    /// The kind of the `at`-th damaged session.
    pub(super) fn in_turn(at: usize) -> Self {
        Self::ALL[at % Self::ALL.len()]
    }

    /// The code of a problem that a run reports for such a session. There may be other problems, which follow from it.
    #[must_use]
    pub fn code(self) -> ProblemCode {
        match self {
            Self::CutAcceleration => ProblemCode::TruncatedPacket,
            Self::CutPictures => ProblemCode::DamagedImage,
            Self::BadSessionToml => ProblemCode::BadSessionToml,
            Self::ZeroRange => ProblemCode::ZeroBlocks,
            Self::NoAcceleration | Self::NoPictures => ProblemCode::NoFiles,
            Self::EmptyCard => ProblemCode::CardDoesNotFitProfile,
            Self::CutMarks => ProblemCode::MarksMalformed,
            Self::GarbagePacket => ProblemCode::BadStamp,
            Self::WrongSize => ProblemCode::WrongSize,
            Self::ClockSetBack => ProblemCode::AmbiguousTime,
            Self::ZeroPictures => ProblemCode::NotAnImage,
            Self::LostBytes => ProblemCode::LostAlignment,
            Self::UnknownObject => ProblemCode::UnknownObject,
        }
    }

    /// The bytes that are written in place of a file's `bytes`; none where the file is not written at all.
    pub(super) fn apply(self, file: SessionFile, mut bytes: Vec<u8>, random: &mut ChaCha8Rng) -> Option<Vec<u8>> {
        use SessionFile::{Marks, Packets, Picture, Toml};
        const ACCELERATION: Sensor = Sensor::Acceleration;
        let is_harmed = |at: usize| at.is_multiple_of(PICTURES_HARMED_EVERY);
        match (self, file) {
            (Self::EmptyCard, Toml | Packets { .. } | Picture { .. })
            | (Self::NoAcceleration, Packets { sensor: ACCELERATION, .. })
            | (Self::NoPictures, Picture { .. }) => return None,
            (Self::CutAcceleration, Packets { sensor: ACCELERATION, is_last: true }) => {
                bytes.truncate(bytes.len().saturating_sub(ACCELERATION_PACKET_BYTES / 3));
            }
            (Self::CutPictures, Picture { at }) if is_harmed(at) => cut_in_scan(&mut bytes),
            (Self::CutMarks, Marks) => bytes.truncate(bytes.len() / 2),
            (Self::BadSessionToml, Toml) => bytes.truncate(bytes.len().saturating_sub(2)), // the quote and the line's end
            (Self::ZeroRange, Packets { sensor: Sensor::Range, .. }) => bytes.fill(0),
            (Self::ZeroPictures, Picture { at }) if is_harmed(at) => bytes.fill(0),
            (Self::GarbagePacket, Packets { sensor: ACCELERATION, is_last: true }) => garbage(&mut bytes, random),
            (Self::ClockSetBack, Packets { sensor, is_last: true }) => set_back(&mut bytes, sensor),
            (Self::LostBytes, Packets { sensor: Sensor::Range, is_last: true }) => {
                let lost = RANGE_PACKET_BYTES / 3..RANGE_PACKET_BYTES / 2;
                bytes.drain(lost.start.min(bytes.len())..lost.end.min(bytes.len()));
            }
            (Self::UnknownObject, Marks) => {
                bytes = String::from_utf8_lossy(&bytes).replace("\"label\": \"", "\"label\": \"my ").into_bytes();
            }
            _ => {}
        }
        Some(bytes)
    }
}

/// Cuts a JPEG picture, so that its header and half of the rest are left.
fn cut_in_scan(bytes: &mut Vec<u8>) {
    const START_OF_SCAN: [u8; 2] = [0xff, 0xda];
    let scan = bytes.windows(2).position(|marker| marker == START_OF_SCAN).unwrap_or_default();
    bytes.truncate(usize::midpoint(scan, bytes.len()));
}

/// Puts random bytes in place of the first packet. None is below 0x80, since a stamp of such bytes is a negative number, which is
/// no time. (Of stamps of any bytes, one in four would be a time in 1970.)
fn garbage(bytes: &mut [u8], random: &mut ChaCha8Rng) {
    for byte in bytes.iter_mut().take(ACCELERATION_PACKET_BYTES) {
        *byte = random.random_range(0x80..=0xff);
    }
}

/// Sets all stamps of a file back by a little more than half of the time that it lasts.
fn set_back(bytes: &mut [u8], sensor: Sensor) {
    let packet_bytes = match sensor {
        Sensor::Acceleration => ACCELERATION_PACKET_BYTES,
        Sensor::Range => RANGE_PACKET_BYTES,
    };
    #[expect(clippy::cast_precision_loss, reason = "some thousand packets")]
    let back_s = (bytes.len() / packet_bytes / 2) as f64 * PACKET_PERIOD_S + 3.0;
    for packet in bytes.chunks_exact_mut(packet_bytes) {
        if let Some(stamp) = packet.first_chunk_mut::<STAMP_BYTES>() {
            *stamp = (f64::from_le_bytes(*stamp) - back_s).to_le_bytes();
        }
    }
}
