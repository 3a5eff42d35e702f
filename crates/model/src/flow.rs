//! The flow of images: how many images a study has, and at which step some of them were left out.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::codes::coded_enum;
use crate::frame_log::FrameReason;
use crate::results::{FlowRow, FrameRow};

coded_enum! {
    /// A step of the flow. Its images are some of those of the step before.
    FlowStep {
        Found = "found": "every image of the study",
        Readable = "readable": "a whole picture of the camera's size, with a time",
        WithPose = "with_pose": "readable, with acceleration and range at that time, and an axis that meets the table",
        Still = "still": "with a pose, and the head was still",
        Selected = "selected": "still, and the pitch is within the target window: used for fused sizes",
        Marked = "marked": "selected, and marked by at least one rater",
        Measured = "measured": "selected and marked, and at least one size could be measured",
    }
}

impl FrameReason {
    /// The last step of the flow that an image with this reason reaches, as far as its reason decides.
    #[must_use]
    pub fn reaches(self) -> FlowStep {
        match self {
            Self::SessionFailed
            | Self::EmptyImage
            | Self::NotAnImage
            | Self::DamagedImage
            | Self::WrongSize
            | Self::NoTime
            | Self::TimesDisagree => FlowStep::Found,
            Self::AmbiguousTime | Self::NoAcceleration | Self::BadGravity | Self::NoRange | Self::NotBelowHorizon => {
                FlowStep::Readable
            }
            Self::Moving => FlowStep::WithPose,
            Self::PitchOutsideTarget => FlowStep::Still,
            Self::Selected => FlowStep::Selected,
        }
    }

    /// The first step of the flow that an image with this reason does not reach; `None` for selected images.
    #[must_use]
    pub fn ends(self) -> Option<FlowStep> {
        let next = |step| FlowStep::ALL.iter().copied().find(|later| *later > step);
        if self == Self::Selected { None } else { next(self.reaches()) }
    }

    /// Whether marks on an image with this reason are measured and fused, in words.
    const fn marks(self) -> &'static str {
        match self {
            Self::Selected => "measured and fused",
            Self::Moving | Self::PitchOutsideTarget => "measured, not fused",
            _ => "not measured",
        }
    }
}

/// Counts of images that have something in common.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ImageCounts {
    /// All such images.
    pub images: usize,
    /// The images with marks of at least one rater.
    pub marked: usize,
    /// The images with marks and at least one measured size.
    pub measured: usize,
}

impl ImageCounts {
    fn add(&mut self, other: Self) {
        self.images += other.images;
        self.marked += other.marked;
        self.measured += other.measured;
    }
}

/// The facts about one image that the flow counts.
#[derive(Debug, Clone, Copy)]
pub struct FlowImage<'a> {
    /// Name of the session.
    pub session: &'a str,
    /// The reason that the ledger gives for the image.
    pub reason: FrameReason,
    /// Number of raters with marks on the image.
    pub raters: u32,
    /// Number of sizes measured on the image.
    pub sizes: u32,
}

impl<'a> From<&'a FrameRow> for FlowImage<'a> {
    fn from(row: &'a FrameRow) -> Self {
        Self { session: &row.session, reason: row.reason, raters: row.raters, sizes: row.sizes }
    }
}

impl<'a> From<&'a FlowRow> for FlowImage<'a> {
    fn from(row: &'a FlowRow) -> Self {
        Self { session: &row.session, reason: row.reason, raters: row.raters, sizes: row.sizes }
    }
}

/// The flow of images: how many reach each step, and why the others do not. The order of the images does not matter.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Flow {
    by_reason: BTreeMap<FrameReason, ImageCounts>,
}

