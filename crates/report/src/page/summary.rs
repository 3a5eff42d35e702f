//! The summary at the top of the page: counts, and the best answers in a few sentences.

use std::collections::BTreeSet;

use model::validation::{ErrorSummary, coverage};
use model::{FlowStep, Level, ResultRow, SessionStatus};

use super::answers::{Answers, median_absolute};
use super::disagreement;
use crate::parquet::Results;
use crate::table::Table;

/// The summary at the top of the page.
pub(super) struct Summary {
    pub(super) study: String,
    pub(super) statement: Option<String>,
    pub(super) sentences: Vec<String>,
    pub(super) cards: Vec<Card>,
    /// The answers by kind of container and quantity.
    pub(super) answers: Option<Table>,
    /// The fused sizes whose images or raters do not agree.
    pub(super) disagreement: Option<Table>,
}

/// A number with its label and a note.
pub(super) struct Card {
    pub(super) label: &'static str,
    pub(super) value: String,
    pub(super) note: String,
}

impl Summary {
    pub(super) fn from_results(results: &Results) -> Self {
        let answers = Answers::from_rows(&results.rows);
        let mut sentences = vec![images_sentence(results)];
        sentences.extend(answers.iter().flat_map(Answers::sentences));
        let mut cards = vec![sessions_card(results), images_card(results), objects_card(&results.rows)];
        cards.extend(answers.iter().flat_map(Answers::cards));
        Self {
            study: results.metadata.study.clone(),
            statement: results.metadata.statement.clone(),
            sentences,
            cards,
            answers: answers.as_ref().map(Answers::table),
            disagreement: disagreement::table(&results.rows),
        }
    }
}

/// The number of all images of the run, and of those that are selected.
fn images(results: &Results) -> (usize, usize) {
    let of_status = |count: fn(&SessionStatus) -> usize| results.metadata.sessions.iter().map(count).sum::<usize>();
    results.flow.as_ref().map_or_else(
        || (of_status(|status| status.images), of_status(|status| status.selected)),
        |flow| (flow.total().images_at(FlowStep::Found), flow.total().images_at(FlowStep::Selected)),
    )
}

fn images_sentence(results: &Results) -> String {
    let (found, selected) = images(results);
    let sessions = results.metadata.sessions.len();
    let lost = results.metadata.sessions.iter().filter(|status| status.has_losses()).count();
    let lost = match lost {
        0 => "none of which lost data".to_owned(),
        lost => format!("{lost} of which lost data or failed"),
    };
    format!("{} ({lost}) gave {}; {selected} are selected.", counted(sessions, "session"), counted(found, "image"))
}

fn sessions_card(results: &Results) -> Card {
    let sessions = &results.metadata.sessions;
    let failed = sessions.iter().filter(|status| status.failed).count();
    let lost = sessions.iter().filter(|status| !status.failed && status.has_losses()).count();
    let note = if failed + lost == 0 { "all well".to_owned() } else { format!("{failed} failed, {lost} lost data") };
    Card { label: "Sessions", value: sessions.len().to_string(), note }
}

#[expect(clippy::cast_precision_loss, reason = "a count of images is far below 2^53")]
fn images_card(results: &Results) -> Card {
    let (found, selected) = images(results);
    let share = if found > 0 { 100.0 * selected as f64 / found as f64 } else { 0.0 };
    Card { label: "Images", value: found.to_string(), note: format!("{selected} selected ({share:.0}\u{a0}%)") }
}

fn objects_card(rows: &[ResultRow]) -> Card {
    let objects: BTreeSet<&str> = rows.iter().map(|row| row.object.as_str()).collect();
    let people = rows.iter().filter(|row| row.level != Level::Consensus);
    let raters: BTreeSet<&str> = people.map(|row| row.rater.as_str()).collect();
    Card {
        label: "Objects",
        value: objects.len().to_string(),
        note: format!("marked by {}", counted(raters.len(), "rater")),
    }
}

