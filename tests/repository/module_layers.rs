//! The layers of crates/pipeline in ARCHITECTURE.md, and the rooms of crates/rims in its `lib.rs`, held against the sources: which of
//! their modules may use which. Tests are not free.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The modules of a crate, each with its layer. A module uses modules of lower layers alone, so that none of them can need each other
/// in a circle. `lib.rs`, which only declares and re-exports, belongs to none.
type Layers = &'static [(&'static str, u32)];

/// The crates whose modules stand in layers.
const CRATES: [(&str, Layers); 2] = [("pipeline", PIPELINE), ("rims", RIMS)];

const PIPELINE: Layers = &[
    ("fault", 1),
    ("inputs", 1),
    ("json", 1),
    ("overlay", 1),
    ("reporter", 1),
    ("signals", 1),
    ("stop", 1),
    ("calibration", 2),
    ("labelme", 2),
    ("work", 2),
    ("study", 3),
    ("parallel", 4),
    ("session", 4),
    ("gallery", 5),
    ("run", 5),
    ("survey", 5),
    ("write_marks", 5),
    ("annotate", 6),
    ("calibrate", 6),
    ("check", 6),
    ("exchange", 6),
    ("inspect", 6),
];

const RIMS: Layers = &[
    ("colour", 1),
    ("edges", 1),
    ("priors", 1),
    ("rim_height", 1),
    ("shape", 1),
    ("weights", 1),
    ("evidence", 2),
    ("circles", 3),
    ("rim", 3),
    ("found", 4),
    ("height", 4),
    ("outline", 4),
    ("squares", 4),
    ("find", 5),
    ("sizes", 5),
    ("tests", 6),
];

#[test]
fn crates_keep_their_layers() {
    for (name, layers) in CRATES {
        let broken: Vec<String> = sources(name).iter().flat_map(|source| broken_layers(layers, source)).collect();
        assert!(broken.is_empty(), "the layers of {name} are broken:\n- {}", broken.join("\n- "));
    }
}

#[test]
fn every_module_has_a_layer() {
    for (name, layers) in CRATES {
        let lib = read_text(&source_dir(name).join("lib.rs"));
        let declared =
            lib.lines().filter_map(|line| line.trim_start_matches("pub ").strip_prefix("mod ")?.strip_suffix(';'));
        let expected: BTreeSet<&str> = layers.iter().map(|(module, _)| *module).collect();
        assert_eq!(declared.collect::<BTreeSet<_>>(), expected, "a module of {name} needs a line among its layers");
    }
}

/// The check itself sees each way of naming a module, and nothing else.
#[test]
fn upward_imports_are_found() {
    let broken = |path: &str, text: &str| {
        let module = path.split(['/', '.']).next().unwrap_or_default().to_owned();
        broken_layers(PIPELINE, &Source { module, path: path.to_owned(), text: text.to_owned() })
    };
    for (path, text) in [
        ("session/road.rs", "use crate::study::Study;\nuse crate::session::Prepared;\n"),
        ("check/mod.rs", "use crate::{run::run, session::{self, Session}, stop};\n"),
        ("study/mod.rs", "/// See [`run`](crate::run).\npub use spec::StudySpec;\n"),
        ("survey.rs", "mod tests {\n    use super::*;\n}\n"),
        ("session/fuse/joint.rs", "use super::run_of;\nuse crate::session::marked::Marked;\n"),
    ] {
        assert_eq!(broken(path, text), Vec::<String>::new(), "{path}: {text}");
    }
    for (path, text, upward) in [
        ("signals/frame.rs", "use crate::study::RangeCone;\n", "study"),
        ("study/mod.rs", "use crate::{\n    inputs::hash,\n    labelme::{self, Marks},\n    run,\n};\n", "run"),
        ("session/auto/mod.rs", "mod tests {\n    fn f() { crate::run::status() }\n}\n", "run"),
        ("run/mod.rs", "pub(in crate::survey) fn f() {}\n", "survey"),
        ("work/state.rs", "use crate::labelme::Marks;\n", "labelme"),
        ("survey.rs", "use super::check;\n", "check"),
        ("study/mod.rs", "use super::{inputs, session::Prepared};\n", "session"),
        ("gallery/ink.rs", "use crate::default_jobs;\n", "default_jobs"),
        ("work/state.rs", "use super::super::run;\n", "super::super"),
    ] {
        let found = broken(path, text);
        assert!(matches!(&found[..], [one] if one.contains(&format!("'{upward}'"))), "{path}: {text}: {found:?}");
    }
}

