//! Sessions that hold the same card, or files of one card: a copy that was made twice while the card filled, or files that were kept in
//! two places.

use std::collections::{BTreeMap, BTreeSet};

use model::{Problem, ProblemCode, SessionStatus, Severity, Stage};

use crate::inputs::SKETCH_FILES;

/// Fewer files in common may be alike by chance: a picture that is black, a file with nothing but its header.
const LEAST_IN_COMMON: usize = 2;

/// Adds a note to each session that shares files with an earlier one in the order of names: what was eaten once would count twice.
pub(super) fn note_same_cards(statuses: &mut BTreeMap<String, SessionStatus>) {
    let mut notes: Vec<(String, Problem)> = Vec::new();
    let mut sessions_of: BTreeMap<&str, Vec<&SessionStatus>> = BTreeMap::new();
    for (session, status) in &*statuses {
        let with_file = status.card_sketch.iter().filter_map(|file| sessions_of.get(file.as_str())).flatten();
        let earlier: BTreeMap<&str, &SessionStatus> =
            with_file.map(|earlier| (earlier.session.as_str(), *earlier)).collect();
        let shared = earlier.values().filter_map(|other| Some((*other, Shared::between(status, other)?)));
        // The first of those that share the most.
        let most = shared.reduce(|most, next| if next.1.share() > most.1.share() { next } else { most });
        notes.extend(most.map(|(other, shared)| (session.clone(), shared.problem(session, &other.session))));
        for file in &status.card_sketch {
            sessions_of.entry(file).or_default().push(status);
        }
    }
    for (session, note) in notes {
        statuses.entry(session).and_modify(|status| status.problems.push(note));
    }
}

/// The files that two cards have in common, out of a sample of the files of both.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Shared {
    common: usize,
    sample: usize,
}

impl Shared {
    /// None where the cards share no more than chance would give.
    fn between(a: &SessionStatus, b: &SessionStatus) -> Option<Self> {
        let [a, b] = [a, b].map(|status| status.card_sketch.iter().collect::<BTreeSet<_>>());
        // Beyond the end of a sketch that is full it is not known which files there are. The least files of both together are known.
        let sample: Vec<_> = a.union(&b).take(SKETCH_FILES).collect();
        let common = sample.iter().filter(|file| a.contains(**file) && b.contains(**file)).count();
        let shared = Self { common, sample: sample.len() };
        (common >= LEAST_IN_COMMON || common > 0 && shared.is_all()).then_some(shared)
    }

    fn is_all(self) -> bool {
        self.common == self.sample
    }

    #[expect(clippy::cast_precision_loss, reason = "at most 16")]
    fn share(self) -> f64 {
        self.common as f64 / self.sample as f64
    }

    fn problem(self, session: &str, first: &str) -> Problem {
        let which = if self.is_all() {
            format!("its files are those of session '{first}'")
        } else {
            format!(
                "about {:.0} % of the files of both together are in session '{first}' as well",
                100.0 * self.share()
            )
        };
        Problem {
            severity: Severity::Note,
            stage: Stage::Ingest,
            code: ProblemCode::SameCard,
            place: format!("cards/{session}"),
            fact: format!("{which}, byte for byte: what was eaten once counts twice in the results"),
            remedy: ProblemCode::SameCard.remedy().to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;
    use crate::inputs::{card_sketch, sha256_of_bytes};

    /// The facts by session, of cards that hold these files.
    fn told(cards: &[(&str, Vec<u32>)]) -> BTreeMap<String, String> {
        let status = |session: &str, files: &[u32]| {
            let hashes: Vec<String> = files.iter().map(|file| sha256_of_bytes(&file.to_le_bytes())).collect();
            let card_sketch = card_sketch(hashes.iter().map(String::as_str));
            SessionStatus { session: session.to_owned(), card_sketch, ..SessionStatus::default() }
        };
        let mut statuses =
            cards.iter().map(|(session, files)| ((*session).to_owned(), status(session, files))).collect();
        note_same_cards(&mut statuses);
        let fact = |(session, status): (String, SessionStatus)| Some((session, status.problems.first()?.fact.clone()));
        statuses.into_iter().filter_map(fact).collect()
    }

    #[test]
    fn every_session_after_the_first_is_told_of_its_card() {
        let (one, other) = ((0..400).collect::<Vec<u32>>(), vec![9000]);
        let told = told(&[
            ("a", one.clone()),
            ("b", vec![]),
            ("c", other.clone()),
            ("d", one.clone()),
            ("e", one),
            ("f", other),
        ]);
        assert_eq!(told.keys().collect::<Vec<_>>(), ["d", "e", "f"]);
        assert!(told["e"].starts_with("its files are those of session 'a'"), "{}", told["e"]);
        assert!(told["f"].contains("session 'c'"));
    }

    #[test]
    fn a_card_that_was_copied_again_as_it_filled_is_told() {
        for first in [3, 12, 100, 200] {
            let told =
                told(&[("a", (0..first).collect()), ("b", (0..2 * first).collect()), ("c", (5000..5400).collect())]);
            assert_eq!(told.keys().collect::<Vec<_>>(), ["b"], "{first} files, then twice as many");
            let percent: f64 = told["b"].split_whitespace().nth(1).unwrap().parse().unwrap();
            assert!((20.0..=80.0).contains(&percent), "{}", told["b"]);
        }
    }

    #[test]
    fn one_file_in_common_may_be_chance() {
        let with_black = |files: std::ops::Range<u32>| [vec![77_777], files.collect()].concat();
        assert_eq!(told(&[("a", with_black(0..10)), ("b", with_black(100..110))]), BTreeMap::new());
    }

    #[test]
    fn empty_files_and_files_that_could_not_be_read_say_nothing() {
        let hashes = [sha256_of_bytes(b""), ingest::UNREADABLE.to_owned()];
        assert_eq!(card_sketch(hashes.iter().map(String::as_str)), Vec::<String>::new());
    }
}
