//! The lines of the log that belong to no recorded image: the session's problems, its dropped images, its fused sizes.

use ingest::{LogLevel, LogNote};
use model::{FrameRow, Level, Problem, ResultRow, Severity, UtcNs};

use super::notes::worth;
use crate::session::SessionOutput;

/// The lines in the order of time. A line without a time stands at the first image's time, a fused size at the last one's.
pub(super) fn of_session(output: &SessionOutput) -> Vec<LogNote> {
    let times = || output.frames.iter().filter_map(|frame| frame.time_utc);
    let (first, last) = (times().min().unwrap_or(UtcNs(0)), times().max().unwrap_or(UtcNs(0)));
    let mut notes: Vec<LogNote> = output.status.problems.iter().map(|problem| of_problem(problem, first)).collect();
    // Recorded images have their line beside the picture.
    notes.extend(output.frames.iter().filter(|frame| !is_recorded(frame)).map(|frame| of_dropped(frame, first)));
    notes.sort_by_key(|note| note.time);
    let fused = || output.results.iter().filter(|row| row.level == Level::Fused);
    let method = fused().map(|row| row.method).max_by_key(|method| worth(*method));
    notes.extend(fused().filter(|row| Some(row.method) == method).filter_map(|row| of_fused(row, last)));
    notes
}

/// Whether ingest could use the image.
fn is_recorded(frame: &FrameRow) -> bool {
    frame.reason >= model::FrameReason::AmbiguousTime
}

fn of_problem(problem: &Problem, time: UtcNs) -> LogNote {
    let Problem { severity, stage, code, place, fact, remedy } = problem;
    let level = match severity {
        Severity::Loss => LogLevel::Error,
        Severity::Note => LogLevel::Info,
    };
    let text = format!("[{stage}] {code}: {fact}; {remedy}");
    LogNote { time, level, about: "session", text, file: place.clone() }
}

fn of_dropped(frame: &FrameRow, otherwise: UtcNs) -> LogNote {
    LogNote {
        time: frame.time_utc.unwrap_or(otherwise),
        level: LogLevel::Warning,
        about: "image",
        text: format!("{}: {}", frame.reason.code(), frame.reason.meaning()),
        file: frame.image.clone(),
    }
}

fn of_fused(row: &ResultRow, time: UtcNs) -> Option<LogNote> {
    let sigma = row.sigma_mm.map(|mm| format!(" ± {mm:.1}")).unwrap_or_default();
    let (object, quantity, rater) = (&row.object, row.quantity, &row.rater);
    let text =
        format!("{object} by {rater}: {quantity} {:.1}{sigma} mm, from {} images", row.predicted_mm?, row.frames);
    Some(LogNote { time, level: LogLevel::Info, about: "fused", text, file: String::new() })
}
