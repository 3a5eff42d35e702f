//! The files of an SD card: which there are, and their bytes with a SHA-256 of the same bytes.

mod decoder;
mod hashing;
mod image_file;
mod names;
mod patterns;
mod place;
mod sensor_files;
mod stream;
mod unread;
mod walk;

pub use names::{entry_named, exact_name_text, name_text};
pub use patterns::{PatternError, Patterns};
pub use walk::{Card, CardFile};

pub(crate) use decoder::Layout;
pub use hashing::UNREADABLE;
pub(crate) use hashing::{Inputs, open_hashing};
pub(crate) use image_file::{LARGEST_IMAGE_BYTES, Remarks, TakenImage, judge_image, read_image, too_large};
pub(crate) use place::{Place, amount, size};
pub(crate) use sensor_files::Anchoring;
pub(crate) use stream::Stream;
pub(crate) use unread::{Declared, is_housekeeping};
