//! The documents agree with the files that they speak of.

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

/// Links to files of the repository, in every document of the front door.
#[test]
fn links_lead_somewhere() {
    let mut checked = 0;
    for document in [
        "README.md",
        "ARCHITECTURE.md",
        "CONTRIBUTING.md",
        "docs/accuracy.md",
        "docs/glossary.md",
        "docs/study.md",
        "docs/uncertainty.md",
        "docs/calibration.md",
        "docs/devices.md",
        "docs/inspect.md",
        "docs/marks.md",
        "docs/rims.md",
        "docs/report.md",
        "docs/viewers.md",
        "docs/simulate.md",
    ] {
        let folder = root().join(document).parent().unwrap().to_owned();
        for link in text(document).split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(link, _)| link) {
            let file = link.split('#').next().unwrap();
            if !file.is_empty() && !file.contains("://") {
                assert!(folder.join(file).exists(), "{document} links to {link}");
                checked += 1;
            }
        }
    }
    assert!(checked > 10);
}

/// What the document shows of a session is what `inspect` prints.
#[test]
fn the_sample_of_inspect_is_what_it_prints() {
    let output = run(["inspect", published_bench().to_str().unwrap()]);
    let printed = stdout(&output);
    let shown = printed.split("\n\n").find(|session| session.starts_with("bench-35cm-55deg\n")).unwrap();
    let indented: String = shown.lines().map(|line| format!("    {line}\n")).collect();
    assert!(text("docs/inspect.md").contains(&indented), "copy into docs/inspect.md:\n{indented}");
}
