//! Figures on the page.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

use crate::figure::Figure;

/// A drawing of more elements than this is shown as a picture: one node of the page, which stays light.
const MOST_ELEMENTS: usize = 2500;

/// A figure as the template shows it.
pub(super) struct FigureView<'a> {
    pub(super) figure: &'a Figure,
    /// Of a drawing with very many elements: it as the source of a picture. Others stand in the page, and have its colours.
    pub(super) source: Option<String>,
}

impl<'a> FigureView<'a> {
    pub(super) fn from_figure(figure: &'a Figure) -> Self {
        let elements = figure.svg.bytes().filter(|byte| *byte == b'<').count();
        Self { figure, source: (elements > MOST_ELEMENTS).then(|| source(&figure.svg)) }
    }
}

/// A picture has no page to take a font from.
fn source(svg: &str) -> String {
    let svg = svg.replacen("<svg ", "<svg font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\" ", 1);
    format!("data:image/svg+xml;base64,{}", BASE64_STANDARD.encode(svg))
}
