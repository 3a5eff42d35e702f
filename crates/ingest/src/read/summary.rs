//! The index at the end of an MCAP file. Every offset and length in it is checked against the file before it is used.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};

use mcap::records::{ChunkIndex, Record, op};
use mcap::sans_io::linear_reader::LinearReaderOptions;
use model::UtcNs;

use super::error::Damage;
use super::records::for_each_record;
use crate::mcap_file::metadata::Records;

/// Opcode, length, body, magic.
const FOOTER_AND_MAGIC_BYTES: u64 = 1 + 8 + 20 + 8;
/// The record before the summary; the summary's checksum is reckoned from its end.
const DATA_END_BYTES: u64 = 1 + 8 + 4;
/// An index entry of an image takes about 150 bytes: this is for millions of images.
const LARGEST_INDEX_BYTES: u64 = 1024 * 1024 * 1024;

/// Which chunks hold what.
#[derive(Debug)]
pub(super) struct Index {
    topics: BTreeMap<u16, String>,
    chunks: Vec<ChunkAt>,
}

/// A chunk record: where it is, and what it holds.
#[derive(Debug, Clone)]
pub(crate) struct ChunkAt {
    pub offset: u64,
    pub bytes: u64,
    pub start: UtcNs,
    end: UtcNs,
    channels: Vec<u16>,
}

impl ChunkAt {
    pub fn covers(&self, time: UtcNs) -> bool {
        (self.start..=self.end).contains(&time)
    }
}

impl Index {
    /// Reads the index and all metadata records.
    pub fn read(file: &File) -> Result<(Self, Records), Damage> {
        let file_bytes = file.metadata()?.len();
        let summary = read_summary(file, file_bytes)?;
        let mut index = Self { topics: BTreeMap::new(), chunks: Vec::new() };
        let mut metadata_at = Vec::new();
        // The library checks the checksum of the summary. Chunks are not opened.
        let options = LinearReaderOptions::default()
            .with_skip_start_magic(true)
            .with_emit_chunks(true)
            .with_validate_summary_section_crc(true)
            .with_record_length_limit(summary.len());
        for_each_record(&summary, options, |opcode, data| {
            // Only these: the library's parser of attachments panics on a short record.
            if !matches!(opcode, op::CHANNEL | op::CHUNK_INDEX | op::METADATA_INDEX) {
                return Ok(());
            }
            match mcap::parse_record(opcode, data)? {
                Record::Channel(channel) => drop(index.topics.insert(channel.id, channel.topic)),
                Record::ChunkIndex(chunk) => index.chunks.push(chunk_at(&chunk, file_bytes)?),
                Record::MetadataIndex(at) => metadata_at.push((at.offset, at.length)),
                _ => {}
            }
            Ok(())
        })?;
        index.check_places()?;
        let mut records = Records::new();
        for (offset, length) in metadata_at {
            let bytes = read_at(file, file_bytes, "metadata record", offset, length)?;
            match mcap::parse_record(op::METADATA, body(&bytes, op::METADATA, "metadata record", offset)?)? {
                Record::Metadata(record) => drop(records.insert(record.name, record.metadata)),
                _ => return Err(Damage::Unexpected { expected: "metadata record", offset }),
            }
        }
        Ok((index, records))
    }

    pub fn topic(&self, channel: u16) -> Option<&str> {
        self.topics.get(&channel).map(String::as_str)
    }

    /// Names of the topics that begin with `prefix`, without it, sorted.
    pub fn topics_with(&self, prefix: &str) -> Vec<String> {
        let mut names: Vec<String> =
            self.topics.values().filter_map(|topic| topic.strip_prefix(prefix)).map(str::to_owned).collect();
        names.sort();
        names.dedup(); // channels may share a topic
        names
    }

