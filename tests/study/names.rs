//! names.csv: containers that the program found get the names of objects, and with them errors.

use model::{Level, Problem, Quantity, Severity};

use super::auto::{Ran, by_ray, damage, run, study};
use crate::support::{StudyFolder, aim_batch, assert_exit, stderr};

const AUTO: [&str; 2] = ["--marks", "auto"];
const HEADER: &str = "session,found,object\n";

fn losses(ran: &Ran) -> Vec<Problem> {
    let problems = ran.sessions().into_iter().flat_map(|session| session.problems);
    problems.filter(|problem| problem.severity == Severity::Loss).collect()
}

fn name(study: &StudyFolder, lines: &str) {
    study.write("names.csv", format!("{HEADER}{lines}"));
}

#[test]
fn a_named_container_has_errors_and_what_is_known_of_its_object() {
    let study = study();
    let found = run(&study, "found", &AUTO, 0).rows();
    assert!(found.iter().all(|row| row.error_pct.is_none()));
    name(&study, "S1,auto-1,dinner plate\n");
    let ran = run(&study, "named", &AUTO, 0);
    let rows = ran.rows();
    let in_s1 = by_ray(&rows, Level::Frame, Quantity::Diameter);
    let in_s1: Vec<_> = in_s1.iter().filter(|row| row.session == "S1").collect();
    assert_eq!(in_s1.len(), 3);
    for row in in_s1 {
        assert_eq!((row.object.as_str(), row.rater.as_str(), row.truth_mm), ("dinner plate", "auto", Some(230.0)));
        assert!(row.plane_z_mm.unwrap() < 0.1, "measured at the height that objects.csv gives");
        assert!(row.error_pct.unwrap().abs() < 1.5, "{row:?}");
        assert!(row.confidence.is_some());
    }
    let others = |rows: &[model::ResultRow]| rows.iter().filter(|row| row.session == "S2").cloned().collect::<Vec<_>>();
    assert_eq!(others(&rows), others(&found), "names are those of one session");

    let report = study.path().join("report");
    let output = aim_batch().arg("report").arg(&ran.out).arg("-o").arg(&report).output().unwrap();
    assert_exit(&output, 0);
    let table = std::fs::read_to_string(report.join("error_by_pitch.csv")).unwrap();
    assert!(table.lines().count() > 1, "{table}");
}

#[test]
fn names_hold_for_marks_that_were_written() {
    let study = study();
    let marks = study.path().join("marks");
    run(&study, "written", &["--marks", "auto", "--write-marks", marks.to_str().unwrap()], 0);
    name(&study, "S1,auto-1,dinner plate\n");
    let searched = run(&study, "searched", &AUTO, 0).rows();
    assert_eq!(run(&study, "manual", &["--marks", "manual"], 0).rows(), searched);
    assert_eq!(run(&study, "both", &["--marks", "both"], 0).rows(), searched);
}

/// A recording whose pictures cannot be read any more would be made again by a search.
#[test]
fn naming_costs_no_search() {
    let study = study();
    let found = run(&study, "r", &AUTO, 0).rows();
    damage(&study.path().join("out/r.work/mcap/S1.mcap"));
    name(&study, "S1,auto-1,dinner plate\n");
    let named = run(&study, "r", &["--marks", "auto", "-v"], 0);
    assert!(!stderr(&named.output).contains("ingested again"), "{}", stderr(&named.output));
    assert!(named.rows().iter().any(|row| row.object == "dinner plate"));
    assert_eq!(named.rows().len(), found.len());
    let again = run(&study, "r", &["--marks", "auto", "-v", "--force"], 0);
    assert_eq!(again.rows(), named.rows());
    let toml = std::fs::read_to_string(study.path().join("study.toml")).unwrap();
    study.write("study.toml", format!("{toml}\n[marks]\nmin_confidence = 0.4\n"));
    damage(&study.path().join("out/r.work/mcap/S1.mcap"));
    let searched = run(&study, "r", &["--marks", "auto", "-v"], 0);
    assert!(stderr(&searched.output).contains("ingested again"), "other settings, another search");
}

#[test]
fn a_name_that_nothing_has_is_told() {
    let study = study();
    name(&study, "S1,auto-1,dinner plate\nS2,auto-77,dinner plate\n");
    let ran = run(&study, "r", &AUTO, 3);
    let losses = losses(&ran);
    let [one] = losses.as_slice() else { panic!("{losses:?}") };
    assert_eq!((one.code.code(), one.place.as_str()), ("name_not_found", "names.csv line 3"));
    assert!(one.fact.contains("'auto-77'") && one.fact.contains("'S2'"), "{}", one.fact);
    run(&study, "people", &["--marks", "manual"], 0); // nobody looked for it
}

#[test]
fn what_cannot_be_is_refused() {
    let study = study();
    for (line, expected) in
        [("S1,auto-1,cup", "line 2: object 'cup'"), ("S9,auto-1,dinner plate", "line 2: session 'S9'")]
    {
        name(&study, &format!("{line}\n"));
        let said = stderr(&run(&study, "r", &AUTO, 2).output);
        assert!(said.contains(expected) && said.contains("names.csv"), "{said}");
    }
}
