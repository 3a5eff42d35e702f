//! The progress of a run, in numbers.

use std::collections::HashMap;
use std::time::{Duration, Instant};

use indicatif::{HumanBytes, HumanCount, HumanDuration};
use model::SessionStatus;
use pipeline::Totals;

/// The progress of a run.
#[derive(Debug)]
pub struct Counts {
    totals: Totals,
    start: Instant,
    done: usize,
    failed: usize,
    images: usize,
    with_pose: usize,
    bytes_read: u64,
    at_work: HashMap<String, Card>,
}

/// The progress of reading one session's card.
#[derive(Debug, Default)]
struct Card {
    bytes: u64,
    read: u64,
}

impl Counts {
    /// The progress at the beginning of a run.
    pub fn new(totals: &Totals) -> Self {
        Self {
            totals: *totals,
            start: Instant::now(),
            done: 0,
            failed: 0,
            images: 0,
            with_pose: 0,
            bytes_read: 0,
            at_work: HashMap::new(),
        }
    }

    /// Notes that a session has so many bytes to be read. A second pass over a card adds nothing to the first.
    pub fn bytes_to_read(&mut self, session: &str, bytes: u64) {
        self.at_work.entry(session.to_owned()).or_default().bytes = bytes;
    }

    /// Notes that so many more bytes of a session have been read. Returns the bytes that are read and all bytes of the session.
    pub fn bytes_read(&mut self, session: &str, bytes: u64) -> (u64, u64) {
        let card = self.at_work.entry(session.to_owned()).or_default();
        let counted = bytes.min(card.bytes.saturating_sub(card.read));
        card.read += counted;
        self.bytes_read += counted;
        (card.read, card.bytes)
    }

    /// Notes that a session is done.
    pub fn done(&mut self, status: &SessionStatus) {
        self.done += 1;
        self.failed += usize::from(status.failed);
        self.images += status.images;
        self.with_pose += status.with_pose;
        if let Some(card) = self.at_work.remove(&status.session) {
            self.bytes_read += card.bytes - card.read;
        }
    }

    /// Position and length of the bar: in bytes where they are known, else in sessions.
    pub fn position(&self) -> (u64, u64) {
        match self.totals.bytes {
            Some(bytes) if bytes > 0 => (self.bytes_read.min(bytes), bytes),
            _ => (self.done as u64, self.to_do() as u64),
        }
    }

    /// Whether all sessions are done.
    pub fn is_over(&self) -> bool {
        self.done >= self.to_do()
    }

    fn to_do(&self) -> usize {
        self.totals.sessions - self.totals.kept
    }

    /// The time that is left, at the pace so far; none before any progress.
    fn left(&self) -> Option<Duration> {
        let (position, length) = self.position();
        #[expect(clippy::cast_precision_loss, reason = "a ratio for a person")]
        let ratio = (position > 0).then(|| (length - position) as f64 / position as f64)?;
        Duration::try_from_secs_f64(self.start.elapsed().as_secs_f64() * ratio).ok()
    }

    /// The numbers of sessions and images as text, short enough for a bar.
    pub fn short(&self) -> String {
        let kept = if self.totals.kept > 0 { format!(" ({} kept)", self.totals.kept) } else { String::new() };
        format!(
            "{}/{} sessions{kept}, images {} with a pose {} without, {} failed",
            self.done + self.totals.kept,
            self.totals.sessions,
            HumanCount(self.with_pose as u64),
            HumanCount((self.images - self.with_pose) as u64),
            self.failed,
        )
    }

    /// The progress as one line for a log.
    pub fn line(&self) -> String {
        let (position, length) = self.position();
        let bytes = match self.totals.bytes {
            Some(bytes) if bytes > 0 => format!(", {} of {} read", HumanBytes(position), HumanBytes(length)),
            _ => String::new(),
        };
        let left = self.left().map(|left| format!(", about {} left", HumanDuration(left))).unwrap_or_default();
        format!("{}{bytes}{left}", self.short())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(bytes: Option<u64>) -> Counts {
        Counts::new(&Totals { sessions: 10, kept: 4, bytes })
    }

    fn done(session: &str, failed: bool) -> SessionStatus {
        SessionStatus { session: session.to_owned(), failed, images: 1_200, with_pose: 1_100, ..Default::default() }
    }

    #[test]
    fn a_card_counts_once_however_often_it_is_read() {
        let mut counts = counts(Some(600));
        counts.bytes_to_read("a", 100);
        assert_eq!(counts.bytes_read("a", 70), (70, 100));
        counts.bytes_to_read("a", 100);
        assert_eq!(counts.bytes_read("a", 70), (100, 100));
        assert_eq!(counts.position(), (100, 600));
        counts.bytes_to_read("b", 100);
        counts.done(&done("b", true));
        assert_eq!(counts.position(), (200, 600), "what is not read of a failed session is not waited for");
        assert_eq!(counts.short(), "5/10 sessions (4 kept), images 1,100 with a pose 100 without, 1 failed");
    }

    #[test]
    fn without_bytes_sessions_are_counted() {
        let mut counts = counts(None);
        assert_eq!(counts.position(), (0, 6));
        for name in ["a", "b", "c", "d", "e", "f"] {
            assert!(!counts.is_over());
            counts.done(&done(name, false));
        }
        assert_eq!((counts.position(), counts.is_over()), ((6, 6), true));
        assert!(counts.line().ends_with("0 failed, about 0 seconds left"), "{}", counts.line());
    }
}
