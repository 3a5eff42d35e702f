//! A figure: a drawing with the words that a reader needs to understand it alone.

/// A drawing in SVG, ready for a page or a file of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Stem of its file name, for example `error_by_pitch`.
    pub name: String,
    /// Heading, as plain text.
    pub title: String,
    /// Caption, as plain text: the things that are drawn, their number, and the definitions of the statistics.
    pub caption: String,
    /// Alternative text for readers who do not see the drawing: its content in a sentence or two, as plain text.
    pub alt: String,
    /// The drawing, as a whole `<svg>` element with a `viewBox`. All ids in it begin with `name`.
    pub svg: String,
}
