//! A sensor file of either layout.

use std::io::Read;

use model::UtcNs;

use crate::parse::{Converter, CsvSamples, Fault, PacketError, PacketParser, PacketSamples};
use crate::profile::{AccelerationStream, PacketLayout, RangeStream, TimeColumn};
use crate::sample::Sample;

/// How the samples of a stream lie in its files.
#[derive(Debug, Clone)]
pub(crate) enum Layout {
    Packets(PacketParser),
    Csv { time: TimeColumn, values: Vec<String>, delimiter: u8, converter: Converter },
}

impl Layout {
    pub fn of_acceleration(stream: &AccelerationStream) -> Result<Self, PacketError> {
        let converter = Converter::from(stream);
        if let Some(csv) = &stream.csv {
            let values = vec![csv.x.clone(), csv.y.clone(), csv.z.clone()];
            return Self::csv(&csv.time, values, csv.delimiter, converter);
        }
        Self::packets(stream.packets.as_ref(), stream.rate_hz, converter)
    }

    pub fn of_range(stream: &RangeStream) -> Result<Self, PacketError> {
        let converter = Converter::from(stream);
        if let Some(csv) = &stream.csv {
            return Self::csv(&csv.time, vec![csv.range.clone()], csv.delimiter, converter);
        }
        Self::packets(stream.packets.as_ref(), stream.rate_hz, converter)
    }

    fn packets(layout: Option<&PacketLayout>, rate_hz: f64, converter: Converter) -> Result<Self, PacketError> {
        let layout = layout.ok_or(PacketError::Layout("packets or csv"))?;
        PacketParser::new(layout, rate_hz, converter).map(Self::Packets)
    }

    fn csv(time: &TimeColumn, values: Vec<String>, delimiter: char, converter: Converter) -> Result<Self, PacketError> {
        let delimiter = u8::try_from(delimiter).map_err(|_| PacketError::Layout("an ASCII delimiter"))?;
        Ok(Self::Csv { time: time.clone(), values, delimiter, converter })
    }
}

/// Streams the samples of one file.
pub(crate) enum Decoder<R> {
    Packets(Box<PacketSamples<R>>),
    Csv(Box<CsvSamples<R>>),
}

impl<R: Read> Decoder<R> {
    pub fn new(reader: R, layout: &Layout) -> Self {
        match layout {
            Layout::Packets(parser) => Self::Packets(Box::new(PacketSamples::new(reader, parser.clone()))),
            Layout::Csv { time, values, delimiter, converter } => {
                let csv = CsvSamples::new(reader, time.clone(), values.clone(), *delimiter, converter.clone());
                Self::Csv(Box::new(csv))
            }
        }
    }

    /// Appends the samples of the next packet or rows. False at the end of the file.
    pub fn next_batch(&mut self, out: &mut Vec<Sample>) -> bool {
        match self {
            Self::Packets(packets) => packets.next_batch(out),
            Self::Csv(csv) => csv.next_batch(out),
        }
    }

    /// The time of the first sample.
    pub fn first_time(mut self) -> Option<UtcNs> {
        let mut samples = Vec::new();
        while samples.is_empty() && self.next_batch(&mut samples) {}
        samples.first().map(Sample::time)
    }

    pub fn finish(self) -> (Vec<Fault>, R) {
        match self {
            Self::Packets(packets) => packets.finish(),
            Self::Csv(csv) => csv.finish(),
        }
    }
}
