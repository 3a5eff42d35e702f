//! CSV: columns by name, exact times, missing and bad values.

use aim_batch_ingest::parse::{Converter, CsvLayout, CsvSamples, Fault, NoTargetReadings};
use aim_batch_ingest::profile::{Axis, CsvFormat, NoTarget, RowTime, TimeUnit};

use crate::support::{timed, times_and_values};

type Samples = Vec<(i64, Vec<f32>)>;

fn layout(time: RowTime, delimiter: char) -> CsvLayout {
    CsvLayout {
        format: CsvFormat { delimiter, ..CsvFormat::default() },
        time,
        values: vec!["range".to_owned()],
        extra: vec![],
        converter: Converter::Range { mm_per_count: 10.0, no_target: NoTargetReadings::default() },
    }
}

fn column(unit: TimeUnit) -> RowTime {
    RowTime { column: Some("t".to_owned()), unit: Some(unit), ..RowTime::default() }
}

fn read_with(text: &[u8], layout: CsvLayout) -> (Samples, Vec<Fault>) {
    let mut csv = CsvSamples::new(text, layout);
    let blocks: Vec<_> = std::iter::from_fn(|| csv.next_block()).collect();
    (times_and_values(&timed(blocks, 10.0)), csv.finish().0)
}

fn read(text: &[u8], unit: TimeUnit, delimiter: u8) -> (Samples, Vec<Fault>) {
    read_with(text, layout(column(unit), char::from(delimiter)))
}

fn range(ns: i64, mm: f32) -> (i64, Vec<f32>) {
    (ns, vec![mm])
}

#[test]
fn columns_are_found_by_name_and_times_are_exact() {
    let text = b"\xef\xbb\xbft; other; range\r\n1760676790.103992576; x; 51.5\r\n1760676790.2;; 8190\r\n";
    let (samples, faults) = read(text, TimeUnit::S, b';');
    assert_eq!(samples, [range(1_760_676_790_103_992_576, 515.0), range(1_760_676_790_200_000_000, 81_900.0)]);
    assert!(faults.is_empty());
}

#[test]
fn every_unit_of_time() {
    for (unit, text) in
        [(TimeUnit::S, "7.5"), (TimeUnit::Ms, "7500"), (TimeUnit::Us, "7500000"), (TimeUnit::Ns, "7500000000")]
    {
        let (samples, _) = read(format!("range,t\n2,{text}").as_bytes(), unit, b',');
        assert_eq!(samples, [range(7_500_000_000, 20.0)], "{unit:?}");
    }
}

#[test]
fn a_missing_column_is_named_with_what_there_is() {
    let (samples, faults) = read(b"time,range\n1,2\n", TimeUnit::S, b',');
    assert!(samples.is_empty());
    assert_eq!(faults, [Fault::MissingColumn { column: "t".to_owned(), found: "time, range".to_owned() }]);
}

#[test]
fn empty_values_are_missing_and_bad_ones_are_reported_with_their_line() {
    let text = b"t,range\n1,2\n2,\n3,NaN\n4,many\nx,5\n6\n7,8\n";
    let (samples, faults) = read(text, TimeUnit::S, b',');
    assert_eq!(samples, [range(1_000_000_000, 20.0), range(7_000_000_000, 80.0)]);
    let first = "column 'range': 'many' is not a number".to_owned();
    assert_eq!(faults, [Fault::BadRows { rows: 3, bytes: 10, first_line: 5, first }]);
}

/// Decimal commas in a file that has commas between its fields: 51,5 is not 51.
#[test]
fn a_row_with_more_fields_than_the_header_is_lost_and_told() {
    let (samples, faults) = read(b"t,range\n1,2\n2,51,5\n3,4\n", TimeUnit::S, b',');
    assert_eq!(samples, [range(1_000_000_000, 20.0), range(3_000_000_000, 40.0)]);
    let first = "the row has 3 fields, the header 2".to_owned();
    assert_eq!(faults, [Fault::BadRows { rows: 1, bytes: 6, first_line: 3, first }]);
}

/// A text with a delimiter in it, before the value: what stands at the value's place belongs to another column.
#[test]
fn a_text_with_a_delimiter_does_not_move_values() {
    let (samples, faults) = read(b"t;place;range;mode\n1;home;20;1\n2;home;9;21;1\n", TimeUnit::S, b';');
    assert_eq!(samples, [range(1_000_000_000, 200.0)]);
    assert!(matches!(faults[..], [Fault::BadRows { rows: 1, first_line: 3, .. }]), "{faults:?}");
}

