//! Writes results to Parquet files, and makes tables, figures and a page from them. It knows nothing of sessions or images on
//! cards.
//!
//! - [`ParquetSink`] takes the rows of a run and writes `results.parquet` and `frames.parquet`.
//! - [`Results`] reads `results.parquet` back, with the metadata of its run. [`read_frames`] reads `frames.parquet`, whose name
//!   [`frames_file`] returns, and [`Results::read_flow`] counts its images.
//! - [`write_truth`] writes `truth.parquet`, which lies beside a simulated study, and [`read_truth`] reads it.
//! - [`tables`] makes the tables that the study asks for, and [`sizes`], [`error_by_pitch`] and [`error_by_height`] three more.
//!   [`accuracy`], [`rater_agreement`] and [`methods`] compare sizes, raters and methods with the truth and with each other.
//!   [`flow`] and [`left_out`] count the images that reach each step of the selection, and those that do not.
//! - [`figures()`] draws the figures of a run as SVG, and [`write_figures`] writes them. [`flow_bars`] draws one of them for a
//!   terminal.
//! - [`terminal`], [`csv()`], [`markdown`] and [`latex`] turn one [`Table`] into text, and [`write_dir`] writes all tables.
//! - [`write_report`] writes the tables and a [`Page`]: `index.html`, which shows all of it, with [`Figure`]s and [`Pictures`].
//! - [`compare`] compares the tables with a folder of expected ones, as a gate for automatic runs.
//!
//! docs/tables.md describes each table, its statistics and its CSV columns.
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
