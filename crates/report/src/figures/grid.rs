//! Small multiples: panels in rows and columns that share their axes.

use super::drawing::{Anchor, Drawing, Text};
use super::legend::{self, Entry};
use super::panel::Panel;
use super::scale::Scale;

/// Width of every figure, in units of the `viewBox`.
pub(super) const PAGE: f64 = 760.0;

const LEFT: f64 = 66.0;
const RIGHT: f64 = 14.0;
const COLUMN_GAP: f64 = 14.0;
const ROW_GAP: f64 = 26.0;
const HEADING: f64 = 20.0;
const BELOW: f64 = 42.0;
/// Greatest width of a panel.
const WIDEST: f64 = 400.0;

/// An axis that panels share.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    pub(super) domain: [f64; 2],
    pub(super) logarithmic: bool,
}

impl Axis {
    pub(super) const fn linear(domain: [f64; 2]) -> Self {
        Self { domain, logarithmic: false }
    }

    pub(super) const fn logarithmic(domain: [f64; 2]) -> Self {
        Self { domain, logarithmic: true }
    }

    fn scale(&self, range: [f64; 2]) -> Scale {
        if self.logarithmic { Scale::logarithmic(self.domain, range) } else { Scale::linear(self.domain, range) }
    }
}

/// Panels in rows and columns. The panels of a row share the axis of y, and all panels share that of x.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Grid {
    pub(super) columns: Vec<String>,
    pub(super) rows: Vec<(String, Axis)>,
    pub(super) x: Axis,
    pub(super) x_label: &'static str,
    pub(super) y_label: &'static str,
    /// Height of a panel.
    pub(super) height: f64,
    pub(super) legend: Vec<Entry>,
}

impl Grid {
    /// The drawing, with axes and legend, and its panels by row and column.
    #[expect(clippy::cast_precision_loss, reason = "a handful of rows")]
    pub(super) fn draw(&self) -> (Drawing, Vec<Vec<Panel>>) {
        let top = 6.0 + legend::height(&self.legend, PAGE - LEFT - RIGHT) + HEADING;
        let rows = self.rows.len() as f64;
        let bottom = top + rows * (self.height + ROW_GAP) - 10.0;
        let mut drawing = Drawing::new(PAGE, bottom + BELOW);
        legend::draw(&mut drawing, &self.legend, [LEFT, 4.0], PAGE - LEFT - RIGHT);
        let panels: Vec<Vec<Panel>> = (0..self.rows.len()).map(|row| self.row(&mut drawing, row, top)).collect();
        let middle = |panels: &[Vec<Panel>]| {
            let first = panels.first()?.first()?;
            let last = panels.last()?.last()?;
            Some([0.5 * (first.left() + last.right()), 0.5 * (first.top() + last.bottom())])
        };
        if let Some([x, y]) = middle(&panels) {
            drawing.text(Text::new(x, bottom + 36.0, Anchor::Middle, self.x_label));
            drawing.text(Text::new(16.0, y, Anchor::Middle, self.y_label).turned());
        }
        (drawing, panels)
    }

    #[expect(clippy::cast_precision_loss, reason = "a handful of panels")]
    fn row(&self, drawing: &mut Drawing, row: usize, top: f64) -> Vec<Panel> {
        let many = self.columns.len() as f64;
        let width = ((PAGE - LEFT - RIGHT - COLUMN_GAP * (many - 1.0)) / many).min(WIDEST);
        let upper = top + row as f64 * (self.height + ROW_GAP) + ROW_GAP - 10.0;
        let (name, axis) = &self.rows[row];
        drawing.text(Text::new(LEFT, upper - 6.0, Anchor::Start, name).bold());
        (0..self.columns.len())
            .map(|column| {
                let left = LEFT + column as f64 * (width + COLUMN_GAP);
                let panel =
                    Panel { x: self.x.scale([left, left + width]), y: axis.scale([upper + self.height, upper]) };
                panel.y_ticks(drawing, &panel.y.ticks(4), column == 0);
                let wide = if width < 200.0 { 4 } else { 7 };
                panel.x_ticks(drawing, &panel.x.ticks(wide), row + 1 == self.rows.len());
                panel.frame(drawing);
                if row == 0 {
                    drawing
                        .text(Text::new(left + 0.5 * width, top - 6.0, Anchor::Middle, &self.columns[column]).bold());
                }
                panel
            })
            .collect()
    }
}

/// Writes the number of measurements of a panel into its upper right corner.
pub(super) fn draw_count(drawing: &mut Drawing, panel: &Panel, n: usize) {
    drawing.text(Text::new(panel.right(), panel.top() - 3.0, Anchor::End, format!("n = {n}")).small());
}
