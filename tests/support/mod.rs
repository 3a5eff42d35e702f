//! The parts that tests share: running the binary, building small studies, finding real photographs.

mod study;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

pub use study::{Shot, StudyFolder, label_me, line, outline, small_camera, small_picture};

/// The binary under test.
pub fn aim_batch() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_aim-batch"));
    for (name, _) in std::env::vars().filter(|(name, _)| name.starts_with("AIM_BATCH_")) {
        command.env_remove(name); // what the person at the keyboard has set must not decide a test
    }
    command
}

/// Runs to the end.
pub fn run<I: AsRef<std::ffi::OsStr>>(arguments: impl IntoIterator<Item = I>) -> Output {
    aim_batch().args(arguments).output().unwrap()
}

/// Runs with `input` on stdin.
pub fn run_with_input(arguments: &[&str], input: &str) -> Output {
    use std::io::Write;
    let mut child = aim_batch()
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let input = input.to_owned();
    let writer = std::thread::spawn(move || {
        let _ = stdin.write_all(input.as_bytes()); // the program may have refused its arguments already
    });
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    output
}

pub fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Asserts the exit code; a failure shows what the program said.
#[track_caller]
pub fn assert_exit(output: &Output, code: i32) {
    let said = stderr(output);
    assert_eq!(output.status.code(), Some(code), "stderr:\n{said}");
    assert!(!said.contains("panicked"), "{said}");
}

/// The workspace's root.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// The published bench that ships with the program.
pub fn published_bench() -> PathBuf {
    root().join("data-samples/published-bench")
}

/// A folder of real photographs, or none with a word about it. AIM_BATCH_REAL_DATA names their parent; default
/// ../shared/real beside the workspace.
pub fn real_data(set: &str) -> Option<PathBuf> {
    let parent = std::env::var_os("AIM_BATCH_REAL_DATA").map_or_else(|| root().join("../shared/real"), PathBuf::from);
    let folder = parent.join(set);
    if folder.is_dir() {
        return Some(folder);
    }
    println!("skipped: no real photographs in {} (AIM_BATCH_REAL_DATA)", folder.display());
    None
}

/// Copies a folder with everything in it.
pub fn copy_folder(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            copy_folder(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).unwrap();
        }
    }
}

/// All files below a folder with their bytes.
pub fn files_below(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(files_below(&path));
        } else {
            let bytes = std::fs::read(&path).unwrap();
            files.insert(path, bytes);
        }
    }
    files
}
