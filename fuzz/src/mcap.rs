//! MCAP files of sessions. Input: the file.

use std::cell::RefCell;
use std::fs::File;
use std::io::{Seek, Write};
use std::path::Path;

use ingest::{ReadError, SessionReader};
use model::UtcNs;
use tempfile::NamedTempFile;

use crate::mend;

thread_local! {
    /// The reader takes a path: one file in memory per thread, written anew for each input.
    static FILE: RefCell<NamedTempFile> = RefCell::new(in_memory());
}

fn in_memory() -> NamedTempFile {
    let memory = Path::new("/dev/shm");
    let file = if memory.is_dir() { NamedTempFile::new_in(memory) } else { NamedTempFile::new() };
    file.expect("a temporary file")
}

/// MCAP: what is read is bounded by the file and in order of time. Read as it is, and with its checksums made right.
pub fn mcap(input: &[u8]) -> usize {
    FILE.with_borrow_mut(|file| {
        let read = read_from(file, input);
        read.max(read_from(file, &mend::mcap(input)))
    })
}

fn read_from(file: &mut NamedTempFile, bytes: &[u8]) -> usize {
    let handle: &mut File = file.as_file_mut();
    handle.set_len(0).expect("the file can be emptied");
    handle.rewind().expect("the file can be rewound");
    handle.write_all(bytes).expect("the file can be written");
    let told = |error: ReadError| {
        let message = error.to_string();
        assert!(
            ["again", "there is no image", "not a file of this program"].iter().any(|part| message.contains(part)),
            "{message}"
        );
    };
    match SessionReader::open(file.path()) {
        Ok(mut session) => read_all(&mut session, bytes.len()).unwrap_or_else(|error| {
            told(error);
            0
        }),
        Err(error) => {
            told(error);
            0
        }
    }
}

fn read_all(session: &mut SessionReader, file_bytes: usize) -> Result<usize, ReadError> {
    let mut order = Order::default();
    session.for_each_acceleration(|time, _| order.next(time))?;
    let acceleration = std::mem::take(&mut order).samples;
    session.for_each_range(|time, _| order.next(time))?;
    let range = order.samples;
    assert!(12 * acceleration + 4 * range <= file_bytes, "{acceleration} and {range} samples in {file_bytes} bytes");
    let extra = session.extra_channels();
    assert!(extra.is_sorted_by(|a, b| a < b), "each channel once: {extra:?}");
    let mut carried = 0;
    for name in &extra {
        let mut order = Order::default();
        session.for_each_extra(name, |time, _| order.next(time))?;
        carried += order.samples;
    }
    assert!(12 * acceleration + 4 * (range + carried) <= file_bytes, "{carried} samples carried in {file_bytes} bytes");
    let images = session.images()?;
    assert!(images.is_sorted_by_key(|entry| (entry.time, entry.file.clone())), "images are in order of time");
    let mut read = acceleration + range + carried;
    for entry in &images {
        let bytes = session.image_bytes(&entry.file)?;
        assert!(bytes.len() <= file_bytes && entry.time.0 >= 0, "{entry:?}");
        read += 1;
    }
    Ok(read)
}

#[derive(Default)]
struct Order {
    last: Option<UtcNs>,
    samples: usize,
}

impl Order {
    fn next(&mut self, time: UtcNs) {
        assert!(time.0 >= 0 && self.last.is_none_or(|last| last <= time), "{time:?} after {:?}", self.last);
        self.last = Some(time);
        self.samples += 1;
    }
}
