//! Why a session cannot be ingested.

use std::path::PathBuf;

use model::{CameraSpecError, ProblemCode};

use crate::card::PatternError;
use crate::config::ConfigError;
use crate::mcap_file::WriteError;
use crate::mcap_file::metadata::MetadataError;
use crate::parse::PacketError;

/// Why a session cannot be ingested at all.
#[derive(Debug, thiserror::Error)]
pub enum IngestError {
    /// There is no card, or it cannot be read.
    #[error("session '{session}': no SD card in {card_dir}: {source}")]
    NoCard {
        /// The session.
        session: String,
        /// Where the card should be.
        card_dir: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// No file of the card fits the profile.
    #[error("session '{session}': none of the {files} files in {card_dir} fits profile '{profile}' ({patterns})")]
    NothingFits {
        /// The session.
        session: String,
        /// The card.
        card_dir: PathBuf,
        /// Files on it.
        files: usize,
        /// Name of the profile.
        profile: String,
        /// The profile's patterns.
        patterns: String,
    },
    /// The profile contradicts itself.
    #[error(transparent)]
    Profile(#[from] ConfigError),
    /// A pattern of the profile.
    #[error(transparent)]
    Pattern(PatternError),
    /// A layout of the profile.
    #[error("device profile: {0}")]
    Layout(#[from] PacketError),
    /// The camera contradicts itself.
    #[error("camera: {0}")]
    Camera(#[from] CameraSpecError),
    /// There is no thread to read the card with.
    #[error("cannot start a thread that reads the card: {0}")]
    Thread(std::io::Error),
    /// The caller asked to stop.
    #[error("stopped before the card was read to its end")]
    Stopped,
    /// The MCAP file cannot be written.
    #[error("cannot write {path}: {source}")]
    Write {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        source: WriteError,
    },
    /// The metadata cannot be written as text.
    #[error(transparent)]
    Metadata(#[from] MetadataError),
    /// The key cannot be written as text.
    #[error("key of the inputs: {0}")]
    Key(serde_json::Error),
}

impl IngestError {
    /// Whether the reason is not the session's: the place to write to, the machine, or a wish to stop. Other sessions
    /// would fail of it as well.
    #[must_use]
    pub fn is_of_all_sessions(&self) -> bool {
        match self {
            Self::Write { source: WriteError::Io(error), .. } => !is_of_name(error),
            Self::Write { .. } | Self::Thread(_) | Self::Stopped => true,
            _ => false,
        }
    }

    /// Stable code, for the status of a session.
    #[must_use]
    pub fn code(&self) -> ProblemCode {
        match self {
            Self::NoCard { .. } => ProblemCode::MissingCard,
            Self::NothingFits { .. } => ProblemCode::CardDoesNotFitProfile,
            Self::Profile(_) | Self::Pattern(_) | Self::Layout(_) => ProblemCode::BadProfile,
            Self::Camera(_) => ProblemCode::BadCamera,
            Self::Thread(_) => ProblemCode::NoThread,
            Self::Stopped => ProblemCode::Stopped,
            Self::Write { .. } | Self::Metadata(_) | Self::Key(_) => ProblemCode::McapNotWritten,
        }
    }

    /// What to do about it.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::NoCard { .. } => "copy the SD card into that folder, or remove the session",
            Self::NothingFits { .. } => {
                "check the device profile, and that the card's own top folder was copied, not a folder around it"
            }
            Self::Profile(_) | Self::Pattern(_) | Self::Layout(_) => "correct the device profile (docs/devices.md)",
            Self::Camera(_) => "correct the camera file (docs/devices.md)",
            Self::Stopped => "run again to go on",
            Self::Thread(_) => "give --jobs a smaller number, or raise the limit of processes",
            Self::Write { source: WriteError::Io(error), .. } if is_of_name(error) => {
                "give the session's folder a shorter name, without characters that are odd in names of files"
            }
            Self::Write { .. } | Self::Metadata(_) | Self::Key(_) => {
                "check free space and permissions of the work folder"
            }
        }
    }
}

/// Whether a name is too long, or otherwise none for this file system.
fn is_of_name(error: &std::io::Error) -> bool {
    matches!(error.kind(), std::io::ErrorKind::InvalidFilename | std::io::ErrorKind::InvalidInput)
}
