//! Marks of a figure: the shapes that stand for measurements.

use std::collections::BTreeSet;

use super::drawing::{Colour, Drawing, Paint, Shape, short};

/// Greatest number of marks of a figure, so that a page can hold it. Where there are more, those that lie on others are left
/// out.
pub(super) const MOST_MARKS: usize = 3000;
/// Greatest number of marks of a figure that have a title.
pub(super) const MOST_TITLES: usize = 400;

/// The outline of a mark. All of them can be told apart without colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Symbol {
    Circle,
    Triangle,
    Square,
    Diamond,
    Cross,
    /// It stands at the upper edge for a value above that edge.
    Above,
    /// It stands at the lower edge for a value below that edge.
    Below,
}

impl Symbol {
    /// The path of the symbol around a place.
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

/// The symbol and paint of a series of marks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Look {
    pub(super) symbol: Symbol,
    pub(super) paint: Paint,
}

impl Look {
    /// A look with the inside of the symbol painted.
    pub(super) const fn filled(symbol: Symbol, colour: Colour) -> Self {
        let line = Paint::line(colour, 1.0);
        Self { symbol, paint: Paint { fill: colour, fill_opacity: 0.55, ..line } }
    }

    /// A look with the outline of the symbol alone.
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
    /// The importance of the mark. Those with the largest weights have titles, and stay where others lie on them.
    pub(super) weight: f64,
    /// The measurement that the mark stands for.
    pub(super) of: T,
}

/// The number of marks of a figure (`of`), and of those that were drawn.
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

    /// A sentence on the marks that were left out; empty where there are none.
    pub(super) fn remark(self) -> String {
        if self.marks == self.of {
            return String::new();
        }
        let Self { of, marks } = self;
        format!(" Of {of} marks, {marks} are drawn: those that lie on others are left out; statistics hold all.")
    }
}

/// Draws at most `most` marks, of which `titles` have a title. Those of one look are drawn together.
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

/// At most about `most` of the marks: one for each cell of a lattice that is as fine as that number allows.
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

/// The indices of the first mark of every symbol in every cell.
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
