use std::collections::BTreeSet;

use super::*;

#[test]
fn the_same_seed_gives_the_same_files_and_another_seed_other_noise() {
    let ((_a, first), (_b, again), (_c, other)) = (study(7), study(7), study(8));
    let names = files_below(&first);
    assert_eq!(names, files_below(&again));
    assert_eq!(names, files_below(&other));
    for name in names {
        let bytes = fs::read(first.join(&name)).unwrap();
        assert_eq!(bytes, fs::read(again.join(&name)).unwrap(), "{}", name.display());
        let is_noisy = name.extension().is_some_and(|extension| extension == "BIN");
        assert_eq!(bytes != fs::read(other.join(&name)).unwrap(), is_noisy, "{}", name.display());
    }
}

#[test]
fn the_shipped_sample_is_what_the_preset_writes() {
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data-samples/published-bench");
    let (_keep, fresh) = study(Options::default().seed);
    let (pictures, others): (Vec<_>, Vec<_>) = files_below(&shipped)
        .into_iter()
        .partition(|name| name.extension().is_some_and(|extension| extension == "JPG"));
    assert_eq!(others, files_below(&fresh));
    for name in others {
        let same = fs::read(shipped.join(&name)).unwrap() == fs::read(fresh.join(&name)).unwrap();
        assert!(same, "{} differs: make data-samples/published-bench again", name.display());
    }
    let planned: usize = all_sessions().iter().map(|session| session.shots.len()).sum();
    assert_eq!(pictures.len(), planned);
    for name in pictures {
        assert_eq!(image::image_dimensions(shipped.join(&name)).unwrap(), (2592, 1944), "{}", name.display());
    }
}

#[test]
fn a_folder_with_something_in_it_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    let refused = published_bench(folder.path(), &Options { seed: 1, render: false }, &|_, _| {});
    assert!(matches!(refused, Err(SimulateError::NotEmpty { .. })));
    assert_eq!(files_below(folder.path()), [PathBuf::from("notes.txt")]);
}

#[test]
fn counts_and_progress_agree_with_the_files() {
    let folder = tempfile::tempdir().unwrap();
    let calls = std::sync::Mutex::new(Vec::new());
    let summary = published_bench(folder.path(), &Options { seed: 1, render: false }, &|done, total| {
        calls.lock().unwrap().push((done, total));
    })
    .unwrap();
    assert_eq!(summary, Summary { sessions: 9 + 3, images: 9 * 8 + 3 * 5, mark_files: 9 * 8 + 3 * 5 * 4 });
    assert_eq!(*calls.lock().unwrap(), (1..=87).map(|done| (done, 87)).collect::<Vec<_>>());
    let marks = files_below(folder.path()).into_iter().filter(|name| name.starts_with("marks")).count();
    assert_eq!(marks, summary.mark_files);
}

/// The overall rows that follow from the printed rows were computed apart from this program.
#[test]
fn expected_overall_rows() {
    let (_keep, root) = study(Options::default().seed);
    for (id, row, mean_pct, sd_pct, within) in [
        ("II", "overall", 2.01, 4.90, 0.01),
        ("III", "overall", -2.73, 38.11, 0.01),
        ("IV", "overall", 4.58, 6.78, 0.01),
        ("V", "overall", -1.34, 9.20, 0.01),
        ("VI", "overall", 4.70, 11.56, 0.05),
        ("VI", "overall_printed_truth", -0.07, 0.04, 0.01),
    ] {
        let mut reader = csv::Reader::from_path(root.join(format!("expected/table_{id}.csv"))).unwrap();
        let header = reader.headers().unwrap().clone();
        let column = |name: &str| header.iter().position(|column| column == name).unwrap();
        let found = reader.records().map(Result::unwrap).find(|record| &record[0] == row).unwrap();
        let number = |name: &str| found[column(name)].parse::<f64>().unwrap();
        assert!((number("error_pct") - mean_pct).abs() <= within, "{id} {row}: {found:?}");
        assert!((number("sd_pct") - sd_pct).abs() <= within, "{id} {row}: {found:?}");
    }
}

#[test]
fn study_toml_names_objects_and_files_that_exist() {
    let (_keep, root) = study(Options::default().seed);
    let study: toml::Table = toml::from_str(&fs::read_to_string(root.join("study.toml")).unwrap()).unwrap();
    let mut objects = csv::Reader::from_path(root.join("objects.csv")).unwrap();
    let known: BTreeSet<String> = objects.records().map(|record| record.unwrap()[0].to_owned()).collect();
    assert_eq!(known.len(), 8 + 3);
    assert!(root.join(format!("devices/{}.toml", study["camera"].as_str().unwrap())).is_file());
    let tables = study["tables"].as_array().unwrap();
    assert_eq!(tables.len(), 5);
    for table in tables {
        for object in table["objects"].as_array().unwrap() {
            assert!(known.contains(object.as_str().unwrap()), "{object}");
        }
        // This is the same table as the model reads it, with the printed numbers in place of the names of their files.
        let mut spec = table.as_table().unwrap().clone();
        let printed = spec.remove("printed").unwrap();
        for file in ["rows", "summaries"] {
            assert!(root.join(printed[file].as_str().unwrap()).is_file());
        }
        spec.try_into::<model::TableSpec>().unwrap();
    }
}
