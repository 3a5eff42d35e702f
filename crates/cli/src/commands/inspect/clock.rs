//! The behaviour of a sensor's clock, for people.

use pipeline::inspect::{ClockFacts, Gaps};

use super::words::{count, duration, line, moment, more, span, span_line};

/// Appends the lines of a sensor: its heading `name`, its rate, and the gaps, losses and jumps of its clock.
pub fn push(text: &mut String, name: &str, clock: &ClockFacts) {
    let declared = format!("{} Hz declared", clock.nominal_rate_hz);
    let rate = match clock.measured_rate_hz {
        Some(rate_hz) => format!("{rate_hz:.2} Hz measured, {declared}"),
        None => format!("{declared}, and none in the stamps"),
    };
    line(text, 2, name, &format!("{}, {rate}", count(clock.samples, "sample")));
    span_line(text, 4, "recorded", clock.recorded.as_ref());
    if let Some((shortest_s, longest_s)) = clock.shortest_step_s.zip(clock.longest_step_s) {
        line(text, 4, "steps", &format!("{:.2} to {:.2} ms", 1000.0 * shortest_s, 1000.0 * longest_s));
    }
    push_gaps(text, &clock.gaps);
    let mut order = format!("{} there twice, {} put in order", clock.duplicate_blocks, clock.reordered_blocks);
    if clock.misplaced_blocks > 0 {
        order.push_str(&format!(", {} left out: times that fit nothing", clock.misplaced_blocks));
    }
    line(text, 4, "packets", &order);
    let missing =
        format!("{} missing, {} lost", count(clock.missing_samples, "sample"), count(clock.lost_bytes, "byte"));
    line(text, 4, "losses", &missing);
    push_jumps(text, clock);
}

fn push_gaps(text: &mut String, gaps: &Gaps) {
    if gaps.count == 0 {
        line(text, 4, "gaps", &format!("none longer than {} s", gaps.longer_than_s));
        return;
    }
    let (number, total) = (count(gaps.count, "gap"), duration(gaps.total_s));
    line(text, 4, "gaps", &format!("{number} longer than {} s, {total} in all; the longest:", gaps.longer_than_s));
    for gap in &gaps.longest {
        more(text, &format!("{} from {}", duration(gap.duration_s), moment(&gap.from)));
    }
}

fn push_jumps(text: &mut String, clock: &ClockFacts) {
    if clock.clock_jumps.count == 0 {
        line(text, 4, "clock", "never set while recording");
        return;
    }
    line(text, 4, "clock", &format!("set {} while recording:", count(clock.clock_jumps.count, "time")));
    for jump in &clock.clock_jumps.first {
        more(text, &format!("by {:+.1} s after {}", jump.by_s, moment(&jump.after)));
    }
    let stretches = clock.stretches.count as u64;
    line(text, 4, "stretches", &count(stretches, "piece of time"));
    for stretch in &clock.stretches.first {
        span(stretch).iter().for_each(|words| more(text, words));
    }
}
