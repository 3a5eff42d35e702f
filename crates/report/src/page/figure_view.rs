//! Figures on the page.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

use crate::figure::Figure;

/// A figure as the template shows it.
pub(super) struct FigureView<'a> {
    pub(super) figure: &'a Figure,
    /// The drawing as the source of a picture: one node of the page, however many points it has, and nothing in it can act.
    pub(super) source: String,
}

impl<'a> FigureView<'a> {
    pub(super) fn of(figure: &'a Figure) -> Self {
        let source = format!("data:image/svg+xml;base64,{}", BASE64_STANDARD.encode(&figure.svg));
        Self { figure, source }
    }
}
