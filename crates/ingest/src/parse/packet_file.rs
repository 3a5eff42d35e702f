//! A file of packets, and what is left of one that is damaged.

use std::cell::Cell;
use std::io::{ErrorKind, Read};

use super::raw::RawBlock;
use super::{Fault, PacketParser};

/// Stamps outside of these (one second after 1970-01-01, and 2100-01-01 UTC) are bytes that are no stamp. A clock that was
/// never set, and counts from 1970, is one.
const EARLIEST_NS: i64 = 1_000_000_000;
const LATEST_NS: i64 = 4_102_444_800 * 1_000_000_000;
/// A stamp follows another where it is no more than a day later.
const FOLLOWS_WITHIN_NS: i64 = 86_400 * 1_000_000_000;
/// Where packets are looked for, a stamp follows the last one where it is no more than so many steps later, and the one
/// after it by one step, give or take this part: chance hardly gives two such stamps.
const SEARCH_STEPS: i64 = 8;
const STEP_PART: i64 = 8;

/// Streams the packets of a file. A packet counts only when what follows it looks like a packet too, or the file ends:
/// where bytes are lost inside one, it is left out and the search goes on for the next.
pub struct PacketSamples<R> {
    reader: R,
    parser: PacketParser,
    bytes: Vec<u8>,
    /// The place in `bytes` where the next packet begins.
    next: usize,
    /// The place in the file where `bytes` begins.
    offset: u64,
    at_end: bool,
    /// Stamp of the last packet, and how much later it is than the one before.
    last_ns: Option<i64>,
    step_ns: Option<i64>,
    /// Until where in the file the search for the next packet has been in vain, so that no byte is searched twice.
    barren_until: Cell<u64>,
    /// The place in the file where the first packet begins that bad ones lead to; 0 where none has been found.
    begins_at: Cell<u64>,
    damage: Damage,
    end: Option<Fault>,
}

#[derive(Debug, Default)]
struct Damage {
    bad_packets: u64,
    first_bad: Option<(u64, String)>,
    zero_bytes: u64,
    first_zero: Option<u64>,
    skipped_bytes: u64,
    first_skipped: Option<u64>,
    places: u64,
    samples: u64,
    impossible: u64,
    first_impossible: Option<String>,
}

impl Damage {
    /// Counts the impossible samples of the packet that begins at `offset`.
    fn note_impossible(&mut self, offset: u64, block: Option<&RawBlock>) {
        let Some(block) = block else { return };
        self.samples += block.len() as u64;
        if let Some((samples, first)) = &block.impossible {
            self.samples += samples;
            self.impossible += samples;
            self.first_impossible.get_or_insert_with(|| format!("in the packet at byte {offset}, {first}"));
        }
    }
}

impl<R: Read> PacketSamples<R> {
    /// The packets in `reader`.
    pub fn new(reader: R, parser: PacketParser) -> Self {
        Self {
            reader,
            parser,
            bytes: Vec::new(),
            next: 0,
            offset: 0,
            at_end: false,
            last_ns: None,
            step_ns: None,
            barren_until: Cell::new(0),
            begins_at: Cell::new(0),
            damage: Damage::default(),
            end: None,
        }
    }

    /// The next packet. None when there are no more.
    pub fn next_block(&mut self) -> Option<RawBlock> {
        loop {
            self.fill();
            let size = self.parser.packet_bytes();
            let rest = self.bytes.len() - self.next;
            if rest < size {
                return self.last_piece();
            }
            let packet = &self.bytes[self.next..self.next + size];
            if packet.iter().all(|byte| *byte == 0) {
                self.pass_zeros(size);
                continue;
            }
            match self.is_time(packet) {
                Err(stamp) => self.pass_bad(stamp),
                Ok(ns) if self.is_cut_inside(ns) => self.resync(self.next + 1),
                Ok(ns) if !self.fits(ns) => self.pass_bad(format!("{} s fits nothing around it", ns / 1_000_000_000)),
                Ok(ns) => {
                    let block = self.parser.parse(packet).ok();
                    self.damage.note_impossible(self.offset + self.next as u64, block.as_ref());
                    let step = self.last_ns.map(|last| self.parser.later_ns(ns, last)).filter(|step| *step > 0);
                    self.step_ns = step.or(self.step_ns);
                    self.last_ns = Some(ns);
                    self.barren_until.set(0);
                    self.next += size;
                    if block.is_some() {
                        return block;
                    }
                }
            }
        }
    }

