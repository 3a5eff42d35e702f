//! The table that every renderer turns into text.

/// A table whose cells have types, so that a terminal, a CSV file and LaTeX show the same numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Name of its files, without extension: `table_II`.
    pub stem: String,
    /// Number in a publication's manner, such as `Table II`; none for tables that no study asked for.
    pub label: Option<String>,
    /// Caption, as plain text.
    pub title: String,
    /// The definitions of the errors, means and SDs in the table, in a sentence or two.
    pub statistic: String,
    /// The columns.
    pub columns: Vec<Column>,
    /// The rows, each with one cell per column.
    pub rows: Vec<TableRow>,
    /// Footnotes with marks, in the order of the marks.
    pub footnotes: Vec<Footnote>,
    /// Footnotes to the table as a whole, without marks.
    pub remarks: Vec<String>,
    /// The sentence that the study wants every report to carry.
    pub statement: Option<String>,
}

/// A column of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name in CSV, with the unit: `predicted_cm`.
    pub name: String,
    /// Heading for people; none for a column that only CSV has.
    pub heading: Option<String>,
    /// Unit, which stands under the heading.
    pub unit: Option<&'static str>,
    /// The purpose of the column.
    pub role: Role,
    /// Alignment of its cells.
    pub align: Align,
    /// The form in which people see its numbers. CSV has up to six decimals of every number.
    pub format: Format,
    /// Name of the column whose number follows after ±, where there is one.
    pub spread: Option<&'static str>,
}

/// The purpose of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// It identifies the row.
    Key,
    /// It holds numbers that are results.
    Result,
    /// It holds words to read.
    Note,
}

/// Alignment of the cells of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// Left, for words.
    Left,
    /// Right, for numbers.
    Right,
}

/// The form in which numbers are shown to people.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// With this many decimals.
    Decimals(usize),
    /// With as many decimals as they need, at most six.
    Shortest,
}

/// A row of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct TableRow {
    /// The kind of row.
    pub kind: RowKind,
    /// In rows of means, the text that stands in place of the first cell that is shown.
    pub label: Option<String>,
    /// One cell per column.
    pub cells: Vec<Cell>,
    /// Marks of its footnotes, which are letters.
    pub marks: Vec<String>,
}

/// The kind of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowKind {
    /// One measurement.
    Row,
    /// Mean and SD of an object's errors.
    ObjectMean,
    /// Mean and SD over the table; in tables of numbers of images, their sums.
    Overall,
    /// Mean and SD over the table, of the errors against the true sizes that were printed.
    OverallPrintedTruth,
}

impl RowKind {
    /// The code of the kind in the CSV column `row`.
    #[must_use]
    pub const fn code(self) -> &'static str {
        match self {
            Self::Row => "row",
            Self::ObjectMean => "object_mean",
            Self::Overall => "overall",
            Self::OverallPrintedTruth => "overall_printed_truth",
        }
    }
}

/// A cell of a table.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// It holds nothing.
    Empty,
    /// Words.
    Text(String),
    /// A number in the unit of its column.
    Number(f64),
    /// A count.
    Count(usize),
}

impl Cell {
    /// A cell of words.
    pub(crate) fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    /// A cell with the number; an empty one where there is no number, or none that is finite.
    pub(crate) fn number(number: Option<f64>) -> Self {
        number.filter(|number| number.is_finite()).map_or(Self::Empty, Self::Number)
    }
}

/// A footnote of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Footnote {
    /// Its letter.
    pub mark: String,
    /// Its text.
    pub text: String,
}

impl Column {
    /// A column of words that identifies the row. People see it once it has a heading.
    pub(crate) fn key(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            heading: None,
            unit: None,
            role: Role::Key,
            align: Align::Left,
            format: Format::Shortest,
            spread: None,
        }
    }

    /// A column of results with two decimals. People see it once it has a heading.
    pub(crate) fn result(name: impl Into<String>, unit: &'static str) -> Self {
        Self {
            name: name.into(),
            heading: None,
            unit: Some(unit),
            role: Role::Result,
            align: Align::Right,
            format: Format::Decimals(2),
            spread: None,
        }
    }

    /// The column of notes.
    pub(crate) fn note() -> Self {
        Self { role: Role::Note, ..Self::key(NOTE) }
    }

    /// The column as one of numbers with this unit.
    pub(crate) fn numbers(self, unit: &'static str) -> Self {
        Self { unit: Some(unit), align: Align::Right, ..self }
    }

    /// The column with a heading, so that people see it.
    pub(crate) fn headed(self, heading: impl Into<String>) -> Self {
        Self { heading: Some(heading.into()), ..self }
    }

    /// The column with a heading where it is to be `shown`.
    pub(crate) fn headed_if(self, shown: bool, heading: &str) -> Self {
        if shown { self.headed(heading) } else { self }
    }

    pub(crate) fn formatted(self, format: Format) -> Self {
        Self { format, ..self }
    }

    /// The column with the numbers of another one after ±.
    pub(crate) fn with_spread(self, column: &'static str) -> Self {
        Self { spread: Some(column), ..self }
    }
}

/// Name of the column of notes.
pub(crate) const NOTE: &str = "note";
/// Name of the column of row kinds.
pub(crate) const ROW: &str = "row";
