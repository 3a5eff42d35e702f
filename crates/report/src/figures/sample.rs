//! The rows of the results that a figure is drawn from, sorted by the panel in which each stands.

use std::collections::{BTreeMap, BTreeSet};

use model::{Kind, Level, Method, Quantity, ResultRow};

use super::drawing::Colour;
use super::marks::{Look, Symbol};
use super::scale::is_drawable;
use super::words::{named, signed};

/// A direction in which containers of a kind are measured: their height, or across (diameter, width and length together, as in
/// the table `error_by_pitch`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Dimension {
    pub(super) kind: Kind,
    pub(super) is_height: bool,
}

impl Dimension {
    pub(super) fn from_row(row: &ResultRow) -> Self {
        Self { kind: row.kind, is_height: row.quantity == Quantity::Height }
    }

    /// Its name, such as `bowl, height`.
    pub(super) fn name(self) -> String {
        format!("{}, {}", self.kind, if self.is_height { "height" } else { "across" })
    }
}

/// Colour and shape of a kind of container, the same in every figure.
pub(super) const fn look(kind: Kind, filled: bool) -> Look {
    let (symbol, colour) = match kind {
        Kind::Plate => (Symbol::Circle, Colour::Blue),
        Kind::Bowl => (Symbol::Triangle, Colour::Vermilion),
        Kind::Box => (Symbol::Square, Colour::Green),
    };
    if filled { Look::filled(symbol, colour) } else { Look::hollow(symbol, colour) }
}

/// A row with a size and a true size.
#[derive(Debug, Clone, Copy)]
pub(super) struct Erring<'a> {
    pub(super) row: &'a ResultRow,
    pub(super) truth_mm: f64,
    /// The predicted size less the true one.
    pub(super) error_mm: f64,
}

impl Erring<'_> {
    pub(super) fn error_pct(&self) -> f64 {
        100.0 * self.error_mm / self.truth_mm
    }

    /// The text that appears when a pointer rests on its mark.
    pub(super) fn title(&self) -> String {
        let row = self.row;
        let image = row.image.as_deref().map(|image| format!(", {}", named(image))).unwrap_or_default();
        format!(
            "{}, {}, {}, {}{image}: {:.1} mm of {:.1} mm, {} %",
            named(&row.object),
            row.quantity,
            named(&row.session),
            named(&row.rater),
            self.truth_mm + self.error_mm,
            self.truth_mm,
            signed(self.error_pct(), 2),
        )
    }
}

/// The rows of a level that have a size and a true size.
pub(super) fn erring(rows: &[ResultRow], level: Level) -> impl Iterator<Item = Erring<'_>> {
    rows.iter().filter(move |row| row.level == level).filter_map(|row| {
        let truth_mm = row.truth_mm.filter(|truth| *truth > 0.0 && is_drawable(*truth))?;
        let error_mm = row.predicted_mm? - truth_mm;
        let row = Erring { row, truth_mm, error_mm };
        is_drawable(row.error_pct()).then_some(row)
    })
}

/// Rows, sorted by dimension and method.
pub(super) struct Sorted<'a> {
    pub(super) dimensions: Vec<Dimension>,
    pub(super) methods: Vec<Method>,
    cells: BTreeMap<(Dimension, Method), Vec<Erring<'a>>>,
}

impl<'a> Sorted<'a> {
    pub(super) fn new(rows: impl Iterator<Item = Erring<'a>>) -> Self {
        let mut cells: BTreeMap<(Dimension, Method), Vec<Erring<'a>>> = BTreeMap::new();
        for row in rows {
            cells.entry((Dimension::from_row(row.row), row.row.method)).or_default().push(row);
        }
        let dimensions: BTreeSet<Dimension> = cells.keys().map(|(dimension, _)| *dimension).collect();
        let methods: BTreeSet<Method> = cells.keys().map(|(_, method)| *method).collect();
        Self { dimensions: dimensions.into_iter().collect(), methods: methods.into_iter().collect(), cells }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    pub(super) fn count(&self) -> usize {
        self.cells.values().map(Vec::len).sum()
    }

    pub(super) fn cell(&self, dimension: Dimension, method: Method) -> &[Erring<'a>] {
        self.cells.get(&(dimension, method)).map_or(&[], Vec::as_slice)
    }

    /// All rows of a dimension, by any method.
    pub(super) fn of_dimension(&self, dimension: Dimension) -> impl Iterator<Item = &Erring<'a>> {
        self.cells.iter().filter(move |((of, _), _)| *of == dimension).flat_map(|(_, rows)| rows)
    }

    pub(super) fn all(&self) -> impl Iterator<Item = &Erring<'a>> {
        self.cells.values().flatten()
    }

    pub(super) fn method_names(&self) -> Vec<String> {
        self.methods.iter().map(|method| method.code().to_owned()).collect()
    }

    /// The kinds of container, for the legend.
    pub(super) fn kinds(&self) -> BTreeSet<Kind> {
        self.dimensions.iter().map(|dimension| dimension.kind).collect()
    }
}

/// A domain that holds the values. Where few of many lie far out (beyond four times the 98 % quantile of their absolute
/// values), it leaves these out, so that the others can be told apart. None where there are no values.
pub(super) fn bulk(values: &[f64]) -> Option<[f64; 2]> {
    let absolute: Vec<f64> = values.iter().map(|value| value.abs()).collect();
    let largest = absolute.iter().copied().fold(0.0, f64::max);
    let most = model::validation::quantile(absolute, 0.98);
    let limit = if values.len() >= 20 && largest > 4.0 * most && most > 0.0 { 2.0 * most } else { largest };
    super::scale::padded(values.iter().copied().filter(|value| value.abs() <= limit).chain([0.0]), 0.08)
}
