//! The figure `selected_share`: the share of each session's images that is selected.

use model::{FlowStep, FrameRow, StudyFlow};

use super::Attempt;
use super::drawing::{Anchor, Colour, Drawing, Paint, Text, short};
use super::flow::NO_LEDGER;
use super::grid::PAGE;
use super::panel::Panel;
use super::scale::Scale;
use super::words::{counted, fitted, named};

const NAME: &str = "selected_share";
const TITLE: &str = "Images selected, by session";

/// Greatest number of sessions for which each has a bar of its own.
const MOST_BARS: usize = 40;
const BAR: Paint = Paint::area(Colour::Blue, 0.75);
const BAR_HEIGHT: f64 = 16.0;
const NAMES: f64 = 190.0;
/// Number of classes of the histogram that stands for more sessions; each is 5 % wide.
const CLASSES: usize = 20;

struct Session {
    name: String,
    found: usize,
    selected: usize,
    share_pct: f64,
}

/// Draws a bar for each session, or a histogram of the shares where there are many sessions.
pub(super) fn draw(frames: &[FrameRow]) -> Attempt {
    if frames.is_empty() {
        return Attempt::left_out(NAME, TITLE, NO_LEDGER);
    }
    let mut study = StudyFlow::default();
    frames.iter().for_each(|frame| study.add(frame));
    let mut sessions: Vec<Session> = study
        .sessions()
        .map(|(name, flow)| Session {
            name: name.to_owned(),
            found: flow.images_at(FlowStep::Found),
            selected: flow.images_at(FlowStep::Selected),
            share_pct: flow.selected_pct().unwrap_or_default(),
        })
        .collect();
    sessions.sort_by(|a, b| a.share_pct.total_cmp(&b.share_pct).then_with(|| a.name.cmp(&b.name)));
    let drawing = if sessions.len() > MOST_BARS { histogram(&sessions) } else { bars(&sessions) };
    Attempt::drawn(NAME, TITLE, [caption(&sessions), alt(&sessions)], drawing)
}

#[expect(clippy::cast_precision_loss, reason = "a count of sessions is far below 2^53")]
fn bars(sessions: &[Session]) -> Drawing {
    let bottom = 8.0 + BAR_HEIGHT * sessions.len() as f64;
    let mut drawing = Drawing::new(PAGE, bottom + 44.0);
    let panel =
        Panel { x: Scale::linear([0.0, 100.0], [NAMES, PAGE - 84.0]), y: Scale::linear([0.0, 1.0], [bottom, 6.0]) };
    for (index, session) in sessions.iter().enumerate() {
        let top = 8.0 + BAR_HEIGHT * index as f64;
        let end = panel.x.place(session.share_pct);
        let path = format!("M{},{}H{}v11H{}z", short(NAMES), short(top + 2.0), short(end), short(NAMES));
        drawing.path("kept", BAR, path);
        let full = named(&session.name);
        let name = Text::new(NAMES - 8.0, top + 12.0, Anchor::End, fitted(&session.name, NAMES - 12.0, 10.5));
        drawing.text(name.small().standing_for(&full));
        let words = format!("{} of {}", session.selected, session.found);
        drawing.text(Text::new(end + 5.0, top + 12.0, Anchor::Start, words).small());
    }
    axis(&mut drawing, &panel);
    drawing
}

#[expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a count of sessions, and a class of a share from 0 to 100"
)]
fn histogram(sessions: &[Session]) -> Drawing {
    let width = 100.0 / CLASSES as f64;
    let mut counts = [0_usize; CLASSES];
    for session in sessions {
        counts[((session.share_pct / width) as usize).min(CLASSES - 1)] += 1;
    }
    let most = counts.iter().copied().max().unwrap_or(1).max(1);
    let mut drawing = Drawing::new(PAGE, 260.0);
    let panel = Panel {
        x: Scale::linear([0.0, 100.0], [66.0, PAGE - 20.0]),
        y: Scale::linear([0.0, most as f64 * 1.08], [216.0, 10.0]),
    };
    panel.y_ticks(&mut drawing, &panel.y.ticks(most.min(5)), true);
    let column = |(class, count): (usize, &usize)| {
        let from = class as f64 * width;
        panel.rectangle([from + 0.08 * width, from + 0.92 * width], [0.0, *count as f64])
    };
    drawing.path("kept", BAR, counts.iter().enumerate().filter(|(_, count)| **count > 0).map(column).collect());
    axis(&mut drawing, &panel);
    drawing.text(Text::new(16.0, 113.0, Anchor::Middle, "sessions").turned());
    drawing
}

fn axis(drawing: &mut Drawing, panel: &Panel) {
    panel.x_ticks(drawing, &panel.x.ticks(5), true);
    panel.frame(drawing);
    let middle = 0.5 * (panel.left() + panel.right());
    drawing.text(Text::new(middle, panel.bottom() + 36.0, Anchor::Middle, "images selected (% of the session's)"));
}

fn caption(sessions: &[Session]) -> String {
    let (all, with_none) = (sessions.len(), sessions.iter().filter(|session| session.selected == 0).count());
    let what = if all > MOST_BARS {
        format!("How many of {all} sessions have which share of their images selected, in classes of 5 %")
    } else {
        format!("Share of the images found in each of {} that is selected", counted(all, "session"))
    };
    format!("{what}. {} without a selected image. Numbers: table flow.", counted(with_none, "session"))
}

fn alt(sessions: &[Session]) -> String {
    let share = |session: Option<&Session>| session.map_or(0.0, |session| session.share_pct);
    format!(
        "Bars. The share of images selected is from {:.0} to {:.0} % in {}, {:.0} % in the middle one.",
        share(sessions.first()),
        share(sessions.last()),
        counted(sessions.len(), "session"),
        share(sessions.get(sessions.len() / 2)),
    )
}
