//! SD card -> one MCAP file per session, and MCAP -> typed streams.
//!
//! - [`profile`]: what a device writes on its card, declared in a versioned TOML file; [`camera`]: likewise its camera.
//! - [`parse`]: packets, CSV, image times and image headers. No I/O: byte slices and [`std::io::Read`] only.
//! - [`card`]: finds and reads the files of a card, and hashes the bytes as they are read.
//! - [`ingest_session`] writes the MCAP file ([`survey_session`] one without pictures, to look before a run); [`SessionReader`] streams it back in bounded memory.
//!
//! # Conventions
//! - Times are [`model::UtcNs`]: a device's stamp becomes one only as its profile declares.
//! - Device frame: x right, y down, z forward. Acceleration is specific force in g: at rest and upright, y reads -1.
//! - The range is the sensor's own reading in mm, its codes (8190, 8191: no target) included.
//! - A bad file never stops a session: what is lost becomes a [`model::Problem`] or a [`DroppedImage`].
//!
//! `docs/devices.md` describes the profile, the camera file and the layout of the MCAP file.
//!
//! # Example
//! ```no_run
//! use aim_batch_ingest::{NoProgress, Profile, SessionReader, SessionSource, camera, ingest_session};
//! use std::path::Path;
//!
//! let devices = Path::new("study/devices");
//! let source = SessionSource {
//!     session: "P01".to_owned(),
//!     card_dir: "study/cards/P01".into(),
//!     profile: Profile::load("aim2-packets", devices)?,
//!     camera_spec: camera::load("aim2-raw", devices)?,
//!     time_zone: jiff::tz::TimeZone::UTC,
//!     clock_zero_utc: None,
//!     program: "example 1.0".to_owned(),
//! };
//! let summary = ingest_session(&source, Path::new("P01.mcap"), &NoProgress)?;
//! println!("{} images, {} problems", summary.images, summary.problems.len());
//!
//! let mut session = SessionReader::open(Path::new("P01.mcap"))?;
//! for image in session.images()? {
//!     println!("{} {}", image.time.0, image.file);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![warn(missing_docs)]

mod annotate;
pub mod camera;
pub mod card;
pub mod config;
mod devices;
mod error;
mod fingerprint;
mod ingest;
mod key;
mod mcap_file;
pub mod parse;
mod picture;
pub mod profile;
mod progress;
mod read;
mod sample;
mod source;
mod summary;
mod thumbnail;
pub mod timeline;
mod unicode;

pub use annotate::{
    AnnotateError, Annotating, ImageNotes, LogLevel, LogNote, MarkNote, annotate_session, annotated_key,
};
pub use card::UNREADABLE;
pub use config::ConfigError;
pub use error::IngestError;
pub use fingerprint::{FileStamp, Fingerprint};
pub use ingest::{Ingested, ingest_if_changed, ingest_session, survey_session};
pub use key::{CardFingerprinter, INGEST_VERSION, inputs_key};
pub use mcap_file::{WriteError, is_partial};
pub use picture::{JpegError, Picture, PictureError};
pub use profile::Profile;
pub use progress::{ByteBudget, IngestProgress, NoProgress};
pub use read::{ReadError, SessionMetadata, SessionReader, ingest_is_current};
pub use sample::Sample;
pub use source::SessionSource;
pub use summary::{Counts, DroppedImage, ImageEntry, IngestSummary};
pub use thumbnail::{Thumbnail, thumbnail};
pub use unicode::{nfc, spelled_out};
