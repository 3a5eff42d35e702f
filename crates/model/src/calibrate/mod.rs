//! Learning a device's biases from a bench with known sizes.
//!
//! Two ways, for two sorts of data. With raw readings and marks, [`physical`] corrections: what the mount, the range sensor and
//! the focal length are off by, for all methods that are exact. With table rows only, [`empirical`] ones: the paper's sizes are
//! off by a factor a + b tan(pitch), the same for all objects of a setup.

pub mod empirical;
pub mod held_out;
pub mod physical;
pub mod protractor;
