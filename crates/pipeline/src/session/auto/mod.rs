//! Finds rims in the selected images of a session, and names them so that one container has one name.

mod appearance;
mod link;
mod named;
mod table;
mod track;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use ingest::{ByteBudget, Picture, SessionReader};
use model::{
    Camera, Container, Estimate, FrameReason, Method, Orientation, Problem, ProblemCode, Quantity, Severity, Shape,
    SizeSigma, Stage, View,
};
use nalgebra::Point2;

use super::frames::{Frame, frames, inputs_of};
use super::prepared::Prepared;
use super::recording::{Recording, bad_mcap};
use crate::calibration::corrected_view;
use crate::labelme::{self, AutoRim};
use crate::stop::Stop;
use crate::study::{AUTO, SessionDir, Study, marks_in, number_of_found, stem_of};
use appearance::Appearance;
use named::{Seen, name_containers};
use rims::{self, Found, Rim, find_rims_of};
use table::{Looked, on_one_table, pictures_of_table, rays_of};
use track::Sighting;

/// The result of a search.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct AutoMarks {
    /// The rims by image (file on the card), the likeliest first.
    pub by_image: BTreeMap<String, Vec<AutoRim>>,
    /// The pictures that could not be searched.
    pub problems: Vec<Problem>,
    /// Whether rims were looked for at all.
    pub searched: bool,
}

/// The reason why a search did not come to its end.
pub(crate) enum SearchError {
    /// A wish to stop came.
    Stopped,
    /// The recording could not be read.
    Recording(Box<Problem>),
}

/// The inputs of a search.
pub(crate) struct Search<'a> {
    pub study: &'a Study,
    pub dir: &'a SessionDir,
    pub prepared: &'a Prepared,
    pub mcap: &'a Path,
    pub budget: &'a ByteBudget,
    pub stop: &'a Stop,
}

