//! The files of an SD card: which there are, and their bytes with a SHA-256 of the same bytes.

mod decoder;
mod hashing;
mod image_file;
mod patterns;
mod place;
mod sensor_files;
mod stream;
mod walk;

pub use patterns::{PatternError, Patterns};
pub use walk::{Card, CardFile};

pub(crate) use decoder::Layout;
pub(crate) use hashing::{Inputs, open_hashing};
pub(crate) use image_file::{LARGEST_IMAGE_BYTES, TakenImage, read_image};
pub(crate) use place::Place;
pub(crate) use sensor_files::Anchoring;
pub(crate) use stream::Stream;
