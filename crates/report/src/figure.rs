//! A figure: a drawing with what a reader needs to understand it without the text around it.

/// A drawing in SVG, ready for a page or a file of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Stem of its file name, for example `error_by_pitch`.
    pub name: String,
    /// Heading, plain text.
    pub title: String,
    /// What is drawn, of how many, and how its statistics are defined; plain text.
    pub caption: String,
    /// What a reader who does not see it should know: what it shows, in a sentence or two; plain text.
    pub alt: String,
    /// The drawing, a whole `<svg>` element with a `viewBox`; ids in it begin with `name`.
    pub svg: String,
}
