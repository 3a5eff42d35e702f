//! The figure `flow`: the numbers of images that reach each step of the selection, and the reasons why the others do not.

use model::{Flow, FlowStep, FrameReason, FrameRow, StudyFlow};

use super::Attempt;
use super::drawing::{Anchor, Colour, Drawing, Paint, Text, short};
use super::grid::PAGE;
use super::legend::{self, Entry, Sample};
use super::scale::Scale;
use super::words::{clean, counted, listed};
use crate::tables::step_heading;

const NAME: &str = "flow";
const TITLE: &str = "Flow of images";
/// The reason why the figures of images are left out.
pub(super) const NO_LEDGER: &str = "the ledger of images, frames.parquet, was not read or has no image";

const KEPT: Paint = Paint::area(Colour::Blue, 0.75);
const LOST: Paint =
    Paint { fill_opacity: 0.1, dash: "2 2", ..Paint { fill: Colour::Ink, ..Paint::line(Colour::Ink, 1.0) } };

const LEFT: f64 = 104.0;
const RIGHT: f64 = PAGE - 100.0;
const TOP: f64 = 34.0;
const ROW: f64 = 30.0;
const BAR: f64 = 17.0;
const LINE: f64 = 14.0;
/// Number of letters that fit below a bar.
const LETTERS: usize = 98;

/// A bar of the figure: a step of the flow, with the reasons for which images of the step before do not reach it.
pub(super) struct Step {
    pub(super) heading: &'static str,
    pub(super) images: usize,
    pub(super) before: usize,
    reasons: Vec<String>,
}

/// Draws the flow of all images of the study.
pub(super) fn draw(frames: &[FrameRow]) -> Attempt {
    if frames.is_empty() {
        return Attempt::left_out(NAME, TITLE, NO_LEDGER);
    }
    let mut study = StudyFlow::default();
    frames.iter().for_each(|frame| study.add(frame));
    let (flow, sessions) = (study.total(), study.sessions().count());
    let steps = steps(&flow);
    #[expect(clippy::cast_precision_loss, reason = "a handful of lines")]
    let extra = |step: &Step| LINE * lines(step, LETTERS).len() as f64;
    let height = TOP + steps.iter().map(|step| ROW + extra(step)).sum::<f64>() + 8.0;
    let mut drawing = Drawing::new(PAGE, height);
    let entries = [
        Entry::new(Sample::Area(KEPT), "images that reach the step"),
        Entry::new(Sample::Area(LOST), "images that the step leaves out"),
    ];
    legend::draw(&mut drawing, &entries, [LEFT, 4.0], RIGHT - LEFT);
    let mut top = TOP;
    for step in &steps {
        draw_step(&mut drawing, step, frames.len(), top);
        top += ROW + extra(step);
    }
    Attempt::drawn(NAME, TITLE, [caption(frames.len(), sessions), alt(&steps)], drawing)
}

/// The steps of the flow in their order. The reasons of a step are in the order of the numbers of images, the greatest first.
pub(super) fn steps(flow: &Flow) -> Vec<Step> {
    let mut before = flow.images_at(FlowStep::Found);
    let mut steps = Vec::new();
    for step in FlowStep::ALL.iter().copied() {
        let images = flow.images_at(step);
        let mut reasons: Vec<(usize, FrameReason)> = FrameReason::ALL
            .iter()
            .filter(|reason| reason.ends() == Some(step))
            .map(|reason| (flow.with_reason(*reason).images, *reason))
            .filter(|(images, _)| *images > 0)
            .collect();
        reasons.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut reasons: Vec<String> =
            reasons.into_iter().map(|(images, reason)| format!("{reason} {images}")).collect();
        match step {
            FlowStep::Marked if before > images => {
                reasons.push(format!("selected, but not marked {}", before - images))
            }
            FlowStep::Measured if before > images => reasons.push(format!("marked, but no size {}", before - images)),
            _ => {}
        }
        steps.push(Step { heading: step_heading(step), images, before, reasons });
        before = images;
    }
    steps
}

/// The reasons of a step as lines of no more than about `most` letters.
pub(super) fn lines(step: &Step, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for reason in &step.reasons {
        match lines.last_mut().filter(|line| line.len() + reason.len() + 14 < most) {
            Some(line) => *line = format!("{line}, {reason}"),
            None => lines.push(reason.clone()),
        }
    }
    if let Some(first) = lines.first_mut() {
        *first = format!("left out: {first}");
    }
    lines
}

#[expect(clippy::cast_precision_loss, reason = "a count of images is far below 2^53")]
fn draw_step(drawing: &mut Drawing, step: &Step, found: usize, top: f64) {
    let scale = Scale::linear([0.0, found as f64], [LEFT, RIGHT]);
    let bar = |from: usize, to: usize| {
        let [from, to] = [from, to].map(|images| short(scale.place(images as f64)));
        format!("M{from},{}H{to}v{BAR}H{from}z", short(top))
    };
    if step.images > 0 {
        drawing.path("kept", KEPT, bar(0, step.images));
    }
    if step.before > step.images {
        drawing.path("lost", LOST, bar(step.images, step.before));
    }
    drawing.text(Text::new(LEFT - 8.0, top + 13.0, Anchor::End, step.heading));
    let words = format!("{} ({})", step.images, percent(step.images, found));
    drawing.text(Text::new(scale.place(step.before as f64) + 6.0, top + 13.0, Anchor::Start, words).small());
    for (index, line) in lines(step, LETTERS).iter().enumerate() {
        let y = top + BAR + 12.0 + LINE * index as f64;
        drawing.text(Text::new(LEFT, y, Anchor::Start, clean(line)).small());
    }
}

/// A share of images in words. A small share that is not 0 is `< 1 %`.
#[expect(clippy::cast_precision_loss, reason = "a count of images is far below 2^53")]
pub(super) fn percent(images: usize, of: usize) -> String {
    let share = 100.0 * images as f64 / of as f64;
    match share {
        _ if images == 0 => "0 %".to_owned(),
        _ if images == of => "100 %".to_owned(),
        share if share < 1.0 => "< 1 %".to_owned(),
        share if share > 99.0 => "> 99 %".to_owned(),
        share => format!("{share:.0} %"),
    }
}

fn caption(images: usize, sessions: usize) -> String {
    format!(
        "What became of the {} found in {}. Each step's images are a part of those of the step above; in brackets, their \
         share of all. Below a bar: the reasons for which the step leaves images out, with their numbers (docs/ledger.md). \
         Images with their pitch in range are selected: their sizes are fused.",
        counted(images, "image"),
        counted(sessions, "session"),
    )
}

fn alt(steps: &[Step]) -> String {
    let words: Vec<String> = steps.iter().map(|step| format!("{} {}", step.heading, step.images)).collect();
    format!("Bars that get shorter from step to step. Images: {}.", listed(&words))
}
