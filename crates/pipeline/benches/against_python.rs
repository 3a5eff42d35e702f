//! Packets and CSV, parsed here and by numpy and pandas.

use std::io::Write;
use std::path::Path;

use ingest::parse::{Converter, CsvLayout, CsvSamples, PacketParser, PacketSamples, RawBlock};
use ingest::profile::{CsvFormat, Epoch, RowTime, Step, TimeUnit};
use ingest::timeline::{Clock, Line, Stepper};
use ingest::{Profile, profile};
use jiff::tz::TimeZone;

use crate::python::Python;
use crate::{card, turns};

const PACKET_SECONDS: i64 = 8 * 3600;
const CSV_SECONDS: i64 = 3600;
const RATE_HZ: i64 = 128;

/// Eight hours of acceleration packets to times and g.
pub fn packets() {
    let folder = tempfile::tempdir().unwrap();
    card::sensors(folder.path(), PACKET_SECONDS);
    let file = folder.path().join("SENSORS/ACC00000.BIN");
    let stream = Profile::load("aim2-packets", Path::new("none")).unwrap().acceleration.unwrap();
    let layout = stream.packets.clone().unwrap();
    let expected = PACKET_SECONDS / 8 * 1022;
    let mut ours = || {
        let parser = PacketParser::new(&layout, &[], Converter::from(&stream)).unwrap();
        let mut packets = PacketSamples::new(std::fs::File::open(&file).unwrap(), parser);
        assert_eq!(on_a_time_line(|| packets.next_block()), expected as u64);
    };
    let Some(mut python) = Python::start("peers.py", "numpy and pandas") else { return };
    for (name, how) in [("numpy, all packets at once", "packets_at_once"), ("numpy, packet by packet", "packets_each")]
    {
        let mut peer = || assert_eq!(python.ask(how, &file), expected);
        let title = format!("{expected} acceleration samples in packets, seconds (least, median, most)");
        turns::compare(&title, ("aim-batch: in order, gaps listed", &mut ours), (name, &mut peer));
    }
}

/// An hour of acceleration rows to times and g.
pub fn csv() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("accel.csv");
    write_csv(&file);
    let expected = CSV_SECONDS * RATE_HZ;
    let layout = CsvLayout {
        format: CsvFormat::default(),
        time: RowTime { column: Some("time_s".to_owned()), unit: Some(TimeUnit::S), ..RowTime::default() },
        values: ["x_g", "y_g", "z_g"].map(str::to_owned).to_vec(),
        extra: vec![],
        converter: Converter::Acceleration {
            g_per_count: 1.0,
            zero_g_counts: [0.0; 3],
            axes: [profile::Axis::PlusX, profile::Axis::PlusY, profile::Axis::PlusZ],
            full_scale_g: None,
        },
    };
    let mut ours = || {
        let mut csv = CsvSamples::new(std::fs::File::open(&file).unwrap(), layout.clone());
        assert_eq!(on_a_time_line(|| csv.next_block()), expected as u64);
    };
    let Some(mut python) = Python::start("peers.py", "numpy and pandas") else { return };
    for (name, how) in [("pandas.read_csv", "csv_pandas"), ("numpy.loadtxt", "csv_numpy")] {
        let mut peer = || assert_eq!(python.ask(how, &file), expected);
        let title = format!("{expected} acceleration samples in CSV, seconds (least, median, most)");
        turns::compare(&title, ("aim-batch: in order, gaps listed", &mut ours), (name, &mut peer));
    }
}

/// Samples that come out in order of time.
fn on_a_time_line(mut next: impl FnMut() -> Option<RawBlock>) -> u64 {
    let mut stepper = Stepper::new(Clock::new(Epoch::Unix, None, TimeZone::UTC), Step::Nominal, RATE_HZ as f64);
    let mut line = Line::new(RATE_HZ as f64, 0.5);
    let mut sum = 0.0;
    while let Some(raw) = next() {
        stepper.push(raw).unwrap().into_iter().for_each(|block| line.push(block));
        while let Some(block) = line.pop() {
            sum += block.channels[1][0];
        }
    }
    stepper.finish().into_iter().for_each(|block| line.push(block));
    line.end();
    assert!(sum < 0.0);
    line.finish().samples
}

fn write_csv(file: &Path) {
    let mut out = std::io::BufWriter::new(std::fs::File::create(file).unwrap());
    writeln!(out, "time_s,x_g,y_g,z_g").unwrap();
    for i in 0..CSV_SECONDS * RATE_HZ {
        let ns = i * 1_000_000_000 / RATE_HZ;
        let (seconds, micros) = (card::START_S + ns / 1_000_000_000, ns % 1_000_000_000 / 1000);
        let noise = (i * 7919 % 9) as f64 / 1000.0;
        writeln!(out, "{seconds}.{micros:06},{:.6},{:.6},{:.6}", noise, -0.829_038 + noise, -0.559_193).unwrap();
    }
}
