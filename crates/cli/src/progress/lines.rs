//! A line of plain text every 30 s, for logs of unattended runs.

use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use super::counts::Counts;

/// Seconds between lines, unless `AIM_BATCH_PROGRESS_S` says otherwise.
const EVERY_S: f64 = 30.0;

/// A thread that writes lines until this value is dropped.
pub struct Lines {
    end: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Lines {
    /// Starts the thread.
    pub fn start(counts: Arc<Mutex<Counts>>) -> Self {
        let every = interval(std::env::var("AIM_BATCH_PROGRESS_S").ok().as_deref());
        let (end, ended) = channel();
        let write = move || {
            while ended.recv_timeout(every) == Err(RecvTimeoutError::Timeout) {
                let line = counts.lock().unwrap_or_else(PoisonError::into_inner).line();
                tracing::info!(target: "aim_batch::progress", "{line}");
            }
        };
        // Where the system gives no thread there are no lines, which is no reason not to run.
        let thread = std::thread::Builder::new().name("progress".to_owned()).spawn(write).ok();
        Self { end: Some(end), thread }
    }
}

impl Drop for Lines {
    fn drop(&mut self) {
        drop(self.end.take());
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn interval(text: Option<&str>) -> Duration {
    let seconds = text.and_then(|text| text.parse().ok()).filter(|seconds| *seconds > 0.0).unwrap_or(EVERY_S);
    Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nonsense_in_the_environment_changes_nothing() {
        for text in [None, Some(""), Some("soon"), Some("-1"), Some("NaN"), Some("0")] {
            assert_eq!(interval(text), Duration::from_secs(30), "{text:?}");
        }
        assert_eq!(interval(Some("0.5")), Duration::from_millis(500));
    }
}
