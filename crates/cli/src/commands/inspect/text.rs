//! The content of recordings as text for people: 80 columns, no colours.

use std::collections::BTreeMap;

use indicatif::HumanBytes;
use model::{Problem, Severity};
use pipeline::inspect::{AccelerationFacts, ExtraFacts, ImageFacts, Inspected, RangeFacts, SessionFacts};

use super::clock;
use super::sparkline::{in_words, sparkline};
use super::words::{count, duration, line, moment, more, span, span_line};
use crate::commands::problems::describe;

/// The facts of all sessions as text, one session under the other.
pub fn text(inspected: &[Inspected]) -> String {
    let sessions: Vec<String> = inspected.iter().map(session).collect();
    sessions.join("\n")
}

fn session(inspected: &Inspected) -> String {
    let mut text = format!("{}\n", inspected.session);
    match &inspected.facts {
        Ok(facts) => push_facts(&mut text, facts),
        Err(problem) => describe(&mut text, "  ", &vec![("nothing can be used".to_owned(), problem)]),
    }
    text
}

fn push_facts(text: &mut String, facts: &SessionFacts) {
    push_head(text, facts);
    match &facts.acceleration {
        Some(acceleration) => push_acceleration(text, acceleration),
        None => line(text, 2, "acceleration", "the profile declares none"),
    }
    match &facts.range {
        Some(range) => push_range(text, range),
        None => line(text, 2, "range", "the profile declares none"),
    }
    facts.extra.iter().for_each(|extra| push_extra(text, extra));
    push_images(text, &facts.images);
    push_problems(text, &facts.problems);
}

fn push_head(text: &mut String, facts: &SessionFacts) {
    let (profile, camera) = (&facts.profile, &facts.camera);
    line(text, 2, "profile", &format!("{} {}", profile.name, profile.version));
    line(text, 2, "camera", &format!("{}, {} x {} px", camera.name, camera.width_px, camera.height_px));
    line(text, 2, "mount", &format!("the camera looks {} deg further down than the sensor", facts.mount_pitch_deg));
    line(text, 2, "time zone", &facts.time_zone);
    span_line(text, 2, "recorded", facts.recorded.as_ref());
    if facts.local_time_changes.is_empty() {
        line(text, 2, "local time", "does not change between");
    }
    for change in &facts.local_time_changes {
        line(text, 2, "local time", &format!("changes by {:+} s at {}", change.by_s, moment(&change.at)));
    }
    if facts.ambiguous.count > 0 {
        let (number, total) = (count(facts.ambiguous.count as u64, "span"), duration(facts.ambiguous.total_s));
        line(text, 2, "exists twice", &format!("{number} of time, {total}: a clock was set back"));
        facts.ambiguous.first.iter().flat_map(span).for_each(|words| more(text, &words));
    }
}

fn push_acceleration(text: &mut String, facts: &AccelerationFacts) {
    clock::push(text, "acceleration", &facts.clock);
    let length = facts.length_median_mg.map_or_else(|| "unknown".to_owned(), |mg| format!("median {mg:.1} mg"));
    line(text, 4, "length", &length);
    line(text, 4, "pitch", &sparkline(&facts.pitch_deg, "deg"));
    more(text, &in_words(&facts.pitch_deg, "deg", "second"));
}

fn push_range(text: &mut String, facts: &RangeFacts) {
    clock::push(text, "range", &facts.clock);
    line(text, 4, "readings", &sparkline(&facts.range_mm, "mm"));
    more(text, &in_words(&facts.range_mm, "mm", "reading"));
    if let (Some(mean), Some(least), Some(greatest)) = (facts.mean_mm, facts.least_mm, facts.greatest_mm) {
        let sd = facts.sd_mm.map_or_else(String::new, |sd| format!(", SD {sd:.2}"));
        more(text, &format!("mean {mean:.2}{sd}, {least:.0} to {greatest:.0} mm"));
    }
    line(text, 4, "repeated", &format!("{} like the one before", count(facts.repeated_samples, "sample")));
    line(text, 4, "no target", &count(facts.no_target_samples, "sample"));
}

fn push_extra(text: &mut String, facts: &ExtraFacts) {
    let sensor = facts.sensor.map_or_else(String::new, |sensor| format!(" with {sensor}"));
    let samples = count(facts.samples, "sample");
    line(text, 2, "carried along", &format!("{}: {samples}{sensor}, {} missing", facts.name, facts.missing_samples));
    span_line(text, 4, "recorded", facts.recorded.as_ref());
    if let (Some(least), Some(mean), Some(greatest)) = (facts.least, facts.mean, facts.greatest) {
        line(text, 4, "values", &format!("{least} to {greatest}, mean {mean:.3}"));
    }
}

fn push_images(text: &mut String, facts: &ImageFacts) {
    line(text, 2, "images", &format!("{}, {}", count(facts.count as u64, "image"), HumanBytes(facts.bytes)));
    span_line(text, 4, "recorded", facts.recorded.as_ref());
    if let Some((median_s, longest_s)) = facts.median_period_s.zip(facts.longest_period_s) {
        line(text, 4, "period", &format!("median {}, longest {}", duration(median_s), duration(longest_s)));
    }
    if facts.dropped.is_empty() {
        line(text, 4, "dropped", "none");
    }
    for (i, dropped) in facts.dropped.iter().enumerate() {
        let words = format!("{} {}, {}", dropped.count, dropped.reason, HumanBytes(dropped.bytes));
        line(text, 4, if i == 0 { "dropped" } else { "" }, &words);
    }
}

/// Appends the codes of the problems with their numbers; `check` shows them in full.
fn push_problems(text: &mut String, problems: &[Problem]) {
    for (name, severity) in [("losses", Severity::Loss), ("notes", Severity::Note)] {
        let mut codes: BTreeMap<&str, usize> = BTreeMap::new();
        for problem in problems.iter().filter(|problem| problem.severity == severity) {
            *codes.entry(problem.code.code()).or_default() += 1;
        }
        if codes.is_empty() {
            line(text, 2, name, "none on the card");
        }
        for (i, (code, number)) in codes.into_iter().enumerate() {
            line(text, 2, if i == 0 { name } else { "" }, &format!("{number} {code}"));
        }
    }
}