#[test]
fn delimiters_at_the_end_of_rows_are_no_fields_too_many() {
    let (samples, faults) = read(b"t,range\n1,2,\n2,3, ,\r\n3\n", TimeUnit::S, b',');
    assert_eq!(samples, [range(1_000_000_000, 20.0), range(2_000_000_000, 30.0)]);
    let first = "the row ends before column 'range'".to_owned();
    assert_eq!(faults, [Fault::BadRows { rows: 1, bytes: 1, first_line: 4, first }]);
}

#[test]
fn a_column_that_is_there_twice_is_read_only_where_the_profile_does_not_name_it() {
    let (samples, faults) = read(b"t,range,note,range\n1,2,,3\n", TimeUnit::S, b',');
    assert!(samples.is_empty());
    assert_eq!(faults, [Fault::RepeatedColumn { column: "range".to_owned(), first: 2, second: 4 }]);
    assert_eq!(faults[0].code().code(), "repeated_column");
    let (samples, faults) = read(b"t,note,range,note\n1,,2,\n", TimeUnit::S, b',');
    assert_eq!(samples, [range(1_000_000_000, 20.0)]);
    assert_eq!(faults, []);
}

#[test]
fn a_row_without_end_does_not_fill_the_memory() {
    let endless = [b"t,range\n1,2\n".to_vec(), vec![0; 1 << 20]].concat();
    let (samples, faults) = read(&endless, TimeUnit::S, b',');
    assert_eq!(samples, [range(1_000_000_000, 20.0)]);
    assert_eq!(faults, [Fault::LongLine { line: 3, limit: 65_536 }]);
}

#[test]
fn a_quote_without_its_pair_costs_one_row() {
    let (samples, faults) = read(b"\"t\",\"range\"\n1,2\n\"2,3\n\"3\",\"4\"\n", TimeUnit::S, b',');
    assert_eq!(samples, [range(1_000_000_000, 20.0), range(3_000_000_000, 40.0)]);
    assert!(matches!(faults[..], [Fault::BadRows { rows: 1, first_line: 3, .. }]), "{faults:?}");
}

#[test]
fn lines_before_the_names_and_no_names_at_all() {
    let mut with_lines = layout(column(TimeUnit::S), ',');
    with_lines.format.skip_lines = 2;
    let (samples, _) = read_with(b"Fs,50.00\nLogging time,3600\nt,range\n1,2\n", with_lines);
    assert_eq!(samples, [range(1_000_000_000, 20.0)]);
    let mut nameless = layout(RowTime { column: Some("#2".to_owned()), ..column(TimeUnit::Ms) }, ',');
    nameless.format.header = false;
    nameless.values = vec!["#1".to_owned()];
    nameless.extra = vec!["#3".to_owned()];
    let mut csv = CsvSamples::new(&b"2,1500,7\n3,1600,\n"[..], nameless);
    let block = csv.next_block().unwrap();
    assert_eq!(block.extra[0][0].to_bits(), 7_f32.to_bits());
    assert!(block.extra[0][1].is_nan());
    assert_eq!(times_and_values(&timed([block], 10.0)), [range(1_500_000_000, 20.0), range(1_600_000_000, 30.0)]);
}

#[test]
fn times_as_text() {
    let text =
        |format: &str| RowTime { column: Some("t".to_owned()), format: Some(format.to_owned()), ..RowTime::default() };
    let (samples, faults) = read_with(
        b"t,range\n2025-06-01 12:00:00.250,1\n2025-06-31 12:00:00.5,1\n",
        layout(text("%Y-%m-%d %H:%M:%S%.f"), ','),
    );
    assert_eq!(samples, [range(1_748_779_200_250_000_000, 10.0)]);
    assert!(matches!(faults[..], [Fault::BadRows { rows: 1, .. }]), "{faults:?}");
    let (samples, _) = read_with(b"t,range\n2025-06-01T14:00:00+0200,1\n", layout(text("%Y-%m-%dT%H:%M:%S%z"), ','));
    assert_eq!(samples, [range(1_748_779_200_000_000_000, 10.0)]);
}

/// Adafruit's library in Python writes `None`, its 819.0 cm are the sensor's 8190, Pololu's 65535 and -1 are failures.
#[test]
fn what_a_driver_writes_for_no_target_is_one_code_and_no_loss() {
    let text = b"t,range\n1,51.5\n2,None\n3,819.0\n4,819.1\n5,65535\n6,-1\n7,inf\n8,\n9,52\n";
    let (samples, faults) = read(text, TimeUnit::S, b',');
    assert_eq!(faults, []);
    let mm: Vec<f32> = samples.iter().map(|(_, values)| values[0]).collect();
    assert_eq!(mm, [515.0, 8190.0, 8190.0, 8191.0, 8190.0, 8190.0, 8190.0, 520.0]);
}

