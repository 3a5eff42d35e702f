//! The errors that can occur while a study is made.

use std::path::PathBuf;

use model::{CameraSpecError, MeasureError, PoseError, ViewError};

/// Why a study could not be made.
#[derive(Debug, thiserror::Error)]
pub enum SimulateError {
    /// An option is out of range.
    #[error("{option} {got}: expected {expected}")]
    Option {
        /// Name of the option.
        option: &'static str,
        /// Its value.
        got: String,
        /// The values that are allowed.
        expected: String,
    },
    /// The output folder is not empty.
    #[error("{} is not empty: name a folder that does not exist yet, or an empty one", path.display())]
    NotEmpty {
        /// The folder.
        path: PathBuf,
    },
    /// A file or folder cannot be read or written.
    #[error("cannot {action} {}: {source}", path.display())]
    Io {
        /// The action that failed.
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// Why it failed.
        source: std::io::Error,
    },
    /// A table cannot be read or written as CSV.
    #[error("{name}: {source}")]
    Csv {
        /// The table.
        name: String,
        /// Why.
        source: csv::Error,
    },
    /// A published reading that the preset needs is absent.
    #[error("{table} has no row for '{object}' at {height_cm} cm, {pitch_deg} degrees")]
    NoReading {
        /// The table.
        table: &'static str,
        /// The object.
        object: String,
        /// The setup's height.
        height_cm: f64,
        /// The setup's pitch.
        pitch_deg: f64,
    },
    /// A camera file cannot be read.
    #[error("{name}: {source}")]
    CameraFile {
        /// The file.
        name: &'static str,
        /// Why.
        source: toml::de::Error,
    },
    /// A camera file does not describe a camera.
    #[error("{name}: {source}")]
    Camera {
        /// The file.
        name: &'static str,
        /// Why.
        source: CameraSpecError,
    },
    /// Parts of a scene file do not go together.
    #[error("{fact}")]
    Scene {
        /// The fault, with the expected and the given values.
        fact: String,
    },
    /// The camera file of a scene does not describe a camera.
    #[error("the scene's camera: {0}")]
    SceneCamera(#[source] CameraSpecError),
    /// A camera cannot be written as TOML.
    #[error("the scene's camera cannot be written as TOML: {0}")]
    CameraText(#[source] toml::ser::Error),
    /// The pose of a camera is not possible.
    #[error("{place}: {source}")]
    Pose {
        /// Session and image.
        place: String,
        /// Why.
        source: PoseError,
    },
    /// A point of an object does not appear in the picture.
    #[error("{place}: {source}")]
    View {
        /// Session and object.
        place: String,
        /// Why.
        source: ViewError,
    },
    /// A mark lies outside its picture.
    #[error("{place}: the mark at ({x:.1}, {y:.1}) px lies outside the picture")]
    OutsidePicture {
        /// Session and object.
        place: String,
        /// Column of the mark, in pixels.
        x: f64,
        /// Row of the mark, in pixels.
        y: f64,
    },
    /// The marks of the study cannot be measured.
    #[error("{place}: {source}")]
    Measure {
        /// Session and object.
        place: String,
        /// Why.
        source: MeasureError,
    },
    /// The marks of the study do not give back the published size.
    #[error("{place}: the marks give {got_mm} mm instead of {expected_mm} mm")]
    NotBackSolved {
        /// Session, object and quantity.
        place: String,
        /// The published size.
        expected_mm: f64,
        /// The size that the marks give, if they give any.
        got_mm: f64,
    },
    /// A picture cannot be encoded.
    #[error("{place}: {source}")]
    Jpeg {
        /// The picture.
        place: String,
        /// Why.
        source: jpeg_encoder::EncodingError,
    },
    /// A picture is larger than JPEG can hold.
    #[error("{place}: {width_px} x {height_px} px is more than the 65535 x 65535 px of a JPEG")]
    TooLarge {
        /// The picture.
        place: String,
        /// Its width.
        width_px: u32,
        /// Its height.
        height_px: u32,
    },
    /// A time lies outside the range of the calendar.
    #[error("{nanoseconds} ns since 1970 is not a time of the calendar")]
    Time {
        /// The time.
        nanoseconds: i64,
    },
    /// Marks cannot be written as JSON.
    #[error("{place}: {source}")]
    Json {
        /// The file.
        place: String,
        /// Why.
        source: serde_json::Error,
    },
}
