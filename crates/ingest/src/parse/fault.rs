//! The faults of a sensor file, each with its remedy.

use model::ProblemCode;

/// A fault of a sensor file. The rest of the file is used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// The file ends inside a packet.
    #[error(
        "the file ends inside the packet at byte {offset}: expected {expected} bytes, got {got}, of which {samples} samples are used"
    )]
    TruncatedPacket {
        /// The place where it begins.
        offset: u64,
        /// Bytes of a whole packet.
        expected: usize,
        /// Bytes there are.
        got: usize,
        /// Samples in them that are whole.
        samples: usize,
    },
    /// Packets that are nothing but zeros.
    #[error("{bytes} bytes are blocks of zeros, the first at byte {first_offset}")]
    Zeros {
        /// Bytes in them.
        bytes: u64,
        /// The place where the first one begins.
        first_offset: u64,
    },
    /// Packets do not follow each other: bytes were lost, or others stand between.
    #[error(
        "in {places} places packets do not follow each other, the first at byte {first_offset}: {bytes} bytes are left out"
    )]
    LostAlignment {
        /// Bytes that are left out.
        bytes: u64,
        /// The number of places.
        places: u64,
        /// The place where the first one begins.
        first_offset: u64,
    },
    /// Packets whose number is not the one after the last.
    #[error(
        "{jumps} jumps in the packets' numbers, the first at byte {first_offset}: expected {expected}, got {got}; packets are missing"
    )]
    SequenceJumps {
        /// The number of them.
        jumps: u64,
        /// The place where the first one is.
        first_offset: u64,
        /// The number that follows.
        expected: u32,
        /// The number that is there.
        got: u32,
    },
    /// A CWA file without its header.
    #[error("the file does not begin with a header; its blocks are used")]
    NoHeader,
    /// A CWA file's damage.
    #[error("{blocks} blocks cannot be used ({bytes} bytes), the first at byte {first_offset}: {first}")]
    BadBlocks {
        /// The number of them.
        blocks: u64,
        /// Bytes in them, and between blocks.
        bytes: u64,
        /// The place where the first one begins.
        first_offset: u64,
        /// The fault of the first one.
        first: String,
    },
    /// Packets whose stamp is no time.
    #[error(
        "{packets} packets ({bytes} bytes) have a stamp that is no time, the first at byte {first_offset}: {first}"
    )]
    BadStamp {
        /// The number of them.
        packets: u64,
        /// Bytes in them.
        bytes: u64,
        /// The place where the first one begins.
        first_offset: u64,
        /// The first stamp.
        first: String,
    },
    /// A column that the profile names is not in the first line.
    #[error("the first line has no column '{column}'; it has: {found}")]
    MissingColumn {
        /// The column.
        column: String,
        /// The columns there are.
        found: String,
    },
    /// A column that the profile names is in the first line more than once.
    #[error(
        "the first line has column '{column}' twice, as columns {first} and {second}: which is meant cannot be told, and the file is not read"
    )]
    RepeatedColumn {
        /// The column.
        column: String,
        /// Its first place, from 1.
        first: usize,
        /// Its second place, from 1.
        second: usize,
    },
    /// Rows that cannot be read.
    #[error("{rows} rows cannot be read and are left out, the first in line {first_line}: {first}")]
    BadRows {
        /// The number of them.
        rows: u64,
        /// Bytes in them.
        bytes: u64,
        /// Line of the first one, from 1.
        first_line: u64,
        /// The fault of the first one.
        first: String,
    },
    /// Accelerations that no sensor gives. They are left out; what is around them is used.
    #[error(
        "{samples} of {of} samples are accelerations that the sensor cannot give and are left out, the first {first}"
    )]
    ImpossibleAcceleration {
        /// The number of them.
        samples: u64,
        /// The number of samples that the file has.
        of: u64,
        /// The place of the first one and its counts.
        first: String,
    },
    /// A line too long for a table of numbers, such as a block of zeros.
    #[error("line {line} is longer than {limit} bytes: from there on the file is not used")]
    LongLine {
        /// The line, from 1.
        line: u64,
        /// The longest that is read.
        limit: usize,
    },
    /// Text of two bytes per character.
    #[error("the file is UTF-16 text; expected UTF-8 or ASCII; it is not read")]
    Utf16,
    /// The system cannot read on.
    #[error("cannot be read from byte {offset} on: {message}")]
    Unreadable {
        /// The place where reading stopped.
        offset: u64,
        /// The message of the operating system.
        message: String,
    },
    /// Samples whose stamps the clock cannot turn into times.
    #[error("{samples} samples have no time: {first}")]
    NoTime {
        /// The number of them.
        samples: u64,
        /// Why the first one has none.
        first: String,
    },
    /// Rows that share a stamp, more or fewer than usual: when within it they were taken cannot be told.
    #[error(
        "{rows} rows share stamps with more or fewer rows than usual, first {first_rows} rows of {} s on the sensor's clock: when they were taken cannot be told, and they are left out",
        *first_stamp_ns as f64 / 1e9
    )]
    StampShared {
        /// The number of them.
        rows: u64,
        /// The number of those of the first such stamp.
        first_rows: usize,
        /// The first such stamp, ns since the clock's zero.
        first_stamp_ns: i64,
    },
    /// Nothing usable in the file.
    #[error("the file holds no samples")]
    NoSamples,
}

