//! Reads and hashes the next images while one is written.

use std::sync::mpsc::sync_channel;

use super::IngestError;
use crate::card::{CardFile, Inputs, read_image};
use crate::progress::IngestProgress;
use crate::summary::DroppedImage;

/// Images that wait to be written. More would only take memory.
const WAITING: usize = 2;

/// Calls `each` with the bytes of every file, or why there are none, in order. A thread reads ahead; it ends with the
/// call. Gives what was read; stops at the first error of `each`.
pub(super) fn read_ahead(
    files: &[CardFile],
    progress: &dyn IngestProgress,
    mut each: impl FnMut(&CardFile, Result<Vec<u8>, DroppedImage>) -> Result<(), IngestError>,
) -> Result<Inputs, IngestError> {
    std::thread::scope(|scope| {
        let (send, receive) = sync_channel(WAITING);
        let read = move || {
            let mut inputs = Inputs::default();
            for file in files {
                let bytes = read_image(file, &mut inputs, progress);
                if send.send((file, bytes)).is_err() {
                    break; // nobody writes any more
                }
            }
            inputs
        };
        let reader = std::thread::Builder::new().name("read-ahead".to_owned()).spawn_scoped(scope, read);
        let reader = reader.map_err(IngestError::Thread)?;
        let written = receive.into_iter().try_for_each(|(file, bytes)| each(file, bytes));
        match reader.join() {
            Ok(inputs) => written.map(|()| inputs),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}
