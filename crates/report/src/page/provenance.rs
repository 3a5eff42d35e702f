//! The origin of the results: settings, versions, hashes and times.

use model::results::RESULTS_SCHEMA_VERSION;
use model::{RunLog, RunMetadata, StageLog};
use serde_json::Value;

use super::table_view::TableView;
use crate::table::{Cell, Column, Role, RowKind, Table, TableRow};

/// The origin of the results, as the page shows it.
pub(super) struct Provenance {
    /// Names and values, in their order on the page.
    pub(super) facts: Vec<(&'static str, String)>,
    pub(super) settings: TableView,
    pub(super) inputs: TableView,
}

impl Provenance {
    pub(super) fn from_metadata(metadata: &RunMetadata, log: Option<&RunLog>) -> Result<Self, serde_json::Error> {
        let mut settings = Vec::new();
        flatten(&metadata.settings, String::new(), &mut settings);
        let inputs = metadata.inputs_sha256.iter().map(|(path, hash)| (path.clone(), hash.clone())).collect();
        let inputs_statistic = "SHA-256 of every file that results were made from. That of a card is the SHA-256 over a \
                                line 'sha256  path' for each of its files, in the order of their paths.";
        Ok(Self {
            facts: facts(metadata, log),
            settings: pairs("settings", "Settings, as resolved", "", ["setting", "value"], settings)?,
            inputs: pairs("inputs", "Inputs", inputs_statistic, ["file or card", "SHA-256"], inputs)?,
        })
    }
}

fn facts(metadata: &RunMetadata, log: Option<&RunLog>) -> Vec<(&'static str, String)> {
    let mut facts = vec![("Program", metadata.program.clone())];
    facts.extend(metadata.commit.clone().map(|commit| ("Commit", commit)));
    facts.push(("Version of the results' schema", RESULTS_SCHEMA_VERSION.to_string()));
    let Some(log) = log else {
        facts.push(("Times of the run", "not known: no run.json of this run beside the results".to_owned()));
        return facts;
    };
    facts.push(("Run began (UTC)", log.started_utc.clone()));
    facts.push(("Run ended (UTC)", log.finished_utc.clone()));
    facts.push(("Run took", format!("{:.1} s, {} sessions at a time", log.seconds, log.jobs)));
    let stage = |stage: &StageLog| {
        let StageLog { stage, done, kept, failed, seconds } = stage;
        format!("{stage} {seconds:.1} s ({done} done, {kept} kept from an earlier run, {failed} failed)")
    };
    facts.push(("By stage", log.stages.iter().map(stage).collect::<Vec<_>>().join("; ")));
    facts
}

/// Appends the leaves of a JSON value with their paths, such as `select.target_pitch_deg`. Lists of plain values are leaves.
fn flatten(value: &Value, path: String, leaves: &mut Vec<(String, String)>) {
    let below = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
    match value {
        Value::Object(object) if !object.is_empty() => {
            object.iter().for_each(|(key, value)| flatten(value, below(key), leaves));
        }
        Value::Array(list) if list.iter().any(|item| item.is_object() || item.is_array()) => {
            for (index, item) in list.iter().enumerate() {
                flatten(item, format!("{path}[{index}]"), leaves);
            }
        }
        Value::String(text) => leaves.push((path, text.clone())),
        Value::Null => leaves.push((path, "none".to_owned())),
        other => leaves.push((path, other.to_string())),
    }
}

fn pairs(
    stem: &str,
    title: &str,
    statistic: &str,
    headings: [&str; 2],
    pairs: Vec<(String, String)>,
) -> Result<TableView, serde_json::Error> {
    let row = |(name, value): (String, String)| TableRow {
        kind: RowKind::Row,
        label: None,
        cells: vec![Cell::Text(name), Cell::Text(value)],
        marks: Vec::new(),
    };
    let table = Table {
        stem: stem.to_owned(),
        label: None,
        title: title.to_owned(),
        statistic: statistic.to_owned(),
        columns: headings.map(|heading| Column { role: Role::Note, ..Column::key(heading).headed(heading) }).into(),
        rows: pairs.into_iter().map(row).collect(),
        footnotes: Vec::new(),
        remarks: Vec::new(),
        statement: None,
    };
    TableView::from_table(&table, false)
}

#[cfg(test)]
mod tests {
    use super::flatten;

    #[test]
    fn settings_are_named_by_their_path() {
        let mut leaves = Vec::new();
        let settings = serde_json::json!({"a": {"b": 1.5, "c": [1, 2], "e": null}, "d": [{"x": "y"}], "f": {}});
        flatten(&settings, String::new(), &mut leaves);
        let leaves: Vec<(&str, &str)> = leaves.iter().map(|(path, value)| (path.as_str(), value.as_str())).collect();
        assert_eq!(leaves, [("a.b", "1.5"), ("a.c", "[1,2]"), ("a.e", "none"), ("d[0].x", "y"), ("f", "{}")]);
    }
}
