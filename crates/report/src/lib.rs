//! Results to Parquet, and results to error tables. Knows nothing of sessions or images on cards.
//!
//! - [`ParquetSink`] takes the rows of a run and writes `results.parquet` and `frames.parquet`.
//! - [`Results`] reads `results.parquet` back, with the metadata of its run; [`read_frames`] reads `frames.parquet`;
//!   [`frames_file`] says where it is, and [`Results::read_flow`] counts its images.
//! - [`write_truth`] and [`read_truth`]: `truth.parquet`, which lies beside a simulated study.
//! - [`tables`] makes the tables that the study asks for; [`sizes`], [`error_by_pitch`] and [`error_by_height`] three more;
//!   [`accuracy`], [`rater_agreement`] and [`methods`] hold sizes, raters and methods against the truth and each other;
//!   [`flow`] and [`left_out`] tell what became of the images.
//! - [`figures()`] draws the figures of a run as SVG, [`write_figures`] writes them; [`flow_bars`] is one of them for a terminal.
//! - [`terminal`], [`csv()`], [`markdown`] and [`latex`] draw one [`Table`]; [`write_dir`] writes them all.
//! - [`write_report`] writes the tables with a [`Page`]: `index.html`, which shows all of it, with [`Figure`]s and [`Pictures`].
//! - [`compare`] holds the tables against a folder of expected ones: a gate for automatic runs.
//!
//! What each table is, its statistics and its CSV columns: docs/tables.md.
#![warn(missing_docs)]

mod atomic;
mod compare;
mod figure;
mod figures;
mod page;
mod parquet;
mod render;
mod table;
mod tables;
mod write_dir;
mod write_report;

pub use atomic::{FileError, write as write_file};
pub use compare::{CompareError, Comparison, Difference, compare};
pub use figure::Figure;
pub use figures::{FigureError, FigureLeftOut, Figures, figures, flow_bars, write_figures};
pub use page::{Page, PageError, PictureError, Pictures};
pub use parquet::{
    ParquetSink, ReadError, Results, SinkError, frames_file, read_frames, read_run_log, read_truth, run_file,
    write_truth,
};
pub use render::{csv, latex, markdown, terminal, terminal_set};
pub use table::{Align, Cell, Column, Footnote, Format, Role, RowKind, Table, TableRow};
pub use tables::{
    accuracy, error_by_height, error_by_pitch, flow, flow_in_short, left_out, methods, rater_agreement, sizes, tables,
};
pub use write_dir::{WriteError, write_dir};
pub use write_report::{ReportError, write_report};
