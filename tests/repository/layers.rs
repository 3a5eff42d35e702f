//! The dependency rule of ARCHITECTURE.md, held against the Cargo.toml files: which crate may use which, and the one home
//! of every heavy crate. Dev-dependencies are free.

use std::collections::BTreeMap;
use std::path::Path;

/// The crates of the workspace in data-flow order, each with those that it may use.
const LAYERS: [(&str, &[&str]); 8] = [
    ("model", &[]),
    ("ingest", &["model"]),
    ("rims", &["model", "ingest"]),
    ("ties", &["model", "ingest"]),
    ("pipeline", &["model", "ingest", "rims", "ties"]),
    ("report", &["model"]),
    ("simulate", &["model"]),
    ("cli", &["model", "ingest", "rims", "pipeline", "report", "simulate"]),
];

/// Crates with few homes, and why.
const HOMES: [(&[&str], &[&str], &str); 11] = [
    (&["mcap", "foxglove", "prost"], &["ingest"], "only ingest knows what a recording looks like inside"),
    (
        // simulate writes pictures, which is no decoding; ingest writes small ones for reports and viewers.
        &["image", "jpeg-encoder"],
        &["ingest", "simulate"],
        "pictures are decoded and reduced by ingest alone; simulate encodes those that it renders",
    ),
    (&["zune-jpeg", "turbojpeg", "png", "kamadak-exif"], &["ingest"], "pictures are decoded by ingest alone"),
    (&["unicode-normalization"], &["ingest"], "names are compared in one form, which ingest::nfc alone gives"),
    (&["rayon"], &["pipeline", "simulate"], "work is shared out by pipeline over sessions, and by simulate's renderer"),
    (&["rusqlite", "redb"], &["pipeline"], "what is kept between runs is pipeline's alone"),
    (&["askama"], &["report"], "pages and figures are made from results alone"),
    (&["quick-xml"], &["pipeline"], "XML is a format of marks alone, from CVAT"),
    (&["wide"], &["rims"], "of all loops, only the search for rims asks for a processor's lanes by name"),
    (&["polars", "arrow", "parquet"], &["report"], "it is most of the build, and rows go through model::ResultSink"),
    (
        &["clap", "indicatif", "miette", "anyhow", "tracing-subscriber", "signal-hook"],
        &["cli"],
        "libraries neither draw, nor parse arguments, nor choose where logs go: they return typed errors and emit events",
    ),
];

/// A member of the workspace and what it uses outside its tests.
#[derive(Debug, Default)]
struct Member {
    name: String,
    uses: Vec<String>,
}

#[test]
fn the_workspace_keeps_its_layers() {
    let broken = broken_rules(&members());
    assert!(broken.is_empty(), "the dependency rule of ARCHITECTURE.md is broken:\n- {}", broken.join("\n- "));
}

#[test]
fn members_stand_in_data_flow_order() {
    let found: Vec<String> = members().into_iter().map(|member| member.name).collect();
    let expected: Vec<&str> = LAYERS.iter().map(|(name, _)| *name).collect();
    assert_eq!(found, expected, "[workspace] members of Cargo.toml; a new crate also needs a line in LAYERS");
}

/// The check itself sees each kind of trespass.
#[test]
fn trespasses_are_found() {
    let member = |name: &str, uses: &[&str]| Member {
        name: name.to_owned(),
        uses: uses.iter().map(|used| (*used).to_owned()).collect(),
    };
    assert_eq!(broken_rules(&[member("report", &["model", "polars", "serde"])]), Vec::<String>::new());
    for (name, used, remedy) in [
        ("model", "ingest", "model may use none of the others"),
        ("report", "pipeline", "report may use only model"),
        ("pipeline", "polars", "only report may"),
        ("ingest", "indicatif", "only cli may"),
        ("cli", "mcap", "only ingest may"),
        ("extra", "model", "a line in LAYERS"),
    ] {
        let broken = broken_rules(&[member(name, &[used])]);
        assert!(broken.len() == 1 && broken[0].contains(remedy), "{name} uses {used}: {broken:?}");
    }
}

fn broken_rules(members: &[Member]) -> Vec<String> {
    let mut broken = Vec::new();
    for Member { name, uses } in members {
        let Some((_, allowed)) = LAYERS.iter().find(|(layer, _)| layer == name) else {
            broken.push(format!("crate '{name}' has no layer: give it a line in LAYERS of tests/repository/layers.rs"));
            continue;
        };
        for used in uses {
            if LAYERS.iter().any(|(layer, _)| layer == used) && !allowed.contains(&used.as_str()) {
                let may =
                    if allowed.is_empty() { "none of the others".into() } else { format!("only {}", list(allowed)) };
                broken.push(format!("{name} uses {used}, but {name} may use {may}: move what both need down to model"));
            }
            for (_, homes, why) in HOMES.iter().filter(|(heavy, ..)| heavy.contains(&used.as_str())) {
                if !homes.contains(&name.as_str()) {
                    broken.push(format!(
                        "{name} depends on '{used}', but only {} may, because {why}: move the code there, or make it a \
                         dev-dependency if only tests need it",
                        list(homes)
                    ));
                }
            }
        }
    }
    broken
}

fn list(names: &[&str]) -> String {
    names.join(", ")
}

fn members() -> Vec<Member> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let workspace = read(&root.join("Cargo.toml"));
    let names = package_names(&workspace["workspace"]["dependencies"]);
    let paths = workspace["workspace"]["members"].as_array().expect("[workspace] members is a list");
    let member = |path: &toml::Value| {
        let path = path.as_str().expect("a member is a path");
        let name = path.rsplit('/').next().unwrap_or(path).to_owned();
        Member { name, uses: used_crates(&read(&root.join(path).join("Cargo.toml")), &names) }
    };
    paths.iter().map(member).collect()
}

fn read(path: &Path) -> toml::Table {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{error}: {}", path.display()));
    text.parse().unwrap_or_else(|error| panic!("{error}: {}", path.display()))
}

/// Everything under [dependencies] and [build-dependencies], also of one target, by the name of its package.
fn used_crates(manifest: &toml::Table, workspace_names: &BTreeMap<String, String>) -> Vec<String> {
    let targets = manifest.get("target").and_then(toml::Value::as_table).into_iter().flat_map(|all| all.values());
    let sections = targets.filter_map(toml::Value::as_table).chain([manifest]);
    let tables = sections.flat_map(|section| ["dependencies", "build-dependencies"].map(|key| section.get(key)));
    let mut uses = Vec::new();
    for dependencies in tables.flatten() {
        for (key, package) in package_names(dependencies) {
            let package = if package == key { workspace_names.get(&key).cloned().unwrap_or(key) } else { package };
            uses.push(own_name(&package).to_owned());
        }
    }
    uses
}

/// The package behind each key of a table of dependencies.
fn package_names(dependencies: &toml::Value) -> BTreeMap<String, String> {
    let renamed = |value: &toml::Value| value.get("package").and_then(toml::Value::as_str).map(str::to_owned);
    let table = dependencies.as_table().expect("dependencies are a table");
    table.iter().map(|(key, value)| (key.clone(), renamed(value).unwrap_or_else(|| key.clone()))).collect()
}

/// 'aim-batch-model' is the crate 'model'.
fn own_name(package: &str) -> &str {
    package.strip_prefix("aim-batch-").unwrap_or(package)
}
