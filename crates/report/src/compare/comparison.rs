//! The result of a comparison.

use std::fmt;

/// The result of a comparison of our tables with expected ones.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Comparison {
    /// Count of the numbers that were compared.
    pub checked: usize,
    /// The numbers that are off, and the expected things that are not there, in the order of files, rows and columns.
    pub differences: Vec<Difference>,
}

/// A difference between our tables and the expected ones.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// Name of the file.
    pub file: String,
    /// The row's key cells; empty for a difference of the whole file.
    pub row: String,
    /// The column; empty for a difference of the whole row.
    pub column: String,
    /// The expected number, or a word for the thing that is missing.
    pub expected: String,
    /// Our number, or the words for why there is none.
    pub got: String,
    /// The absolute difference of the two numbers, in the unit of `allowed`; none where we have no number.
    pub difference: Option<f64>,
    /// The greatest difference that is allowed, and its unit: percentage points, per cent of the expected number, or none for
    /// counts.
    pub allowed: Option<(f64, &'static str)>,
}

impl Difference {
    /// The difference that stands for an expected thing that is not there.
    pub(super) fn missing(file: &str, row: &str, column: &str, expected: &str, got: &str) -> Self {
        let [file, row, column, expected, got] = [file, row, column, expected, got].map(str::to_owned);
        Self { file, row, column, expected, got, difference: None, allowed: None }
    }
}

/// The absolute difference of two numbers of a column, and the allowed one with the unit of both.
fn rule(column: &str, expected: f64, got: f64, tolerance_pct: f64) -> (f64, (f64, &'static str)) {
    let absolute = (got - expected).abs();
    if column.ends_with("_pct") {
        return (absolute, (tolerance_pct, "pp"));
    }
    if column.ends_with("_cm") || column.ends_with("_mm") {
        let relative = if absolute == 0.0 { 0.0 } else { 100.0 * absolute / expected.abs() };
        return (relative, (tolerance_pct, "%"));
    }
    (absolute, (0.0, ""))
}

impl Comparison {
    /// Compares an expected number with our cell.
    pub(super) fn check(&mut self, file: &str, row: &str, column: &str, expected: f64, got: &str, tolerance_pct: f64) {
        self.checked += 1;
        let Ok(number) = got.parse::<f64>() else {
            self.differences.push(Difference::missing(file, row, column, &expected.to_string(), "nothing"));
            return;
        };
        let (difference, allowed) = rule(column, expected, number, tolerance_pct);
        // A hair above the tolerance is rounding: 0.15 is not exact in binary.
        if difference > allowed.0 + 1e-9 {
            self.differences.push(Difference {
                difference: Some(difference),
                allowed: Some(allowed),
                ..Difference::missing(file, row, column, &expected.to_string(), got)
            });
        }
    }

    /// Whether everything is as expected.
    #[must_use]
    pub fn is_ok(&self) -> bool {
        self.differences.is_empty()
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.differences.is_empty() {
            return write!(f, "{} numbers compared with the expected tables, no difference", self.checked);
        }
        let head = ["file", "row", "column", "expected", "got", "difference", "allowed"].map(str::to_owned);
        let lines: Vec<[String; 7]> = std::iter::once(head).chain(self.differences.iter().map(fields)).collect();
        let widths: [usize; 7] =
            std::array::from_fn(|at| lines.iter().map(|line| line[at].chars().count()).max().unwrap_or(0));
        writeln!(f, "{} numbers compared, {} differences:", self.checked, self.differences.len())?;
        for (index, line) in lines.iter().enumerate() {
            let padded: Vec<String> =
                line.iter().zip(widths).map(|(field, width)| format!("{field:<width$}")).collect();
            let end = if index + 1 == lines.len() { "" } else { "\n" };
            write!(f, "{}{end}", padded.join("  ").trim_end())?;
        }
        Ok(())
    }
}

fn fields(difference: &Difference) -> [String; 7] {
    let with_unit = |number: f64| {
        let unit = difference.allowed.map_or("", |(_, unit)| unit);
        format!("{number:.3} {unit}").trim_end().to_owned()
    };
    [
        difference.file.clone(),
        difference.row.clone(),
        difference.column.clone(),
        difference.expected.clone(),
        difference.got.clone(),
        difference.difference.map(with_unit).unwrap_or_default(),
        difference.allowed.map(|(allowed, _)| with_unit(allowed)).unwrap_or_default(),
    ]
}
