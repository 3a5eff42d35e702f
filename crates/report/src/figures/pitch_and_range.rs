//! The figure `pitch_and_range`: pitch and range over time, session by session (Fig. 2 of the paper).

use std::collections::BTreeMap;

use model::{FrameReason, FrameRow};

use super::drawing::{Anchor, Colour, Drawing, Paint, Text};
use super::envelope::{self, Sample};
use super::flow::NO_LEDGER;
use super::grid::PAGE;
use super::legend::{self, Entry};
use super::marks::{self, Look, Mark, Symbol};
use super::panel::Panel;
use super::scale::{Scale, extremes, is_drawable, padded, time, time_ticks};
use super::settings::Window;
use super::words::{counted, estimated_width, fitted, named, number};
use super::{Attempt, legend::Sample as Sampled};
use crate::parquet::Results;

const NAME: &str = "pitch_and_range";
const TITLE: &str = "Pitch and range over time";

/// Greatest number of sessions that have panels.
const MOST_SESSIONS: usize = 12;
/// Greatest number of images of a session that are drawn one by one. Of more, the smallest and largest values are drawn.
const MOST_IMAGES: usize = 250;

const SELECTED: Look = Look::filled(Symbol::Circle, Colour::Blue);
const OTHER: Look = Look { symbol: Symbol::Square, paint: Paint::line(Colour::Ink, 1.0).faint(0.7) };
const WITHOUT: Look = Look { symbol: Symbol::Cross, paint: Paint::line(Colour::Vermilion, 1.2) };
const WINDOW: Paint = Paint::area(Colour::Blue, 0.12);
const BORDER: Paint = Paint::line(Colour::Ink, 0.8).dashed("2 3");

const LEFT: f64 = 62.0;
const GAP: f64 = 18.0;
const HEADING: f64 = 22.0;
const PITCH: f64 = 84.0;
const RANGE: f64 = 64.0;
const BLOCK: f64 = HEADING + PITCH + 10.0 + RANGE + 34.0;

/// Scales and widths that the panels of all sessions share.
struct Shared {
    pitch_deg: [f64; 2],
    range_cm: [f64; 2],
    window: Option<Window>,
    columns: usize,
    width: f64,
}

/// Draws pitch and range of every image over its time.
pub(super) fn draw(results: &Results, frames: &[FrameRow]) -> Attempt {
    let mut sessions: BTreeMap<&str, Vec<&FrameRow>> = BTreeMap::new();
    for frame in frames {
        sessions.entry(&frame.session).or_default().push(frame);
    }
    let timed = |frames: &[&FrameRow]| frames.iter().any(|frame| frame.time_utc.is_some());
    let all = sessions.len();
    let shown: Vec<(&str, Vec<&FrameRow>)> =
        sessions.into_iter().filter(|(_, frames)| timed(frames)).take(MOST_SESSIONS).collect();
    if shown.is_empty() {
        let reason = if frames.is_empty() { NO_LEDGER } else { "no image has a time" };
        return Attempt::left_out(NAME, TITLE, reason);
    }
    let shared = shared(&shown, Window::from_results(results));
    let entries = legend_entries(shared.window);
    let top = 8.0 + legend::height(&entries, PAGE - LEFT);
    #[expect(clippy::cast_precision_loss, reason = "a handful of rows")]
    let height = top + BLOCK * shown.len().div_ceil(shared.columns) as f64 + 18.0;
    let mut drawing = Drawing::new(PAGE, height);
    legend::draw(&mut drawing, &entries, [LEFT, 4.0], PAGE - LEFT);
    for (index, (name, frames)) in shown.iter().enumerate() {
        draw_session(&mut drawing, &shared, (name, frames), index, top);
    }
    drawing.text(Text::new(0.5 * (LEFT + PAGE), height - 6.0, Anchor::Middle, "time of the image (UTC)"));
    Attempt::drawn(NAME, TITLE, [caption(all, &shown, shared.window), alt(&shown)], drawing)
}

