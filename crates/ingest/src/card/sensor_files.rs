//! In which order the files of a sensor are read.

use std::fs::File;
use std::io::{BufRead, BufReader};

use jiff::tz::TimeZone;
use model::UtcNs;

use super::CardFile;
use super::decoder::{Decoder, Layout};
use crate::parse::{RawBlock, Stamps, image_time};
use crate::profile::{Anchor, ClockSpec};
use crate::timeline::{LEARNED_ROWS, SharedStamps, StampCounts};

/// If these rows of a file have stamps of their own, so have all.
const FIRST_ROWS: u64 = 4096;

/// The source of the time at which boot-relative clocks were zero.
#[derive(Debug, Clone)]
pub(crate) struct Anchoring<'a> {
    pub spec: Option<&'a ClockSpec>,
    /// As session.toml gives it.
    pub session: Option<UtcNs>,
    pub zone: &'a TimeZone,
}

impl Anchoring<'_> {
    /// Whether one time holds for all files.
    pub fn is_of_session(&self) -> bool {
        matches!(self.spec.map(|spec| &spec.anchor), Some(Anchor::Session {}))
    }

    /// For one file; none when nothing says so.
    pub fn of_file(&self, file: &CardFile) -> Option<UtcNs> {
        match &self.spec?.anchor {
            Anchor::Session {} => self.session,
            Anchor::Name { pattern } => {
                let name = file.name.rsplit('/').next().unwrap_or(&file.name);
                image_time::from_name(name, pattern, self.zone).ok()
            }
        }
    }
}

/// Files in the order of their first samples, or of their names where the counter may have started anew between them; and
/// files that are there twice.
pub(crate) fn in_order(
    mut files: Vec<CardFile>,
    layout: &Layout,
    anchoring: &Anchoring<'_>,
) -> (Vec<CardFile>, Vec<(CardFile, CardFile)>) {
    let first = |file: &CardFile| (!layout.is_wrapping()).then(|| first_stamp_ns(file, layout, anchoring));
    files.sort_by_cached_key(|file| (first(file), file.name.clone()));
    let mut kept: Vec<CardFile> = Vec::new();
    let mut twice = Vec::new();
    for file in files {
        let same = kept.iter().rev().take(8).find(|other| other.bytes == file.bytes && same_bytes(other, &file));
        match same {
            Some(other) if file.bytes > 0 => twice.push((file, other.clone())),
            _ => kept.push(file),
        }
    }
    (kept, twice)
}

/// The first stamp as the device wrote it, behind the anchor if there is one: the order of files does not depend on what
/// local time it is.
fn first_stamp_ns(file: &CardFile, layout: &Layout, anchoring: &Anchoring<'_>) -> Option<i64> {
    let mut decoder = Decoder::new(File::open(&file.path).ok()?, layout);
    let zero_ns = anchoring.of_file(file).map_or(0, |anchor| anchor.0);
    loop {
        let RawBlock { stamps, .. } = decoder.next_block()?;
        let ns = match stamps {
            Stamps::Packet { ns, .. } => Some(ns),
            Stamps::Each(stamps) => stamps.first().copied(),
            Stamps::Counted { .. } => Some(0),
        };
        if let Some(ns) = ns {
            return Some(zero_ns.saturating_add(ns));
        }
    }
}

/// How rows of a CSV file share stamps, by its first rows. None where they have stamps of their own, or none.
pub(crate) fn shared_stamps(file: &CardFile, layout: &Layout) -> Option<SharedStamps> {
    if !layout.has_row_stamps() {
        return None;
    }
    let mut decoder = Decoder::new(File::open(&file.path).ok()?, layout);
    let mut counts = StampCounts::default();
    while let Some(RawBlock { stamps: Stamps::Each(stamps), .. }) = decoder.next_block() {
        counts.add(&stamps);
        if counts.rows() >= LEARNED_ROWS || (counts.rows() >= FIRST_ROWS && counts.shared(layout.rate_hz).is_none()) {
            break;
        }
    }
    counts.shared(layout.rate_hz)
}

/// Rows of a file, missing and damaged ones included.
pub(crate) fn count_rows(file: &CardFile, layout: &Layout) -> u64 {
    let Ok(reader) = File::open(&file.path) else { return 0 };
    let mut decoder = Decoder::new(reader, layout);
    let mut rows = 0;
    while let Some(block) = decoder.next_block() {
        if let Stamps::Counted { samples, .. } = block.stamps {
            rows += u64::from(samples);
        }
    }
    rows
}

fn same_bytes(a: &CardFile, b: &CardFile) -> bool {
    let (Ok(a), Ok(b)) = (File::open(&a.path), File::open(&b.path)) else { return false };
    let (mut a, mut b) = (BufReader::with_capacity(64 * 1024, a), BufReader::with_capacity(64 * 1024, b));
    loop {
        let same = match (a.fill_buf(), b.fill_buf()) {
            (Ok([]), Ok([])) => return true,
            (Ok(a), Ok(b)) => {
                let n = a.len().min(b.len());
                if n == 0 || a[..n] != b[..n] {
                    return false;
                }
                n
            }
            _ => return false,
        };
        a.consume(same);
        b.consume(same);
    }
}
