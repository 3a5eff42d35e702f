//! The progress that an ingest reports to its caller, and the caller's requests. Drawing is the caller's.

use std::sync::{Condvar, Mutex, PoisonError};

/// Told how far the ingest of one session is; asked whether to go on, and for room in memory. Called from the threads that
/// ingest.
pub trait IngestProgress: Sync {
    /// Before a pass over the card: `bytes` are in the files of this session. Hashing and ingest are a pass each.
    fn begin(&self, bytes: u64);

    /// `bytes` more have been read. The sum passes `begin`'s figure when one file holds two streams and is read twice.
    fn advance(&self, bytes: u64);

    /// Whether to stop soon, with [`IngestError::Stopped`](crate::IngestError::Stopped) and nothing written.
    fn is_stopped(&self) -> bool {
        false
    }

    /// Bound of all images in memory at once, shared by the sessions at work.
    fn image_budget(&self) -> Option<&ByteBudget> {
        None
    }
}

/// Tells nobody, never stops, has no bounds.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoProgress;

impl IngestProgress for NoProgress {
    fn begin(&self, _bytes: u64) {}

    fn advance(&self, _bytes: u64) {}
}

/// A number of bytes that several threads share: who wants more than is left waits until others give back.
#[derive(Debug)]
pub struct ByteBudget {
    total: u64,
    left: Mutex<u64>,
    given_back: Condvar,
}

/// Bytes taken from a budget, given back when this is dropped.
#[derive(Debug)]
pub struct Taken<'a> {
    budget: &'a ByteBudget,
    bytes: u64,
}

impl ByteBudget {
    /// A budget of so many bytes.
    #[must_use]
    pub fn new(total: u64) -> Self {
        Self { total, left: Mutex::new(total), given_back: Condvar::new() }
    }

    /// Takes bytes, waiting for them if need be. Who asks for more than there is in all gets all: one image is always let
    /// through.
    pub fn take(&self, bytes: u64) -> Taken<'_> {
        let bytes = bytes.min(self.total);
        let left = self.left.lock().unwrap_or_else(PoisonError::into_inner);
        let mut left = self.given_back.wait_while(left, |left| *left < bytes).unwrap_or_else(PoisonError::into_inner);
        *left -= bytes;
        Taken { budget: self, bytes }
    }
}

impl Drop for Taken<'_> {
    fn drop(&mut self) {
        *self.budget.left.lock().unwrap_or_else(PoisonError::into_inner) += self.bytes;
        self.budget.given_back.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};

    use super::*;

    #[test]
    fn no_more_than_the_budget_is_out_at_once() {
        let budget = ByteBudget::new(100);
        let (out, most) = (AtomicU64::new(0), AtomicU64::new(0));
        std::thread::scope(|scope| {
            for thread in 0..8_u64 {
                let (budget, out, most) = (&budget, &out, &most);
                scope.spawn(move || {
                    for round in 0..200 {
                        let bytes = 1 + (thread * 31 + round * 17) % 60;
                        let _taken = budget.take(bytes);
                        most.fetch_max(out.fetch_add(bytes, Ordering::SeqCst) + bytes, Ordering::SeqCst);
                        out.fetch_sub(bytes, Ordering::SeqCst);
                    }
                });
            }
        });
        let most = most.into_inner();
        assert!((1..=100).contains(&most), "{most}");
        assert_eq!(budget.left.into_inner().unwrap_or_default(), 100);
    }

    #[test]
    fn more_than_all_is_all() {
        let budget = ByteBudget::new(10);
        drop(budget.take(1_000));
        assert_eq!(budget.take(10).bytes, 10);
    }
}