impl Search<'_> {
    /// Looks for rims in the selected images, one picture at a time in the order of time, so that nothing depends on what
    /// runs beside it. Where all files of marks are read, images for which rater `auto` has a file are left out. A search without
    /// files is the same whatever people correct, so that containers keep their names.
    pub fn run(&self, recording: &Recording) -> Result<AutoMarks, SearchError> {
        let source = self.study.spec.marks.source;
        let mut auto = AutoMarks::default();
        if !source.searches() {
            return Ok(auto);
        }
        auto.searched = true;
        let (checked, taken) = if source.reads_all() { self.checked(recording) } else { Default::default() };
        let refuse = |error| SearchError::Recording(Box::new(bad_mcap(&self.dir.name, &error)));
        let mut reader = SessionReader::open(self.mcap).map_err(refuse)?;
        let frames = frames(self.study, self.prepared, recording);
        let is_free = |frame: &Frame| !checked.contains(&stem_of(&frame.image.file));
        let is_measured = |frame: &Frame| frame.signals.reason == FrameReason::Selected && is_free(frame);
        if !frames.iter().any(is_measured) {
            return Ok(auto); // no picture is opened for the table alone
        }
        let for_table = pictures_of_table(&frames);
        let (mut seen, mut helping, mut looked) = (Vec::new(), Vec::new(), Vec::new());
        for (number, frame) in frames.iter().enumerate() {
            let is_measured = is_measured(frame);
            if !is_measured && !for_table.contains(&number) {
                continue;
            }
            if self.stop.is_set() {
                return Err(SearchError::Stopped);
            }
            let room = frame.image.bytes
                + BYTES_PER_PIXEL * u64::from(frame.image.width_px) * u64::from(frame.image.height_px);
            let _taken = self.budget.take(room);
            let bytes = reader.image_bytes(&frame.image.file).map_err(refuse)?;
            match self.in_picture(number, frame, &bytes, for_table.contains(&number)) {
                Ok((found, of_table)) => {
                    (if is_measured { &mut seen } else { &mut helping }).extend(found);
                    looked.extend(of_table);
                }
                Err(fact) if is_measured => auto.problems.push(self.not_searched(frame, fact)),
                Err(_) => {} // nothing is measured in it
            }
        }
        let inputs = self.study.spec.uncertainty.inputs();
        let on_table = on_one_table(&looked, &seen, &helping, &inputs);
        auto.by_image = name_containers(seen, &on_table, &taken, self.study.spec.marks.min_diameter_mm);
        Ok(auto)
    }

    /// The names of the images for which rater `auto` has files, and the numbers of the objects in those files.
    fn checked(&self, recording: &Recording) -> (BTreeSet<String>, BTreeSet<u32>) {
        let files = self.dir.marks.get(AUTO).and_then(|dir| marks_in(dir).ok()).unwrap_or_default();
        let by_stem: BTreeMap<String, Orientation> =
            recording.images.iter().map(|image| (stem_of(&image.file), image.orientation)).collect();
        let mut taken = BTreeSet::new();
        for file in &files {
            let orientation = by_stem.get(&stem_of(&file.to_string_lossy())).copied().unwrap_or_default();
            let picture = self.prepared.marked_picture(self.study, orientation);
            // A file that cannot be used becomes a problem where its marks are read.
            let marks = labelme::read_bytes(file).and_then(|bytes| labelme::parse(&bytes, file, picture));
            let objects = marks.map(|marks| marks.objects).unwrap_or_default();
            taken.extend(objects.iter().filter_map(|marks| number_of_found(&marks.object)));
        }
        (files.iter().map(|file| stem_of(&file.to_string_lossy())).collect(), taken)
    }

    /// What a picture shows, with the features of the table where they are asked for.
    fn in_picture(
        &self,
        number: usize,
        frame: &Frame,
        bytes: &[u8],
        for_table: bool,
    ) -> Result<(Vec<Seen>, Option<Looked>), String> {
        let Some(pose) = frame.signals.pose_for(Method::Ray) else { return Ok((Vec::new(), None)) };
        let calibration = self.study.calibration.as_ref();
        let Some(view) = corrected_view(calibration, Method::Ray, View::new(self.prepared.camera, pose)) else {
            return Ok((Vec::new(), None));
        };
        let picture = Picture::decode(bytes).map_err(|error| error.to_string())?;
        let rims = find_rims_of(&picture, &view, &self.study.spec.marks.shapes).map_err(|error| error.to_string())?;
        let sure = rims.iter().filter(|rim| rim.confidence >= self.study.spec.marks.min_confidence);
        let seen = sure.filter_map(|rim| self.seen_rim(number, frame, &view, rim)).collect();
        Ok((seen, for_table.then(|| Looked::new(number, &picture, &view, &rims))))
    }

    /// The rim with all that it is linked by; none where it has no size, or where the marks camera would not show it.
    fn seen_rim(&self, number: usize, frame: &Frame, view: &View, rim: &Rim) -> Option<Seen> {
        let (camera, marks_camera) = (&self.prepared.camera, &self.prepared.marks_camera.1);
        let points_px: Vec<[f64; 2]> =
            rim.points_px.iter().filter_map(|point| in_marked_picture(camera, marks_camera, *point)).collect();
        let rim_px = marks_camera.focal_px()[0] / camera.focal_px()[0] * rim.perimeter_px;
        let found = Found { perimeter_px: rim_px, ..rim.found() };
        let auto = AutoRim { object: String::new(), points_px, found };
        let sighting = self.sighting(number, frame, view, rim)?;
        let image = frame.image.file.clone();
        let least = if found.shape == Shape::Circle { rims::LEAST_POINTS } else { CORNERS };
        (auto.points_px.len() >= least).then_some(Seen { image, rim: auto, sighting, rays: rays_of(view, rim) })
    }

    fn sighting(&self, number: usize, frame: &Frame, view: &View, rim: &Rim) -> Option<Sighting> {
        let camera_mm = view.pose().camera_height_mm();
        let own = rim.found().container();
        let height_mm = rim.height_as(&own).mm;
        // The height is taken as known here. What its uncertainty does to the size is considered for all images of a
        // container together.
        let container = Container { rim_height_mm: Some(height_mm), ..own };
        let sizes = rim.sizes(view, Method::Ray, &container, &inputs_of(self.study, frame));
        let size = |wanted: Quantity| {
            let (_, size) = sizes.iter().find(|(quantity, _)| *quantity == wanted)?;
            size.as_ref().ok()
        };
        let width_mm = size(Quantity::Width).map(|width| width.measured.predicted_mm);
        let Estimate { measured, sigma, .. } = size(Quantity::Diameter).or_else(|| size(Quantity::Length))?;
        Some(Sighting {
            image: number,
            time: frame.image.time,
            across_mm: measured.predicted_mm / (1.0 - height_mm / camera_mm),
            narrowness: width_mm.map(|width_mm| width_mm / measured.predicted_mm),
            relative_sigma: sigma_within_session_mm(sigma) / measured.predicted_mm,
            camera_mm,
            at_mm: rim.on_table_mm.0,
            appearance: Appearance { plate: rim.plate_height, bowl: rim.height, plate_log_odds: rim.plate_log_odds },
        })
    }

    fn not_searched(&self, frame: &Frame, fact: String) -> Problem {
        Problem {
            severity: Severity::Loss,
            stage: Stage::Marks,
            code: ProblemCode::PictureNotSearched,
            place: format!("cards/{}/{}", self.dir.name, frame.image.file),
            fact,
            remedy: "look at the picture; mark it by hand, or copy it from the card again".to_owned(),
        }
    }
}

/// The standard uncertainty, in mm, of a size against others of its session. A wrong angle or range makes all of them wrong
/// alike, apart from the part that differs between views: above all, what stands in the range sensor's cone.
fn sigma_within_session_mm(sigma: &SizeSigma) -> f64 {
    let own = (sigma.total_mm.powi(2) - sigma.common_mm.powi(2)).max(0.0).sqrt();
    own.hypot(VIEWS_DIFFER * sigma.common_mm)
}

/// The share of the common uncertainty that remains between two views of the same thing. In simulated sessions (`worn`,
/// seeds 101 to 103) the sizes of one container scatter by 3.8 %, including edges that are not the rim's outer one, where
/// 3.9 % are stated.
const VIEWS_DIFFER: f64 = 0.75;

/// The number of points of a rectangle.
const CORNERS: usize = 4;

/// A decoded picture has three bytes per pixel; the search for edges needs a fourth.
const BYTES_PER_PIXEL: u64 = 4;

/// The point of the pictures that people mark that shows the same as a point of the recorded one, rounded to a thousandth of
/// a pixel: far finer than any edge, and short in files.
fn in_marked_picture(camera: &Camera, marks_camera: &Camera, point: Point2<f64>) -> Option<[f64; 2]> {
    let point =
        if camera == marks_camera { point } else { marks_camera.pixel_of(&camera.ray_through(point).ok()?).ok()? };
    Some([point.x, point.y].map(|c| (c * 1e3).round() / 1e3))
}
