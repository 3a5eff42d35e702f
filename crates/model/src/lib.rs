//! Vocabulary and mathematics of aim-batch. No I/O.
//!
//! A camera worn on eyeglasses looks down on a table. Gravity gives the *pitch* (depression of the optical axis below
//! the horizontal) and the *roll*; a range sensor along the optical axis gives the *range* to the table. Together they fix
//! the table plane in the camera frame, so a pixel that shows a point of known height has a place in millimetres.
//!
//! Source: Raju, Sazonov et al., *Estimation of Plate and Bowl Dimensions for Food Portion Size Assessment in a Wearable
//! Sensor System* ("the paper"). Equation numbers in this crate are the paper's.
//!
//! # Conventions
//! - Camera frame: x right, y down, z forward along the optical axis (OpenCV, ROS optical frames).
//! - World frame: origin on the table vertically under the camera; X right, Y forward (horizontal), Z up.
//! - Radians and millimetres, unless a name says otherwise. Pixels: (0, 0) is the centre of the first pixel.
//! - Roll is positive when the camera turns clockwise about its optical axis as the wearer sees it. In the camera frame,
//!   down = (sin(roll) cos(pitch), cos(roll) cos(pitch), sin(pitch)).
//!
//! # Example
//! ```
//! use aim_batch_model::{Camera, LensModel, Pose, View};
//! use nalgebra::Point2;
//!
//! let camera = Camera::new([2592, 1944], [1695.0, 1703.0], [1296.0, 972.0], 0.0, LensModel::None)?;
//! let pose = Pose::new(55_f64.to_radians(), 0.0, 580.0)?;
//! let view = View::new(camera, pose);
//! // The principal point meets the table at the end of the range.
//! let on_table_mm = view.on_plane(Point2::new(1296.0, 972.0), 0.0)?;
//! assert!((on_table_mm.y - 580.0 * 55_f64.to_radians().cos()).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![warn(missing_docs)]

pub mod bundle;
pub mod calibrate;
mod camera;
mod camera_spec;
mod circle;
mod codes;
mod container;
mod doubt;
mod flow;
mod frame_log;
mod fusion;
mod gallery;
mod joint;
pub mod lens;
mod located;
mod marks;
mod measure;
mod orientation;
mod polynomial;
mod pose;
mod problem_code;
pub mod results;
mod sensed;
mod sigma;
mod sink;
mod source;
mod stats;
mod status;
mod table;
mod time;
mod uncertainty;
pub mod validation;
mod view;
mod wall;

pub use camera::{Camera, CameraError, resampled_px};
pub use camera_spec::{CameraSpec, CameraSpecError, LensSpec};
pub use circle::{Circle, CircleError, CircleFit, fit_circle};
pub use container::{Container, Kind, Method, Quantity, Shape, Wall};
pub use doubt::Doubt;
pub use flow::{Flow, FlowStep, ImageCounts, StudyFlow};
pub use frame_log::{FrameFlag, FrameReason};
pub use fusion::{Consistency, Fused, Part, Share, Verdict, combined_sigma, fuse, parts_of_sum};
pub use gallery::{GalleryMark, GalleryPicture, GallerySink, PictureView};
pub use joint::{JointError, JointHeight, Sight, Sights, joint_height, sights};
pub use lens::{LensError, LensModel};
pub use marks::{Feature, Mark, ObjectMarks};
pub use measure::{LeftOut, MarkPlace, MeasureError, Measured, height_by_paper_mm, height_by_ray_mm, measure};
pub use orientation::Orientation;
pub use pose::{Pose, PoseError};
pub use problem_code::{ProblemCode, problems_markdown};
pub use results::{FrameRow, Level, ResultRow};
pub use sigma::{InputSigma, LEARNED, Sensitivity, SizeSigma};
pub use sink::{ResultSink, RunLog, RunMetadata, SessionLog, StageLog};
pub use source::{PerSource, SOURCES, Source, SourceCovariance};
pub use stats::{ErrorStats, median};
pub use status::{Problem, SessionStatus, Severity, Stage};
pub use table::{Note, PrintedRow, PrintedSummary, PrintedTable, Selection, TableLayout, TableSpec};
pub use time::UtcNs;
pub use uncertainty::{Estimate, best_of, estimate};
pub use view::{View, ViewError};
