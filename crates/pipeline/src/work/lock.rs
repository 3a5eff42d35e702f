//! Lets one run at a time into a work folder. The system drops the lock with the process, however that ends.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read as _, Seek as _, Write as _};
use std::path::Path;
use std::time::Duration;

use jiff::Timestamp;

use super::WorkError;

/// A lock, held until this value is dropped.
pub(super) struct Lock {
    _file: File,
}

impl Lock {
    pub fn take(path: &Path, program: &str) -> Result<Self, WorkError> {
        let refuse = |source| WorkError::Lock { path: path.to_owned(), source };
        let open = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path);
        let mut file = open.map_err(refuse)?;
        match try_lock(&file) {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(WorkError::Held { path: path.to_owned(), holder: holder_line(&mut file) });
            }
            Err(TryLockError::Error(error)) if error.kind() == std::io::ErrorKind::Unsupported => {
                tracing::warn!("this file system has no locks; start no second run here: {}", path.display());
            }
            Err(TryLockError::Error(error)) => return Err(refuse(error)),
        }
        let holder = format!("{program}, process {} on {}, since {}\n", std::process::id(), host(), now());
        let write = file.set_len(0).and_then(|()| file.rewind()).and_then(|()| file.write_all(holder.as_bytes()));
        write.map_err(refuse)?;
        Ok(Self { _file: file })
    }
}

/// Tries several times: `status` looks whether the lock is held, and holds it for that moment.
fn try_lock(file: &File) -> Result<(), TryLockError> {
    for _ in 0..10 {
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => std::thread::sleep(Duration::from_millis(20)),
            other => return other,
        }
    }
    file.try_lock()
}

/// The run at work in a work folder, in its own words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Holder(pub String);

impl Holder {
    /// The run at work, if there is one. Takes no lock and waits for nothing.
    #[must_use]
    pub fn current(work_dir: &Path) -> Option<Self> {
        let mut file = File::open(work_dir.join("lock")).ok()?;
        match file.try_lock_shared() {
            Err(TryLockError::WouldBlock) => Some(Self(holder_line(&mut file))),
            _ => None,
        }
    }
}

fn holder_line(file: &mut File) -> String {
    let mut text = String::new();
    // The holder's own words help people, but nothing depends on them.
    let _ = file.rewind().and_then(|()| file.take(1_000).read_to_string(&mut text));
    match text.lines().next() {
        Some(line) if !line.is_empty() => line.to_owned(),
        _ => "a process that has not told its name yet".to_owned(),
    }
}

fn now() -> String {
    Timestamp::now().round(jiff::Unit::Second).map_or_else(|_| String::new(), |now| now.to_string())
}

fn host() -> String {
    let name = std::fs::read_to_string("/proc/sys/kernel/hostname").ok().or_else(|| std::env::var("HOSTNAME").ok());
    name.map_or_else(|| "this machine".to_owned(), |name| name.trim().to_owned())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    #[test]
    fn the_second_is_told_who_holds_it_and_the_lock_goes_with_its_holder() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("lock");
        assert_eq!(Holder::current(dir.path()), None);
        let first = Lock::take(&path, "aim-batch 9.9").unwrap();
        let Err(WorkError::Held { holder, .. }) = Lock::take(&path, "aim-batch 9.9") else { panic!("not held") };
        assert!(holder.starts_with(&format!("aim-batch 9.9, process {} on ", std::process::id())), "{holder}");
        assert_eq!(Holder::current(dir.path()), Some(Holder(holder)));
        drop(first);
        assert_eq!(Holder::current(dir.path()), None);
        assert!(Lock::take(&path, "aim-batch 9.9").is_ok());
    }
}
