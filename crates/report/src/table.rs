//! The one table that every renderer draws.

/// A table: cells with types, so that a terminal, a CSV file and LaTeX show the same numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Name of its files, without extension: `table_II`.
    pub stem: String,
    /// Number in a publication's manner: `Table II`; none for tables that no study asked for.
    pub label: Option<String>,
    /// Caption.
    pub title: String,
    /// What the errors are and which mean and SD are given, in a sentence or two.
    pub statistic: String,
    /// Columns.
    pub columns: Vec<Column>,
    /// Rows, each with one cell per column.
    pub rows: Vec<TableRow>,
    /// Footnotes with marks, in the order of the marks.
    pub footnotes: Vec<Footnote>,
    /// Footnotes to the table as a whole, without marks.
    pub remarks: Vec<String>,
    /// The sentence that the study wants every report to carry.
    pub statement: Option<String>,
}

/// A column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name in CSV, with the unit: `predicted_cm`.
    pub name: String,
    /// Heading for people; none for a column that only CSV has.
    pub heading: Option<String>,
    /// Unit under the heading.
    pub unit: Option<&'static str>,
    /// What the column is for.
    pub role: Role,
    /// Alignment.
    pub align: Align,
    /// How people see its numbers. CSV has up to six decimals of every number.
    pub format: Format,
    /// Name of the column whose number follows after ±, where it has one.
    pub spread: Option<&'static str>,
}

/// What a column is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Says which row it is.
    Key,
    /// A number to compare.
    Result,
    /// Words.
    Note,
}

/// Alignment of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// Left, for words.
    Left,
    /// Right, for numbers.
    Right,
}

/// How numbers are shown to people.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// With this many decimals.
    Decimals(usize),
    /// With as many decimals as they need, at most six.
    Shortest,
}

/// A row.
#[derive(Debug, Clone, PartialEq)]
pub struct TableRow {
    /// What it stands for.
    pub kind: RowKind,
    /// Stands for the first shown cell, in rows of means.
    pub label: Option<String>,
    /// One cell per column.
    pub cells: Vec<Cell>,
    /// Marks of its footnotes: letters.
    pub marks: Vec<String>,
}

/// What a row stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowKind {
    /// A measurement.
    Row,
    /// Mean and SD of an object's errors.
    ObjectMean,
    /// Mean and SD over the table; of numbers of images, their sums.
    Overall,
    /// The same, of errors against the truths that were printed.
    OverallPrintedTruth,
}

impl RowKind {
    /// Its code in the CSV column `row`.
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

/// A cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// Nothing.
    Empty,
    /// Words.
    Text(String),
    /// A number in the unit of its column.
    Number(f64),
    /// A count.
    Count(usize),
}

impl Cell {
    /// Words.
    pub(crate) fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    /// A number, or nothing. Numbers that are not finite are nothing.
    pub(crate) fn number(number: Option<f64>) -> Self {
        number.filter(|number| number.is_finite()).map_or(Self::Empty, Self::Number)
    }
}

/// A footnote.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Footnote {
    /// Its letter.
    pub mark: String,
    /// What the reader must know.
    pub text: String,
}

impl Column {
    /// A column of words that says which row it is. Give it a heading to show it.
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

    /// A column of numbers with two decimals.
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

    pub(crate) fn numbers(self, unit: &'static str) -> Self {
        Self { unit: Some(unit), align: Align::Right, ..self }
    }

    pub(crate) fn headed(self, heading: impl Into<String>) -> Self {
        Self { heading: Some(heading.into()), ..self }
    }

    pub(crate) fn headed_if(self, shown: bool, heading: &str) -> Self {
        if shown { self.headed(heading) } else { self }
    }

    pub(crate) fn formatted(self, format: Format) -> Self {
        Self { format, ..self }
    }

    pub(crate) fn with_spread(self, column: &'static str) -> Self {
        Self { spread: Some(column), ..self }
    }
}

/// Name of the column of notes.
pub(crate) const NOTE: &str = "note";
/// Name of the column of row kinds.
pub(crate) const ROW: &str = "row";
