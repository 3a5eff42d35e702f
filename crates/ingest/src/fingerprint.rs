//! Whether files are as they were, without reading them: names, sizes, times and inode numbers.

use std::fs::Metadata;
use std::path::Path;
use std::time::{Duration, SystemTime};

use sha2::{Digest, Sha256};

/// File systems keep times in steps of up to 2 s (FAT): a file that changed so recently may change again unseen.
const TIME_STEP: Duration = Duration::from_secs(2);

/// A digest over what the system says of files. Equal fingerprints of the same paths mean equal contents, as far as the
/// system tells the truth; on Unix a change of contents changes the inode's own time, which no program can set.
#[derive(Debug, Clone)]
pub struct Fingerprint {
    hasher: Sha256,
    latest: SystemTime,
    bytes: u64,
    taken: SystemTime,
}

impl Default for Fingerprint {
    fn default() -> Self {
        Self { hasher: Sha256::new(), latest: SystemTime::UNIX_EPOCH, bytes: 0, taken: SystemTime::now() }
    }
}

impl Fingerprint {
    /// Adds a text that files are looked at under: settings, a key.
    pub fn add_text(&mut self, text: &str) {
        self.hasher.update((text.len() as u64).to_le_bytes());
        self.hasher.update(text);
    }

    /// Adds a file, which may be missing. Files must come in a defined order.
    pub fn add_file(&mut self, name: &str, path: &Path) {
        self.add_text(name);
        match std::fs::metadata(path) {
            Ok(metadata) => self.add_metadata(&metadata),
            Err(error) => self.add_text(&error.kind().to_string()),
        }
    }

    fn add_metadata(&mut self, metadata: &Metadata) {
        let modified = metadata.modified().unwrap_or(SystemTime::UNIX_EPOCH);
        let mut numbers = vec![i128::from(metadata.len()), nanoseconds(modified)];
        self.latest = self.latest.max(modified);
        self.bytes += metadata.len();
        #[cfg(unix)]
        {
            use std::os::unix::fs::MetadataExt as _;
            let changed_ns = i128::from(metadata.ctime()) * 1_000_000_000 + i128::from(metadata.ctime_nsec());
            numbers.extend([changed_ns, i128::from(metadata.ino())]);
            let changed = Duration::from_nanos(u64::try_from(changed_ns).unwrap_or(0));
            self.latest = self.latest.max(SystemTime::UNIX_EPOCH + changed);
        }
        numbers.iter().for_each(|number| self.hasher.update(number.to_le_bytes()));
    }

    /// Sum of the sizes of the files.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// In hexadecimal.
    #[must_use]
    pub fn hex(&self) -> String {
        format!("{:x}", self.hasher.clone().finalize())
    }

    /// In hexadecimal, or none when a file changed so shortly before that it may have changed again without a trace.
    #[must_use]
    pub fn settled(&self) -> Option<String> {
        (self.latest + TIME_STEP <= self.taken).then(|| self.hex())
    }
}

fn nanoseconds(time: SystemTime) -> i128 {
    let since = |duration: Duration| i128::try_from(duration.as_nanos()).unwrap_or(i128::MAX);
    match time.duration_since(SystemTime::UNIX_EPOCH) {
        Ok(after) => since(after),
        Err(before) => -since(before.duration()),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use std::fs::{File, FileTimes};

    use super::*;

    fn of(path: &Path) -> Fingerprint {
        let mut fingerprint = Fingerprint::default();
        fingerprint.add_file("a", path);
        fingerprint
    }

    #[test]
    fn a_changed_file_shows_even_with_its_old_size_and_time() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a");
        std::fs::write(&path, b"before").unwrap();
        let long_ago = SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000);
        let times = FileTimes::new().set_modified(long_ago);
        File::options().write(true).open(&path).unwrap().set_times(times).unwrap();
        let before = of(&path);
        assert_eq!(before.hex(), of(&path).hex());
        std::thread::sleep(Duration::from_millis(20));
        std::fs::write(&path, b"after!").unwrap();
        File::options().write(true).open(&path).unwrap().set_times(times).unwrap();
        assert_eq!((before.bytes(), of(&path).bytes()), (6, 6));
        #[cfg(unix)]
        assert_ne!(before.hex(), of(&path).hex());
        std::fs::remove_file(&path).unwrap();
        assert_ne!(before.hex(), of(&path).hex());
    }

    #[test]
    fn what_changed_a_moment_ago_is_not_settled() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a");
        std::fs::write(&path, b"x").unwrap();
        let mut fingerprint = of(&path);
        assert_eq!(fingerprint.settled(), None);
        fingerprint.taken += Duration::from_secs(10);
        assert_eq!(fingerprint.settled(), Some(fingerprint.hex()));
    }
}
