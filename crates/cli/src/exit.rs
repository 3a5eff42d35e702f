//! How a command ends, and the exit code that tells it. Scripts rely on the codes: they are part of the interface.

use std::io::{ErrorKind, Write};
use std::process::ExitCode;

/// All is well.
const WELL: u8 = 0;
/// The command failed, or with `run --expect` the tables differ.
const FAILED: u8 = 1;
/// The command line or a configuration file (study.toml, a camera file) must be changed. clap exits with the same code.
const USAGE: u8 = 2;
/// The command finished, but some sessions failed or data was lost; the messages say which and why.
const LOSSES: u8 = 3;
/// To be added to a signal's number: the signal stopped the command (130 for SIGINT, 143 for SIGTERM), as shells have it.
/// All finished work is kept.
const SIGNAL: u8 = 128;

/// How a command ended.
pub enum Outcome {
    /// All is well.
    Well,
    /// The command finished, but something was lost; the messages have said what.
    WithLosses,
}

/// Why a command did not finish.
pub enum Failure {
    /// The command line or a configuration file must be changed.
    Usage(anyhow::Error),
    /// The signal of this number came.
    Stopped(usize, anyhow::Error),
    /// Any other failure.
    Failed(anyhow::Error),
}

impl<E: Into<anyhow::Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Failed(error.into())
    }
}

impl Failure {
    /// For `map_err`: the error is one that the user can mend on the command line or in a configuration file.
    pub fn usage(error: impl Into<anyhow::Error>) -> Self {
        Self::Usage(error.into())
    }
}

/// Writes to stderr what failed, and returns the exit code.
pub fn finish(outcome: Result<Outcome, Failure>) -> ExitCode {
    match outcome {
        Ok(Outcome::Well) => ExitCode::from(WELL),
        Ok(Outcome::WithLosses) => ExitCode::from(LOSSES),
        Err(Failure::Usage(error)) => fail(&error, USAGE),
        Err(Failure::Stopped(signal, error)) => fail(&error, code_of_signal(signal)),
        Err(Failure::Failed(error)) if is_broken_pipe(&error) => ExitCode::from(WELL), // `aim-batch ... | head`
        Err(Failure::Failed(error)) => fail(&error, FAILED),
    }
}

/// The exit code of a program that the signal of this number ended.
pub fn code_of_signal(signal: usize) -> u8 {
    u8::try_from(usize::from(SIGNAL) + signal).unwrap_or(u8::MAX)
}

/// Writes the error and its causes to stderr, and returns the code.
fn fail(error: &anyhow::Error, code: u8) -> ExitCode {
    let mut text = format!("error: {error}\n");
    for cause in error.chain().skip(1) {
        // An error of a library that prints its source in its own message would otherwise say it twice.
        if !text.contains(&cause.to_string()) {
            text.push_str(&format!("  because: {cause}\n"));
        }
    }
    // Nothing can be done where stderr is closed.
    let _ = std::io::stderr().write_all(text.as_bytes());
    ExitCode::from(code)
}

/// Whether the error came from a reader that has gone.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        let io = cause.downcast_ref::<std::io::Error>();
        let in_csv = cause.downcast_ref::<csv::Error>().and_then(|error| match error.kind() {
            csv::ErrorKind::Io(error) => Some(error),
            _ => None,
        });
        io.or(in_csv).is_some_and(|error| error.kind() == ErrorKind::BrokenPipe)
    })
}
