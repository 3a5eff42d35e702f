//! CSV files of samples.
//!
//! Input: 8 bytes of settings (in the order in which they are taken below), then the file.

use ingest::parse::{Converter, CsvLayout, CsvSamples, Fault, NoTargetReadings};
use ingest::profile::{Axis, CsvFormat, Epoch, RowTime, Step, TimeUnit};
use model::UtcNs;

use crate::clocked::{Clocked, Setting, zone};
use crate::cursor::{Cursor, Pieces};

/// Patterns of times, and what they count from.
const FORMATS: [(&str, Epoch); 3] = [
    ("%Y-%m-%d %H:%M:%S%.f", Epoch::Local),
    ("%Y-%m-%dT%H:%M:%S%.fZ", Epoch::Unix),
    ("%d.%m.%Y %I:%M:%S %p %z", Epoch::Unix),
];

/// CSV: rows are samples, missing or told as bad.
pub fn csv(input: &[u8]) -> usize {
    let mut cursor = Cursor::new(input);
    let (flags, time_code) = (cursor.u8(), cursor.u8());
    let delimiter = cursor.pick(&[',', ';', '\t', ' ', '"']);
    let skip_lines = match cursor.u8() {
        u8::MAX => u32::MAX,
        lines => u32::from(lines % 8),
    };
    let (fineness, zone_code, rate_code, epoch_code) = (cursor.u8(), cursor.u8(), cursor.u8(), cursor.u8());
    let file = cursor.rest();
    let flag = |bit: u8| flags & (1 << bit) != 0;
    let epoch = [Epoch::Unix, Epoch::Boot, Epoch::Local, Epoch::LocalAtStart][usize::from(epoch_code) % 4];
    let (time, epoch) = row_time(time_code, flag(0), epoch);
    let layout = layout(
        flag(0),
        flag(1),
        time,
        CsvFormat { delimiter, skip_lines, header: flag(0), decimal_comma: delimiter == ';', ..CsvFormat::default() },
    );
    let rate_hz = 1.0 + f64::from(rate_code);
    let mut clocked = Clocked::new(Setting {
        epoch,
        wrap_ns: flag(2).then_some(1 << 40),
        zone: zone(zone_code),
        anchor: Some(UtcNs(1_748_779_200_000_000_000)),
        step: Step::Nominal,
        rate_hz,
        gap_s: 0.5,
    });
    let mut csv = CsvSamples::new(Pieces::new(file, fineness), layout);
    let mut rows = 0;
    while let Some(mut block) = csv.next_block() {
        rows += block.len() as u64 + block.missing;
        block.declared_rate_hz = flag(3).then_some(rate_hz / 3.0);
        clocked.push(block);
    }
    let faults = csv.finish().0;
    assert!(
        !faults.iter().any(|fault| matches!(fault, Fault::Unreadable { .. })),
        "a file at hand is read: {faults:?}"
    );
    for fault in &faults {
        if let Fault::BadRows { rows: bad, bytes, first_line, .. } = fault {
            rows += bad;
            assert!(*bytes <= file.len() as u64 && *first_line > u64::from(skip_lines), "{fault:?}");
        }
        assert!(!fault.to_string().contains('\n'), "a message is one line: {fault}");
    }
    assert!(rows <= file.len() as u64, "{rows} rows in {} bytes", file.len());
    clocked.finish()
}

fn row_time(code: u8, header: bool, epoch: Epoch) -> (RowTime, Epoch) {
    let column = Some(if header { "t" } else { "#1" }.to_owned());
    let unit = |unit| RowTime { column: column.clone(), unit: Some(unit), epoch, ..RowTime::default() };
    match code % 8 {
        0 => (unit(TimeUnit::S), epoch),
        1 => (unit(TimeUnit::Ms), epoch),
        2 => (unit(TimeUnit::Us), epoch),
        3 => (unit(TimeUnit::Ns), epoch),
        4 => (RowTime { rows_per_s: Some(50.0), ..RowTime::default() }, Epoch::Boot),
        text => {
            let (format, epoch) = FORMATS[usize::from(text - 5)];
            (RowTime { column, format: Some(format.to_owned()), ..RowTime::default() }, epoch)
        }
    }
}

fn layout(header: bool, is_range: bool, time: RowTime, format: CsvFormat) -> CsvLayout {
    let named = |names: &[&str], numbers: &[&str]| -> Vec<String> {
        if header { names } else { numbers }.iter().map(|name| (*name).to_owned()).collect()
    };
    let (values, converter) = if is_range {
        (named(&["range"], &["#2"]), Converter::Range { mm_per_count: 1.0, no_target: NoTargetReadings::default() })
    } else {
        let axes = [Axis::PlusX, Axis::MinusZ, Axis::PlusY];
        let converter =
            Converter::Acceleration { g_per_count: 0.001, zero_g_counts: [1.0, 2.0, 3.0], axes, full_scale_g: None };
        (named(&["x", "y", "z"], &["#2", "#3", "#4"]), converter)
    };
    CsvLayout { format, time, values, extra: named(&["optical"], &["#5"]), converter }
}
