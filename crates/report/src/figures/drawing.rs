//! The parts of a figure, which are shapes and words at places on a page, and their way to SVG.

use askama::Template;

/// A place or a length on the page as text, in units of the `viewBox`, rounded so that it is short. 0.1 units are 0.02 mm when
/// a figure is printed over two columns.
pub(super) fn short(value: f64) -> String {
    let text = format!("{value:.1}");
    let text = text.strip_suffix(".0").unwrap_or(&text);
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// A colour. People who see colours differently can tell it apart from the others (after Okabe and Ito, Color Universal
/// Design, 2008; the blue is lighter), and it has a contrast of at least 3 with both a white and a nearly black page (WCAG
/// 2.2, 1.4.11).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Colour {
    None,
    /// The colour of the text around the figure.
    Ink,
    Blue,
    Vermilion,
    Green,
}

impl Colour {
    pub(super) const fn code(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Ink => "currentColor",
            Self::Blue => "#1f87c9",
            Self::Vermilion => "#d55e00",
            Self::Green => "#009e73",
        }
    }
}

/// The colours and lines with which shapes are painted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Paint {
    pub(super) fill: Colour,
    pub(super) fill_opacity: f64,
    pub(super) stroke: Colour,
    pub(super) stroke_width: f64,
    pub(super) stroke_opacity: f64,
    /// Lengths of dashes and gaps, as in SVG; empty for a solid line.
    pub(super) dash: &'static str,
}

impl Paint {
    pub(super) const fn line(stroke: Colour, stroke_width: f64) -> Self {
        Self { fill: Colour::None, fill_opacity: 1.0, stroke, stroke_width, stroke_opacity: 1.0, dash: "" }
    }

    pub(super) const fn area(fill: Colour, fill_opacity: f64) -> Self {
        Self { fill, fill_opacity, stroke: Colour::None, stroke_width: 0.0, stroke_opacity: 1.0, dash: "" }
    }

    pub(super) const fn dashed(self, dash: &'static str) -> Self {
        Self { dash, ..self }
    }

    pub(super) const fn faint(self, stroke_opacity: f64) -> Self {
        Self { stroke_opacity, ..self }
    }
}

/// A path with an optional title.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shape {
    pub(super) path: String,
    /// The text that appears when a pointer rests on the shape.
    pub(super) title: Option<String>,
}

/// The part of a text that is at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    pub(super) const fn code(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// A line of words at a place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Text {
    pub(super) x: String,
    pub(super) y: String,
    pub(super) size: f64,
    pub(super) anchor: Anchor,
    pub(super) bold: bool,
    /// Whether the line runs from below upwards.
    pub(super) turned: bool,
    pub(super) text: String,
    /// The whole text, where `text` is shortened.
    pub(super) full: Option<String>,
}

/// Size of words, in units of the `viewBox`: 8 points when a figure of 760 units is printed 180 mm wide.
pub(super) const TEXT_SIZE: f64 = 12.0;

impl Text {
    pub(super) fn new(x: f64, y: f64, anchor: Anchor, text: impl Into<String>) -> Self {
        let text = text.into();
        Self { x: short(x), y: short(y), size: TEXT_SIZE, anchor, bold: false, turned: false, text, full: None }
    }

    pub(super) fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub(super) fn turned(self) -> Self {
        Self { turned: true, ..self }
    }

    pub(super) fn small(self) -> Self {
        Self { size: 10.5, ..self }
    }

    /// The text with the whole one, for which it stands shortened.
    pub(super) fn standing_for(self, full: &str) -> Self {
        let full = (self.text != full).then(|| full.to_owned());
        Self { full, ..self }
    }
}

/// A part of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Item {
    Shapes { class: &'static str, paint: Paint, shapes: Vec<Shape> },
    Text(Text),
}

/// A page with its parts. Later ones lie above earlier ones.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Drawing {
    pub(super) width: String,
    pub(super) height: String,
    pub(super) items: Vec<Item>,
}

impl Drawing {
    pub(super) fn new(width: f64, height: f64) -> Self {
        Self { width: short(width), height: short(height), items: Vec::new() }
    }

    pub(super) fn path(&mut self, class: &'static str, paint: Paint, path: String) {
        self.shapes(class, paint, vec![Shape { path, title: None }]);
    }

    pub(super) fn shapes(&mut self, class: &'static str, paint: Paint, shapes: Vec<Shape>) {
        if shapes.iter().any(|shape| !shape.path.is_empty()) {
            self.items.push(Item::Shapes { class, paint, shapes });
        }
    }

    pub(super) fn text(&mut self, text: Text) {
        self.items.push(Item::Text(text));
    }
}

/// The template of the SVG element.
#[derive(Debug, Template)]
#[template(path = "figure.svg")]
struct Svg<'a> {
    name: &'a str,
    title: &'a str,
    alt: &'a str,
    standalone: bool,
    drawing: &'a Drawing,
}

/// A drawing as SVG: for a page, or (`standalone`) for a file of its own, with a white ground, a size and fonts.
pub(super) fn svg(drawing: &Drawing, [name, title, alt]: [&str; 3], standalone: bool) -> Result<String, askama::Error> {
    Svg { name, title, alt, standalone, drawing }.render()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance of a colour, as WCAG 2.2 defines it.
    fn luminance(code: &str) -> f64 {
        let channel = |at: usize| {
            let value = f64::from(u8::from_str_radix(&code[at..at + 2], 16).expect("hexadecimal")) / 255.0;
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5)
    }

    #[test]
    fn colours_are_seen_on_white_and_on_dark_pages() {
        for colour in [Colour::Blue, Colour::Vermilion, Colour::Green] {
            let luminance_of = luminance(colour.code()) + 0.05;
            let contrasts = [1.05 / luminance_of, luminance_of / (luminance("#1b1b1b") + 0.05)];
            assert!(contrasts.iter().all(|contrast| *contrast >= 3.0), "{colour:?}: {contrasts:?}");
        }
    }

    #[test]
    fn places_are_short() {
        assert_eq!([12.04, 12.0, -0.01, 3.25].map(short), ["12", "12", "0", "3.2"]);
    }
}
