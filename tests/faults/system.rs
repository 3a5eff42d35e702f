//! The system says no: no space, no permission, a file system that cannot be written. Linux, in mount namespaces of their own;
//! where those cannot be had, the tests say 'skipped'.
#![cfg(target_os = "linux")]

use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;
use std::process::{Command, Output};

use super::Bench;
use crate::support::{assert_exit, stderr};

/// Runs with a file system mounted at `place`, which nobody else sees.
fn with_mount(bench: &Bench, options: &str, place: &Path) -> Option<Output> {
    std::fs::create_dir_all(place).unwrap();
    let run = bench.command();
    let script = format!(
        "mount -t tmpfs -o {options} none '{0}' && cd '{1}' && \"$@\"; code=$?; cp -r '{0}' '{1}/seen' 2>/dev/null; exit $code",
        place.display(),
        bench.path("").display(),
    );
    let is_root = Command::new("id").arg("-u").output().is_ok_and(|id| id.stdout == b"0\n");
    let namespace: &[&str] = if is_root { &["-m"] } else { &["-rm"] };
    let mut command = Command::new("unshare");
    for (name, value) in run.get_envs() {
        match value {
            Some(value) => command.env(name, value),
            None => command.env_remove(name),
        };
    }
    let probe = Command::new("unshare").args(namespace).args(["mount", "-t", "tmpfs", "none", "/mnt"]).output();
    if !probe.is_ok_and(|probe| probe.status.success()) {
        println!("skipped: no mount namespaces here");
        return None;
    }
    command.args(namespace).args(["sh", "-c", &script, "sh"]).arg(run.get_program()).args(run.get_args());
    Some(command.output().unwrap())
}

#[test]
fn no_space_in_the_work_folder() {
    let bench = Bench::new();
    let place = bench.work();
    let Some(output) = with_mount(&bench, "size=300k", &place) else { return };
    assert_exit(&output, 1);
    let said = stderr(&output);
    assert!(said.contains("No space left on device") || said.contains("disk is full"), "{said}");
    assert!(said.contains("free space"), "{said}");
    assert!(!bench.out().exists());
    assert_eq!(bench.run_well(), bench.undisturbed());
}

#[test]
fn no_space_for_the_results_leaves_the_old_ones() {
    let bench = Bench::new();
    let work = bench.work();
    let place = bench.path("out");
    let mut run = None;
    // From so little that nothing fits, to so much that almost all does.
    for size in ["4k", "12k", "20k", "28k"] {
        let output = with_mount(&bench, &format!("size={size}"), &place);
        let Some(output) = output else { return };
        run = Some(output.status.code());
        let seen = bench.path("seen");
        let whole = seen.join("results.parquet");
        assert!(!whole.exists() || output.status.code() == Some(0), "half-written results of {size}");
        let _ = std::fs::remove_dir_all(seen);
        let said = stderr(&output);
        assert!(said.contains("disk is full") || said.contains("No space left"), "{said}");
    }
    assert_eq!(run, Some(Some(1)));
    assert!(!work.join("state.sqlite").exists(), "all of it went into the small file system");
    assert_eq!(bench.run_well(), bench.undisturbed());
}

#[test]
fn a_read_only_file_system_is_told_before_any_work() {
    let bench = Bench::new();
    let Some(output) = with_mount(&bench, "ro", &bench.path("out")) else { return };
    assert_exit(&output, 1);
    assert!(stderr(&output).contains("Read-only file system"), "{}", stderr(&output));
    assert!(stderr(&output).contains("writable"), "{}", stderr(&output));
}

/// The program as a user who may not do everything, as root may.
fn as_nobody(bench: &Bench) -> Option<Command> {
    let is_root = Command::new("id").arg("-u").output().is_ok_and(|id| id.stdout == b"0\n");
    if !is_root {
        return Some(bench.command());
    }
    let nobody = ["--reuid=65534", "--regid=65534", "--clear-groups"];
    let readable = std::fs::metadata(env!("CARGO_BIN_EXE_aim-batch")).is_ok();
    let probe = Command::new("setpriv").args(nobody).arg(env!("CARGO_BIN_EXE_aim-batch")).arg("--version").output();
    if !readable || !probe.is_ok_and(|probe| probe.status.success()) {
        println!("skipped: cannot run as another user here");
        return None;
    }
    let run = bench.command();
    let mut command = Command::new("setpriv");
    command.args(nobody).arg(run.get_program()).args(run.get_args()).current_dir(bench.path(""));
    Some(command)
}

fn allow(path: &Path, mode: u32) {
    std::fs::set_permissions(path, std::fs::Permissions::from_mode(mode)).unwrap();
}

#[test]
fn an_output_folder_without_permission() {
    let bench = Bench::new();
    allow(&bench.path(""), 0o755);
    std::fs::create_dir(bench.path("out")).unwrap();
    allow(&bench.path("out"), 0o555);
    let Some(mut command) = as_nobody(&bench) else { return };
    let output = command.output().unwrap();
    assert_exit(&output, 1);
    assert!(stderr(&output).contains("Permission denied"), "{}", stderr(&output));
    assert_eq!(std::fs::read_dir(bench.path("out")).unwrap().count(), 0);
    allow(&bench.path("out"), 0o755);
    bench.run_well();
}

#[test]
fn a_card_without_permission_is_told_and_read_when_it_is_given() {
    let bench = Bench::new();
    for folder in ["", "out"] {
        std::fs::create_dir_all(bench.path(folder)).unwrap();
        allow(&bench.path(folder), 0o777);
    }
    let sensor = bench.card_file("S00002", "SENSORS");
    allow(&sensor, 0o000);
    allow(&bench.study().join("cards/S00004"), 0o000);
    let Some(mut command) = as_nobody(&bench) else { return };
    let output = command.output().unwrap();
    assert_exit(&output, 3);
    let losses = bench.losses();
    assert_eq!(losses.iter().map(|(session, _)| session.as_str()).collect::<Vec<_>>(), ["S00002", "S00004"]);
    assert!(losses[0].1.contains(&"unreadable_file".to_owned()), "{losses:?}");
    allow(&sensor, 0o644);
    allow(&bench.study().join("cards/S00004"), 0o755);
    let Some(mut command) = as_nobody(&bench) else { return };
    assert_exit(&command.output().unwrap(), 0);
    assert_eq!(bench.files(), bench.undisturbed());
}
