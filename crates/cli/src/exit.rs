//! Exit codes: 0 all well, 1 failed, 2 usage or configuration, 3 finished with losses, 128 + N stopped by signal N.

use std::io::{ErrorKind, Write};
use std::process::ExitCode;

/// How a command ended.
pub enum Outcome {
    /// All well.
    Well,
    /// Finished, but something was lost, which has been told.
    WithLosses,
}

/// Why a command did not finish.
pub enum Failure {
    /// The command line or a configuration file must be changed.
    Usage(anyhow::Error),
    /// A signal of that number came.
    Stopped(usize, anyhow::Error),
    /// Anything else.
    Failed(anyhow::Error),
}

impl<E: Into<anyhow::Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Failed(error.into())
    }
}

impl Failure {
    /// For `map_err`: what the user can mend on the command line or in a configuration file.
    pub fn usage(error: impl Into<anyhow::Error>) -> Self {
        Self::Usage(error.into())
    }
}

/// Tells what failed, and gives the code.
pub fn finish(outcome: Result<Outcome, Failure>) -> ExitCode {
    match outcome {
        Ok(Outcome::Well) => ExitCode::SUCCESS,
        Ok(Outcome::WithLosses) => ExitCode::from(3),
        Err(Failure::Usage(error)) => tell(&error, 2),
        Err(Failure::Stopped(signal, error)) => tell(&error, u8::try_from(128 + signal).unwrap_or(u8::MAX)),
        Err(Failure::Failed(error)) if is_broken_pipe(&error) => ExitCode::SUCCESS, // `aim-batch ... | head`
        Err(Failure::Failed(error)) => tell(&error, 1),
    }
}

fn tell(error: &anyhow::Error, code: u8) -> ExitCode {
    let mut text = format!("error: {error}\n");
    for cause in error.chain().skip(1) {
        // Libraries that print their source in their own message would otherwise say it twice.
        if !text.contains(&cause.to_string()) {
            text.push_str(&format!("  because: {cause}\n"));
        }
    }
    // Nothing is left to be done when stderr is closed.
    let _ = std::io::stderr().write_all(text.as_bytes());
    ExitCode::from(code)
}

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
