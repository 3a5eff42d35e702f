//! Tests of a folder of tables.

use model::TableLayout;
use report::{WriteError, write_dir};

use crate::bench;

fn names(dir: &std::path::Path) -> Vec<String> {
    let mut names: Vec<String> =
        std::fs::read_dir(dir).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn every_table_in_three_formats_and_one_document_with_the_statement_once() {
    let dir = tempfile::tempdir().unwrap();
    let target = dir.path().join("new/tables");
    write_dir(&bench::plates(), &target).unwrap();
    let stems = ["accuracy", "error_by_height", "error_by_pitch", "sizes", "table_I"];
    let mut expected: Vec<String> =
        stems.iter().flat_map(|stem| ["csv", "md", "tex"].map(|extension| format!("{stem}.{extension}"))).collect();
    expected.push("tables.md".to_owned());
    expected.sort();
    assert_eq!(names(&target), expected, "and no temporary file is left");
    let document = std::fs::read_to_string(target.join("tables.md")).unwrap();
    assert_eq!(document.matches("### ").count(), 5);
    assert_eq!(document.matches("proves arithmetic only").count(), 1);
    for file in ["table_I.md", "table_I.tex", "error_by_pitch.md"] {
        assert!(std::fs::read_to_string(target.join(file)).unwrap().contains("proves arithmetic only"), "{file}");
    }
}

#[test]
fn every_table_says_what_it_is_and_how_its_statistics_are_defined() {
    let dir = tempfile::tempdir().unwrap();
    write_dir(&bench::plates(), dir.path()).unwrap();
    let tex: Vec<String> = names(dir.path()).into_iter().filter(|name| name.ends_with(".tex")).collect();
    assert_eq!(tex.len(), 5);
    for name in tex {
        let text = |extension: &str| std::fs::read_to_string(dir.path().join(&name).with_extension(extension)).unwrap();
        let caption = text("tex").split("\\caption{").nth(1).unwrap().split("}\n\\label").next().unwrap().to_owned();
        let (title, statistic) = caption.split_once(". ").unwrap();
        assert!(!title.is_empty() && statistic.ends_with('.') && statistic.len() > 60, "{name}: {caption}");
        // The sentences are the same, apart from characters that LaTeX and Markdown escape.
        let first = statistic.split([':', '\\']).next().unwrap();
        assert!(text("md").starts_with("### ") && text("md").contains(first), "{name}: {first}");
    }
}

#[test]
fn ids_that_cannot_name_files_are_refused_before_anything_is_written() {
    let dir = tempfile::tempdir().unwrap();
    for id in ["../II", "", "a/b", "a\\b", "a b"] {
        let results = bench::results(Vec::new(), vec![bench::spec(id, TableLayout::Setups, &[])]);
        assert!(matches!(write_dir(&results, dir.path()), Err(WriteError::Id { .. })), "'{id}'");
    }
    let twice = ["II", "ii"].map(|id| bench::spec(id, TableLayout::Raters, &[])).to_vec();
    let error = write_dir(&bench::results(Vec::new(), twice), dir.path()).unwrap_err();
    assert!(matches!(error, WriteError::SameFile { .. }));
    assert!(names(dir.path()).is_empty());
}

#[test]
fn a_file_in_place_of_the_folder_is_an_error() {
    let dir = tempfile::tempdir().unwrap();
    let target = dir.path().join("tables");
    std::fs::write(&target, "").unwrap();
    assert!(matches!(write_dir(&bench::plates(), &target), Err(WriteError::Folder { .. })));
}