#[test]
fn a_profile_says_what_no_target_is() {
    let declared = vec![NoTarget::Number(0.0), NoTarget::Word("out of range".to_owned())];
    let converter = Converter::Range { mm_per_count: 10.0, no_target: NoTargetReadings::new(Some(declared)) };
    let text = b"t,range\n1,0\n2,Out of Range\n3,None\n4,7\n";
    let (samples, faults) = read_with(text, CsvLayout { converter, ..layout(column(TimeUnit::S), ',') });
    assert_eq!(samples, [range(1_000_000_000, 8190.0), range(2_000_000_000, 8190.0), range(4_000_000_000, 70.0)]);
    assert!(matches!(faults[..], [Fault::BadRows { rows: 1, first_line: 4, .. }]), "{faults:?}");
}

#[test]
fn accelerations_that_no_sensor_has_are_left_out_and_told_with_their_line() {
    let axes = [Axis::PlusX, Axis::PlusY, Axis::PlusZ];
    let converter =
        Converter::Acceleration { g_per_count: 1.0, zero_g_counts: [0.0; 3], axes, full_scale_g: Some(2.0) };
    let values = ["x", "y", "z"].map(str::to_owned).to_vec();
    let text = b"t,x,y,z\n1,0,-1,0\n2,0,-9999,0\n3,0,0,4\n4,1e30,0,0\n5,0,0,-2.1\n";
    let (samples, faults) = read_with(text, CsvLayout { converter, values, ..layout(column(TimeUnit::S), ',') });
    assert_eq!(samples, [(1_000_000_000, vec![0.0, -1.0, 0.0]), (5_000_000_000, vec![0.0, 0.0, -2.1])]);
    let first = "in line 3: [0.0, -9999.0, 0.0]".to_owned();
    assert_eq!(faults, [Fault::ImpossibleAcceleration { samples: 3, of: 5, first }]);
}

/// Samples one second apart.
const TWO_ROWS: &[u8] = b"t,range\n1,2\n2,3\n";

#[test]
fn lines_that_end_in_a_carriage_return_alone_are_read() {
    let expected = [range(1_000_000_000, 20.0), range(2_000_000_000, 30.0)];
    for text in
        ["t,range\r1,2\r2,3\r", "t,range\r1,2\r2,3", "\u{feff}t,range\r\r1,2\r2,3\r", "t,range\r\r\n1,2\r\r\n2,3\r\r\n"]
    {
        let (samples, faults) = read(text.as_bytes(), TimeUnit::S, b',');
        assert_eq!((&samples[..], &faults[..]), (&expected[..], &[][..]), "{text:?}");
    }
    let long: String = std::iter::once("t,range".to_owned())
        .chain((0..50_000).map(|i| format!("{i},7")))
        .collect::<Vec<_>>()
        .join("\r");
    assert_eq!(read(long.as_bytes(), TimeUnit::S, b',').0.len(), 50_000);
}

#[test]
fn text_of_two_bytes_per_character_is_told_as_such() {
    let text = String::from_utf8_lossy(TWO_ROWS);
    let little = |mark: bool| {
        let marks = if mark { vec![0xfeff_u16] } else { vec![] };
        marks.into_iter().chain(text.encode_utf16()).collect::<Vec<u16>>()
    };
    for bytes in [
        little(true).into_iter().flat_map(u16::to_le_bytes).collect::<Vec<u8>>(),
        little(true).into_iter().flat_map(u16::to_be_bytes).collect(),
        little(false).into_iter().flat_map(u16::to_le_bytes).collect(),
        little(false).into_iter().flat_map(u16::to_be_bytes).collect(),
    ] {
        assert_eq!(read(&bytes, TimeUnit::S, b','), (vec![], vec![Fault::Utf16]));
    }
}

#[test]
fn a_column_s_seconds_since_1970_keep_their_fraction_and_zones_by_name_count() {
    let text =
        |format: &str| RowTime { column: Some("t".to_owned()), format: Some(format.to_owned()), ..RowTime::default() };
    let (samples, faults) = read_with(b"t,range\n1748779200.250,1\n", layout(text("%s%.f"), ','));
    assert_eq!((samples, faults), (vec![range(1_748_779_200_250_000_000, 10.0)], vec![]));
    let zone = b"t,range\n2025-06-01 14:00:00.5 Europe/Berlin,1\n";
    let (samples, faults) = read_with(zone, layout(text("%Y-%m-%d %H:%M:%S%.f %Q"), ','));
    assert_eq!((samples, faults), (vec![range(1_748_779_200_500_000_000, 10.0)], vec![]));
}
