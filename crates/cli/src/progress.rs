//! Progress bars, on a terminal only.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use indicatif::{HumanBytes, MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use ingest::IngestProgress;
use model::{SessionStatus, Stage};
use pipeline::Reporter;

/// The bars of one command: an overall one, and a line per session at work. indicatif shows nothing where stderr is no
/// terminal.
#[derive(Clone)]
pub struct Bars {
    all: MultiProgress,
    overall: ProgressBar,
    sessions: Arc<Mutex<HashMap<String, SessionLine>>>,
}

struct SessionLine {
    bar: ProgressBar,
    bytes: u64,
    read: u64,
}

impl Bars {
    /// Bars on stderr; none with `quiet`.
    pub fn new(quiet: bool) -> Self {
        let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        Self { all: MultiProgress::with_draw_target(target), overall: ProgressBar::hidden(), sessions: Arc::default() }
    }

    /// Runs `write` with the bars out of the way.
    pub fn above<R>(&self, write: impl FnOnce() -> R) -> R {
        self.all.suspend(write)
    }

    /// A single bar that counts `what` up to `total`; it takes the number done and the total.
    pub fn counter(&self, what: &'static str) -> impl Fn(u64, u64) + Sync + use<> {
        let bar = self.all.add(ProgressBar::no_length());
        bar.set_style(style("{msg} [{bar:40}] {pos}/{len} {eta}"));
        bar.set_message(what);
        move |done, total| {
            bar.set_length(total);
            bar.set_position(done);
            if done >= total {
                bar.finish_and_clear();
            }
        }
    }

    /// As a run's reporter.
    pub fn for_run(&self) -> Self {
        let overall = self.all.add(ProgressBar::no_length());
        overall.set_style(style("sessions [{bar:40}] {pos}/{len} {msg} {eta}"));
        overall.enable_steady_tick(Duration::from_millis(250));
        Self { overall, ..self.clone() }
    }

    fn with_line(&self, session: &str, change: impl FnOnce(&mut SessionLine)) {
        let mut lines = self.sessions.lock().unwrap_or_else(PoisonError::into_inner);
        let line = lines.entry(session.to_owned()).or_insert_with(|| {
            let bar = self.all.add(ProgressBar::new_spinner());
            bar.set_style(style("  {spinner} {prefix}: {msg}"));
            bar.set_prefix(session.to_owned());
            SessionLine { bar, bytes: 0, read: 0 }
        });
        change(line);
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

impl Reporter for Bars {
    fn begin(&self, sessions: usize) {
        self.overall.set_length(sessions as u64);
    }

    fn stage(&self, session: &str, stage: Stage) {
        self.with_line(session, |line| line.bar.set_message(stage.meaning()));
    }

    fn bytes_to_read(&self, session: &str, bytes: u64) {
        self.with_line(session, |line| (line.bytes, line.read) = (bytes, 0));
    }

    fn bytes_read(&self, session: &str, bytes: u64) {
        self.with_line(session, |line| {
            line.read += bytes;
            line.bar.set_message(format!(
                "reading {} of {}",
                HumanBytes(line.read.min(line.bytes)),
                HumanBytes(line.bytes)
            ));
            line.bar.tick();
        });
    }

    fn done(&self, status: &SessionStatus) {
        let mut lines = self.sessions.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(line) = lines.remove(&status.session) {
            line.bar.finish_and_clear();
            self.all.remove(&line.bar);
        }
        self.overall.inc(1);
        if Some(self.overall.position()) == self.overall.length() {
            self.overall.finish_and_clear();
        }
    }
}

impl IngestProgress for Bars {
    fn begin(&self, bytes: u64) {
        self.bytes_to_read("card", bytes);
    }

    fn advance(&self, bytes: u64) {
        self.bytes_read("card", bytes);
    }
}