    /// The chunks that hold messages of any of these topics, in file order.
    pub fn chunks_of<'i>(&'i self, topics: &'i [&'i str]) -> impl Iterator<Item = &'i ChunkAt> {
        let holds = |channel: &u16| self.topic(*channel).is_some_and(|topic| topics.contains(&topic));
        self.chunks.iter().filter(move |chunk| chunk.channels.iter().any(holds))
    }

    /// No byte of the file is in two chunks: what is read is bounded by the file.
    fn check_places(&self) -> Result<(), Damage> {
        let mut places: Vec<(u64, u64)> = self.chunks.iter().map(|chunk| (chunk.offset, chunk.bytes)).collect();
        places.sort_unstable();
        match places.windows(2).find(|pair| pair[0].0 + pair[0].1 > pair[1].0) {
            Some(pair) => Err(Damage::Unexpected { expected: "chunk of its own", offset: pair[1].0 }),
            None => Ok(()),
        }
    }

    /// The chunks of a sensor, by the time of their first message.
    pub fn sensor_chunks(&self, topic: &str) -> Vec<ChunkAt> {
        let mut chunks: Vec<ChunkAt> = self.chunks_of(&[topic]).cloned().collect();
        chunks.sort_by_key(|chunk| (chunk.start, chunk.offset));
        chunks
    }
}

fn chunk_at(chunk: &ChunkIndex, file_bytes: u64) -> Result<ChunkAt, Damage> {
    let end = chunk.chunk_start_offset.checked_add(chunk.chunk_length);
    if end.is_none_or(|end| end > file_bytes) {
        return Err(Damage::Outside { part: "chunk", offset: chunk.chunk_start_offset, file_bytes });
    }
    let time = |ns: u64| i64::try_from(ns).map(UtcNs).map_err(|_| Damage::Time(ns));
    Ok(ChunkAt {
        offset: chunk.chunk_start_offset,
        bytes: chunk.chunk_length,
        start: time(chunk.message_start_time)?,
        end: time(chunk.message_end_time)?,
        channels: chunk.message_index_offsets.keys().copied().collect(),
    })
}

/// From the data end record to the end of the file.
fn read_summary(file: &File, file_bytes: u64) -> Result<Vec<u8>, Damage> {
    let footer_at = file_bytes.checked_sub(FOOTER_AND_MAGIC_BYTES).ok_or(Damage::NoIndex)?;
    let footer = read_at(file, file_bytes, "footer", footer_at, FOOTER_AND_MAGIC_BYTES)?;
    let footer = footer.strip_suffix(mcap::MAGIC).ok_or(Damage::NoIndex)?;
    let Record::Footer(footer) = mcap::parse_record(op::FOOTER, body(footer, op::FOOTER, "footer", footer_at)?)? else {
        return Err(Damage::NoIndex);
    };
    let start = footer.summary_start.checked_sub(DATA_END_BYTES).ok_or(Damage::NoIndex)?;
    let length = file_bytes.checked_sub(start).filter(|length| *length <= LARGEST_INDEX_BYTES);
    let length = length.ok_or(Damage::Outside { part: "index", offset: start, file_bytes })?;
    read_at(file, file_bytes, "index", start, length)
}

/// The body of the one record in `bytes`.
pub(super) fn body<'b>(bytes: &'b [u8], opcode: u8, expected: &'static str, offset: u64) -> Result<&'b [u8], Damage> {
    let wrong = Damage::Unexpected { expected, offset };
    let Some((&[found, ref length @ ..], body)) = bytes.split_first_chunk::<9>() else { return Err(wrong) };
    let length = u64::from_le_bytes(*length);
    if found == opcode && length == body.len() as u64 { Ok(body) } else { Err(wrong) }
}

pub(super) fn read_at(
    mut file: &File,
    file_bytes: u64,
    part: &'static str,
    offset: u64,
    length: u64,
) -> Result<Vec<u8>, Damage> {
    let outside = Damage::Outside { part, offset, file_bytes };
    if offset.checked_add(length).is_none_or(|end| end > file_bytes) {
        return Err(outside);
    }
    let mut bytes = vec![0; usize::try_from(length).map_err(|_| outside)?];
    file.seek(SeekFrom::Start(offset))?;
    file.read_exact(&mut bytes)?;
    Ok(bytes)
}
