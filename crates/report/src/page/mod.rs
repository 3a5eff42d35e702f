//! The report as one page: `index.html`, which opens from disk and needs no network.
//!
//! The page is plain HTML that reads and prints without its script. The script sorts, filters and pages tables, and opens
//! pictures; its data are JSON in the page. Long tables and the measurements are such JSON, of which a page at a time is in the
//! document, so that ten thousand rows make a page as light as a hundred do. docs/report.md describes it to its readers.

mod answers;
mod assets;
mod data;
mod disagreement;
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

/// Why a page could not be made.
#[derive(Debug, thiserror::Error)]
pub enum PageError {
    /// The template failed, which only a failing writer can cause.
    #[error("cannot put the page together")]
    Template(#[from] askama::Error),
    /// The data of the script cannot be written as JSON.
    #[error("cannot write the page's data as JSON")]
    Json(#[from] serde_json::Error),
}

/// The content of a page.
#[derive(Debug, Clone, Copy)]
pub struct Page<'a> {
    /// The results.
    pub results: &'a Results,
    /// The times of the run, where they are known.
    pub log: Option<&'a RunLog>,
    /// The figures, in their order on the page, and those for which there are no data.
    pub figures: &'a Figures,
    /// The pictures with their marks. A row without one shows its numbers alone.
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
    /// The page as HTML. `tables` are those of the study and then all others. Each of them lies beside the page as CSV, Markdown
    /// and LaTeX. The same input gives the same bytes.
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
            answers: summary.answers.iter().chain(&summary.disagreement).map(bare).collect::<Result<_, _>>()?,
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