fn shared(shown: &[(&str, Vec<&FrameRow>)], window: Option<Window>) -> Shared {
    let columns = match shown.len() {
        1 => 1,
        2..=4 => 2,
        _ => 3,
    };
    let frames = || shown.iter().flat_map(|(_, frames)| frames);
    let borders = window.iter().flat_map(|window| [window.low_deg, window.high_deg]);
    let pitch_deg = padded(frames().filter_map(|frame| frame.pitch_deg).chain(borders), 0.08);
    let range_cm = padded(frames().filter_map(range_cm), 0.1);
    #[expect(clippy::cast_precision_loss, reason = "a handful of columns")]
    let width = (PAGE - LEFT - 12.0 - GAP * (columns as f64 - 1.0)) / columns as f64;
    Shared {
        pitch_deg: pitch_deg.unwrap_or([0.0, 90.0]),
        range_cm: range_cm.unwrap_or([0.0, 100.0]),
        window,
        columns,
        width,
    }
}

fn range_cm(frame: &&FrameRow) -> Option<f64> {
    frame.range_mm.map(|range| range / 10.0).filter(|range| is_drawable(*range))
}

#[expect(clippy::cast_precision_loss, reason = "times are drawn to seconds")]
fn posix_s(frame: &FrameRow) -> Option<f64> {
    frame.time_utc.map(|time| time.0 as f64 * 1e-9)
}

fn is_selected(frame: &FrameRow) -> bool {
    frame.reason == FrameReason::Selected
}

fn draw_session(drawing: &mut Drawing, shared: &Shared, (name, frames): (&str, &[&FrameRow]), index: usize, top: f64) {
    #[expect(clippy::cast_precision_loss, reason = "a handful of panels")]
    let [column, row] = [(index % shared.columns) as f64, (index / shared.columns) as f64];
    let left = LEFT + column * (shared.width + GAP);
    let top = top + row * BLOCK + HEADING;
    let Some(times) = padded(frames.iter().filter_map(|frame| posix_s(frame)), 0.03) else { return };
    let x = Scale::linear(times, [left, left + shared.width]);
    let pitch = Panel { x, y: Scale::linear(shared.pitch_deg, [top + PITCH, top]) };
    let lower = top + PITCH + 10.0;
    let range = Panel { x, y: Scale::linear(shared.range_cm, [lower + RANGE, lower]) };
    draw_heading(drawing, (name, frames), &pitch);
    if let Some(window) = shared.window {
        drawing.path("window", WINDOW, pitch.rectangle(times, [window.low_deg, window.high_deg]));
        pitch.level(drawing, "window", BORDER, window.low_deg);
        pitch.level(drawing, "window", BORDER, window.high_deg);
    }
    let first = column == 0.0;
    let ticks = time_ticks(times, if shared.columns == 1 { 9 } else { 4 });
    for (panel, most, label) in [(&pitch, 4, "pitch (deg)"), (&range, 3, "range (cm)")] {
        panel.y_ticks(drawing, &panel.y.ticks(most), first);
        panel.x_ticks(drawing, &ticks, std::ptr::eq(panel, &range));
        panel.frame(drawing);
        if first {
            let middle = 0.5 * (panel.top() + panel.bottom());
            drawing.text(Text::new(16.0, middle, Anchor::Middle, label).turned());
        }
    }
    if let Some([begin, _]) = extremes(frames.iter().filter_map(|frame| posix_s(frame))) {
        let date = Text::new(left, range.bottom() + 29.0, Anchor::Start, time(begin, "%Y-%m-%d"));
        drawing.text(date.small());
    }
    draw_values(drawing, &pitch, frames, |frame| frame.pitch_deg.filter(|pitch| is_drawable(*pitch)));
    draw_values(drawing, &range, frames, |frame| range_cm(&frame));
}

fn draw_heading(drawing: &mut Drawing, (name, frames): (&str, &[&FrameRow]), panel: &Panel) {
    let selected = frames.iter().filter(|frame| is_selected(frame)).count();
    let right = format!("{selected} of {}", frames.len());
    let width = panel.right() - panel.left() - estimated_width(&right, 10.5);
    let text = Text::new(panel.left(), panel.top() - 6.0, Anchor::Start, fitted(name, width, 10.5));
    drawing.text(text.small().bold().standing_for(&named(name)));
    drawing.text(Text::new(panel.right(), panel.top() - 6.0, Anchor::End, right).small());
}

