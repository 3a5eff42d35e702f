//! A small study of many sessions, and runs of it.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use model::{SessionStatus, Severity};
use serde_json::Value;
use tempfile::TempDir;

use crate::support::{aim_batch, assert_exit, run};

/// A simulated study in a temporary folder, and where its results go.
pub struct Bench {
    folder: TempDir,
}

/// Bytes of the results and of the ledger.
#[derive(PartialEq, Eq)]
pub struct Files(pub Vec<u8>, pub Vec<u8>);

impl std::fmt::Debug for Files {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} and {} bytes", self.0.len(), self.1.len())
    }
}

impl Bench {
    pub const SESSIONS: usize = 6;

    /// Six whole sessions of six images.
    pub fn new() -> Self {
        Self::with(&[])
    }

    /// Likewise, but for these options of the preset.
    pub fn with(options: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let study = folder.path().join("study");
        let default = [("--image-size", "64x48"), ("--images", "6"), ("--sessions", "6"), ("--damage", "0")];
        let default = default.iter().filter(|(name, _)| options.iter().all(|(other, _)| other != name));
        let options = default.chain(options).flat_map(|(name, value)| [*name, *value]);
        let made = ["simulate", "large", "-o", study.to_str().unwrap()];
        assert_exit(&run(made.into_iter().chain(options)), 0);
        Self { folder }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn study(&self) -> PathBuf {
        self.path("study")
    }

    /// Where results go, in a folder of their own.
    pub fn out(&self) -> PathBuf {
        self.path("out/results.parquet")
    }

    pub fn work(&self) -> PathBuf {
        self.path("out/results.work")
    }

    pub fn mcap(&self, session: &str) -> PathBuf {
        self.work().join(format!("mcap/{session}.mcap"))
    }

    /// How many recordings are whole.
    pub fn recordings(&self) -> usize {
        let files = std::fs::read_dir(self.work().join("mcap")).into_iter().flatten().flatten();
        files.filter(|file| file.path().extension().is_some_and(|extension| extension == "mcap")).count()
    }

    /// `aim-batch run` of the study.
    pub fn command(&self) -> Command {
        let mut command = aim_batch();
        command.arg("run").arg(self.study()).arg("--out").arg(self.out()).current_dir(self.folder.path());
        command
    }

    /// `aim-batch status` of it; gives what it prints.
    #[track_caller]
    pub fn status(&self, options: &[&str]) -> String {
        let output = aim_batch().arg("status").arg(self.study()).arg("--out").arg(self.out()).args(options).output();
        let output = output.unwrap();
        assert_exit(&output, 0);
        crate::support::stdout(&output)
    }

    pub fn run(&self) -> Output {
        self.run_with(&[])
    }

    pub fn run_with(&self, options: &[&str]) -> Output {
        self.command().args(options).output().unwrap()
    }

    /// Runs well; gives what came out.
    #[track_caller]
    pub fn run_well(&self) -> Files {
        assert_exit(&self.run(), 0);
        self.files()
    }

    /// Started, and left alone.
    pub fn start(&self, options: &[&str], environment: &[(&str, &str)]) -> Child {
        let mut command = self.command();
        command.args(options).envs(environment.iter().copied()).stdout(Stdio::null()).stderr(Stdio::piped());
        command.spawn().unwrap()
    }

    pub fn files(&self) -> Files {
        let frames = self.out().with_file_name("frames.parquet");
        Files(std::fs::read(self.out()).unwrap(), std::fs::read(frames).unwrap())
    }

    /// The files of an undisturbed run of the study as it is now, in a work folder of its own.
    #[track_caller]
    pub fn undisturbed(&self) -> Files {
        let out = self.path("undisturbed/results.parquet");
        let _ = std::fs::remove_dir_all(self.path("undisturbed"));
        let output = run(["run", self.study().to_str().unwrap(), "--out", out.to_str().unwrap()]);
        assert_exit(&output, output.status.code().unwrap());
        let frames = out.with_file_name("frames.parquet");
        Files(std::fs::read(&out).unwrap(), std::fs::read(frames).unwrap())
    }

    pub fn statuses(&self) -> Vec<SessionStatus> {
        report::Results::read(&self.out()).unwrap().metadata.sessions
    }

    /// Sessions that lost something, with the codes.
    pub fn losses(&self) -> Vec<(String, Vec<String>)> {
        let of = |status: SessionStatus| {
            let losses = status.problems.iter().filter(|problem| problem.severity == Severity::Loss);
            (status.session.clone(), losses.map(|problem| problem.code.code().to_owned()).collect::<Vec<_>>())
        };
        self.statuses().into_iter().map(of).filter(|(_, codes)| !codes.is_empty()).collect()
    }

    /// Sessions for which ingest, signals and measuring were done in the last run that wrote results.
    pub fn done(&self) -> [u64; 3] {
        let text = std::fs::read(self.out().with_file_name("run.json")).unwrap();
        let log: Value = serde_json::from_slice(&text).unwrap();
        [0, 1, 2].map(|stage| log["times"]["stages"][stage]["done"].as_u64().unwrap())
    }

    /// A file of the study, by its place there.
    pub fn edit(&self, file: &str, change: impl FnOnce(String) -> String) {
        let path = self.study().join(file);
        let text = std::fs::read_to_string(&path).unwrap();
        let changed = change(text.clone());
        assert_ne!(text, changed);
        std::fs::write(path, changed).unwrap();
    }

    pub fn card_file(&self, session: &str, folder: &str) -> PathBuf {
        let mut files: Vec<PathBuf> = std::fs::read_dir(self.study().join("cards").join(session).join(folder))
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .collect();
        files.sort();
        files.swap_remove(0)
    }

    /// Files that somebody began and nobody finished.
    pub fn leftovers(&self) -> Vec<String> {
        let files = crate::support::files_below(&self.path("out"));
        let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
        let is_left =
            |name: &String| name.ends_with(".partial") || name.ends_with("-part") || name.ends_with("-journal");
        files.keys().map(name).filter(is_left).collect()
    }
}

/// Changes one byte in the middle of a file, keeping its size.
pub fn flip_byte(path: &Path) {
    let mut bytes = std::fs::read(path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 0xff;
    std::fs::write(path, bytes).unwrap();
}

/// Sends a signal, by its name without SIG.
pub fn signal(child: &Child, name: &str) {
    let sent = Command::new("sh").arg("-c").arg(format!("kill -{name} {}", child.id())).status().unwrap();
    assert!(sent.success());
}

/// Waits until the child tells its name in the lock of the work folder.
pub fn wait_for_lock(bench: &Bench, child: &Child) {
    let lock = bench.work().join("lock");
    let own = format!("process {} ", child.id());
    for _ in 0..1_000 {
        if std::fs::read_to_string(&lock).is_ok_and(|text| text.contains(&own)) {
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("the run has not begun in 10 s");
}
