//! Naming places on a card in messages.

use std::path::Path;

use model::{Problem, ProblemCode, Severity, Stage};

use crate::unicode::nfc;

/// A card, as messages name it: `cards/SESSION` in a study, else the folder's name.
#[derive(Debug, Clone)]
pub(crate) struct Place(String);

impl Place {
    pub fn of_card(card_dir: &Path) -> Self {
        let name = |path: &Path| path.file_name().map(|name| nfc(name.to_string_lossy()));
        let own = name(card_dir).unwrap_or_else(|| card_dir.display().to_string());
        match card_dir.parent().and_then(name) {
            Some(parent) if parent == "cards" => Self(format!("cards/{own}")),
            _ => Self(own),
        }
    }

    /// Something lost from a file of the card; from the card itself for an empty `file`.
    pub fn problem(
        &self,
        code: ProblemCode,
        file: &str,
        fact: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Problem {
        let place = if file.is_empty() { self.0.clone() } else { format!("{}/{file}", self.0) };
        Problem {
            severity: Severity::Loss,
            stage: Stage::Ingest,
            code,
            place,
            fact: fact.into(),
            remedy: remedy.into(),
        }
    }

    /// Something worth knowing, by which nothing was lost.
    pub fn note(&self, code: ProblemCode, file: &str, fact: impl Into<String>, remedy: impl Into<String>) -> Problem {
        Problem { severity: Severity::Note, ..self.problem(code, file, fact, remedy) }
    }
}

/// How much: `3 images (2.1 MB)`, in decimal units.
pub(crate) fn amount(count: usize, thing: &str, bytes: u64) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {thing}{plural} ({})", size(bytes))
}

/// Bytes in decimal units: `812 bytes`, `2.1 MB`.
pub(crate) fn size(bytes: u64) -> String {
    let exact = bytes as f64;
    match bytes {
        1 => "1 byte".to_owned(),
        0..1_000 => format!("{bytes} bytes"),
        1_000..1_000_000 => format!("{:.1} kB", exact / 1e3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", exact / 1e6),
        _ => format!("{:.1} GB", exact / 1e9),
    }
}