impl Answers<'_> {
    fn sentences(&self) -> Vec<String> {
        let objects: BTreeSet<&str> = self.rows.iter().map(|row| row.object.as_str()).collect();
        let mut first = format!(
            "Best answers: {} of {} by method {}",
            counted(self.rows.len(), self.name()),
            counted(objects.len(), "object"),
            self.method
        );
        match self.median_sigma_pct() {
            Some(sigma) => first.push_str(&format!(", with a standard uncertainty of {sigma:.1} % in the median.")),
            None => first.push('.'),
        }
        let mut sentences = vec![first];
        sentences.extend(self.error_sentence());
        sentences.extend(self.coverage_sentence());
        sentences
    }

    fn error_sentence(&self) -> Option<String> {
        let errors = self.errors_pct();
        let all = ErrorSummary::from_errors(&errors)?;
        let known = if errors.len() == self.rows.len() { "all of them".to_owned() } else { errors.len().to_string() };
        Some(format!(
            "Of {known} the true size is known: mean error {}, median of the absolute errors {:.1} %.",
            mean_and_sd(&all),
            median_absolute(&errors)
        ))
    }

    fn coverage_sentence(&self) -> Option<String> {
        let claims = self.rows.iter().filter(|row| row.doubts.is_empty());
        let claims: Vec<(f64, f64)> =
            claims.filter_map(|row| Some((row.predicted_mm? - row.truth_mm?, row.sigma_mm?))).collect();
        let coverage = coverage(&claims)?;
        Some(format!(
            "Where no assumption is in doubt ({}), the intervals that are stated to hold 68 and 95 % of the true sizes hold \
             {:.0} and {:.0} %.",
            counted(claims.len(), "size"),
            100.0 * coverage.within_68,
            100.0 * coverage.within_95
        ))
    }

    fn cards(&self) -> Vec<Card> {
        let method = self.method;
        let mut cards = vec![Card {
            label: if self.level == Level::Fused { "Fused sizes" } else { "Sizes" },
            value: self.rows.len().to_string(),
            note: format!("by method {method}"),
        }];
        let sigma = self.median_sigma_pct().map(|sigma| Card {
            label: "Uncertainty",
            value: format!("{sigma:.1} %"),
            note: "median sigma of these".to_owned(),
        });
        let error = ErrorSummary::from_errors(&self.errors_pct()).map(|summary| Card {
            label: "Error",
            value: format!("{:.1} %", median_absolute(&self.errors_pct())),
            note: format!("median of {} absolute errors", summary.n),
        });
        cards.extend(sigma.into_iter().chain(error));
        cards
    }
}

fn mean_and_sd(summary: &ErrorSummary) -> String {
    match summary.sd {
        Some(sd) => format!("{} \u{b1} {sd:.2} %", signed(summary.bias)),
        None => format!("{} %", signed(summary.bias)),
    }
}

/// A number with a sign, which is a true minus where it is negative, and two decimals. Zero has no sign.
fn signed(number: f64) -> String {
    match format!("{number:+.2}") {
        text if text == "+0.00" || text == "-0.00" => "0.00".to_owned(),
        text => text.replace('-', "\u{2212}"),
    }
}

/// A number of things as `1 image` or `2 images`. `size of a selected image` has its plural at the first word.
fn counted(count: usize, name: &str) -> String {
    match (count, name.split_once(' ')) {
        (1, _) => format!("1 {name}"),
        (_, Some(("size", rest))) => format!("{count} sizes {rest}"),
        _ => format!("{count} {name}s"),
    }
}

#[cfg(test)]
mod tests {
    use super::{counted, signed};

    #[test]
    fn numbers_read_well() {
        assert_eq!([1.0, -1.346, 0.001, -0.001].map(signed), ["+1.00", "\u{2212}1.35", "0.00", "0.00"]);
        assert_eq!(counted(1, "image"), "1 image");
        assert_eq!(counted(0, "image"), "0 images");
        assert_eq!(counted(2, "size of a selected image"), "2 sizes of a selected image");
        assert_eq!(counted(2, "fused size"), "2 fused sizes");
    }
}
