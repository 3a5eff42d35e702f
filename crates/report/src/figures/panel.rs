//! A panel: a rectangle with two scales, its axes, and lines at given values.

use super::drawing::{Anchor, Colour, Drawing, Paint, Text, short};
use super::scale::{Scale, Tick};
use super::words::estimated_width;

/// The paint of axes and their ticks.
pub(super) const AXIS: Paint = Paint::line(Colour::Ink, 1.0);
/// The paint of the lines behind the marks that help to read values.
pub(super) const GUIDE: Paint = Paint::line(Colour::Ink, 0.8).faint(0.18);

/// Length of a tick.
const TICK: f64 = 4.0;

/// A rectangle with two scales. The range of `y` runs from its lower edge to its upper one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Panel {
    pub(super) x: Scale,
    pub(super) y: Scale,
}

impl Panel {
    pub(super) const fn left(&self) -> f64 {
        self.x.range()[0]
    }

    pub(super) const fn right(&self) -> f64 {
        self.x.range()[1]
    }

    pub(super) const fn top(&self) -> f64 {
        self.y.range()[1]
    }

    pub(super) const fn bottom(&self) -> f64 {
        self.y.range()[0]
    }

    /// Draws the left and the lower edge.
    pub(super) fn frame(&self, drawing: &mut Drawing) {
        let path =
            format!("M{},{}V{}H{}", short(self.left()), short(self.top()), short(self.bottom()), short(self.right()));
        drawing.path("axis", AXIS, path);
    }

    /// Draws ticks below the panel, with their labels where `named`.
    pub(super) fn x_ticks(&self, drawing: &mut Drawing, ticks: &[Tick], named: bool) {
        let tick = |tick: &Tick| format!("M{},{}v{TICK}", short(self.x.place(tick.value)), short(self.bottom()));
        drawing.path("axis", AXIS, ticks.iter().map(tick).collect());
        for tick in ticks.iter().filter(|_| named) {
            // At the right edge a label moves inwards, since there may be another panel.
            let most = self.right() + 6.0 - 0.5 * estimated_width(&tick.label, 10.5);
            let x = self.x.place(tick.value).min(most.max(self.left()));
            drawing.text(Text::new(x, self.bottom() + 16.0, Anchor::Middle, &tick.label).small());
        }
    }

    /// Draws ticks to the left of the panel and guides across it, with their labels where `named`.
    pub(super) fn y_ticks(&self, drawing: &mut Drawing, ticks: &[Tick], named: bool) {
        let guide = |tick: &Tick| {
            format!("M{},{}H{}", short(self.left()), short(self.y.place(tick.value)), short(self.right()))
        };
        drawing.path("guide", GUIDE, ticks.iter().map(guide).collect());
        let tick = |tick: &Tick| format!("M{},{}h-{TICK}", short(self.left()), short(self.y.place(tick.value)));
        drawing.path("axis", AXIS, ticks.iter().map(tick).collect());
        for tick in ticks.iter().filter(|_| named) {
            let text = Text::new(self.left() - 7.0, self.y.place(tick.value) + 3.8, Anchor::End, &tick.label);
            drawing.text(text.small());
        }
    }

    /// Draws a line across the panel at a value of y, where the value lies in the panel.
    pub(super) fn level(&self, drawing: &mut Drawing, class: &'static str, paint: Paint, y: f64) {
        if self.y.holds(y) {
            let path = format!("M{},{}H{}", short(self.left()), short(self.y.place(y)), short(self.right()));
            drawing.path(class, paint, path);
        }
    }

    /// Draws a line from the lower to the upper edge at a value of x, where the value lies in the panel.
    pub(super) fn upright(&self, drawing: &mut Drawing, class: &'static str, paint: Paint, x: f64) {
        if self.x.holds(x) {
            let path = format!("M{},{}V{}", short(self.x.place(x)), short(self.bottom()), short(self.top()));
            drawing.path(class, paint, path);
        }
    }

    /// The path of a rectangle between values, cut off at the edges of the panel.
    pub(super) fn rectangle(&self, x: [f64; 2], y: [f64; 2]) -> String {
        let ([left, right], [low, high]) = (x.map(|x| self.x.place(x)), y.map(|y| self.y.place(y)));
        format!("M{},{}H{}V{}H{}z", short(left), short(low), short(right), short(high), short(left))
    }

    /// The path of a line through points given as values. A value beyond the panel stands at its edge.
    pub(super) fn line(&self, values: impl IntoIterator<Item = [f64; 2]>) -> String {
        let place = |[x, y]: [f64; 2]| format!("{},{}", short(self.x.place(x)), short(self.y.place(y)));
        let places: Vec<String> = values.into_iter().map(place).collect();
        if places.is_empty() { String::new() } else { format!("M{}", places.join("L")) }
    }
}
