//! Ground truth -> a study on disk: renderer and sensor models.
//!
//! A *preset* decides what was seen and read; the rest of the crate turns that into the files of a study:
//! - [`scene`]: a container on a table, and what a ray meets there;
//! - [`render`]: a scene and a camera at a pose -> a picture;
//! - [`sensors`]: the motion of a head -> packets of an accelerometer and of a range sensor;
//! - [`study`]: the folder, its images' names, marks in LabelMe's format;
//! - [`trial`]: sizes measured through erring sensors, without pictures: accuracy and coverage of uncertainties;
//! - [`published`]: the preset `published-bench`, the paper's bench rebuilt from its published readings;
//! - [`large`]: the preset `large`, many sessions for load tests;
//! - [`world`]: laid tables by ray casting, with soft light, blur and noise;
//! - [`laid`]: the presets `bench` and `worn` made of them.
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
