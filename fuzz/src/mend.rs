//! Makes checksums right again, so that an altered file is read beyond them.

use std::collections::BTreeMap;

use sha2::{Digest, Sha256};

const MCAP_MAGIC: usize = 8;
/// Opcode and length of a record.
const RECORD_HEAD: usize = 9;
const CHUNK: u8 = 0x06;
const METADATA: u8 = 0x0c;
const FOOTER: u8 = 0x02;
const SEAL: &[u8] = b"aim_batch.seal";

/// A CWA file in which the words of every block sum to 0.
pub(crate) fn cwa(file: &[u8]) -> Vec<u8> {
    let mut file = file.to_vec();
    let mut at = if file.starts_with(b"MD") { 1024 } else { 0 };
    while let Some(block) = file.get_mut(at..at + 512) {
        if !block.starts_with(b"AX\xfc\x01") {
            at += 1;
            continue;
        }
        let (words, checksum) = block.split_at_mut(510);
        let sum = words.chunks(2).fold(0_u16, |sum, word| sum.wrapping_add(u16::from_le_bytes([word[0], word[1]])));
        checksum.copy_from_slice(&sum.wrapping_neg().to_le_bytes());
        at += 512;
    }
    file
}

/// A PNG file in which the checksum of every chunk is right; none for other files.
pub(crate) fn png(file: &[u8]) -> Option<Vec<u8>> {
    let mut mended = file.to_vec();
    let mut at = file.starts_with(b"\x89PNG\r\n\x1a\n").then_some(8)?;
    while let Some(length) = mended.get(at..).and_then(<[u8]>::first_chunk) {
        let data = u32::from_be_bytes(*length) as usize;
        let Some(chunk) = mended.get_mut(at + 4..at.saturating_add(data).saturating_add(12)) else { break };
        let (content, checksum) = chunk.split_at_mut(4 + data);
        checksum.copy_from_slice(&crc32fast::hash(content).to_be_bytes());
        at += 12 + data;
    }
    Some(mended)
}

/// An MCAP file with the checksums of its chunks, without that of its index, and with the seal of its metadata.
pub(crate) fn mcap(file: &[u8]) -> Vec<u8> {
    let mut file = file.to_vec();
    let mut metadata: BTreeMap<Vec<u8>, BTreeMap<Vec<u8>, Vec<u8>>> = BTreeMap::new();
    let mut seal_at = None;
    for (opcode, at, length) in records(&file) {
        let Some(body) = file.get_mut(at..at + length) else { break };
        match opcode {
            CHUNK => mend_chunk(body),
            FOOTER if length == 20 => body[16..].fill(0), // 0: none
            METADATA => match parse_metadata(body) {
                Some((name, entries)) if name == SEAL => {
                    let places = entries.get(b"sha256".as_slice());
                    seal_at = places.filter(|text| text.len() == 64).map(|_| at + length - 64);
                }
                Some((name, entries)) => drop(metadata.insert(name, entries)),
                None => {}
            },
            _ => {}
        }
    }
    if let Some(place) = seal_at.and_then(|at| file.get_mut(at..at + 64)) {
        place.copy_from_slice(seal(&metadata).as_bytes());
    }
    file
}

/// Opcode, place of the body and its length.
fn records(file: &[u8]) -> Vec<(u8, usize, usize)> {
    let mut found = Vec::new();
    let mut at = MCAP_MAGIC;
    while let Some(head) = file.get(at..at + RECORD_HEAD) {
        let length = u64::from_le_bytes(std::array::from_fn(|i| head[1 + i]));
        let Some(length) = usize::try_from(length).ok().filter(|length| *length <= file.len()) else { break };
        found.push((head[0], at + RECORD_HEAD, length));
        at += RECORD_HEAD + length;
    }
    found
}

/// Start, end, uncompressed size, its checksum, compression, size of the records, the records.
fn mend_chunk(body: &mut [u8]) {
    let Some(compression) = length_at(body, 28) else { return };
    let data_at = 32 + compression + 8;
    let Some(data) = body.get(data_at..) else { return };
    let (size, crc) = ((data.len() as u64).to_le_bytes(), crc32fast::hash(data).to_le_bytes());
    body[16..24].copy_from_slice(&size);
    body[24..28].copy_from_slice(&crc);
    body[data_at - 8..data_at].copy_from_slice(&size);
}

type Entries = BTreeMap<Vec<u8>, Vec<u8>>;

fn parse_metadata(body: &[u8]) -> Option<(Vec<u8>, Entries)> {
    let (name, rest) = text(body)?;
    let mut rest = rest.get(4..)?;
    let mut entries = Entries::new();
    while !rest.is_empty() {
        let (key, after) = text(rest)?;
        let (value, after) = text(after)?;
        entries.insert(key.to_vec(), value.to_vec());
        rest = after;
    }
    Some((name.to_vec(), entries))
}

fn text(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let length = length_at(bytes, 0)?;
    bytes.get(4..)?.split_at_checked(length)
}

fn length_at(bytes: &[u8], at: usize) -> Option<usize> {
    let field = bytes.get(at..)?.first_chunk()?;
    usize::try_from(u32::from_le_bytes(*field)).ok().filter(|length| *length <= bytes.len())
}

/// As ingest seals its metadata: lengths and texts of all records but the seal, in order.
fn seal(records: &BTreeMap<Vec<u8>, Entries>) -> String {
    let mut hasher = Sha256::new();
    let mut add = |text: &[u8]| {
        hasher.update((text.len() as u64).to_le_bytes());
        hasher.update(text);
    };
    for (name, entries) in records {
        add(name);
        for (key, value) in entries {
            add(key);
            add(value);
        }
    }
    format!("{:x}", hasher.finalize())
}
