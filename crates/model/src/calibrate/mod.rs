//! Calibration of a device's biases on a bench with known sizes.
//!
//! There are two ways, for two sorts of data. Raw readings and marks give [`physical`] corrections, of the mount, the range
//! sensor and the focal length, for all methods that are exact. Table rows alone give [`empirical`] ones: the paper's sizes are
//! wrong by a factor a + b tan(pitch), which is the same for all objects of a setup.

pub mod empirical;
pub mod held_out;
pub mod physical;
pub mod protractor;
