//! Progress: bars on a terminal, a line now and then where there is none, nothing with `--quiet`.

mod counts;
mod lines;

use std::collections::HashMap;
use std::io::IsTerminal as _;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use indicatif::{HumanBytes, MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use ingest::IngestProgress;
use model::{SessionStatus, Stage};
use pipeline::{Reporter, Totals};

use counts::Counts;
use lines::Lines;

/// The progress bars of one command. indicatif shows nothing where stderr is no terminal.
#[derive(Clone)]
pub struct Bars {
    all: MultiProgress,
    quiet: bool,
}

impl Bars {
    /// Bars on stderr; none with `quiet`.
    pub fn new(quiet: bool) -> Self {
        let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        Self { all: MultiProgress::with_draw_target(target), quiet }
    }

    /// Runs `write` with the bars out of the way.
    pub fn above<R>(&self, write: impl FnOnce() -> R) -> R {
        self.all.suspend(write)
    }

    /// A function that shows a bar with the caption `what`. It takes the number done and the total.
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

    /// A bar for the bytes of one card.
    pub fn for_card(&self) -> CardBar {
        let bar = self.all.add(ProgressBar::no_length());
        bar.set_style(style("reading [{bar:40}] {bytes} of {total_bytes} {eta}"));
        CardBar(bar)
    }

    /// The reporter of a run: an overall bar, and a line for each session at work.
    pub fn for_run(&self) -> RunBars {
        let overall = self.all.add(ProgressBar::no_length());
        overall.set_style(style("[{bar:30}] {percent}% {eta} left: {msg}"));
        let counts = Arc::new(Mutex::new(Counts::new(&Totals::default())));
        let wants_lines = !self.quiet && !std::io::stderr().is_terminal();
        RunBars {
            all: self.all.clone(),
            overall,
            sessions: Mutex::default(),
            _lines: wants_lines.then(|| Lines::start(Arc::clone(&counts))),
            counts,
        }
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

/// The bar of one card.
pub struct CardBar(ProgressBar);

impl IngestProgress for CardBar {
    fn begin(&self, bytes: u64) {
        self.0.set_length(bytes);
        self.0.set_position(0);
    }

    fn advance(&self, bytes: u64) {
        self.0.inc(bytes);
    }
}

/// The bars of a run.
pub struct RunBars {
    all: MultiProgress,
    overall: ProgressBar,
    sessions: Mutex<HashMap<String, ProgressBar>>,
    counts: Arc<Mutex<Counts>>,
    _lines: Option<Lines>,
}

impl RunBars {
    fn counts(&self) -> MutexGuard<'_, Counts> {
        self.counts.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn say(&self, session: &str, text: String) {
        let mut lines = self.sessions.lock().unwrap_or_else(PoisonError::into_inner);
        let line = lines.entry(session.to_owned()).or_insert_with(|| {
            let bar = self.all.add(ProgressBar::new_spinner());
            bar.set_style(style("  {spinner} {prefix}: {msg}"));
            bar.set_prefix(session.to_owned());
            bar
        });
        line.set_message(text);
        line.tick();
    }

    fn show_overall(&self, counts: &Counts) {
        let (position, length) = counts.position();
        self.overall.set_length(length);
        self.overall.set_position(position);
        self.overall.set_message(counts.short());
        if counts.is_over() {
            self.overall.finish_and_clear();
        }
    }
}

impl Reporter for RunBars {
    fn begin(&self, totals: &Totals) {
        *self.counts() = Counts::new(totals);
        self.overall.reset();
        self.overall.enable_steady_tick(Duration::from_millis(250));
        self.show_overall(&self.counts());
    }

    fn stage(&self, session: &str, stage: Stage) {
        self.say(session, stage.meaning().to_owned());
    }

    fn bytes_to_read(&self, session: &str, bytes: u64) {
        self.counts().bytes_to_read(session, bytes);
    }

    fn bytes_read(&self, session: &str, bytes: u64) {
        let mut counts = self.counts();
        let (read, total) = counts.bytes_read(session, bytes);
        self.show_overall(&counts);
        drop(counts);
        self.say(session, format!("reading {} of {}", HumanBytes(read), HumanBytes(total)));
    }

    fn done(&self, status: &SessionStatus) {
        let mut lines = self.sessions.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(line) = lines.remove(&status.session) {
            line.finish_and_clear();
            self.all.remove(&line);
        }
        drop(lines);
        let mut counts = self.counts();
        counts.done(status);
        self.show_overall(&counts);
    }
}
