//! Names that mean something to LaTeX, Markdown, CSV or a terminal.

use model::TableLayout;
use report::{Table, csv, latex, markdown, tables, terminal};

use crate::bench;

const NASTY: &str = r"a_b & 5% |c| #1 $x$ {y} \z ~^<br>*[1]*`";

fn table_of(name: &str) -> Table {
    let mut spec = bench::spec("1", TableLayout::Setups, &[]);
    spec.title = name.to_owned();
    spec.notes = vec![bench::note(Some(name), None, name)];
    let mut results = bench::results(vec![bench::plate(name, true, Some(190.0), 200.0)], vec![spec]);
    results.metadata.statement = Some(name.to_owned());
    tables(&results).remove(0)
}

#[test]
fn latex_prints_names_as_they_are() {
    let text = latex(&table_of(NASTY));
    let escaped = r"a\_b \& 5\% \textbar{}c\textbar{} \#1 \$x\$ \{y\} \textbackslash{}z \textasciitilde{}\textasciicircum{}\textless{}br\textgreater{}*[1]*`";
    // Caption, row, footnote and statement; the comment in the first line may have it raw.
    assert_eq!(text.matches(escaped).count(), 4, "{text}");
    assert_eq!(text.matches(NASTY).count(), 1, "{text}");
    assert!(text.starts_with("% "));
}

#[test]
fn latex_prints_letters_without_a_glyph_as_code_points() {
    let text = latex(&table_of("Sch\u{fc}ssel \u{8336}\u{7897} \u{105}"));
    assert!(text.contains("Sch\u{fc}ssel \\texttt{U+8336}\\texttt{U+7897} \\texttt{U+0105} &"), "{text}");
}

#[test]
fn markdown_prints_names_as_they_are() {
    let text = markdown(&table_of(NASTY));
    let escaped = r"a\_b &amp; 5% \|c\| \#1 \$x\$ \{y\} \\z \~\^&lt;br&gt;\*\[1\]\*\`";
    assert_eq!(text.matches(escaped).count(), 4, "{text}");
    assert_eq!(text.matches(NASTY).count(), 0, "{text}");
}

#[test]
fn csv_reads_back() {
    for name in [NASTY, "a, \"b\"", "two\nlines", " spaces "] {
        let text = csv(&table_of(name));
        let mut reader = ::csv::Reader::from_reader(text.as_bytes());
        let records: Vec<_> = reader.records().map(Result::unwrap).collect();
        assert_eq!(records.len(), 3);
        assert_eq!(&records[0][1], name);
    }
}

#[test]
fn control_characters_reach_neither_terminal_nor_document() {
    let table = table_of("bo\u{1b}[2Jwl\nnext\r");
    for text in [terminal(&table, Some(120)), markdown(&table), latex(&table)] {
        assert!(!text.contains(['\u{1b}', '\r']), "{text}");
        assert!(!text.contains("\nnext"), "{text}");
    }
}
