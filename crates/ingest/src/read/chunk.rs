//! One chunk of an MCAP file: read whole, its checksum verified, its messages handed out.

use std::fs::File;

use mcap::records::{MessageHeader, Record, op};
use model::UtcNs;

use super::error::Damage;
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
    let wrong = |offset| Damage::Unexpected { expected: "chunk as this program writes them", offset };
    let Record::Chunk { header, data } =
        mcap::parse_record(op::CHUNK, body(&bytes, op::CHUNK, "chunk", chunk.offset)?)?
    else {
        return Err(wrong(chunk.offset));
    };
    if !header.compression.is_empty() || header.uncompressed_size != data.len() as u64 {
        return Err(wrong(chunk.offset));
    }
    if crc32fast::hash(&data) != header.uncompressed_crc {
        return Err(Damage::Checksum { offset: chunk.offset });
    }
    let mut rest: &[u8] = &data;
    while !rest.is_empty() {
        let (opcode, record, after) = split_record(rest).ok_or_else(|| wrong(chunk.offset))?;
        rest = after;
        if opcode == op::MESSAGE
            && let Record::Message { header, data } = mcap::parse_record(opcode, record)?
        {
            each(&header, &data)?;
        }
    }
    Ok(())
}

/// Opcode and body of the first record, and what follows it.
fn split_record(bytes: &[u8]) -> Option<(u8, &[u8], &[u8])> {
    let (&[opcode, ref length @ ..], rest) = bytes.split_first_chunk::<9>()?;
    let length = usize::try_from(u64::from_le_bytes(*length)).ok()?;
    let (record, after) = rest.split_at_checked(length)?;
    Some((opcode, record, after))
}

/// When a message was taken.
pub(super) fn time_of(header: &MessageHeader) -> Result<UtcNs, Damage> {
    i64::try_from(header.log_time).map(UtcNs).map_err(|_| Damage::Time(header.log_time))
}
