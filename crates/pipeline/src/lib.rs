//! From a study on disk to rows of results.
//!
//! In one session the card is ingested to MCAP, [`signals`] turn samples into a pose for each image, images near the target
//! pitch are selected, people's marks ([`labelme`]) become sizes, and the sizes of selected images are fused. [`run()`] does
//! this for all sessions of a [`Study`] in parallel and hands the rows to a [`model::ResultSink`].
//!
//! [`check()`] does the same without pictures and stores nothing: it tells before a run what that would lose. [`inspect`]
//! shows the content of recordings.
//!
//! Progress is reported to a [`Reporter`]; this crate draws nothing. A session that fails becomes a status with a code, a
//! fact and a remedy; the others complete.
#![warn(missing_docs)]

mod annotate;
pub mod calibrate;
pub mod calibration;
mod check;
pub mod exchange;
#[cfg(debug_assertions)]
mod fault;
mod gallery;
mod inputs;
pub mod inspect;
mod json;
pub mod labelme;
pub mod overlay;
mod parallel;
mod reporter;
mod run;
mod session;
pub mod signals;
mod stop;
pub mod study;
mod survey;
mod work;
mod write_marks;

pub use annotate::{Annotated, NotAnnotated, annotate};
pub use check::{Checked, check};
pub use gallery::{Gallery, GalleryError, GalleryHalted, GalleryOptions, NotShown, gallery};
pub use inspect::{inspect_file, inspect_study};
pub use parallel::default_jobs;
pub use reporter::{Reporter, Silent, Totals};
pub use run::{Current, Halted, Ran, RunError, RunOptions, SessionState, StudyState, run, status};
pub use stop::Stop;
pub use study::{Study, StudyError};
pub use survey::{SurveyError, SurveyOptions};
pub use work::{Holder, WorkError};
pub use write_marks::{MarksWritten, WriteMarksError, write_marks};
