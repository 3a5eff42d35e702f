//! Figures as the page shows them.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

use crate::figure::Figure;

/// A drawing of more elements than this is shown as a picture. It is then a single node of the page, which stays light.
const MOST_ELEMENTS: usize = 2500;

/// A figure as the template shows it.
pub(super) struct FigureView<'a> {
    pub(super) figure: &'a Figure,
    /// The drawing as the source of a picture, where it has very many elements. Other drawings stand in the page, and have its
    /// colours.
    pub(super) source: Option<String>,
}

impl<'a> FigureView<'a> {
    pub(super) fn from_figure(figure: &'a Figure) -> Self {
        let elements = figure.svg.bytes().filter(|byte| *byte == b'<').count();
        Self { figure, source: (elements > MOST_ELEMENTS).then(|| source(&figure.svg)) }
    }
}

/// The drawing as a `data:` URL. It gets fonts of its own, since a picture has no page to take them from.
fn source(svg: &str) -> String {
    let svg = svg.replacen("<svg ", "<svg font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\" ", 1);
    format!("data:image/svg+xml;base64,{}", BASE64_STANDARD.encode(svg))
}