    /// Returns the faults of the file, and the reader.
    pub fn finish(self) -> (Vec<Fault>, R) {
        let damage = self.damage;
        let bytes = damage.bad_packets * self.parser.packet_bytes() as u64;
        let bad_stamps = damage.first_bad.map(|(first_offset, first)| Fault::BadStamp {
            packets: damage.bad_packets,
            bytes,
            first_offset,
            first,
        });
        let zeros = damage.first_zero.map(|first_offset| Fault::Zeros { bytes: damage.zero_bytes, first_offset });
        let skipped = damage.first_skipped.map(|first_offset| Fault::LostAlignment {
            bytes: damage.skipped_bytes,
            places: damage.places,
            first_offset,
        });
        let (samples, of) = (damage.impossible, damage.samples);
        let impossible = damage.first_impossible.map(|first| Fault::ImpossibleAcceleration { samples, of, first });
        let faults = bad_stamps.into_iter().chain(zeros).chain(skipped).chain(impossible).chain(self.end);
        (faults.collect(), self.reader)
    }

    /// The stamp, if it is a time; what it is otherwise.
    fn is_time(&self, packet: &[u8]) -> Result<i64, String> {
        let ns = self.parser.stamp_ns(packet).map_err(|error| error.to_string())?;
        if self.parser.is_absolute() && !(EARLIEST_NS..LATEST_NS).contains(&ns) {
            return Err(format!("{} s since 1970 is not between the years 1970 and 2100", ns / 1_000_000_000));
        }
        Ok(ns)
    }

    /// The time that the stamp of a packet at that place would be.
    fn stamp_at(&self, at: usize) -> Option<i64> {
        let ns = self.bytes.get(at..).and_then(|rest| self.parser.known_stamp_ns(rest))?;
        (!self.parser.is_absolute() || (EARLIEST_NS..LATEST_NS).contains(&ns)).then_some(ns)
    }

    /// The place where the packet after the next one begins.
    fn following(&self) -> usize {
        self.next + self.parser.packet_bytes()
    }

    /// Whether a stamp follows the last one, or the next one follows it: one alone is damaged.
    fn fits(&self, ns: i64) -> bool {
        let follows = |last: i64, ns: i64| (0..=FOLLOWS_WITHIN_NS).contains(&self.parser.later_ns(ns, last));
        let before = self.last_ns.is_none_or(|last| follows(last, ns));
        before || self.stamp_at(self.following()).is_some_and(|next| follows(ns, next))
    }

    /// Whether what follows the next packet is no packet, but one begins inside it, or between the two: bytes were lost.
    fn is_cut_inside(&self, ns: i64) -> bool {
        let size = self.parser.packet_bytes();
        let following = self.bytes.get(self.following()..).unwrap_or_default();
        let follows = |next_ns| (0..=self.search_reach_ns()).contains(&self.parser.later_ns(next_ns, ns));
        let is_end = following.len() < self.parser.header_bytes().max(1);
        if is_end || following.iter().take(size).all(|byte| *byte == 0) {
            return false;
        }
        if self.stamp_at(self.following()).is_some_and(follows) {
            return false;
        }
        self.find_packet(self.next + 1, Some(ns)).is_some_and(|found| found % size != self.next % size)
    }

    /// How much later a stamp may be that is looked for.
    fn search_reach_ns(&self) -> i64 {
        self.step_ns.map_or(FOLLOWS_WITHIN_NS, |step| step.saturating_mul(SEARCH_STEPS).min(FOLLOWS_WITHIN_NS))
    }

    /// Whether a packet begins at that place in `bytes`: its stamp and the next one's follow on the last one believed.
    fn is_packet(&self, at: usize, last_ns: Option<i64>) -> bool {
        let following = at + self.parser.packet_bytes();
        let follows_last = |ns: &i64| {
            last_ns.is_none_or(|last| (0..=self.search_reach_ns()).contains(&self.parser.later_ns(*ns, last)))
        };
        let Some(ns) = self.stamp_at(at).filter(follows_last) else { return false };
        let steps_ns = self.step_ns.map_or(1..=FOLLOWS_WITHIN_NS, |step| {
            let part = step / STEP_PART;
            step - part..=step.saturating_add(part)
        });
        let next = self.stamp_at(following);
        next.is_some_and(|next| steps_ns.contains(&self.parser.later_ns(next, ns))) || following == self.bytes.len()
    }

