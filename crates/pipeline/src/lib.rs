//! From a study on disk to rows of results.
//!
//! One session: its card is ingested to MCAP, [`signals`] turn samples into a pose for each image, frames near the target
//! pitch are selected, people's marks ([`labelme`]) become sizes, and sizes of selected frames are fused. [`run`] does this
//! for all sessions of a [`Study`] in parallel and hands the rows to a [`model::ResultSink`].
//!
//! Progress is told to a [`Reporter`]; this crate draws nothing. A session that fails becomes a status with a code, a fact
//! and a remedy; the others complete.
#![warn(missing_docs)]

mod inputs;
pub mod labelme;
mod reporter;
mod run;
mod session;
pub mod signals;
pub mod study;

pub use reporter::{Reporter, Silent};
pub use run::{RunError, RunOptions, run};
pub use session::{SessionOptions, SessionOutput, run_session};
pub use study::{Study, StudyError};
