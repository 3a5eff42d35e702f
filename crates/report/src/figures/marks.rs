//! Marks: the shapes that stand for measurements.

use std::collections::BTreeSet;

use super::drawing::{Colour, Drawing, Paint, Shape, short};

/// A figure has no more marks than this, or it grows beyond what a page takes; of more, those that lie on others are
/// left out.
pub(super) const MOST_MARKS: usize = 3000;
/// A figure has no more marks that a pointer can ask than this.
pub(super) const MOST_TITLES: usize = 400;

/// The outline of a mark. Told apart without colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Symbol {
    Circle,
    Triangle,
    Square,
    Diamond,
    Cross,
    /// Stands at the upper edge for a value above it.
    Above,
    /// Stands at the lower edge for a value below it.
    Below,
}

impl Symbol {
    /// The path of the symbol about a place.
    pub(super) fn path(self, x: f64, y: f64) -> String {
        let from = |dx: f64, dy: f64| format!("M{},{}", short(x + dx), short(y + dy));
        match self {
            Self::Circle => from(-2.6, 0.0) + "a2.6,2.6 0 1 0 5.2,0a2.6,2.6 0 1 0 -5.2,0z",
            Self::Triangle => from(0.0, -3.2) + "l2.9,5h-5.8z",
            Self::Square => from(-2.3, -2.3) + "h4.6v4.6h-4.6z",
            Self::Diamond => from(0.0, -3.8) + "l3.8,3.8l-3.8,3.8l-3.8,-3.8z",
            Self::Cross => from(-2.2, -2.2) + "l4.4,4.4m0,-4.4l-4.4,4.4",
            Self::Above => from(0.0, 0.0) + "l2.6,6h-5.2z",
            Self::Below => from(0.0, 0.0) + "l2.6,-6h-5.2z",
        }
    }
}

/// What a series of marks looks like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Look {
    pub(super) symbol: Symbol,
    pub(super) paint: Paint,
}

impl Look {
    /// A mark with its inside painted.
    pub(super) const fn filled(symbol: Symbol, colour: Colour) -> Self {
        let line = Paint::line(colour, 1.0);
        Self { symbol, paint: Paint { fill: colour, fill_opacity: 0.55, ..line } }
    }

    /// A mark with an outline alone.
    pub(super) const fn hollow(symbol: Symbol, colour: Colour) -> Self {
        Self { symbol, paint: Paint::line(colour, 1.0) }
    }
}

/// A mark at a place of the page.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mark<T> {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) look: Look,
    /// How much the reader would miss it: the marks with the largest have titles, and stay where others lie on them.
    pub(super) weight: f64,
    /// What it stands for.
    pub(super) of: T,
}

/// How many marks of a figure there were, and how many of them were drawn.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Drawn {
    pub(super) of: usize,
    pub(super) marks: usize,
}

impl Drawn {
    pub(super) fn add(&mut self, other: Self) {
        self.of += other.of;
        self.marks += other.marks;
    }

    /// A sentence where marks were left out.
    pub(super) fn remark(self) -> String {
        if self.marks == self.of {
            return String::new();
        }
        let Self { of, marks } = self;
        format!(" Of {of} marks, {marks} are drawn: those that lie on others are left out; statistics hold all.")
    }
}

/// Draws marks, those of one look together; at most `most`, of which `titles` have a title.
pub(super) fn draw<T>(
    drawing: &mut Drawing,
    marks: Vec<Mark<T>>,
    [most, titles]: [usize; 2],
    title: impl Fn(&T) -> String,
) -> Drawn {
    let of = marks.len();
    let mut marks = thinned(marks, most);
    let drawn = Drawn { of, marks: marks.len() };
    marks.sort_by(|a, b| b.weight.total_cmp(&a.weight));
    let titled = marks.len().min(titles);
    let mut looks: Vec<(Look, Vec<Shape>, String)> = Vec::new();
    for (place, mark) in marks.iter().enumerate() {
        let index = looks.iter().position(|(look, ..)| *look == mark.look).unwrap_or_else(|| {
            looks.push((mark.look, Vec::new(), String::new()));
            looks.len() - 1
        });
        let path = mark.look.symbol.path(mark.x, mark.y);
        let (_, shapes, rest) = &mut looks[index];
        if place < titled {
            shapes.push(Shape { path, title: Some(title(&mark.of)) });
        } else {
            rest.push_str(&path);
        }
    }
    for (look, mut shapes, rest) in looks {
        if !rest.is_empty() {
            shapes.insert(0, Shape { path: rest, title: None });
        }
        drawing.shapes("marks", look.paint, shapes);
    }
    drawn
}

/// At most about `most` marks: one for each cell of a lattice that is as fine as that allows.
fn thinned<T>(mut marks: Vec<Mark<T>>, most: usize) -> Vec<Mark<T>> {
    if marks.len() <= most {
        return marks;
    }
    marks.sort_by(|a, b| b.weight.total_cmp(&a.weight));
    let mut cell = 0.5;
    loop {
        let kept = in_cells(&marks, cell);
        if kept.len() <= most || cell > 1000.0 {
            let mut index = 0;
            marks.retain(|_| {
                index += 1;
                kept.contains(&(index - 1))
            });
            return marks;
        }
        cell *= 1.25;
    }
}

/// The first mark of every cell and symbol.
#[expect(clippy::cast_possible_truncation, reason = "places on a page")]
fn in_cells<T>(marks: &[Mark<T>], cell: f64) -> BTreeSet<usize> {
    let mut cells = BTreeSet::new();
    let is_first = |(_, mark): &(usize, &Mark<T>)| {
        cells.insert((mark.look.symbol, (mark.x / cell) as i32, (mark.y / cell) as i32))
    };
    marks.iter().enumerate().filter(is_first).map(|(index, _)| index).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_marks_one_for_each_place_is_drawn_and_the_heaviest_has_a_title() {
        let look = Look::filled(Symbol::Circle, Colour::Blue);
        let mark =
            |i: u32| Mark { x: f64::from(i % 100), y: f64::from(i / 100 % 100), look, weight: f64::from(i), of: i };
        let mut drawing = Drawing::new(100.0, 100.0);
        let drawn = draw(&mut drawing, (0..20_000).map(mark).collect(), [3000, 1], |of| format!("number {of}"));
        assert_eq!(drawn.of, 20_000);
        assert!(drawn.marks > 1000 && drawn.marks <= 3000, "{drawn:?}");
        let text = format!("{drawing:?}");
        assert_eq!(text.matches("a2.6,2.6 0 1 0 5.2").count(), drawn.marks);
        assert!(text.contains("number 19999") && !text.contains("number 19998"));
        assert!(drawn.remark().contains("Of 20000 marks"));
    }
}
