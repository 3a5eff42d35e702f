//! A Python that stays, so that its start is not timed.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

pub struct Python {
    child: Child,
    questions: ChildStdin,
    answers: BufReader<ChildStdout>,
    /// The line that the script prints when it is ready.
    pub says: String,
}

impl Python {
    /// Starts a script of this folder. None, with a word about it, where the modules that it needs are not to be had.
    pub fn start(script: &str, needs: &str) -> Option<Self> {
        let program = std::env::var_os("AIM_BATCH_PYTHON").unwrap_or_else(|| "python3".into());
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches").join(script);
        let started = Command::new(&program).arg(script).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = started.ok()?;
        let questions = child.stdin.take()?;
        let mut python = Self { answers: BufReader::new(child.stdout.take()?), child, questions, says: String::new() };
        match python.line().trim().strip_prefix("ready") {
            Some(says) => python.says = says.trim().to_owned(),
            None => {
                println!("skipped: {} has no {needs} (AIM_BATCH_PYTHON names another)", program.display());
                return None;
            }
        }
        Some(python)
    }

    /// Lets the script work on a file; the number that it answers.
    pub fn ask(&mut self, how: &str, file: &Path) -> i64 {
        writeln!(self.questions, "{how} {}", file.display()).unwrap();
        self.line().trim().parse().unwrap()
    }

    fn line(&mut self) -> String {
        let mut line = String::new();
        self.answers.read_line(&mut line).unwrap();
        line
    }
}

impl Drop for Python {
    fn drop(&mut self) {
        drop(self.child.kill().and_then(|()| self.child.wait()));
    }
}
