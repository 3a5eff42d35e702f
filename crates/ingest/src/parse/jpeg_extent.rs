//! JPEG (ITU-T T.81, Annex B): from the start marker over segments and scans to the end marker of the main picture.
//!
//! Thumbnails lie inside APP segments and are skipped with them. Only 0xff bytes are looked at within a scan.

use memchr::memchr;

use super::image_extent::{ImageDamage, ImageExtent};
use super::jpeg_tables::ZeroCodes;

/// Zeros that a damaged card gives come in blocks of at least this many bytes: the usual cluster of a small card.
pub(super) const ZERO_BLOCK_BYTES: usize = 4096;

const END_MARKER: &str = "ff d9";
const SEGMENT: &str = "a marker of JPEG (ff c0 to ff fe)";

/// A damaged card loses or changes whole sectors.
const SECTOR_BYTES: usize = 512;

const SOI: u8 = 0xd8;
const EOI: u8 = 0xd9;
const SOS: u8 = 0xda;
const DHT: u8 = 0xc4;
const APP2: u8 = 0xe2;

/// The extent of the main picture of a JPEG file.
///
/// # Errors
/// [`ImageDamage`] when its end marker cannot be reached, or a block of its data is zeros.
pub(super) fn jpeg_extent(bytes: &[u8]) -> Result<ImageExtent, ImageDamage> {
    if !bytes.starts_with(&[0xff, SOI]) {
        return Err(strange(bytes, 0, "the start marker ff d8"));
    }
    let mut walk =
        Walk { bytes, at: 2, tables: ZeroCodes::default(), has_scan: false, has_more_pictures: false, stray_bytes: 0 };
    loop {
        let (at, code) = walk.marker()?;
        match code {
            EOI if walk.has_scan => {
                let Walk { at: bytes, has_more_pictures, stray_bytes, .. } = walk;
                return Ok(ImageExtent { bytes, has_more_pictures, stray_bytes });
            }
            EOI => return Err(ImageDamage::NoPixels { at }),
            SOS => {
                let header = walk.segment(at)?;
                walk.has_scan = true;
                walk.scan(header)?;
            }
            DHT => {
                let tables = walk.segment(at)?;
                walk.tables.define(tables);
            }
            APP2 => walk.has_more_pictures |= walk.segment(at)?.starts_with(b"MPF\0"),
            _ if is_segment(code, walk.has_scan) => drop(walk.segment(at)?),
            _ => return Err(strange(bytes, at, SEGMENT)),
        }
    }
}

/// Markers with a length behind them. Once a scan was there, a frame does not begin again.
fn is_segment(code: u8, has_scan: bool) -> bool {
    match code {
        0xc4 | 0xcc | 0xdb..=0xdd | 0xe0..=0xef | 0xfe => true,
        0xc0..=0xcf | 0xde..=0xdf | 0xf0..=0xfd => !has_scan,
        _ => false,
    }
}

fn strange(bytes: &[u8], at: usize, expected: &'static str) -> ImageDamage {
    let found: Vec<String> = bytes.iter().skip(at).take(2).map(|byte| format!("{byte:02x}")).collect();
    ImageDamage::Strange { found: found.join(" "), at, expected }
}

struct Walk<'a> {
    bytes: &'a [u8],
    at: usize,
    tables: ZeroCodes,
    has_scan: bool,
    has_more_pictures: bool,
    stray_bytes: usize,
}

impl<'a> Walk<'a> {
    /// The place where the next marker is, and its code. Any number of 0xff may stand before the code. Stray bytes before the marker
    /// are passed over and counted, as libjpeg does ("extraneous bytes before marker"), as long as they are fewer than a damaged card
    /// would give.
    fn marker(&mut self) -> Result<(usize, u8), ImageDamage> {
        let start = self.at;
        let stray = memchr(0xff, &self.bytes[start..]).ok_or_else(|| self.no_end())?;
        self.stray_bytes += stray;
        if self.stray_bytes >= SECTOR_BYTES {
            return Err(strange(self.bytes, start, SEGMENT));
        }
        let at = start + stray;
        let fill = self.bytes[at..].iter().take_while(|byte| **byte == 0xff).count();
        let code = *self.bytes.get(at + fill).ok_or_else(|| self.no_end())?;
        self.at = at + fill + 1;
        Ok((at, code))
    }

    /// Reads the segment whose marker is at `marker_at`, and goes on behind it.
    fn segment(&mut self, marker_at: usize) -> Result<&'a [u8], ImageDamage> {
        let rest = &self.bytes[self.at..];
        let [high, low, ..] = rest else { return Err(self.no_end()) };
        let length = usize::from(u16::from_be_bytes([*high, *low]));
        if length < 2 {
            return Err(strange(self.bytes, self.at, "the length of a segment, at least 2"));
        }
        let Some(segment) = rest.get(2..length) else {
            let part = format!("segment {:02x}", self.bytes[self.at - 1]);
            return Err(ImageDamage::Cut { part, at: marker_at, expected: length, got: rest.len() });
        };
        self.at += length;
        Ok(segment)
    }

    /// Goes to the marker behind the entropy-coded data of a scan.
    fn scan(&mut self, header: &[u8]) -> Result<(), ImageDamage> {
        let zeros_are_even_colour = self.tables.zeros_are_even_colour(header);
        loop {
            let rest = &self.bytes[self.at..];
            let gap = memchr(0xff, rest).unwrap_or(rest.len());
            // Only a stretch without any 0xff can hold such a block: rare, so looking closely costs nothing.
            if gap >= ZERO_BLOCK_BYTES && !zeros_are_even_colour {
                self.refuse_zeros(&rest[..gap])?;
            }
            match rest.get(gap + 1) {
                None => return Err(self.no_end()),
                Some(0x00 | 0xd0..=0xd7) => self.at += gap + 2,
                Some(0xff) => self.at += gap + 1,
                Some(_) => {
                    self.at += gap;
                    return Ok(());
                }
            }
        }
    }

    fn refuse_zeros(&self, gap: &[u8]) -> Result<(), ImageDamage> {
        match zero_block(gap) {
            Some((start, bytes)) => Err(ImageDamage::Zeros { at: self.at + start, bytes }),
            None => Ok(()),
        }
    }

    fn no_end(&self) -> ImageDamage {
        ImageDamage::NoEnd { bytes: self.bytes.len(), marker: END_MARKER }
    }
}

/// Start and length of the first run of at least [`ZERO_BLOCK_BYTES`] zeros: every such run fills a half block.
fn zero_block(bytes: &[u8]) -> Option<(usize, usize)> {
    const HALF: usize = ZERO_BLOCK_BYTES / 2;
    let is_zero = |byte: &&u8| **byte == 0;
    let mut past = 0;
    for (index, half) in bytes.chunks_exact(HALF).enumerate() {
        let at = index * HALF;
        if at < past || half.iter().any(|byte| *byte != 0) {
            continue;
        }
        let start = at - bytes[past..at].iter().rev().take_while(is_zero).count();
        past = at + bytes[at..].iter().take_while(is_zero).count();
        if past - start >= ZERO_BLOCK_BYTES {
            return Some((start, past - start));
        }
    }
    None
}
