//! The columns that a profile names, and their places in the rows of a CSV file.

use std::io::Read;

use super::Fault;
use super::csv_file::CsvLayout;
use super::csv_rows::CsvRows;

/// Columns that a message lists.
const SHOWN_COLUMNS: usize = 30;

/// The places of the columns in a row.
#[derive(Clone)]
pub(super) struct Columns {
    pub time: Option<usize>,
    pub values: Vec<usize>,
    pub extra: Vec<usize>,
    /// The number of fields in the header. None where the file has no header.
    width: Option<usize>,
}

impl Columns {
    /// The columns of a file whose rows have not been read yet: reads its header, if it has one. Fails where a column is
    /// missing, or where the header has its name twice, since nothing then says which of the two is meant.
    pub fn find<R: Read>(rows: &mut CsvRows<R>, layout: &CsvLayout) -> Result<Self, Fault> {
        for _ in 0..layout.format.skip_lines {
            if !rows.skip_line()? {
                break;
            }
        }
        if !layout.format.header {
            return Self::collect(layout, None, |name| numbered(name));
        }
        if !rows.next_row()? {
            return Err(Fault::NoSamples);
        }
        let header = &*rows;
        let width = header.fields().count();
        Self::collect(layout, Some(width), |name| {
            let others = layout.format.other_names.get(name).into_iter().flatten();
            let place = std::iter::once(name).chain(others).find_map(|name| position(header, name).transpose());
            place.unwrap_or_else(|| {
                let found = header.fields().take(SHOWN_COLUMNS).map(shown).collect::<Vec<_>>().join(", ");
                Err(Fault::MissingColumn { column: name.clone(), found })
            })
        })
    }

    /// Refuses a row that has more fields than the header: a comma within a number or a text moves every field behind it,
    /// so no value of the row is sure to be that of its column. Empty fields at the end come from delimiters that end rows.
    pub fn check_width<R: Read>(&self, row: &CsvRows<R>) -> Result<(), String> {
        let Some(width) = self.width else { return Ok(()) };
        // One look at the first field too many is all that a row of the usual length costs.
        if row.get(width).is_none() || row.fields().skip(width).all(|field| field.trim_ascii().is_empty()) {
            return Ok(());
        }
        Err(format!("the row has {} fields, the header {width}", row.fields().count()))
    }

    fn collect(
        layout: &CsvLayout,
        width: Option<usize>,
        find: impl Fn(&String) -> Result<usize, Fault>,
    ) -> Result<Self, Fault> {
        Ok(Self {
            time: layout.time.column.as_ref().map(&find).transpose()?,
            values: layout.values.iter().map(&find).collect::<Result<_, _>>()?,
            extra: layout.extra.iter().map(&find).collect::<Result<_, _>>()?,
            width,
        })
    }
}

/// The place of a column that is named by its number, as '#2'.
fn numbered(name: &str) -> Result<usize, Fault> {
    let number = name.strip_prefix('#').and_then(|number| number.parse::<usize>().ok());
    number.and_then(|number| number.checked_sub(1)).ok_or_else(|| Fault::MissingColumn {
        column: name.to_owned(),
        found: "columns by number: #1, #2 and so on".to_owned(),
    })
}

/// The place of a name in the header. None where it is not there; fails where it is there twice.
fn position<R: Read>(header: &CsvRows<R>, name: &str) -> Result<Option<usize>, Fault> {
    let mut places = header.fields().enumerate().filter(|(_, column)| column.trim_ascii() == name.as_bytes());
    let Some((first, _)) = places.next() else { return Ok(None) };
    places.next().map_or(Ok(Some(first)), |(second, _)| {
        Err(Fault::RepeatedColumn { column: name.to_owned(), first: first + 1, second: second + 1 })
    })
}

/// Untrusted bytes for a message: printable and short.
pub(super) fn shown(bytes: &[u8]) -> String {
    String::from_utf8_lossy(&bytes.trim_ascii()[..bytes.trim_ascii().len().min(40)]).escape_debug().to_string()
}
