//! Scores of a trial: how well sizes and their uncertainties agree with the truth.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use model::{ErrorStats, Method, Quantity};

use super::{Subject, Trial};

/// The images that a size was measured from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// One image.
    Image,
    /// All images of a session.
    Session,
}

/// The score of the sizes of one sort.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// The subject; none for all subjects together.
    pub subject: Option<Subject>,
    /// The quantity.
    pub quantity: Quantity,
    /// The method.
    pub method: Method,
    /// The level.
    pub level: Level,
    /// Number of sizes.
    pub n: usize,
    /// Number of sizes for which the method claims to apply.
    pub claimed: usize,
    /// Mean error of all sizes, in per cent of the truth.
    pub bias_pct: f64,
    /// Root mean square error of all sizes, in per cent of the truth.
    pub rmse_pct: f64,
    /// Root mean square error of the sizes for which the method claims to apply, in per cent of the truth.
    pub claimed_rmse_pct: f64,
    /// Share, from 0 to 1, of the claimed sizes whose 68.3 % interval holds the truth.
    pub within_1: f64,
    /// Share, from 0 to 1, of the claimed sizes whose 95 % interval holds the truth.
    pub within_2: f64,
}

/// The scores of a trial, by subject and for all subjects together.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Score {
    /// The lines, in the order of level, quantity, subject and method.
    pub lines: Vec<Line>,
}

type Key = (Level, Quantity, Option<Subject>, Method);

/// Number of SDs within which 95 % of a Gaussian lie.
const K_95: f64 = 1.959_963_98;

/// The score of a trial's sizes.
#[must_use]
pub fn score(trials: &[Trial]) -> Score {
    let mut groups: BTreeMap<Key, Vec<&Trial>> = BTreeMap::new();
    for trial in trials {
        for subject in [None, Some(trial.subject)] {
            groups.entry((trial.level, trial.quantity, subject, trial.method)).or_default().push(trial);
        }
    }
    Score { lines: groups.into_iter().filter_map(|(key, group)| line(key, &group)).collect() }
}

#[expect(clippy::cast_precision_loss, reason = "a count of sizes is far below 2^53")]
fn line((level, quantity, subject, method): Key, group: &[&Trial]) -> Option<Line> {
    let error_pct = |t: &&Trial| 100.0 * (t.predicted_mm - t.true_mm) / t.true_mm;
    let all = ErrorStats::from_errors(&group.iter().map(error_pct).collect::<Vec<_>>())?;
    let claimed: Vec<&Trial> = group.iter().copied().filter(|t| t.claims).collect();
    let within = |k: f64| {
        let held = claimed.iter().filter(|t| (t.predicted_mm - t.true_mm).abs() <= k * t.sigma_mm).count();
        held as f64 / claimed.len() as f64
    };
    Some(Line {
        subject,
        quantity,
        method,
        level,
        n: group.len(),
        claimed: claimed.len(),
        bias_pct: all.mean,
        rmse_pct: all.rms,
        claimed_rmse_pct: ErrorStats::from_errors(&claimed.iter().map(error_pct).collect::<Vec<_>>())
            .map_or(f64::NAN, |stats| stats.rms),
        within_1: within(1.0),
        within_2: within(K_95),
    })
}

impl Score {
    /// The line of one sort of sizes; none where the trial has no such sizes.
    #[must_use]
    pub fn line(&self, level: Level, quantity: Quantity, subject: Option<Subject>, method: Method) -> Option<&Line> {
        let same =
            |line: &&Line| (line.level, line.quantity, line.subject, line.method) == (level, quantity, subject, method);
        self.lines.iter().find(same)
    }

    /// The score as a Markdown table.
    #[must_use]
    pub fn markdown(&self) -> String {
        let mut text = "| from | size | of | method | n | claimed | bias % | RMSE % | RMSE % claimed | 68 % cover | 95 % cover |\n\
                        |---|---|---|---|---|---|---|---|---|---|---|\n"
            .to_owned();
        let number = |value: f64, digits: usize| {
            if value.is_finite() { format!("{value:.digits$}") } else { "-".to_owned() }
        };
        for l in &self.lines {
            let level = if l.level == Level::Image { "image" } else { "session" };
            let subject = l.subject.map_or("all", Subject::name);
            let _ = writeln!(
                text,
                "| {level} | {} | {subject} | {} | {} | {} | {} | {} | {} | {} | {} |",
                l.quantity,
                l.method,
                l.n,
                l.claimed,
                number(l.bias_pct, 2),
                number(l.rmse_pct, 2),
                number(l.claimed_rmse_pct, 2),
                number(100.0 * l.within_1, 1),
                number(100.0 * l.within_2, 1),
            );
        }
        text
    }
}
