//! Why an MCAP file cannot be read.

use std::path::{Path, PathBuf};

use crate::mcap_file::metadata::MetadataError;

/// Why an MCAP file cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("{path}: {damage}")]
pub struct ReadError {
    path: PathBuf,
    #[source]
    damage: Damage,
}

/// The damage of a file.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Damage {
    #[error("cannot be read: {0}")]
    Io(#[from] std::io::Error),
    #[error("the MCAP file is damaged ({0}); delete it and ingest the session again")]
    Mcap(#[from] mcap::McapError),
    #[error(
        "the MCAP file is damaged: the {part} at byte {offset} does not lie within the file's {file_bytes} bytes; delete it and ingest the session again"
    )]
    Outside { part: &'static str, offset: u64, file_bytes: u64 },
    #[error("the MCAP file is damaged: at byte {offset} expected a {expected}; delete it and ingest the session again")]
    Unexpected { expected: &'static str, offset: u64 },
    #[error(
        "the MCAP file is damaged: the chunk at byte {offset} has another checksum than it says; delete it and ingest the session again"
    )]
    Checksum { offset: u64 },
    #[error("the MCAP file ends early, or is none: it has no index at its end; delete it and ingest the session again")]
    NoIndex,
    #[error("a message cannot be decoded ({0}); delete the file and ingest the session again")]
    Message(#[from] prost::DecodeError),
    #[error(
        "an MCAP file, but not a file of this program: it has no metadata record {}; 'aim-batch ingest' makes one from an SD card",
        crate::mcap_file::metadata::SEAL
    )]
    NotOurs,
    #[error("{0}; delete the file and ingest the session again")]
    Metadata(#[from] MetadataError),
    #[error("a message's time {0} ns is after the year 2262; delete the file and ingest the session again")]
    Time(u64),
    #[error("a message of samples does not have as many times as values; delete the file and ingest the session again")]
    Lengths,
    #[error("there is no image '{0}' in this session")]
    NoImage(String),
}

impl ReadError {
    pub(crate) fn new(path: &Path, damage: Damage) -> Self {
        Self { path: path.to_owned(), damage }
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }
}
