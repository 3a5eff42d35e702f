//! The kinds of damage that are done to files on cards.

use std::ops::Range;

/// A file of packets of one size, or any file where `packet` is 1.
pub struct Corruptible {
    pub bytes: Vec<u8>,
    packet: usize,
}

impl Corruptible {
    pub fn new(bytes: Vec<u8>, packet: usize) -> Self {
        Self { bytes, packet }
    }

    fn range(&self, packets: Range<usize>) -> Range<usize> {
        packets.start * self.packet..packets.end * self.packet
    }

    /// The card was pulled out while writing: so many bytes are missing at the end.
    pub fn truncate(&mut self, bytes: usize) -> &mut Self {
        self.bytes.truncate(self.bytes.len() - bytes);
        self
    }

    /// Bytes that do not belong there.
    pub fn append(&mut self, bytes: &[u8]) -> &mut Self {
        self.bytes.extend(bytes);
        self
    }

    /// A bit that does not hold.
    pub fn flip(&mut self, at: usize) -> &mut Self {
        self.bytes[at] ^= 0x80;
        self
    }

    /// Packets that were never written.
    pub fn drop(&mut self, packets: Range<usize>) -> &mut Self {
        let range = self.range(packets);
        self.bytes.drain(range);
        self
    }

    /// Bytes that were lost inside the file.
    pub fn drop_bytes(&mut self, range: Range<usize>) -> &mut Self {
        self.bytes.drain(range);
        self
    }

    /// Sectors that were never written.
    pub fn zero(&mut self, range: Range<usize>) -> &mut Self {
        self.bytes[range].fill(0);
        self
    }

    /// Packets that were written twice, the second time behind the first.
    pub fn duplicate(&mut self, packets: Range<usize>) -> &mut Self {
        let range = self.range(packets);
        let copy = self.bytes[range.clone()].to_vec();
        self.bytes.splice(range.end..range.end, copy);
        self
    }

    /// A packet that was written late: behind `after`.
    pub fn reorder(&mut self, packet: usize, after: usize) -> &mut Self {
        let range = self.range(packet..packet + 1);
        let late: Vec<u8> = self.bytes.drain(range).collect();
        let at = after * self.packet; // one packet fewer stands before it now
        self.bytes.splice(at..at, late);
        self
    }

    /// The clock is set by so many seconds before that packet. Stamps are f64 at the packets' beginnings.
    pub fn shift_clock(&mut self, from_packet: usize, seconds: f64) -> &mut Self {
        for packet in self.bytes.chunks_exact_mut(self.packet).skip(from_packet) {
            let stamp = f64::from_le_bytes(*packet.first_chunk().unwrap()) + seconds;
            packet[..8].copy_from_slice(&stamp.to_le_bytes());
        }
        self
    }
}
