//! The wish to stop, from outside (a signal) or from inside.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// The wish to stop, shared by all threads of a command. It stays set once it is.
#[derive(Debug, Clone, Default)]
pub struct Stop {
    signal: Arc<AtomicUsize>,
    inside: Arc<AtomicBool>,
}

impl Stop {
    /// The place where a signal handler stores the signal's number; 0 means none.
    #[must_use]
    pub fn signal_slot(&self) -> Arc<AtomicUsize> {
        Arc::clone(&self.signal)
    }

    /// The number of the signal that came, if one did.
    #[must_use]
    pub fn signal(&self) -> Option<usize> {
        Some(self.signal.load(Ordering::SeqCst)).filter(|number| *number != 0)
    }

    /// Asks to stop for a reason of the program's own.
    pub fn set(&self) {
        self.inside.store(true, Ordering::SeqCst);
    }

    /// Whether to stop.
    #[must_use]
    pub fn is_set(&self) -> bool {
        self.inside.load(Ordering::Relaxed) || self.signal.load(Ordering::Relaxed) != 0
    }
}
