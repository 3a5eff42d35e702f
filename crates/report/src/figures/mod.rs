//! Figures as SVG, drawn from the results alone.
//!
//! A figure is a [`drawing`] (shapes and words at places on a page). A module of its own draws it from rows ([`sample`]) with the
//! help of [`scale`], [`panel`], [`grid`], [`marks`] and [`legend`]. One template (templates/figure.svg) writes all figures, and
//! escapes every word. No figure has styles of its own: colours are attributes, and text has the colour and the font of the page
//! around it. docs/figures.md describes each figure and defines its statistics.

mod bland_altman;
mod by_setup;
mod calibration;
mod coverage;
mod drawing;
mod envelope;
mod flow;
mod flow_text;
mod grid;
mod legend;
mod marks;
mod panel;
mod pitch_and_range;
mod sample;
mod scale;
mod selected;
mod settings;
mod sizes;
mod words;
mod write;

use model::FrameRow;

use crate::figure::Figure;
use crate::parquet::Results;
use drawing::Drawing;

pub use flow_text::flow_bars;
pub use write::write_figures;

/// The reason why the figures of errors are left out.
const NO_TRUTH: &str = "no size has a true size to compare with";

/// Why a figure could not be made: its template failed, which only a failing writer can cause.
#[derive(Debug, thiserror::Error)]
#[error("cannot put a figure together")]
pub struct FigureError(#[from] askama::Error);

/// The figures of a run, and those for which it has no data.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Figures {
    /// The figures that could be drawn, in the order in which a report shows them.
    pub drawn: Vec<Figure>,
    /// The figures for which there are no data.
    pub left_out: Vec<FigureLeftOut>,
    /// The sentence that the study wants every report to carry.
    pub statement: Option<String>,
    /// The drawn figures as the content of files of their own.
    standalone: Vec<String>,
}

/// A figure for which there are no data.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FigureLeftOut {
    /// Stem of the name that its file would have.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// The data that are missing, as a part of a sentence.
    pub reason: &'static str,
}

/// The result of drawing a figure.
enum Attempt {
    Drawn { name: &'static str, title: &'static str, captions: [String; 2], drawing: Drawing },
    LeftOut(FigureLeftOut),
}

impl Attempt {
    /// A figure that was drawn. `captions` are the caption and the alternative text.
    const fn drawn(name: &'static str, title: &'static str, captions: [String; 2], drawing: Drawing) -> Self {
        Self::Drawn { name, title, captions, drawing }
    }

    const fn left_out(name: &'static str, title: &'static str, reason: &'static str) -> Self {
        Self::LeftOut(FigureLeftOut { name, title, reason })
    }
}

/// Draws the figures of a run from its rows and from the ledger of its images (empty where there is none).
///
/// Each SVG takes its text's colour and font from the page that it stands in. The same results give the same bytes.
///
/// # Errors
/// [`FigureError`].
pub fn figures(results: &Results, frames: &[FrameRow]) -> Result<Figures, FigureError> {
    let mut figures = Figures { statement: results.metadata.statement.clone(), ..Figures::default() };
    for attempt in all(results, frames) {
        match attempt {
            Attempt::Drawn { name, title, captions: [caption, alt], drawing } => {
                let text = |standalone: bool| drawing::svg(&drawing, [name, title, &alt], standalone);
                let (svg, standalone) = (text(false)?, text(true)?);
                let (name, title) = (name.to_owned(), title.to_owned());
                figures.drawn.push(Figure { name, title, caption, alt, svg });
                figures.standalone.push(standalone);
            }
            Attempt::LeftOut(left_out) => figures.left_out.push(left_out),
        }
    }
    Ok(figures)
}

fn all(results: &Results, frames: &[FrameRow]) -> Vec<Attempt> {
    vec![
        flow::draw(frames),
        pitch_and_range::draw(results, frames),
        selected::draw(frames),
        by_setup::by_pitch(results),
        by_setup::by_height(results),
        bland_altman::draw(results),
        coverage::draw(results),
        calibration::draw(results),
        sizes::draw(results),
    ]
}
