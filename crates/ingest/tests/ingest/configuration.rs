//! Configuration files, cameras and profiles by name.

use std::path::Path;

use aim_batch_ingest::config::{self, ConfigError};
use aim_batch_ingest::{Profile, camera};

fn profile_error(text: &str) -> String {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("own.toml");
    std::fs::write(&path, text).unwrap();
    Profile::read_file(&path).unwrap_err().to_string().replace(&path.display().to_string(), "own.toml")
}

fn built_in(name: &str) -> String {
    let profiles = Path::new(env!("CARGO_MANIFEST_DIR")).join("profiles");
    std::fs::read_to_string(profiles.join(format!("{name}.toml"))).unwrap()
}

#[test]
fn every_built_in_profile_and_camera_loads() {
    for name in ["aim2-packets", "csv", "axivity-cwa", "pupil-neon", "pupil-invisible"] {
        let profile = Profile::load(name, Path::new("no-such-folder")).unwrap();
        assert_eq!(profile.name, name);
        let text = toml::to_string(&profile).unwrap();
        assert_eq!(toml::from_str::<Profile>(&text).unwrap(), profile, "the resolved profile reads back");
    }
    let aim2 = Profile::load("aim2-packets", Path::new("none")).unwrap();
    assert!((aim2.mount_pitch_deg - 21.0).abs() < 1e-12);
    for name in ["aim2-raw", "aim2-corrected"] {
        assert!(camera::load(name, Path::new("none")).unwrap().camera().is_ok());
    }
}

#[test]
fn an_unknown_key_is_named_with_line_column_and_the_nearest_known_key() {
    let text = built_in("csv").replace("mm_per_count", "mm_per_cuont");
    let line = text.lines().position(|line| line.starts_with("mm_per_cuont")).unwrap() + 1;
    let message = profile_error(&text);
    assert!(message.starts_with(&format!("own.toml:{line}:1: unknown key 'mm_per_cuont'")), "{message}");
    assert!(message.contains("did you mean 'mm_per_count'?"), "{message}");
}

#[test]
fn an_unknown_key_in_a_tagged_table_is_found_at_its_own_line() {
    let text = built_in("csv").replace("pattern =", "patern =");
    let line = text.lines().position(|line| line.contains("patern")).unwrap() + 1;
    let message = profile_error(&text);
    assert!(message.starts_with(&format!("own.toml:{line}:25: unknown key 'patern'")), "{message}");
    assert!(message.contains("did you mean 'pattern'?"), "{message}");

    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("camera.toml");
    let text = "schema_version = 1\nname = \"c\"\nwidth_px = 4\nheight_px = 3\nfocal_px = [1.0, 1.0]\n\
                principal_px = [2.0, 1.5]\n[lens]\nmodel = \"division\"\nlamda = -0.1\n";
    std::fs::write(&path, text).unwrap();
    let Err(ConfigError::UnknownKey { line, column, key, nearest, known, .. }) = camera::read_file(&path) else {
        panic!("expected an unknown key");
    };
    assert_eq!((line, column, key.as_str(), nearest.as_deref()), (9, 1, "lamda", Some("lambda")));
    assert_eq!(known, ["lambda"]);
}

#[test]
fn a_value_of_the_wrong_type_names_its_key() {
    let message = profile_error(&built_in("aim2-packets").replace("samples = 1022", "samples = \"many\""));
    assert!(message.contains("acceleration.packets.samples: "), "{message}");
    let message = profile_error("schema_version = 1\nname = ");
    assert!(message.starts_with("own.toml:2:"), "{message}");
    let message = profile_error(&built_in("csv").replace("version = \"1\"", ""));
    assert!(message.contains("missing field `version`"), "{message}");
}

