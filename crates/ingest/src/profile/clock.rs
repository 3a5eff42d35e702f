//! The meaning of a clock's numbers.

use serde::{Deserialize, Serialize};

/// Unit of a time.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TimeUnit {
    /// Seconds.
    #[default]
    S,
    /// Milliseconds.
    Ms,
    /// Microseconds.
    Us,
    /// Nanoseconds.
    Ns,
}

impl TimeUnit {
    /// Nanoseconds in one unit, as a power of ten.
    #[must_use]
    pub fn power_of_ten_ns(self) -> u32 {
        match self {
            Self::S => 9,
            Self::Ms => 6,
            Self::Us => 3,
            Self::Ns => 0,
        }
    }

    /// After how many ns a counter of so many bits starts anew.
    #[must_use]
    pub fn wrap_ns(self, bits: Option<u32>) -> Option<i128> {
        bits.map(|bits| (1_i128 << bits.min(63)) * i128::from(self.ns()))
    }

    /// Nanoseconds in one unit.
    #[must_use]
    pub fn ns(self) -> i64 {
        10_i64.pow(self.power_of_ten_ns())
    }
}

/// The zero of a time.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Epoch {
    /// 1970-01-01 00:00 UTC.
    #[default]
    Unix,
    /// 1970-01-01 00:00 on the wall clock of the study's time zone: local time written as if it were UTC.
    Local,
    /// As `local`, but by the offset that held when the recording began: the device knows no summer time.
    LocalAtStart,
    /// When the device was started: `[clock] anchor` says when that was.
    Boot,
}

/// `[clock]`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClockSpec {
    /// When the counter of a clock with epoch `boot` was zero.
    pub anchor: Anchor,
}

/// When a boot-relative clock was zero.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "from", rename_all = "snake_case", deny_unknown_fields)]
pub enum Anchor {
    /// `clock_zero_utc` of session.toml.
    Session {},
    /// The name of each sensor file.
    Name {
        /// strptime pattern of the name, as for images.
        pattern: String,
    },
}
