//! CSV: columns by name, exact times, missing and bad values.

use aim_batch_ingest::Sample;
use aim_batch_ingest::parse::{Converter, CsvSamples, Fault};
use aim_batch_ingest::profile::{TimeColumn, TimeUnit};
use model::UtcNs;

fn read(text: &[u8], unit: TimeUnit, delimiter: u8) -> (Vec<Sample>, Vec<Fault>) {
    let time = TimeColumn { column: "t".to_owned(), unit };
    let converter = Converter::Range { mm_per_count: 10.0 };
    let mut csv = CsvSamples::new(text, time, vec!["range".to_owned()], delimiter, converter);
    let mut samples = Vec::new();
    while csv.next_batch(&mut samples) {}
    (samples, csv.finish().0)
}

fn range(ns: i64, mm: f64) -> Sample {
    Sample::Range { time: UtcNs(ns), mm }
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
    assert_eq!(faults, [Fault::BadRows { rows: 3, first_line: 5, first }]);
}

#[test]
fn a_row_without_end_does_not_fill_the_memory() {
    let endless = [b"t,range\n1,2\n".to_vec(), vec![0; 1 << 20]].concat();
    let (samples, faults) = read(&endless, TimeUnit::S, b',');
    assert_eq!(samples, [range(1_000_000_000, 20.0)]);
    assert_eq!(faults, [Fault::LongLine { line: 3, limit: 65_536 }]);
    let quoted = [b"t,range\n1,2\n\"".to_vec(), b"3,4\n".repeat(1 << 18)].concat();
    let (samples, faults) = read(&quoted, TimeUnit::S, b',');
    assert_eq!(samples, [range(1_000_000_000, 20.0)]);
    assert!(matches!(faults[..], [Fault::LongLine { .. }]));
}
