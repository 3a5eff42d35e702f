//! The report as one page: `index.html`, which opens from disk and asks no network for anything.
//!
//! What it holds is plain HTML that reads and prints without its script. The script sorts, filters and pages tables, and
//! opens pictures; what it needs comes along as JSON. Long tables and the measurements are JSON, of which a page at a time is
//! in the document: ten thousand rows make a page as light as a hundred. docs/report.md describes it to its readers.

mod answers;
mod assets;
mod data;
mod figure_view;
mod measurements;
mod pictures;
mod policy;
mod provenance;
mod status;
mod summary;
mod table_view;

use askama::Template;
use model::RunLog;

pub use pictures::{PictureError, Pictures};

use crate::figures::{FigureLeftOut, Figures};
use crate::parquet::Results;
use crate::table::Table;
use assets::{SCRIPT, STYLE};
use figure_view::FigureView;
use provenance::Provenance;
use summary::Summary;
use table_view::TableView;

/// A page that could not be made.
#[derive(Debug, thiserror::Error)]
pub enum PageError {
    /// The template failed, which only a failing writer can cause.
    #[error("cannot put the page together")]
    Template(#[from] askama::Error),
    /// What the script needs cannot be written as JSON.
    #[error("cannot write the page's data as JSON")]
    Json(#[from] serde_json::Error),
}

/// What a page is made from.
#[derive(Debug, Clone, Copy)]
pub struct Page<'a> {
    /// The results.
    pub results: &'a Results,
    /// When and how long the run was at work, where that is known.
    pub log: Option<&'a RunLog>,
    /// Drawings, in their order on the page, and those for which there are no data.
    pub figures: &'a Figures,
    /// Pictures with marks; rows without one show their numbers alone.
    pub pictures: &'a Pictures,
}

#[derive(Template)]
#[template(path = "page.html")]
struct PageTemplate<'a> {
    policy: String,
    style: &'static str,
    script: &'static str,
    summary: Summary,
    answers: Vec<TableView>,
    asked: Vec<TableView>,
    more: Vec<TableView>,
    figures: Vec<FigureView<'a>>,
    figures_left_out: &'a [FigureLeftOut],
    status: Vec<TableView>,
    provenance: Provenance,
    measurements_json: String,
    pictures: usize,
    pictures_json: String,
}

impl Page<'_> {
    /// The page, as HTML. `tables` are those of the study, then all others, each of which lies beside the page as CSV,
    /// Markdown and LaTeX. The same input gives the same bytes.
    ///
    /// # Errors
    /// [`PageError`].
    pub(crate) fn html(&self, tables: &[Table]) -> Result<String, PageError> {
        let metadata = &self.results.metadata;
        let asked = metadata.tables.len().min(tables.len());
        let with_files =
            |tables: &[Table]| tables.iter().map(|table| TableView::from_table(table, true)).collect::<Result<_, _>>();
        let summary = Summary::from_results(self.results);
        let bare = |table: &Table| TableView::from_table(table, false);
        let page = PageTemplate {
            policy: policy::content_security_policy(SCRIPT),
            style: STYLE,
            script: SCRIPT,
            answers: summary.answers.iter().map(bare).collect::<Result<_, _>>()?,
            summary,
            asked: with_files(&tables[..asked])?,
            more: with_files(&tables[asked..])?,
            figures: self.figures.drawn.iter().map(FigureView::from_figure).collect(),
            figures_left_out: &self.figures.left_out,
            status: status::tables(metadata).iter().map(bare).collect::<Result<_, _>>()?,
            provenance: Provenance::from_metadata(metadata, self.log)?,
            measurements_json: data::script_json(&measurements::grid(&self.results.rows))?,
            pictures: self.pictures.len(),
            pictures_json: data::script_json(&self.pictures.index())?,
        };
        Ok(page.render()?)
    }
}