#[test]
fn values_that_contradict_each_other_are_refused() {
    let packets = built_in("aim2-packets");
    let csv = built_in("csv");
    let cases = [
        (packets.replace("\"+y\"", "\"-x\""), "acceleration.axes: a sensor axis is used twice"),
        (packets.replace("0.001 ", "0.0 "), "acceleration.g_per_count: 0 is not a positive number"),
        (
            packets.replace("channels = [\"range\"]", "channels = [\"r\"]"),
            "range.packets.channels: 0 channels named range",
        ),
        (packets.replace("field = \"stamp\", type = \"f64\"", "field = \"t\", type = \"f64\""), "0 fields named stamp"),
        (packets.replace("type = \"f64\"", "type = \"f32\""), "the stamp's type cannot hold a time of today"),
        (packets.replace("samples = 1022", "samples = 0"), "0 samples"),
        (packets.replace("samples = 1022", "samples = 9000000000000000000"), "a packet of more than 16 MiB"),
        (csv.replace("range*.csv", "range[.csv"), "is not a file pattern"),
        (csv.replace("%Y%m%dT", "%Y"), "images.time.pattern"),
        (csv.replace("schema_version = 1", "schema_version = 2"), "schema_version"),
        (csv.replace("[range.csv]", "[range.packets]").replace("range = \"range_mm\"", ""), "own.toml"),
        ("schema_version = 1\nname = \"n\"\nversion = \"1\"\nmount_pitch_deg = 0.0".to_owned(), "declares no files"),
    ];
    for (text, expected) in cases {
        let message = profile_error(&text);
        assert!(message.contains(expected), "expected '{expected}' in: {message}");
    }
}

#[test]
fn an_unknown_name_lists_what_exists() {
    let devices = tempfile::tempdir().unwrap();
    std::fs::copy(
        Path::new(env!("CARGO_MANIFEST_DIR")).join("cameras/aim2-raw.toml"),
        devices.path().join("unit-7.toml"),
    )
    .unwrap();
    std::fs::write(devices.path().join("own-profile.toml"), built_in("csv")).unwrap();
    let message = camera::load("aim2-rwa", devices.path()).unwrap_err().to_string();
    assert!(message.contains("unknown camera 'aim2-rwa' (did you mean 'aim2-raw'?)"), "{message}");
    assert!(message.contains("known are aim2-corrected, aim2-raw, unit-7;"), "{message}");
    let message = Profile::load("../csv", devices.path()).unwrap_err().to_string();
    assert!(
        message.contains("known are aim2-packets, axivity-cwa, csv, own-profile, pupil-invisible, pupil-neon;"),
        "{message}"
    );
}

#[test]
fn a_study_s_own_file_goes_before_the_built_in_one() {
    let devices = tempfile::tempdir().unwrap();
    let own = built_in("csv").replace("version = \"1\"", "version = \"own\"");
    std::fs::write(devices.path().join("csv.toml"), own).unwrap();
    assert_eq!(Profile::load("csv", devices.path()).unwrap().version, "own");
    assert_eq!(Profile::load("csv.toml", devices.path()).unwrap().version, "own");
}

#[test]
fn a_camera_that_contradicts_itself_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("camera.toml");
    let text = "schema_version = 1\nname = \"c\"\nwidth_px = 4\nheight_px = 3\nprincipal_px = [2.0, 1.5]\n[lens]\nmodel = \"none\"";
    std::fs::write(&path, text).unwrap();
    let message = camera::read_file(&path).unwrap_err().to_string();
    assert!(message.contains("expected either focal_px"), "{message}");
}

#[test]
fn files_that_are_no_configuration_are_refused() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("x.toml");
    let read = || config::read_toml::<toml::Table>(&path).unwrap_err();
    assert!(matches!(read(), ConfigError::Unreadable { .. }));
    std::fs::write(&path, b"name = \"\xff\"").unwrap();
    assert!(matches!(read(), ConfigError::NotUtf8 { offset: 8, .. }));
    std::fs::write(&path, vec![b'#'; 5_000_000]).unwrap();
    assert!(matches!(read(), ConfigError::TooLarge { .. }));
}

#[test]
fn words_for_no_target_are_for_csv_files() {
    let with = |name: &str, list: &str| {
        let text = built_in(name).replace("mm_per_count = 1.0\n", &format!("mm_per_count = 1.0\nno_target = {list}\n"));
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.toml");
        std::fs::write(&path, text).unwrap();
        Profile::read_file(&path).map_err(|error| error.to_string())
    };
    assert!(with("csv", "[0, 8190.5, \"OOR\"]").is_ok());
    assert!(with("aim2-packets", "[0, -1]").is_ok());
    let message = with("aim2-packets", "[\"OOR\"]").unwrap_err();
    assert!(message.contains("range.no_target") && message.contains("cannot hold the word 'OOR'"), "{message}");
    let message = with("csv", "[nan]").unwrap_err();
    assert!(message.contains("not a finite number"), "{message}");
}
