//! Whether files are as they were, without reading them: names, sizes, times and inode numbers.

use std::fs::Metadata;
use std::path::Path;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use sha2::{Digest, Sha256};

/// File systems keep times in steps of up to 2 s (FAT): a file that changed so recently may change again unseen.
const TIME_STEP_NS: i128 = 2_000_000_000;

/// The facts that the file system gives of a file.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct FileStamp {
    bytes: u64,
    modified_ns: i128,
    /// The time at which the inode changed, which no program can set; zero where there is no such time.
    changed_ns: i128,
    inode: u64,
}

impl FileStamp {
    /// Size of the file.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.bytes
    }
}

impl From<&Metadata> for FileStamp {
    fn from(metadata: &Metadata) -> Self {
        let modified_ns = nanoseconds(metadata.modified().unwrap_or(UNIX_EPOCH));
        let stamp = Self { bytes: metadata.len(), modified_ns, ..Self::default() };
        #[cfg(unix)]
        let stamp = {
            use std::os::unix::fs::MetadataExt as _;
            let changed_ns = i128::from(metadata.ctime()) * 1_000_000_000 + i128::from(metadata.ctime_nsec());
            Self { changed_ns, inode: metadata.ino(), ..stamp }
        };
        stamp
    }
}

/// A digest over what the system says of files. Equal fingerprints of the same paths mean equal contents, as far as the
/// system tells the truth; on Unix a change of contents changes the inode's own time, which no program can set.
#[derive(Debug, Clone)]
pub struct Fingerprint {
    hasher: Sha256,
    latest_ns: i128,
    bytes: u64,
    taken_ns: i128,
}

impl Default for Fingerprint {
    fn default() -> Self {
        Self { hasher: Sha256::new(), latest_ns: 0, bytes: 0, taken_ns: nanoseconds(SystemTime::now()) }
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
        match std::fs::metadata(path) {
            Ok(metadata) => self.add_stamp(name, &FileStamp::from(&metadata)),
            Err(error) => {
                self.add_text(name);
                self.add_text(&error.kind().to_string());
            }
        }
    }

    /// Adds a file by what was said of it.
    pub fn add_stamp(&mut self, name: &str, stamp: &FileStamp) {
        let FileStamp { bytes, modified_ns, changed_ns, inode } = stamp;
        self.add_text(name);
        for number in [i128::from(*bytes), *modified_ns, *changed_ns, i128::from(*inode)] {
            self.hasher.update(number.to_le_bytes());
        }
        // A time of modification is copied along with a card, and may lie in the future for long; the inode's own is not.
        let is_copied = *modified_ns > self.taken_ns && *changed_ns != 0;
        self.latest_ns = self.latest_ns.max(*changed_ns).max(if is_copied { 0 } else { *modified_ns });
        self.bytes += bytes;
    }

    /// Adds a file that nobody reads: its bytes do not count.
    pub fn add_unread(&mut self, name: &str, stamp: &FileStamp) {
        self.add_stamp(name, stamp);
        self.bytes -= stamp.bytes;
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
        (self.latest_ns + TIME_STEP_NS <= self.taken_ns).then(|| self.hex())
    }
}

fn nanoseconds(time: SystemTime) -> i128 {
    let since = |duration: Duration| i128::try_from(duration.as_nanos()).unwrap_or(i128::MAX);
    match time.duration_since(UNIX_EPOCH) {
        Ok(after) => since(after),
        Err(before) => -since(before.duration()),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use std::fs::{File, FileTimes};

    use super::*;

    fn fingerprint_of(path: &Path) -> Fingerprint {
        let mut fingerprint = Fingerprint::default();
        fingerprint.add_file("a", path);
        fingerprint
    }

    #[test]
    fn a_changed_file_shows_even_with_its_old_size_and_time() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a");
        std::fs::write(&path, b"before").unwrap();
        let long_ago = UNIX_EPOCH + Duration::from_secs(1_000_000);
        let times = FileTimes::new().set_modified(long_ago);
        File::options().write(true).open(&path).unwrap().set_times(times).unwrap();
        let before = fingerprint_of(&path);
        assert_eq!(before.hex(), fingerprint_of(&path).hex());
        std::thread::sleep(Duration::from_millis(20));
        std::fs::write(&path, b"after!").unwrap();
        File::options().write(true).open(&path).unwrap().set_times(times).unwrap();
        assert_eq!((before.bytes(), fingerprint_of(&path).bytes()), (6, 6));
        #[cfg(unix)]
        assert_ne!(before.hex(), fingerprint_of(&path).hex());
        std::fs::remove_file(&path).unwrap();
        assert_ne!(before.hex(), fingerprint_of(&path).hex());
    }

    #[cfg(unix)]
    #[test]
    fn a_time_of_modification_in_the_future_is_no_change_to_come() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a");
        std::fs::write(&path, b"x").unwrap();
        let next_year = SystemTime::now() + Duration::from_secs(30_000_000);
        File::options().write(true).open(&path).unwrap().set_times(FileTimes::new().set_modified(next_year)).unwrap();
        let mut fingerprint = Fingerprint::default();
        fingerprint.taken_ns += 10_000_000_000;
        fingerprint.add_file("a", &path);
        assert_eq!(fingerprint.settled(), Some(fingerprint.hex()));
    }

    #[test]
    fn what_changed_a_moment_ago_is_not_settled() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a");
        std::fs::write(&path, b"x").unwrap();
        let mut fingerprint = fingerprint_of(&path);
        assert_eq!(fingerprint.settled(), None);
        fingerprint.taken_ns += 10_000_000_000;
        assert_eq!(fingerprint.settled(), Some(fingerprint.hex()));
    }
}