impl Flow {
    /// Counts one image.
    pub fn add<'a>(&mut self, image: impl Into<FlowImage<'a>>) {
        let image = image.into();
        let marked = image.raters > 0;
        self.by_reason.entry(image.reason).or_default().add(ImageCounts {
            images: 1,
            marked: usize::from(marked),
            measured: usize::from(marked && image.sizes > 0),
        });
    }

    /// Adds the counts of `other`.
    pub fn merge(&mut self, other: &Self) {
        for (reason, counts) in &other.by_reason {
            self.by_reason.entry(*reason).or_default().add(*counts);
        }
    }

    /// The counts of the images with this reason.
    #[must_use]
    pub fn with_reason(&self, reason: FrameReason) -> ImageCounts {
        self.by_reason.get(&reason).copied().unwrap_or_default()
    }

    /// The number of images that reach a step.
    #[must_use]
    pub fn images_at(&self, step: FlowStep) -> usize {
        let selected = self.with_reason(FrameReason::Selected);
        match step {
            FlowStep::Marked => selected.marked,
            FlowStep::Measured => selected.measured,
            _ => self.sum(|reason| reason.reaches() >= step).images,
        }
    }

    /// The counts of the images that were not selected. Those with a pose are measured where they are marked, but not fused.
    #[must_use]
    pub fn not_selected(&self) -> ImageCounts {
        self.sum(|reason| reason != FrameReason::Selected)
    }

    /// The share of all images that was selected, in per cent; `None` when there are no images.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a count of images is far below 2^53")]
    pub fn selected_pct(&self) -> Option<f64> {
        let all = self.images_at(FlowStep::Found);
        (all > 0).then(|| 100.0 * self.images_at(FlowStep::Selected) as f64 / all as f64)
    }

    /// The sum of the counts over the reasons for which `counts` holds.
    fn sum(&self, counts: impl Fn(FrameReason) -> bool) -> ImageCounts {
        let mut sum = ImageCounts::default();
        for (_, of_reason) in self.by_reason.iter().filter(|(reason, _)| counts(**reason)) {
            sum.add(*of_reason);
        }
        sum
    }
}

/// The flow of a study, session by session.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct StudyFlow {
    sessions: BTreeMap<String, Flow>,
}

impl StudyFlow {
    /// Counts one image for its session.
    pub fn add<'a>(&mut self, image: impl Into<FlowImage<'a>>) {
        let image = image.into();
        if let Some(flow) = self.sessions.get_mut(image.session) {
            return flow.add(image);
        }
        self.sessions.entry(image.session.to_owned()).or_default().add(image);
    }

    /// Adds the counts of `other`, session by session.
    pub fn merge(&mut self, other: Self) {
        for (session, flow) in other.sessions {
            self.sessions.entry(session).or_default().merge(&flow);
        }
    }

    /// The names of the sessions with images, in their order, each with its flow.
    pub fn sessions(&self) -> impl Iterator<Item = (&str, &Flow)> {
        self.sessions.iter().map(|(name, flow)| (name.as_str(), flow))
    }

    /// The flow of the study as a whole.
    #[must_use]
    pub fn total(&self) -> Flow {
        let mut total = Flow::default();
        for flow in self.sessions.values() {
            total.merge(flow);
        }
        total
    }
}

/// The Markdown of two tables: the reasons, with the step that each ends and the fate of marks, and then the steps.
pub(crate) fn flow_markdown() -> String {
    let mut text =
        "| reason | meaning | first step not reached | marks on such an image |\n|---|---|---|---|\n".to_owned();
    for reason in FrameReason::ALL {
        let ends = reason.ends().map_or_else(String::new, |step| format!("`{step}`"));
        let _ = writeln!(text, "| `{reason}` | {} | {ends} | {} |", reason.meaning(), reason.marks());
    }
    text.push_str(
        "\n## The flow of images\n\n\
         How many images reach each step, each a part of the one before (docs/tables.md, table `flow`):\n\n\
         | step | meaning |\n|---|---|\n",
    );
    for step in FlowStep::ALL {
        let _ = writeln!(text, "| `{step}` | {} |", step.meaning());
    }
    text
}