impl Fault {
    /// Bytes of the file that gave nothing.
    #[must_use]
    pub fn lost_bytes(&self) -> u64 {
        match self {
            Self::TruncatedPacket { got, samples: 0, .. } => *got as u64,
            Self::Zeros { bytes, .. }
            | Self::LostAlignment { bytes, .. }
            | Self::BadBlocks { bytes, .. }
            | Self::BadStamp { bytes, .. }
            | Self::BadRows { bytes, .. } => *bytes,
            _ => 0,
        }
    }

    /// Stable code, snake case.
    #[must_use]
    pub fn code(&self) -> ProblemCode {
        match self {
            Self::TruncatedPacket { .. } => ProblemCode::TruncatedPacket,
            Self::Zeros { .. } => ProblemCode::ZeroBlocks,
            Self::LostAlignment { .. } => ProblemCode::LostAlignment,
            Self::SequenceJumps { .. } => ProblemCode::SequenceJumps,
            Self::NoHeader => ProblemCode::MissingHeader,
            Self::BadBlocks { .. } => ProblemCode::BadBlocks,
            Self::BadStamp { .. } => ProblemCode::BadStamp,
            Self::MissingColumn { .. } => ProblemCode::MissingColumn,
            Self::RepeatedColumn { .. } => ProblemCode::RepeatedColumn,
            Self::BadRows { .. } => ProblemCode::BadRows,
            Self::ImpossibleAcceleration { .. } => ProblemCode::ImpossibleAcceleration,
            Self::LongLine { .. } => ProblemCode::LongLine,
            Self::Utf16 => ProblemCode::TextEncoding,
            Self::Unreadable { .. } => ProblemCode::UnreadableFile,
            Self::NoTime { .. } | Self::StampShared { .. } => ProblemCode::SamplesWithoutTime,
            Self::NoSamples => ProblemCode::NoSamples,
        }
    }

    /// The remedy: what a person can do about it.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::TruncatedPacket { .. } => {
                "copy the file from the card again; if it stays so, the device was switched off while writing, or the \
                 profile's header, channels or samples do not fit"
            }
            Self::Zeros { .. } => "copy the file from the card again; a card pulled out while writing leaves zeros",
            Self::LostAlignment { .. } | Self::BadBlocks { .. } | Self::SequenceJumps { .. } | Self::NoHeader => {
                "copy the file from the card again; if it stays so, the card has bad sectors, or the profile does not fit"
            }
            Self::BadStamp { .. } => "check header, endian and the stamp's type in the device profile",
            Self::MissingColumn { .. } => "correct the column's name in the device profile, or the file",
            Self::RepeatedColumn { .. } => {
                "rename one of them in the file; or declare header = false, skip_lines = 1 and columns by number, such as #2"
            }
            Self::BadRows { .. } => {
                "look at that line; time and values are plain decimal numbers, and no row has more fields than the header"
            }
            Self::ImpossibleAcceleration { samples, of, .. } if 2 * samples > *of => {
                "correct g_per_count, zero_g_counts or full_scale_g in the device profile: no sensor reads so much all the time"
            }
            Self::ImpossibleAcceleration { .. } => {
                "none needed if the logger writes them for 'no value'; otherwise correct g_per_count or full_scale_g in the \
                 device profile, or copy the file from the card again"
            }
            Self::LongLine { .. } => "copy the file from the card again; a damaged card leaves blocks of zeros",
            Self::Utf16 => {
                "save the file as UTF-8, such as by `iconv -f UTF-16 -t UTF-8`; Windows tools call UTF-16 'Unicode'"
            }
            Self::Unreadable { .. } => "copy the file from the card again; check its permissions",
            Self::NoTime { .. } => "declare the clock in the device profile: epoch, wrap_bits, [clock] anchor",
            Self::StampShared { .. } => {
                "let the logger write times with decimals; or, if no row is missing, declare rows_per_s in the profile in \
                 place of the time's column"
            }
            Self::NoSamples => "remove the file if the device wrote it empty, else copy it from the card again",
        }
    }
}
