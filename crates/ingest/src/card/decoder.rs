//! A sensor file of any layout.

use std::io::Read;

use jiff::tz::TimeZone;

use crate::parse::{
    Converter, CsvLayout, CsvSamples, CwaLayout, CwaSamples, Fault, PacketError, PacketParser, PacketSamples, RawBlock,
    names_zone,
};
use crate::profile::{AccelerationStream, CsvFormat, Epoch, PacketLayout, RangeStream, RowTime, Step};
use crate::timeline::Clock;

/// Longer steps between samples are gaps: half a second, or three samples of a slow sensor.
const SHORTEST_GAP_S: f64 = 0.5;
const GAP_SAMPLES: f64 = 3.0;

/// How the samples of a stream lie in its files, and what its clock means.
#[derive(Debug, Clone)]
pub(crate) struct Layout {
    files: FileLayout,
    epoch: Epoch,
    wrap_ns: Option<i128>,
    pub step: Step,
    pub rate_hz: f64,
    pub gap_s: f64,
    /// Names of the channels that are carried along.
    pub extra: Vec<String>,
}

#[derive(Debug, Clone)]
enum FileLayout {
    Packets(PacketParser),
    Csv(CsvLayout),
    Cwa(CwaLayout),
}

/// The settings that all streams of a profile share.
struct StreamSettings<'p> {
    rate_hz: f64,
    gap_s: Option<f64>,
    extra: &'p [String],
    converter: Converter,
}

impl Layout {
    pub fn of_acceleration(stream: &AccelerationStream) -> Result<Self, PacketError> {
        let common = StreamSettings {
            rate_hz: stream.rate_hz,
            gap_s: stream.gap_s,
            extra: &stream.extra,
            converter: Converter::from(stream),
        };
        if let Some(csv) = &stream.csv {
            let values = vec![csv.x.clone(), csv.y.clone(), csv.z.clone()];
            return Ok(Self::csv(csv.format(), &csv.time, values, common));
        }
        if let Some(cwa) = &stream.cwa {
            let layout = CwaLayout { converter: common.converter.clone(), extra: common.extra.to_vec() };
            return Ok(Self::new(FileLayout::Cwa(layout), cwa.epoch, None, Step::Stamps, &common));
        }
        Self::packets(stream.packets.as_ref(), common)
    }

    pub fn of_range(stream: &RangeStream) -> Result<Self, PacketError> {
        let common = StreamSettings {
            rate_hz: stream.rate_hz,
            gap_s: stream.gap_s,
            extra: &stream.extra,
            converter: Converter::from(stream),
        };
        if let Some(csv) = &stream.csv {
            return Ok(Self::csv(csv.format(), &csv.time, vec![csv.range.clone()], common));
        }
        Self::packets(stream.packets.as_ref(), common)
    }

    fn packets(layout: Option<&PacketLayout>, common: StreamSettings<'_>) -> Result<Self, PacketError> {
        let layout = layout.ok_or_else(|| PacketError::Layout("packets, csv or cwa".to_owned()))?;
        let parser = PacketParser::new(layout, common.extra, common.converter.clone())?;
        let wrap_ns = layout.stamp.wrap_ns();
        Ok(Self::new(FileLayout::Packets(parser), layout.stamp.epoch, wrap_ns, layout.step, &common))
    }

    fn csv(format: CsvFormat, time: &RowTime, values: Vec<String>, common: StreamSettings<'_>) -> Self {
        let epoch = match &time.format {
            Some(format) if !names_zone(format) => Epoch::Local,
            Some(_) => Epoch::Unix,
            None => time.epoch,
        };
        let wrap_ns = time.unit.unwrap_or_default().wrap_ns(time.wrap_bits);
        let layout = CsvLayout {
            format,
            time: time.clone(),
            values,
            extra: common.extra.to_vec(),
            converter: common.converter.clone(),
        };
        let common = StreamSettings { rate_hz: time.rows_per_s.unwrap_or(common.rate_hz), ..common };
        Self::new(FileLayout::Csv(layout), epoch, wrap_ns, Step::Nominal, &common)
    }

    fn new(files: FileLayout, epoch: Epoch, wrap_ns: Option<i128>, step: Step, common: &StreamSettings<'_>) -> Self {
        let gap_s = common.gap_s.unwrap_or(SHORTEST_GAP_S.max(GAP_SAMPLES / common.rate_hz));
        Self { files, epoch, wrap_ns, step, rate_hz: common.rate_hz, gap_s, extra: common.extra.to_vec() }
    }

    /// A clock for this stream.
    pub fn clock(&self, zone: &TimeZone) -> Clock {
        Clock::new(self.epoch, self.wrap_ns, zone.clone())
    }

    /// Whether stamps say nothing of the order of files: the counter may start anew between them.
    pub fn is_wrapping(&self) -> bool {
        self.wrap_ns.is_some()
    }

    /// Whether there are no stamps: times come from a declared rate or duration.
    pub fn is_counted(&self) -> bool {
        matches!(&self.files, FileLayout::Csv(csv) if csv.time.column.is_none())
    }

    /// Whether each row has a stamp.
    pub fn has_row_stamps(&self) -> bool {
        matches!(&self.files, FileLayout::Csv(csv) if csv.time.column.is_some())
    }

    /// Whether rows are spread evenly over a declared time, so that they must be counted first: over how many seconds.
    pub fn rows_over_s(&self) -> Option<f64> {
        match &self.files {
            FileLayout::Csv(csv) => csv.time.rows_over_s,
            FileLayout::Packets(_) | FileLayout::Cwa(_) => None,
        }
    }
}

/// Streams the packets, or batches of rows, of one file.
pub(crate) enum Decoder<R: Read> {
    Packets(Box<PacketSamples<R>>),
    Csv(Box<CsvSamples<R>>),
    Cwa(Box<CwaSamples<R>>),
}

impl<R: Read> Decoder<R> {
    pub fn new(reader: R, layout: &Layout) -> Self {
        match &layout.files {
            FileLayout::Packets(parser) => Self::Packets(Box::new(PacketSamples::new(reader, parser.clone()))),
            FileLayout::Csv(csv) => Self::Csv(Box::new(CsvSamples::new(reader, csv.clone()))),
            FileLayout::Cwa(cwa) => Self::Cwa(Box::new(CwaSamples::new(reader, cwa.clone()))),
        }
    }

    /// The next packet or batch. None at the end of the file.
    pub fn next_block(&mut self) -> Option<RawBlock> {
        match self {
            Self::Packets(packets) => packets.next_block(),
            Self::Csv(csv) => csv.next_block(),
            Self::Cwa(cwa) => cwa.next_block(),
        }
    }

    pub fn finish(self) -> (Vec<Fault>, R) {
        match self {
            Self::Packets(packets) => packets.finish(),
            Self::Csv(csv) => csv.finish(),
            Self::Cwa(cwa) => cwa.finish(),
        }
    }
}
