//! The documents agree with the files that they speak of.

use std::path::Path;

use crate::support::{published_bench, root, run, stdout};

fn text(file: &str) -> String {
    std::fs::read_to_string(root().join(file)).unwrap().replace("\r\n", "\n")
}

#[test]
fn the_csv_profile_stands_whole_in_the_devices_document() {
    assert!(
        text("docs/devices.md").contains(&text("crates/ingest/profiles/csv.toml")),
        "copy the profile into docs/devices.md"
    );
}

#[test]
fn ci_runs_the_readme_s_commands() {
    let (readme, ci, readers) = (text("README.md"), text(".ci/run"), text(".ci/readers"));
    assert!(readme.contains("\n    cargo test --workspace\n") && ci.contains("\n  cargo test --workspace "));
    assert!(readme.contains("cargo run -- run data-samples/published-bench --out results.parquet"));
    assert!(readers.contains("study=data-samples/published-bench") && readers.contains("-- run \"$study\" --out"));
}

/// The columns of truth.parquet, made from the schema.
#[test]
fn the_simulate_document_has_the_columns_of_the_truth() {
    let expected = model::results::truth_markdown();
    assert!(text("docs/simulate.md").contains(&expected), "copy into docs/simulate.md:\n{expected}");
}

/// Links to files of the repository and to sections in them, in every document of the root and of docs/.
#[test]
fn links_lead_somewhere() {
    let mut checked = 0;
    for document in documents() {
        let here = text(&document);
        let folder = Path::new(&document).parent().unwrap().to_owned();
        for link in here.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(link, _)| link) {
            if link.contains("://") {
                continue;
            }
            let (file, section) = link.split_once('#').unwrap_or((link, ""));
            let target = folder.join(file);
            assert!(file.is_empty() || root().join(&target).exists(), "{document} links to {link}");
            if !section.is_empty() {
                let there = if file.is_empty() { here.clone() } else { text(target.to_str().unwrap()) };
                assert!(anchors(&there).any(|anchor| anchor == section), "{document} links to {link}");
            }
            checked += 1;
        }
    }
    assert!(checked > 100, "{checked} links");
}

/// The documents of the root and of docs/, relative to the root.
fn documents() -> Vec<String> {
    let names = |folder: &str| {
        let entries = std::fs::read_dir(root().join(folder)).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect::<Vec<_>>()
    };
    let inside = names("docs").into_iter().map(|name| format!("docs/{name}"));
    inside.chain(names(".")).filter(|name| name.ends_with(".md")).collect()
}

/// The anchors of a document's headings, as GitHub makes them: lower case, no punctuation, hyphens for spaces.
fn anchors(text: &str) -> impl Iterator<Item = String> {
    let headings = text
        .lines()
        .filter_map(|line| line.trim_start_matches('#').strip_prefix(' ').filter(|_| line.starts_with('#')));
    headings.map(|heading| {
        let kept = heading.to_lowercase().replace(' ', "-");
        kept.chars().filter(|c| c.is_alphanumeric() || "-_".contains(*c)).collect()
    })
}

/// The document shows of a session exactly the text that `inspect` prints.
#[test]
fn the_sample_of_inspect_is_what_it_prints() {
    let output = run(["inspect", published_bench().to_str().unwrap()]);
    let printed = stdout(&output);
    let shown = printed.split("\n\n").find(|session| session.starts_with("bench-35cm-55deg\n")).unwrap();
    let indented: String = shown.lines().map(|line| format!("    {line}\n")).collect();
    assert!(text("docs/inspect.md").contains(&indented), "copy into docs/inspect.md:\n{indented}");
}
