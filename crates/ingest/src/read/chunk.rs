//! One chunk of an MCAP file: read whole, its checksum verified, its messages handed out.

use std::fs::File;

use mcap::records::{MessageHeader, Record, op};
use mcap::sans_io::linear_reader::LinearReaderOptions;
use model::UtcNs;

use super::error::Damage;
use super::records::for_each_record;
use super::summary::{ChunkAt, body, read_at};
use crate::mcap_file::LARGEST_CHUNK_BYTES;

/// Calls `each` with all messages of the chunk, in file order.
pub(super) fn for_each_message(
    file: &File,
    chunk: &ChunkAt,
    mut each: impl FnMut(&MessageHeader, &[u8]) -> Result<(), Damage>,
) -> Result<(), Damage> {
    if chunk.bytes > LARGEST_CHUNK_BYTES {
        return Err(Damage::Unexpected { expected: "chunk of at most one image", offset: chunk.offset });
    }
    let bytes = read_at(file, file.metadata()?.len(), "chunk", chunk.offset, chunk.bytes)?;
    let wrong = Damage::Unexpected { expected: "chunk compressed with lz4", offset: chunk.offset };
    match mcap::parse_record(op::CHUNK, body(&bytes, op::CHUNK, "chunk", chunk.offset)?)? {
        // We write no other, and the library's reader trusts the lengths in uncompressed ones.
        Record::Chunk { header, .. } if header.compression == "lz4" => {}
        _ => return Err(wrong),
    }
    let limit = usize::try_from(LARGEST_CHUNK_BYTES).unwrap_or(usize::MAX);
    let options = LinearReaderOptions::default()
        .with_skip_start_magic(true)
        .with_skip_end_magic(true)
        .with_prevalidate_chunk_crcs(true)
        .with_record_length_limit(limit);
    for_each_record(&bytes, options, |opcode, data| {
        if opcode == op::MESSAGE
            && let Record::Message { header, data } = mcap::parse_record(opcode, data)?
        {
            each(&header, &data)?;
        }
        Ok(())
    })
}

/// When a message was taken.
pub(super) fn time_of(header: &MessageHeader) -> Result<UtcNs, Damage> {
    i64::try_from(header.log_time).map(UtcNs).map_err(|_| Damage::Time(header.log_time))
}
