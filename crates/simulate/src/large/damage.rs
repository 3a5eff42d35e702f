//! What happens to cards and marks, and what `aim-batch run` says of it (docs/devices.md, docs/simulate.md).

use rand::Rng;
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

use crate::sensors::{PACKET_PERIOD_S, SAMPLES_PER_PACKET};

/// Every so many pictures are harmed where pictures are, the first one (which is marked) among them.
const PICTURES_HARMED_EVERY: usize = 3;

/// Bytes of a stamp, and of the accelerometer's packets: 4 channels of 16 bit.
const STAMP_BYTES: usize = 8;
const ACCELERATION_PACKET_BYTES: usize = STAMP_BYTES + 4 * 2 * SAMPLES_PER_PACKET;
const RANGE_PACKET_BYTES: usize = STAMP_BYTES + 2 * SAMPLES_PER_PACKET;

/// A kind of damage. Each makes a run tell a loss, whatever the seed and the number of images.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Damage {
    /// The accelerometer's last file ends inside a packet.
    CutAcceleration,
    /// Every third picture ends half way through its scan.
    CutPictures,
    /// session.toml ends inside a value.
    BadSessionToml,
    /// The range sensor's files are nothing but zeros.
    ZeroRange,
    /// The card has none of the accelerometer's files.
    NoAcceleration,
    /// The marks' files end half way.
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
    /// The marks' labels name an object that objects.csv does not have.
    UnknownObject,
}

/// A sensor's record is stored in two files.
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
    /// All kinds, in the order in which damaged sessions take them.
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

    /// The code of a problem that a run tells of such a session. There may be others, which follow from it.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::CutAcceleration => "truncated_packet",
            Self::CutPictures => "damaged_image",
            Self::BadSessionToml => "bad_session_toml",
            Self::ZeroRange => "zero_blocks",
            Self::NoAcceleration | Self::NoPictures => "no_files",
            Self::EmptyCard => "card_does_not_fit_profile",
            Self::CutMarks => "marks_malformed",
            Self::GarbagePacket => "bad_stamp",
            Self::WrongSize => "wrong_size",
            Self::ClockSetBack => "ambiguous_time",
            Self::ZeroPictures => "not_an_image",
            Self::LostBytes => "lost_alignment",
            Self::UnknownObject => "unknown_object",
        }
    }

    /// What is written in place of a file's `bytes`; none if it is not written at all.
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

/// Leaves a JPEG picture its header and half of what comes after.
fn cut_in_scan(bytes: &mut Vec<u8>) {
    const START_OF_SCAN: [u8; 2] = [0xff, 0xda];
    let scan = bytes.windows(2).position(|marker| marker == START_OF_SCAN).unwrap_or_default();
    bytes.truncate(usize::midpoint(scan, bytes.len()));
}

/// Random bytes in place of the first packet, none below 0x80: a stamp of such bytes is a negative number, which is no time
/// (one in four stamps of any bytes would be one in 1970).
fn garbage(bytes: &mut [u8], random: &mut ChaCha8Rng) {
    for byte in bytes.iter_mut().take(ACCELERATION_PACKET_BYTES) {
        *byte = random.random_range(0x80..=0xff);
    }
}

/// Sets all stamps of a file back by half of what it lasts, and a little.
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