    /// The place in `bytes` where a packet begins, at `from` or later.
    fn find_packet(&self, from: usize, last_ns: Option<i64>) -> Option<usize> {
        let size = self.parser.packet_bytes();
        let barren = self.barren();
        let end = (self.bytes.len() + 1).saturating_sub(if self.at_end { size } else { 2 * size });
        let found = (from.max(barren)..end).find(|at| self.is_packet(*at, last_ns));
        if found.is_none() {
            self.barren_until.set(self.barren_until.get().max(self.offset + end as u64));
        }
        found
    }

    /// Until where in `bytes` the search has been in vain.
    fn barren(&self) -> usize {
        usize::try_from(self.barren_until.get().saturating_sub(self.offset)).unwrap_or(usize::MAX)
    }

    /// Whether the file has had no packet yet, and whole packets further on lead to one. Without a stamp to go by, a search
    /// byte by byte would first find what begins some bytes before a packet: the head of a number that rises also rises.
    fn begins_with_bad_packets(&self) -> bool {
        let (following, size) = (self.following(), self.parser.packet_bytes());
        if self.last_ns.is_some() || self.begins_at.get() >= self.offset + following as u64 {
            return self.last_ns.is_none();
        }
        let barren = self.barren().saturating_sub(following).checked_next_multiple_of(size).unwrap_or(usize::MAX);
        let from = following.saturating_add(barren);
        let found = (from..self.bytes.len()).step_by(size).find(|at| self.is_packet(*at, None));
        self.begins_at.set(found.map_or(0, |at| self.offset + at as u64));
        found.is_some()
    }

    fn pass_bad(&mut self, stamp: String) {
        let size = self.parser.packet_bytes();
        if !self.begins_with_bad_packets()
            && let Some(found) =
                self.find_packet(self.next + 1, self.last_ns).filter(|found| found % size != self.next % size)
        {
            self.skip_to(found);
            return;
        }
        self.damage.bad_packets += 1;
        self.damage.first_bad.get_or_insert((self.offset + self.next as u64, stamp));
        self.next += size;
    }

    fn resync(&mut self, from: usize) {
        let found = self.find_packet(from, self.last_ns).unwrap_or(self.next + self.parser.packet_bytes());
        self.skip_to(found);
    }

    fn skip_to(&mut self, found: usize) {
        self.damage.places += 1;
        self.damage.skipped_bytes += (found - self.next) as u64;
        self.damage.first_skipped.get_or_insert(self.offset + self.next as u64);
        self.next = found;
    }

    fn pass_zeros(&mut self, size: usize) {
        self.damage.zero_bytes += size as u64;
        self.damage.first_zero.get_or_insert(self.offset + self.next as u64);
        self.next += size;
    }

    /// The rest at the end of the file, which is less than a packet.
    fn last_piece(&mut self) -> Option<RawBlock> {
        let piece = &self.bytes[self.next..];
        if piece.is_empty() || self.end.is_some() {
            return None;
        }
        let (offset, got) = (self.offset + self.next as u64, piece.len());
        if piece.iter().all(|byte| *byte == 0) {
            self.pass_zeros(got);
            return None;
        }
        let block = match piece.len() > self.parser.header_bytes() && self.is_time(piece).is_ok() {
            true => self.parser.parse(piece).ok().filter(|block| !block.is_empty()),
            false => None,
        };
        let expected = self.parser.packet_bytes();
        self.damage.note_impossible(offset, block.as_ref());
        let samples = block.as_ref().map_or(0, RawBlock::len);
        self.end = Some(Fault::TruncatedPacket { offset, expected, got, samples });
        self.next = self.bytes.len();
        block
    }

    /// Reads on until three packets are at hand: one, the one that follows, and what may lie between them.
    fn fill(&mut self) {
        let size = self.parser.packet_bytes();
        if self.at_end || self.bytes.len() - self.next >= 3 * size {
            return;
        }
        self.bytes.drain(..self.next);
        self.offset += self.next as u64;
        self.next = 0;
        let wanted = (3 * size).max(256 * 1024);
        let mut got = self.bytes.len();
        self.bytes.resize(wanted, 0);
        while got < wanted {
            match self.reader.read(&mut self.bytes[got..]) {
                Ok(0) => {
                    self.at_end = true;
                    break;
                }
                Ok(n) => got += n,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => {
                    self.at_end = true;
                    self.end = Some(Fault::Unreadable { offset: self.offset + got as u64, message: error.to_string() });
                    break;
                }
            }
        }
        self.bytes.truncate(got);
    }
}
