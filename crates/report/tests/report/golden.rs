//! The output of the renderers, frozen. `INSTA_UPDATE=always cargo test -p aim-batch-report` rewrites it; read the change before
//! you keep it.

use report::{csv, error_by_height, error_by_pitch, latex, markdown, tables, terminal, terminal_set};

use crate::bench;

#[test]
fn setups() {
    let table = &tables(&bench::plates())[0];
    insta::assert_snapshot!("setups_terminal", terminal(table, Some(120)));
    insta::assert_snapshot!("setups_csv", csv(table));
    insta::assert_snapshot!("setups_markdown", markdown(table));
    insta::assert_snapshot!("setups_latex", latex(table));
}

#[test]
fn raters() {
    let table = &tables(&bench::raters())[0];
    insta::assert_snapshot!("raters_terminal", terminal(table, Some(120)));
    insta::assert_snapshot!("raters_csv", csv(table));
    insta::assert_snapshot!("raters_markdown", markdown(table));
    insta::assert_snapshot!("raters_latex", latex(table));
}

#[test]
fn bands() {
    let results = bench::plates();
    insta::assert_snapshot!("by_pitch_csv", csv(&error_by_pitch(&results)));
    insta::assert_snapshot!("by_height_terminal", terminal(&error_by_height(&results), None));
}

#[test]
fn nothing_measured() {
    let results = bench::results(Vec::new(), vec![bench::raters().metadata.tables.remove(0)]);
    insta::assert_snapshot!("nothing_terminal", terminal_set(&tables(&results), Some(100)));
    assert!(terminal(&error_by_pitch(&results), None).contains("No size of a single image"));
}

#[test]
fn no_line_is_wider_than_the_terminal_and_the_statement_stands_once_at_the_end() {
    let results = bench::paper_plates();
    for width in [80, 120] {
        let text = terminal_set(&[tables(&results), vec![error_by_pitch(&results)]].concat(), Some(width));
        assert!(text.lines().all(|line| line.chars().count() <= width), "width {width}:\n{text}");
        assert_eq!(text.matches("proves arithmetic only").count(), 1);
        assert!(text.trim_end().ends_with("proves arithmetic only."));
    }
}
