//! A file of packets.

use std::io::{ErrorKind, Read};

use super::{Fault, PacketError, PacketParser};
use crate::sample::Sample;

/// Streams the samples of a file of packets, one packet at a time.
pub struct PacketSamples<R> {
    reader: R,
    parser: PacketParser,
    packet: Vec<u8>,
    /// Packets begun so far.
    packets: u64,
    bad_stamps: u64,
    first_bad_stamp: Option<(u64, String)>,
    end: Option<Fault>,
}

impl<R: Read> PacketSamples<R> {
    /// The packets in `reader`.
    pub fn new(reader: R, parser: PacketParser) -> Self {
        let packet = vec![0; parser.packet_bytes()];
        Self { reader, parser, packet, packets: 0, bad_stamps: 0, first_bad_stamp: None, end: None }
    }

    /// Appends the samples of the next packet. False when there are no more packets.
    pub fn next_batch(&mut self, out: &mut Vec<Sample>) -> bool {
        let expected = self.packet.len();
        let offset = self.packets * expected as u64;
        let got = match self.fill() {
            Ok(got) => got,
            Err(error) => {
                self.end = Some(Fault::Unreadable { offset, message: error.to_string() });
                return false;
            }
        };
        if got == 0 {
            return false;
        }
        self.packets += 1;
        if got < expected {
            self.end = Some(Fault::TruncatedPacket { packet: self.packets, offset, expected, got });
            return false;
        }
        if let Err(PacketError::Stamp(stamp)) = self.parser.parse(&self.packet, out) {
            self.bad_stamps += 1;
            self.first_bad_stamp.get_or_insert((offset, stamp));
        }
        true
    }

    /// What was wrong with the file, and the reader.
    pub fn finish(self) -> (Vec<Fault>, R) {
        let bad_stamps = self.first_bad_stamp.map(|(first_offset, first)| Fault::BadStamp {
            packets: self.bad_stamps,
            first_offset,
            first,
        });
        (bad_stamps.into_iter().chain(self.end).collect(), self.reader)
    }

    /// Fills the packet; fewer bytes at the end of the file.
    fn fill(&mut self) -> std::io::Result<usize> {
        let mut got = 0;
        while got < self.packet.len() {
            match self.reader.read(&mut self.packet[got..]) {
                Ok(0) => break,
                Ok(n) => got += n,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        Ok(got)
    }
}
