//! Reads and hashes the next images while one is written.

use std::sync::mpsc::sync_channel;

use crate::card::{CardFile, Inputs, LARGEST_IMAGE_BYTES, read_image};
use crate::error::IngestError;
use crate::progress::IngestProgress;
use crate::summary::DroppedImage;

/// Images that wait to be written. More would only take memory.
const WAITING: usize = 2;

/// Calls `each` with the bytes of every file, or why there are none, in order. A thread reads ahead, within the budget of
/// images; it ends with the call. Gives what was read; stops at the first error of `each`, or when asked to.
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
                let room = progress.image_budget().map(|budget| budget.take(file.bytes.min(LARGEST_IMAGE_BYTES)));
                let bytes = read_image(file, &mut inputs, progress);
                if progress.is_stopped() || send.send((file, bytes, room)).is_err() {
                    break; // nobody writes any more
                }
            }
            inputs
        };
        let reader = std::thread::Builder::new().name("read-ahead".to_owned()).spawn_scoped(scope, read);
        let reader = reader.map_err(IngestError::Thread)?;
        let written = receive.into_iter().try_for_each(|(file, bytes, _room)| each(file, bytes));
        match reader.join() {
            Ok(inputs) => written.map(|()| inputs),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}