/// A source file of a crate.
struct Source {
    /// The module of the crate's root that it belongs to.
    module: String,
    /// Its path below src.
    path: String,
    text: String,
}

fn broken_layers(layers: Layers, source: &Source) -> Vec<String> {
    let Source { module, path, text } = source;
    let layer_of = |name: &str| layers.iter().find(|(module, _)| *module == name).map(|(_, layer)| *layer);
    // A line of comment may name whatever it explains.
    let code: String =
        text.lines().filter(|line| !line.trim_start().starts_with("//")).flat_map(|l| [l, "\n"]).collect();
    let mut used = names_after("crate::", &code);
    if *path == format!("{module}.rs") || *path == format!("{module}/mod.rs") {
        used.extend(names_after("super::", &code).into_iter().filter(|name| layer_of(name).is_some()));
    }
    if code.contains("super::super") {
        return vec![format!("{path} climbs by 'super::super': write 'crate::', which shows where it leads")];
    }
    let Some(layer) = layer_of(module) else { return vec![format!("{path}: '{module}' has no layer")] };
    let broken = |name: &String| match layer_of(name) {
        None => Some(format!("{path} uses '{name}' of the crate's root: name the module that it is in")),
        Some(of_name) if of_name >= layer && name != module => Some(format!(
            "{path} uses '{name}' of layer {of_name}, but {module} is in layer {layer} and may use lower ones alone: move \
             what both need down"
        )),
        Some(_) => None,
    };
    used.iter().filter_map(broken).collect()
}

/// The names that stand right after `root` in `code`: one name, or the first ones of a group in braces.
fn names_after(root: &str, code: &str) -> BTreeSet<String> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let name_of = |text: &str| -> String { text.trim_start().chars().take_while(|c| is_part(*c)).collect() };
    let mut names = BTreeSet::new();
    for (at, _) in code.match_indices(root) {
        let is_whole = !code[..at].ends_with(|c: char| is_part(c) || c == ':');
        let rest = &code[at + root.len()..];
        match rest.strip_prefix('{') {
            _ if !is_whole => {}
            Some(group) => names.extend(items(group).into_iter().map(name_of)),
            None => names.extend([name_of(rest)]),
        }
    }
    names.remove("");
    names
}

/// The items of a group, of which `group` is what follows its opening brace.
fn items(group: &str) -> Vec<&str> {
    let (mut items, mut depth, mut begin) = (Vec::new(), 0_u32, 0);
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            ',' | '}' if depth == 0 => {
                items.push(&group[begin..at]);
                begin = at + 1;
            }
            '}' => depth -= 1,
            _ => {}
        }
        if c == '}' && begin == at + 1 {
            break;
        }
    }
    items
}

fn sources(name: &str) -> Vec<Source> {
    let (root, mut folders, mut sources) = (source_dir(name), vec![source_dir(name)], Vec::new());
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{error}: {}", folder.display())) {
            let file = entry.expect("an entry of a folder of sources").path();
            let path = file.strip_prefix(&root).expect("it lies below").to_string_lossy().replace('\\', "/");
            if file.is_dir() {
                folders.push(file);
            } else if path.ends_with(".rs") && path != "lib.rs" {
                let module = path.split(['/', '.']).next().unwrap_or_default().to_owned();
                sources.push(Source { module, path, text: read_text(&file) });
            }
        }
    }
    sources
}

fn source_dir(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../{name}/src"))
}

fn read_text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{error}: {}", path.display()))
}
