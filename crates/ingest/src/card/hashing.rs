//! SHA-256 of the bytes as they are read, so that each file is read once.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{ErrorKind, Read, Result as IoResult};

use sha2::{Digest, Sha256};

use super::CardFile;
use crate::progress::IngestProgress;

/// In place of a hash: the file could not be read to its end.
pub const UNREADABLE: &str = "unreadable";

/// SHA-256 of every input file, by its name.
#[derive(Debug, Clone, Default)]
pub(crate) struct Inputs {
    pub sha256: BTreeMap<String, String>,
    pub bytes: u64,
}

impl Inputs {
    /// Records a file that cannot be opened.
    pub fn add_unreadable(&mut self, file: &CardFile) {
        self.sha256.insert(file.name.clone(), UNREADABLE.to_owned());
    }

    /// Records a file that is not read on purpose, with the reason in place of a hash.
    pub fn add_refused(&mut self, file: &CardFile, reason: String) {
        self.sha256.entry(file.name.clone()).or_insert(reason);
    }

    /// Adds what another reader has recorded.
    pub fn merge(&mut self, other: Self) {
        self.bytes += other.bytes;
        self.sha256.extend(other.sha256);
    }

    /// Reads what is left of the file and records its hash.
    pub fn add(&mut self, file: &CardFile, mut reader: HashingReader<'_>) -> IoResult<()> {
        let end = reader.drain();
        // A file that two streams share is read twice and counted once.
        let hash = if end.is_ok() { format!("{:x}", reader.hasher.finalize()) } else { UNREADABLE.to_owned() };
        if self.sha256.insert(file.name.clone(), hash).is_none() {
            self.bytes += reader.bytes;
        }
        end
    }
}

/// Reads a file and hashes what is read.
pub(crate) struct HashingReader<'a> {
    file: File,
    hasher: Sha256,
    bytes: u64,
    progress: &'a dyn IngestProgress,
}

pub(crate) fn open_hashing<'a>(file: &CardFile, progress: &'a dyn IngestProgress) -> IoResult<HashingReader<'a>> {
    Ok(HashingReader { file: File::open(&file.path)?, hasher: Sha256::new(), bytes: 0, progress })
}

impl HashingReader<'_> {
    /// Reads to the end of the file, keeping nothing.
    fn drain(&mut self) -> IoResult<()> {
        let mut buffer = vec![0; 256 * 1024];
        loop {
            match self.read(&mut buffer) {
                Ok(0) => return Ok(()),
                Ok(_) => {}
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }
}

impl Read for HashingReader<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> IoResult<usize> {
        if self.progress.is_stopped() {
            return Err(std::io::Error::other("stopped"));
        }
        let got = self.file.read(buffer)?;
        self.hasher.update(&buffer[..got]);
        self.bytes += got as u64;
        self.progress.advance(got as u64);
        Ok(got)
    }
}
