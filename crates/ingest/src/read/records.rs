//! The records of bytes that are at hand.

use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};

use super::error::Damage;

/// Feeds `bytes` to the library's reader, which checks what `options` say, and calls `each` with opcode and body of every
/// record.
pub(super) fn for_each_record(
    bytes: &[u8],
    options: LinearReaderOptions,
    mut each: impl FnMut(u8, &[u8]) -> Result<(), Damage>,
) -> Result<(), Damage> {
    let mut reader = LinearReader::new_with_options(options);
    let mut rest = bytes;
    while let Some(event) = reader.next_event() {
        match event? {
            LinearReadEvent::ReadRequest(wanted) => {
                let (now, later) = rest.split_at(wanted.min(rest.len()));
                reader.insert(now.len()).copy_from_slice(now);
                reader.notify_read(now.len());
                rest = later;
            }
            LinearReadEvent::Record { data, opcode } => each(opcode, data)?,
        }
    }
    Ok(())
}
