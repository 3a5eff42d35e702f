//! What people should know of a session's clocks.

use model::{Problem, ProblemCode, UtcNs};

use crate::card::Place;
use crate::timeline::{Span, StreamFacts, Timeline};

/// A measured rate that differs more from the nominal one is told.
const RATE_TOLERANCE: f64 = 0.05;

/// Problems and notes on the time lines.
pub(super) fn clock_problems(timeline: &Timeline, place: &Place) -> Vec<Problem> {
    let sensors = [("accelerometer", &timeline.acceleration), ("range sensor", &timeline.range)];
    let mut problems = Vec::new();
    for (sensor, facts) in sensors {
        let Some(facts) = facts else { continue };
        problems.extend(gaps(sensor, facts, place));
        problems.extend(order(sensor, facts, place));
        problems.extend(misplaced(sensor, facts, place));
        problems.extend(rate(sensor, facts, place));
        problems.extend(jumps(sensor, facts, place));
    }
    problems.extend(ambiguous(&timeline.ambiguous, place));
    problems
}

fn gaps(sensor: &str, facts: &StreamFacts, place: &Place) -> Option<Problem> {
    let longest = facts.listed_gaps.iter().max_by(|a, b| a.seconds().total_cmp(&b.seconds()))?;
    let fact = format!(
        "{} gaps of more than {} s in the {sensor}'s samples, {:.1} s in all; the longest {:.2} s from {}",
        facts.gaps,
        facts.gap_s,
        facts.gaps_total_s,
        longest.seconds(),
        text(longest.from),
    );
    Some(place.note(ProblemCode::Gaps, "", fact, "nothing is bridged: images in a gap have no pose"))
}

fn order(sensor: &str, facts: &StreamFacts, place: &Place) -> Vec<Problem> {
    let mut notes = Vec::new();
    if facts.duplicates > 0 {
        let fact = format!("{} packets of the {sensor} are there twice; each is used once", facts.duplicates);
        notes.push(place.note(ProblemCode::DuplicatePackets, "", fact, "none needed"));
    }
    if facts.reordered > 0 {
        let fact = format!("{} packets of the {sensor} came after later ones; they are put in order", facts.reordered);
        notes.push(place.note(ProblemCode::PacketsOutOfOrder, "", fact, "none needed"));
    }
    notes
}

fn misplaced(sensor: &str, facts: &StreamFacts, place: &Place) -> Option<Problem> {
    let fact = format!(
        "{} packets of the {sensor} ({} samples) claim times that fit nothing around them, the first {}; they are left out",
        facts.misplaced,
        facts.misplaced_samples,
        text(facts.first_misplaced?),
    );
    Some(place.problem(
        ProblemCode::MisplacedPackets,
        "",
        fact,
        "copy the card again; if it stays so, the stamps are damaged",
    ))
}

fn rate(sensor: &str, facts: &StreamFacts, place: &Place) -> Option<Problem> {
    let measured = facts.measured_rate_hz?;
    let nominal = facts.nominal_rate_hz;
    ((measured / nominal - 1.0).abs() > RATE_TOLERANCE).then(|| {
        let what = if facts.times_declared { "rows over the declared time" } else { "stamps" };
        let fact = format!("the {sensor}'s {what} give {measured:.2} Hz, the device profile says {nominal} Hz");
        place.note(ProblemCode::RateNotNominal, "", fact, "the stamps are used; correct rate_hz in the device profile")
    })
}

fn jumps(sensor: &str, facts: &StreamFacts, place: &Place) -> Option<Problem> {
    let first = facts.clock_jumps.first()?;
    let fact = format!(
        "the {sensor}'s clock was set {} times while recording; first after {}, by {:+.1} s",
        facts.jumps,
        text(first.at),
        first.by_s,
    );
    let remedy = "times before and after belong to different settings of the clock: check which are right";
    Some(place.note(ProblemCode::ClockSet, "", fact, remedy))
}

fn ambiguous(spans: &[Span], place: &Place) -> Option<Problem> {
    let first = spans.first()?;
    let seconds: f64 = spans.iter().map(Span::seconds).sum();
    let fact = format!(
        "{seconds:.1} s exist twice because a clock was set back, first {} to {}; images then cannot be told apart",
        text(first.from),
        text(first.to),
    );
    Some(place.problem(
        ProblemCode::AmbiguousTime,
        "",
        fact,
        "split the card's files where the clock was set, if that is known",
    ))
}

fn text(time: UtcNs) -> String {
    jiff::Timestamp::from_nanosecond(i128::from(time.0))
        .map_or_else(|_| time.0.to_string(), |time| format!("{time:.1}"))
}
