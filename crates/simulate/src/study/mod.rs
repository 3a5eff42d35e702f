//! The files of a study: its folder, the names of its images, marks in LabelMe's format, and tables as CSV.

mod folder;
mod labelme;
mod object_row;
mod simulated;

pub use folder::StudyFolder;
pub use labelme::{LabeledLine, labelme_json};
pub use object_row::ObjectRow;
pub use simulated::{Simulated, Summary};

use jiff::Timestamp;
use model::UtcNs;

use crate::error::SimulateError;

/// The stem of an image's file name, which is the time when it was taken, such as `20210301T150010.250Z`.
///
/// # Errors
/// [`SimulateError::Time`] for a time outside the calendar.
pub fn image_stem(time: UtcNs) -> Result<String, SimulateError> {
    let timestamp = Timestamp::from_nanosecond(i128::from(time.0));
    let timestamp = timestamp.map_err(|_| SimulateError::Time { nanoseconds: time.0 })?;
    Ok(timestamp.strftime("%Y%m%dT%H%M%S%.3fZ").to_string())
}
