//! Sessions that hold the same card.

use std::collections::BTreeMap;

use model::{Problem, ProblemCode, SessionStatus, Severity, Stage};

/// Adds a note to each session whose card is that of an earlier one in the order of names: what was eaten once would count twice.
pub(super) fn note_same_cards(statuses: &mut BTreeMap<String, SessionStatus>) {
    let mut first_of: BTreeMap<String, String> = BTreeMap::new();
    for (session, status) in statuses {
        let Some(card) = &status.card_sha256 else { continue };
        match first_of.get(card) {
            Some(first) => status.problems.push(same_card(session, first)),
            None => {
                first_of.insert(card.clone(), session.clone());
            }
        }
    }
}

fn same_card(session: &str, first: &str) -> Problem {
    Problem {
        severity: Severity::Note,
        stage: Stage::Ingest,
        code: ProblemCode::SameCard,
        place: format!("cards/{session}"),
        fact: format!(
            "its files are those of session '{first}', byte for byte: what was eaten once counts twice in the results"
        ),
        remedy: ProblemCode::SameCard.remedy().to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_session_after_the_first_is_told_of_its_card() {
        let status =
            |card: Option<&str>| SessionStatus { card_sha256: card.map(str::to_owned), ..SessionStatus::default() };
        let cards = [("a", Some("1")), ("b", None), ("c", Some("2")), ("d", Some("1")), ("e", Some("1")), ("f", None)];
        let mut statuses = cards.map(|(name, card)| (name.to_owned(), status(card))).into_iter().collect();
        note_same_cards(&mut statuses);
        let told: Vec<&String> =
            statuses.iter().filter(|(_, s)| !s.problems.is_empty()).map(|(name, _)| name).collect();
        assert_eq!(told, ["d", "e"]);
        assert!(statuses["e"].problems[0].fact.contains("session 'a'"));
    }
}
