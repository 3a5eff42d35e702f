//! Tests of the flow of images, as tables and as bars.

use model::{
    FrameReason, FrameRow, Problem, ProblemCode, ResultSink as _, RunLog, RunMetadata, SessionStatus, Severity, Stage,
};
use report::{
    ParquetSink, ReadError, Results, Table, compare, csv, flow, flow_bars, flow_in_short, frames_file, latex, left_out,
    terminal, terminal_set, write_dir,
};

use crate::bench;

fn frame(session: &str, reason: FrameReason, raters: u32) -> FrameRow {
    FrameRow { bytes: 1, raters, sizes: raters, ..FrameRow::without_numbers("by hand", session, "a.jpg", reason) }
}

/// Three sessions: one with images, one without, one lost.
fn metadata() -> RunMetadata {
    let status = |session: &str, failed| SessionStatus { session: session.to_owned(), failed, ..Default::default() };
    let problem = Problem {
        severity: Severity::Loss,
        stage: Stage::Ingest,
        code: ProblemCode::MissingCard,
        place: "cards/c".to_owned(),
        fact: "no card".to_owned(),
        remedy: "copy it".to_owned(),
    };
    let lost = SessionStatus { problems: vec![problem], ..status("c-lost", true) };
    RunMetadata { sessions: vec![status("a", false), status("b-empty", false), lost], ..bench::plates().metadata }
}

fn frames() -> Vec<FrameRow> {
    vec![
        frame("a", FrameReason::Selected, 2),
        frame("a", FrameReason::Selected, 0),
        frame("a", FrameReason::Moving, 1),
        frame("a", FrameReason::Moving, 0),
        frame("a", FrameReason::NoRange, 0),
        frame("a", FrameReason::EmptyImage, 0),
    ]
}

/// Results that are written to files and read back, as a run does.
fn read(metadata: &RunMetadata, frames: Vec<FrameRow>) -> Results {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("results.parquet");
    let mut sink = ParquetSink::create(&path, &frames_file(&path)).unwrap();
    sink.session(bench::plates().rows, frames).unwrap();
    sink.finish(metadata, &RunLog::default()).unwrap();
    let mut results = Results::read(&path).unwrap();
    results.read_flow(&frames_file(&path)).unwrap();
    results
}

fn small() -> Results {
    read(&metadata(), frames())
}

fn line<'a>(text: &'a str, start: &str) -> &'a str {
    text.lines().find(|line| line.starts_with(start)).unwrap_or_else(|| panic!("no '{start}' in\n{text}"))
}

#[test]
fn drawn() {
    let tables: Vec<Table> = [flow(&small()), left_out(&small())].into_iter().flatten().collect();
    insta::assert_snapshot!("flow_terminal", terminal_set(&tables, Some(80)));
    insta::assert_snapshot!("left_out_latex", latex(&tables[1]));
    insta::assert_snapshot!("flow_csv", tables.iter().map(csv).collect::<Vec<_>>().join("\n"));
}

/// The bars have the words of the table and of the figure.
#[test]
fn bars_for_a_terminal() {
    let text = flow_bars(&small(), Some(60)).unwrap();
    insta::assert_snapshot!("flow_bars", text);
    assert!(text.lines().all(|line| line.chars().count() <= 60), "{text}");
    let figures = report::figures(&small(), &frames()).unwrap();
    for line in text.lines().filter(|line| line.contains("left out: ")) {
        assert!(figures.drawn[0].svg.contains(line.trim()), "{line}");
    }
    assert!(flow_bars(&bench::plates(), None).is_none());
}

#[test]
fn a_lost_session_is_not_one_without_images() {
    let text = csv(&flow(&small()).unwrap());
    assert!(line(&text, "row,a,").starts_with("row,a,6,5,4,2,2,1,1,1,1,33.333333,"), "{text}");
    assert!(line(&text, "row,b-empty").starts_with("row,b-empty,0,0,0,0,0,0,0,0,0,,0,"), "{text}");
    assert!(line(&text, "row,c-lost").starts_with("row,c-lost,,,,,,,,,,,,"), "{text}");
    assert!(line(&text, "row,c-lost").contains("missing_card"), "{text}");
    assert!(line(&text, "overall,").starts_with("overall,,6,5,4,2,2,1,1,"), "{text}");
}

