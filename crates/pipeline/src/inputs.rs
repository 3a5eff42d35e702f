//! SHA-256 of the small input files of a run. (Cards are hashed as they are ingested.)

use std::collections::BTreeSet;
use std::io;
use std::path::Path;

use sha2::{Digest, Sha256};

/// SHA-256 of a file, in hexadecimal, in bounded memory. Anything but a regular file, such as a pipe, is not opened, since
/// it might never end.
pub(crate) fn sha256_of_file(path: &Path) -> io::Result<String> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(io::Error::other("not a regular file"));
    }
    let mut hasher = Sha256::new();
    io::copy(&mut std::fs::File::open(path)?, &mut hasher)?;
    Ok(hex(&hasher.finalize()))
}

/// SHA-256 of bytes, in hexadecimal.
pub(crate) fn sha256_of_bytes(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

/// The number of files in a [`card_sketch`].
pub(crate) const SKETCH_FILES: usize = 16;
/// Among a million files in sketches of a study, two different ones are alike by chance in one study of 500.
const SKETCH_DIGITS: usize = 12;

/// A sample of files by the hashes of their contents: the least ones, so that of two cards the same files are taken whatever else
/// they hold. Empty files say nothing, and files that could not be read have no hash.
pub(crate) fn card_sketch<'a>(sha256: impl Iterator<Item = &'a str>) -> Vec<String> {
    let empty = sha256_of_bytes(b"");
    let is_hash = |hash: &&str| hash.len() == empty.len() && hash.bytes().all(|digit| digit.is_ascii_hexdigit());
    let files: BTreeSet<&str> =
        sha256.filter(is_hash).filter(|hash| *hash != empty).filter_map(|hash| hash.get(..SKETCH_DIGITS)).collect();
    files.into_iter().take(SKETCH_FILES).map(str::to_owned).collect()
}

fn hex(digest: &[u8]) -> String {
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}
