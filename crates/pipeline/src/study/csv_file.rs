//! Small CSV files written by people.

use std::path::Path;

use serde::de::DeserializeOwned;

use super::StudyError;

/// The rows of a file with their line numbers. Blanks around cells are dropped; the header names the columns, in any order.
pub(super) fn read_rows<T: DeserializeOwned>(path: &Path) -> Result<Vec<(u64, T)>, StudyError> {
    let bytes = std::fs::read(path).map_err(|source| StudyError::Unreadable { path: path.to_owned(), source })?;
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(bytes.as_slice());
    let refuse = |line: u64, fact: String| StudyError::Line { path: path.to_owned(), line, fact };
    let refuse_csv =
        |error: csv::Error| refuse(error.position().map_or(1, |at| line_of(&bytes, at)), fact_of(&error, None));
    let headers = reader.headers().map_err(refuse_csv)?.clone();
    if headers.len() == 1 && headers[0].contains([';', '\t']) {
        return Err(refuse(1, "expected columns separated by commas; save the file as CSV with commas".to_owned()));
    }
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(refuse_csv)?;
        let line = record.position().map_or(1, |at| line_of(&bytes, at));
        let row = record.deserialize(Some(&headers)).map_err(|error| refuse(line, fact_of(&error, Some(&headers))))?;
        rows.push((line, row));
    }
    Ok(rows)
}

/// The line of a position, from 1. The reader stops between CR and LF, and before blank lines, so lines are counted here.
fn line_of(bytes: &[u8], at: &csv::Position) -> u64 {
    let start = usize::try_from(at.byte()).unwrap_or(usize::MAX).min(bytes.len());
    let blank = bytes[start..].iter().take_while(|byte| matches!(byte, b'\r' | b'\n')).count();
    1 + bytes[..start + blank].iter().filter(|byte| **byte == b'\n').count() as u64
}

/// The fault in the words of the file, with the column by its name.
fn fact_of(error: &csv::Error, headers: Option<&csv::StringRecord>) -> String {
    match error.kind() {
        csv::ErrorKind::Deserialize { err, .. } => {
            let column = err.field().and_then(|i| headers?.get(usize::try_from(i).ok()?));
            column.map_or_else(|| err.kind().to_string(), |name| format!("column '{name}': {}", err.kind()))
        }
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("expected {expected_len} columns, as in the header; got {len}")
        }
        csv::ErrorKind::Utf8 { .. } => "not UTF-8 text; save the file as UTF-8".to_owned(),
        _ => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    #[derive(Debug, serde::Deserialize)]
    struct Row {
        #[serde(rename = "name")]
        _name: String,
        #[serde(rename = "size")]
        _size: Option<f64>,
    }

    fn refusal(text: &[u8]) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("o.csv");
        std::fs::write(&path, text).unwrap();
        read_rows::<Row>(&path).unwrap_err().to_string()
    }

    #[test]
    fn lines_are_counted_as_editors_count_them() {
        for text in ["name,size\na,1\nb,x\n", "name,size\r\na,1\r\nb,x\r\n"] {
            assert!(
                refusal(text.as_bytes()).starts_with("line 3: column 'size': invalid float"),
                "{}",
                refusal(text.as_bytes())
            );
        }
        assert!(refusal(b"name,size\r\n\r\na,1\r\n\r\nb,x\r\n").starts_with("line 5:"));
    }

    #[test]
    fn what_is_wrong_is_said_in_plain_words() {
        assert!(refusal(b"name;size\na;1\n").contains("separated by commas"));
        assert!(refusal(b"name,size\na\n").contains("expected 2 columns, as in the header; got 1"));
        assert!(refusal(b"name,size\n\xff,1\n").contains("not UTF-8"));
    }
}
