//! Small results made by hand, and the plates of the paper's Table II.

use model::results::ResultRow;
use model::{
    Kind, Level, Method, Note, PrintedRow, PrintedSummary, PrintedTable, Quantity, RunMetadata, Selection, Shape,
    TableLayout, TableSpec, UtcNs,
};
use report::Results;

pub fn row(object: &str, kind: Kind, quantity: Quantity, predicted_mm: Option<f64>, truth_mm: f64) -> ResultRow {
    ResultRow {
        study: "by hand".to_owned(),
        session: "s1".to_owned(),
        rater: "anna".to_owned(),
        image: Some("a.jpg".to_owned()),
        time_utc: Some(UtcNs(1_700_000_000_000_001_000)),
        roll_deg: Some(0.0),
        predicted_mm,
        plane_z_mm: Some(0.0),
        truth_mm: Some(truth_mm),
        error_pct: predicted_mm.map(|predicted| 100.0 * (predicted - truth_mm) / truth_mm),
        method_used: predicted_mm.map(|_| Method::Paper),
        ..ResultRow::without_numbers(object, kind, quantity, Method::Paper)
    }
}

/// A plate at a bench setup of 20 cm and 42 degrees, or 35 cm and 55 degrees.
pub fn plate(object: &str, low: bool, predicted_mm: Option<f64>, truth_mm: f64) -> ResultRow {
    let (height, pitch, range) = if low { (200.0, 42.0, 460.0) } else { (350.0, 55.0, 580.0) };
    ResultRow {
        setup_height_mm: Some(height),
        setup_pitch_deg: Some(pitch),
        pitch_deg: Some(pitch + 0.4),
        range_mm: Some(range),
        ..row(object, Kind::Plate, Quantity::Diameter, predicted_mm, truth_mm)
    }
}

/// A fused height by one rater.
pub fn fused(object: &str, rater: &str, predicted_mm: Option<f64>, truth_mm: f64) -> ResultRow {
    ResultRow {
        level: Level::Fused,
        rater: rater.to_owned(),
        image: None,
        time_utc: None,
        ..row(object, Kind::Bowl, Quantity::Height, predicted_mm, truth_mm)
    }
}

pub fn spec(id: &str, layout: TableLayout, quantities: &[Quantity]) -> TableSpec {
    TableSpec {
        id: id.to_owned(),
        title: "Error in dimensions".to_owned(),
        layout,
        quantities: quantities.to_vec(),
        method: Method::Paper,
        selection: Selection::All,
        objects: Vec::new(),
        kinds: Vec::new(),
        printed: None,
        notes: Vec::new(),
    }
}

pub fn note(object: Option<&str>, setup: Option<(f64, f64)>, text: &str) -> Note {
    Note {
        object: object.map(str::to_owned),
        setup_height_mm: setup.map(|setup| setup.0),
        setup_pitch_deg: setup.map(|setup| setup.1),
        text: text.to_owned(),
    }
}

pub fn results(rows: Vec<ResultRow>, tables: Vec<TableSpec>) -> Results {
    let metadata = RunMetadata {
        program: "aim-batch 0.1.0".to_owned(),
        commit: None,
        study: "by hand".to_owned(),
        statement: Some("Made by hand; proves arithmetic only.".to_owned()),
        settings: serde_json::json!({ "target_pitch_deg": 55.0 }),
        tables,
        sessions: Vec::new(),
        inputs_sha256: std::collections::BTreeMap::from([("objects.csv".to_owned(), "00ff".to_owned())]),
    };
    Results { rows, metadata, flow: None }
}

/// Two plates at two setups, with one size missing: errors of -5, 5 and 5 %.
pub fn plates() -> Results {
    let printed = PrintedTable {
        source: "Somebody et al., Table 1".to_owned(),
        rows: vec![PrintedRow {
            object: "plate a".to_owned(),
            setup_height_mm: Some(200.0),
            setup_pitch_deg: Some(42.0),
            predicted_mm: Some(171.0),
            error_pct: Some(5.0),
            ..PrintedRow::default()
        }],
        summaries: vec![
            PrintedSummary { object: Some("plate a".to_owned()), mean_pct: 0.1, sd_pct: 7.0 },
            PrintedSummary { object: None, mean_pct: 1.7, sd_pct: 4.1 },
        ],
    };
    let spec = TableSpec {
        kinds: vec![Kind::Plate],
        printed: Some(printed),
        notes: vec![
            note(Some("plate a"), Some((200.0, 42.0)), "printed without its minus sign"),
            note(Some("plate a"), None, "the rows give 0.00"),
            note(None, None, "the rows give an SD of 5.77"),
        ],
        ..spec("I", TableLayout::Setups, &[Quantity::Diameter])
    };
    let lost = ResultRow { flags: "above_horizon".to_owned(), ..plate("plate b", false, None, 200.0) };
    let rows = vec![
        plate("plate b", true, Some(210.0), 200.0),
        lost,
        plate("plate a", false, Some(189.0), 180.0),
        plate("plate a", true, Some(171.0), 180.0),
    ];
    results(rows, vec![spec])
}

/// A box that two raters measured, and a bowl that one of them measured: errors of 0 and 10 %. The bowl's printed truth is 55 mm.
pub fn raters() -> Results {
    let printed_row = |object: &str, truth_mm, error_pct| PrintedRow {
        object: object.to_owned(),
        truth_mm: Some(truth_mm),
        error_pct: Some(error_pct),
        ..PrintedRow::default()
    };
    let printed = PrintedTable {
        source: "Somebody et al., Table 2".to_owned(),
        rows: vec![printed_row("box", 100.0, 0.0), printed_row("bowl", 55.0, -10.0)],
        summaries: vec![PrintedSummary { object: None, mean_pct: -5.0, sd_pct: 5.0 }],
    };
    let spec = TableSpec {
        objects: vec!["box".to_owned(), "bowl".to_owned()],
        printed: Some(printed),
        notes: vec![note(Some("bowl"), None, "printed with the wrong sign")],
        ..spec("V", TableLayout::Raters, &[Quantity::Height])
    };
    let lost = ResultRow { flags: "rim_not_marked".to_owned(), ..fused("bowl", "ben", None, 50.0) };
    // Two sessions of one rater: 108 and 112 count as their mean.
    let rows = vec![
        fused("box", "ben", Some(90.0), 100.0),
        fused("box", "anna", Some(108.0), 100.0),
        ResultRow { session: "s2".to_owned(), ..fused("box", "anna", Some(112.0), 100.0) },
        fused("bowl", "anna", Some(55.0), 50.0),
        lost,
    ];
    results(rows, vec![spec])
}

/// Table II of the paper: five plates at nine setups.
pub fn paper_plates() -> Results {
    let mut reader = csv::Reader::from_reader(include_str!("table_II_plates.csv").as_bytes());
    let rows = reader.records().map(|record| {
        let record = record.unwrap();
        let number = |column: usize| record[column].parse::<f64>().unwrap();
        let square = record[0].starts_with("square");
        ResultRow {
            setup_height_mm: Some(number(1) * 10.0),
            setup_pitch_deg: Some(number(2)),
            pitch_deg: Some(number(2)),
            range_mm: Some(number(3)),
            shape: if square { Shape::Square } else { Shape::Circle },
            ..row(
                &record[0],
                Kind::Plate,
                if square { Quantity::Width } else { Quantity::Diameter },
                Some(number(4) * 10.0),
                number(5) * 10.0,
            )
        }
    });
    let spec = spec("II", TableLayout::Setups, &[Quantity::Diameter, Quantity::Width]);
    results(rows.collect(), vec![spec])
}
