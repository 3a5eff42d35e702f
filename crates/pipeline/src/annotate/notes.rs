//! The notes on each image of a session: its row of the ledger, marks and sizes.

use std::collections::{BTreeMap, BTreeSet};

use ingest::{ImageEntry, ImageNotes, MarkNote};
use model::{Feature, FrameReason, FrameRow, Level, Method, Quantity, ResultRow};

use crate::session::{SessionOutput, ShownMark, ShownObject};

/// The kept output of a session, by image.
pub(super) struct Notes<'a> {
    output: &'a SessionOutput,
    frames: BTreeMap<&'a str, &'a FrameRow>,
    sizes: BTreeMap<&'a str, Vec<&'a ResultRow>>,
    /// The row for an image that the ledger does not have.
    unknown: FrameRow,
    /// The raters, sorted.
    pub raters: Vec<String>,
}

impl<'a> Notes<'a> {
    pub fn from_output(output: &'a SessionOutput) -> Self {
        let session = output.status.session.as_str();
        let raters: BTreeSet<&str> = output.results.iter().map(|row| row.rater.as_str()).collect();
        Self {
            output,
            frames: output.frames.iter().map(|frame| (frame.image.as_str(), frame)).collect(),
            sizes: sizes_by_image(&output.results),
            unknown: FrameRow::without_numbers("", session, "", FrameReason::SessionFailed),
            raters: raters.into_iter().map(str::to_owned).collect(),
        }
    }

    pub fn of_image(&self, image: &ImageEntry) -> ImageNotes<'_> {
        let file = image.file.as_str();
        let sizes = self.sizes.get(file).cloned().unwrap_or_default();
        let shown = self.output.shown.images.get(file);
        let marks = shown.into_iter().flat_map(|shown| &shown.objects);
        ImageNotes {
            frame: self.frames.get(file).copied().unwrap_or(&self.unknown),
            view: shown.and_then(|shown| self.output.shown.view(shown)),
            marks: marks.flat_map(|object| object.marks.iter().map(|mark| mark_note(object, mark, &sizes))).collect(),
            sizes,
            drawn_jpeg: None,
        }
    }
}

/// One row of each quantity that a rater measured in an image, by the method that is worth most.
fn sizes_by_image(results: &[ResultRow]) -> BTreeMap<&str, Vec<&ResultRow>> {
    let mut chosen: BTreeMap<(&str, &str, &str, Quantity), &ResultRow> = BTreeMap::new();
    for row in results.iter().filter(|row| row.level == Level::Frame && row.predicted_mm.is_some()) {
        let Some(image) = row.image.as_deref() else { continue };
        let place = chosen.entry((image, &row.rater, &row.object, row.quantity)).or_insert(row);
        if worth(row.method) > worth(place.method) {
            *place = row;
        }
    }
    let mut sizes: BTreeMap<&str, Vec<&ResultRow>> = BTreeMap::new();
    for ((image, ..), row) in chosen {
        sizes.entry(image).or_default().push(row);
    }
    sizes
}

/// Methods with fewer assumptions are worth more.
pub(super) fn worth(method: Method) -> u8 {
    match method {
        Method::Best => 4,
        Method::Ray => 3,
        Method::Coaxial => 2,
        Method::Joint => 1,
        Method::Paper => 0,
    }
}

fn mark_note(object: &ShownObject, mark: &ShownMark, sizes: &[&ResultRow]) -> MarkNote {
    let of_object = sizes.iter().filter(|row| row.object == object.object && row.rater == object.rater);
    let across = of_object.filter(|row| row.quantity != Quantity::Height);
    let plane_z_mm = match (mark.quantity, mark.feature) {
        (Some(Quantity::Height), _) => None, // it stands upright
        (_, Feature::Base) => Some(0.0),
        (_, Feature::Rim) => across.filter_map(|row| row.plane_z_mm).next(),
    };
    MarkNote {
        object: object.object.clone(),
        rater: object.rater.clone(),
        feature: mark.feature,
        closed: mark.closed,
        points_px: mark.points_px.clone(),
        plane_z_mm,
    }
}
