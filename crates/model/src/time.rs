//! Times in UTC, the one clock that everything after ingest uses.

use serde::{Deserialize, Serialize};

/// A time in nanoseconds since 1970-01-01T00:00:00 UTC (POSIX, no leap seconds). A device's own stamp becomes such a time
/// only through the clock that its profile declares.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct UtcNs(pub i64);

impl UtcNs {
    /// Seconds from `earlier` to `self`; negative when `self` is the earlier of the two.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a difference of 100 days still resolves 1 ns in 53 bits")]
    pub fn seconds_since(self, earlier: Self) -> f64 {
        self.0.saturating_sub(earlier.0) as f64 * 1e-9
    }

    /// The time that is `seconds` later, rounded to 1 ns. It saturates at the ends of the range, in the years 1677 and 2262.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the float-to-integer cast saturates")]
    pub fn plus_seconds(self, seconds: f64) -> Self {
        Self(self.0.saturating_add((seconds * 1e9).round() as i64))
    }
}