/// Draws one mark for each image, or the extremes of many. Images without a value stand at the lower edge.
fn draw_values(drawing: &mut Drawing, panel: &Panel, frames: &[&FrameRow], value: impl Fn(&FrameRow) -> Option<f64>) {
    let timed = || frames.iter().filter_map(|frame| Some((*frame, panel.x.place(posix_s(frame)?))));
    if frames.len() > MOST_IMAGES {
        let samples: Vec<Sample> = timed()
            .map(|(frame, x)| Sample {
                x,
                y: value(frame).map(|value| panel.y.place(value)),
                selected: is_selected(frame),
            })
            .collect();
        envelope::draw(drawing, &samples, [SELECTED.paint, OTHER.paint, WITHOUT.paint], panel.bottom());
        return;
    }
    let mark = |(frame, x)| {
        let place = value(frame).map(|value| panel.y.place(value));
        let look = match place {
            None => WITHOUT,
            Some(_) if is_selected(frame) => SELECTED,
            Some(_) => OTHER,
        };
        let weight = if is_selected(frame) { 1.0 } else { 0.0 };
        Mark { x, y: place.unwrap_or_else(|| panel.bottom() - 4.0), look, weight, of: frame }
    };
    // With two panels for each session there are then no more marks than the figure may have.
    let titles = marks::MOST_TITLES / (2 * MOST_SESSIONS);
    marks::draw(drawing, timed().map(mark).collect(), [MOST_IMAGES, titles], |frame| title(frame));
}

fn title(frame: &FrameRow) -> String {
    let shown = |value: Option<f64>, unit: &str| {
        value.filter(|value| is_drawable(*value)).map(|value| format!(", {} {unit}", number(value, 1)))
    };
    format!(
        "{}: {}{}{}",
        named(&frame.image),
        frame.reason,
        shown(frame.pitch_deg, "deg").unwrap_or_default(),
        shown(frame.range_mm, "mm").unwrap_or_default()
    )
}

fn legend_entries(window: Option<Window>) -> Vec<Entry> {
    let mut entries = vec![
        Entry::new(Sampled::Mark(SELECTED), "image, selected"),
        Entry::new(Sampled::Mark(OTHER), "not selected"),
        Entry::new(Sampled::Mark(WITHOUT), "without pitch or range"),
    ];
    entries.extend(window.map(|_| Entry::new(Sampled::Area(WINDOW), "target window of pitch")));
    entries
}

fn caption(all: usize, shown: &[(&str, Vec<&FrameRow>)], window: Option<Window>) -> String {
    let mut text = if shown.len() < all {
        format!("The first {} of {all} sessions by name (figure selected_share has all). ", shown.len())
    } else {
        String::new()
    };
    text.push_str(
        "Pitch of the camera (depression of its axis below the horizontal) and range along its axis at the time of every \
         image, with the day of the first, and how many of the session's images are selected.",
    );
    if let Some(window) = window {
        text.push_str(&format!(" Shaded: pitch from {}.", window.name()));
    }
    if shown.iter().any(|(_, frames)| frames.len() > MOST_IMAGES) {
        text.push_str(
            " Sessions with many images: lines from the smallest to the largest value of neighbouring images.",
        );
    }
    let untimed = shown.iter().flat_map(|(_, frames)| frames).filter(|frame| frame.time_utc.is_none()).count();
    if untimed > 0 {
        text.push_str(&format!(" {} without a time not shown.", counted(untimed, "image")));
    }
    text
}

fn alt(shown: &[(&str, Vec<&FrameRow>)]) -> String {
    let frames = || shown.iter().flat_map(|(_, frames)| frames);
    let selected = frames().filter(|frame| is_selected(frame)).count();
    let range = |values: Option<[f64; 2]>, unit: &str| {
        values.map_or_else(|| "none".to_owned(), |[low, high]| format!("{low:.0} to {high:.0} {unit}"))
    };
    format!(
        "Pitch and range over time in {}: {} of {} selected, pitch {}, range {}.",
        counted(shown.len(), "session"),
        selected,
        counted(frames().count(), "image"),
        range(extremes(frames().filter_map(|frame| frame.pitch_deg)), "deg"),
        range(extremes(frames().filter_map(range_cm)), "cm"),
    )
}