#[test]
fn reasons_that_left_nothing_out_have_no_row_and_the_shares_are_of_all_images() {
    let text = csv(&left_out(&small()).unwrap());
    assert_eq!(text.lines().count(), 1 + 3, "{text}");
    assert!(line(&text, "moving,").starts_with("moving,still,2,33.333333,1,1,"), "{text}");
    let all = read(&metadata(), vec![frame("a", FrameReason::Selected, 1)]);
    let none = left_out(&all).unwrap();
    assert!(none.rows.is_empty() && none.remarks[0].contains("No image"));
}

#[test]
fn of_many_sessions_the_terminal_shows_the_ten_with_the_least_kept_and_the_files_all() {
    let many = |sessions: usize| {
        // Session i keeps i of 40 images.
        let frames = (0..sessions).flat_map(|i| {
            let reason = move |n| if n < i { FrameReason::Selected } else { FrameReason::Moving };
            (0..40).map(move |n| frame(&format!("session-{:02}", 99 - i), reason(n), 0))
        });
        read(&RunMetadata { sessions: Vec::new(), ..metadata() }, frames.collect())
    };
    let results = many(31);
    assert_eq!(flow(&results).unwrap().rows.len(), 31 + 1);
    let short = flow_in_short(&results).unwrap();
    let text = csv(&short);
    let names: Vec<&str> = text.lines().skip(1).filter_map(|line| line.split(',').nth(1)).collect();
    let mut expected: Vec<String> = (0..10).map(|i| format!("session-{}", 99 - i)).collect();
    expected.push(String::new());
    assert_eq!(names, expected, "the least kept first, the study last");
    assert!(line(&text, "overall").starts_with("overall,,1240,"), "the study is still whole: {text}");
    assert!(terminal(&short, None).contains("10 of 31 sessions"));
    assert_eq!(flow_in_short(&many(30)), flow(&many(30)), "thirty are shown");
}

#[test]
fn no_name_or_number_is_broken_at_80_columns() {
    let mut frames = frames();
    for frame in &mut frames {
        frame.session = "bench-20cm-42deg".to_owned();
    }
    let results = read(&RunMetadata { sessions: Vec::new(), ..metadata() }, frames);
    let text = terminal_set(&[flow(&results).unwrap(), left_out(&results).unwrap()], Some(80));
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    for whole in
        ["bench-20cm-42deg ", "whole study ", "found ", "range ", "marks ", "sizes ", "empty_image ", "moving "]
    {
        assert!(text.contains(whole), "'{whole}' is broken in\n{text}");
    }
}

#[test]
fn files_and_gate_have_the_tables_only_where_the_ledger_was_read() {
    let dir = tempfile::tempdir().unwrap();
    write_dir(&small(), dir.path()).unwrap();
    assert!(compare(dir.path(), &small(), 0.0).unwrap().is_ok());
    let file = dir.path().join("flow.csv");
    let text = std::fs::read_to_string(&file).unwrap();
    std::fs::write(&file, text.replace("row,a,6,", "row,a,7,")).unwrap();
    let comparison = compare(dir.path(), &small(), 50.0).unwrap();
    assert_eq!(comparison.differences.len(), 1, "numbers of images must be equal: {comparison}");

    let without = bench::plates();
    assert!(flow(&without).is_none() && flow_in_short(&without).is_none() && left_out(&without).is_none());
    let other = tempfile::tempdir().unwrap();
    write_dir(&without, other.path()).unwrap();
    assert!(dir.path().join("left_out.tex").is_file() && !other.path().join("flow.csv").exists());
}

#[test]
fn a_ledger_of_another_run_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    let [one, two] = ["one.parquet", "two.parquet"].map(|name| dir.path().join(name));
    for (path, metadata) in [(&one, metadata()), (&two, bench::plates().metadata)] {
        let mut sink = ParquetSink::create(path, &frames_file(path)).unwrap();
        sink.session(Vec::new(), frames()).unwrap();
        sink.finish(&metadata, &RunLog::default()).unwrap();
    }
    let mut results = Results::read(&one).unwrap();
    let error = results.read_flow(&frames_file(&two)).unwrap_err();
    assert!(matches!(error, ReadError::OtherRun { .. }) && results.flow.is_none());
    assert!(matches!(results.read_flow(&one).unwrap_err(), ReadError::MissingColumn { .. }));
    results.read_flow(&dir.path().join("one.frames.parquet")).unwrap();
}
