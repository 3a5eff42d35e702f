//! Makes studies with known truth: from a scene to a study on disk, with a renderer and models of sensors.
//!
//! A *preset* decides which things the camera sees and which values the sensors read. The rest of the crate turns that into the
//! files of a study:
//! - [`scene`]: a container on a table, and the surfaces that a ray meets there;
//! - [`render`]: pictures of a scene by a camera at a pose;
//! - [`sensors`]: the packets of an accelerometer and of a range sensor on a moving head;
//! - [`study`]: the folder of a study, the names of its images, and marks in LabelMe's format;
//! - [`trial`]: sizes that are measured through erring sensors, without pictures: accuracy, and coverage of uncertainties;
//! - [`published`]: the preset `published-bench`, the paper's bench rebuilt from its published readings;
//! - [`large`]: the preset `large`, with many sessions, for load tests;
//! - [`world`]: laid tables by ray casting, with soft light, blur and noise;
//! - [`laid`]: the presets `bench` and `worn`, which show such tables.
//!
//! ```no_run
//! use aim_batch_simulate::published::{Options, published_bench};
//!
//! published_bench(std::path::Path::new("bench"), &Options::default(), &|_done, _total| {})?;
//! # Ok::<(), aim_batch_simulate::SimulateError>(())
//! ```
#![warn(missing_docs)]

mod error;
pub mod laid;
pub mod large;
pub mod published;
pub mod render;
pub mod scene;
pub mod sensors;
pub mod study;
pub mod trial;
pub mod world;

pub use error::SimulateError;
pub use large::{LargeOptions, large};
pub use published::{Options, published_bench};
pub use study::{Simulated, Summary};
