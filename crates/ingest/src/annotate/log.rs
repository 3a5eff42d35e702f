//! The fate of images and session, in words.

use foxglove::messages::Log;
use foxglove::messages::log::Level;
use model::{FrameReason, FrameRow, UtcNs};

use crate::mcap_file::timestamp;
use crate::summary::ImageEntry;

/// How much a line of the log matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LogLevel {
    /// As it should be, and of no use for sizes.
    Detail,
    /// As it should be.
    Info,
    /// Cannot be used.
    Warning,
    /// Something was lost.
    Error,
}

/// A line of the log.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LogNote {
    /// When.
    pub time: UtcNs,
    /// How much it matters.
    pub level: LogLevel,
    /// Its subject: `image`, `session` or `fused`.
    pub about: &'static str,
    /// The text.
    pub text: String,
    /// The file that it is about, relative to the study or the card.
    pub file: String,
}

impl LogNote {
    pub(super) fn message(&self) -> Log {
        let level = match self.level {
            LogLevel::Detail => Level::Debug,
            LogLevel::Info => Level::Info,
            LogLevel::Warning => Level::Warning,
            LogLevel::Error => Level::Error,
        };
        Log {
            timestamp: timestamp(self.time),
            level: level.into(),
            message: self.text.clone(),
            name: self.about.to_owned(),
            file: self.file.clone(),
            line: 0,
        }
    }
}

/// Why an image was kept or dropped.
pub(super) fn of_frame(image: &ImageEntry, frame: &FrameRow) -> LogNote {
    let level = match frame.reason {
        FrameReason::Selected => LogLevel::Info,
        reason if reason.has_pose() => LogLevel::Detail,
        _ => LogLevel::Warning,
    };
    LogNote { time: image.time, level, about: "image", text: in_words(frame), file: image.file.clone() }
}

/// `selected: still, ...; flags range_held`.
pub(super) fn in_words(frame: &FrameRow) -> String {
    let flags = if frame.flags.is_empty() { String::new() } else { format!("; flags {}", frame.flags) };
    format!("{}: {}{flags}", frame.reason.code(), frame.reason.meaning())
}
