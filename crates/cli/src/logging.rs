//! Writes the log events of the libraries to stderr.

use std::io::{self, Write};

use clap::ValueEnum;
use tracing_subscriber::Layer;
use tracing_subscriber::filter::{LevelFilter, Targets};
use tracing_subscriber::fmt::MakeWriter;
use tracing_subscriber::layer::SubscriberExt;
use tracing_subscriber::util::SubscriberInitExt;

use crate::progress::Bars;

/// The form of the log.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LogFormat {
    /// Lines for people
    Text,
    /// One JSON object per line
    Json,
}

/// Starts logging. Errors are always written, warnings and information with `-v` (`verbose` 1) and always as JSON, and
/// debugging with `-vv`.
///
/// The problems of sessions are warnings: `run` lists them at its end for people, and the log has them for programs.
pub fn start(verbose: u8, format: LogFormat, bars: &Bars) {
    let level = match (verbose, format) {
        (0, LogFormat::Text) => LevelFilter::ERROR,
        (0, LogFormat::Json) | (1, _) => LevelFilter::INFO,
        _ => LevelFilter::DEBUG,
    };
    // The events of foreign libraries are of no use to people who measure plates, unless they are errors.
    let ours = Targets::new()
        .with_target("aim_batch", level)
        .with_target("aim_batch::progress", LevelFilter::INFO) // --quiet makes none
        .with_default(LevelFilter::ERROR);
    let lines = tracing_subscriber::fmt::layer().with_writer(AboveBars(bars.clone()));
    let registry = tracing_subscriber::registry();
    match format {
        LogFormat::Text => {
            let ansi = io::IsTerminal::is_terminal(&io::stderr());
            registry.with(lines.without_time().with_target(false).with_ansi(ansi).with_filter(ours)).init();
        }
        LogFormat::Json => registry.with(lines.json().with_filter(ours)).init(),
    }
}

/// A writer to stderr that writes above the progress bars, so that neither spoils the other.
struct AboveBars(Bars);

impl<'a> MakeWriter<'a> for AboveBars {
    type Writer = AboveBarsWriter<'a>;

    fn make_writer(&'a self) -> Self::Writer {
        AboveBarsWriter(&self.0)
    }
}

struct AboveBarsWriter<'a>(&'a Bars);

impl Write for AboveBarsWriter<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.above(|| io::stderr().write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        io::stderr().flush()
    }
}
