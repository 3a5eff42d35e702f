//! Makes the pictures of a report: every measured picture made small, with its marks; for some sessions also the surest one
//! with its lens corrected, and projected on the table (Figs. 9 to 12 of the paper).

mod carried_marks;
mod corrected;
mod error;
mod ink;
mod plane;
mod resample;
mod small;

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::path::Path;

use ingest::{ByteBudget, ImageEntry, Picture, SessionReader};
use model::{FrameRow, GalleryPicture, GallerySink, PictureView, SessionStatus, Stage, View};
use rayon::prelude::*;

pub use error::{GalleryError, GalleryHalted};

use crate::parallel::jobs_or_default;
use crate::reporter::{Reporter, Totals};
use crate::session::{SessionOutput, Shown, ShownImage};
use crate::stop::Stop;
use crate::work::{State, recording_of, state_file};
use carried_marks::MarkedPicture;

/// The number of sessions of which the corrected and the projected picture are made.
const EXEMPLARY_SESSIONS: usize = 12;
/// A decoded picture has three bytes per pixel; its reduced copies are small beside it.
const BYTES_PER_PIXEL: u64 = 4;
/// The number of pictures that are read, per thread, before any of them is handed on.
const AHEAD: usize = 4;

/// The source of the pictures, and the bounds of the work.
#[derive(Debug, Clone)]
pub struct GalleryOptions<'a> {
    /// The work folder of the run whose results are reported.
    pub work_dir: &'a Path,
    /// The sessions of these results.
    pub sessions: &'a [SessionStatus],
    /// The number of pictures at a time; none for [`default_jobs`](crate::default_jobs).
    pub jobs: Option<NonZeroUsize>,
    /// The bound of the decoded pictures in memory at once. One is always let through.
    pub image_memory_bytes: u64,
    /// The wish to stop, from a signal or from inside.
    pub stop: Stop,
}

/// The result of a gallery.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Gallery {
    /// The number of pictures that the sink took.
    pub pictures: usize,
    /// The pictures that could not be shown.
    pub not_shown: Vec<NotShown>,
}

/// A picture, or all those of a session, that could not be shown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotShown {
    /// The name of the session.
    pub session: String,
    /// The file of the image, relative to the card; none for the session as a whole.
    pub image: Option<String>,
    /// The reason.
    pub fact: String,
}

/// Makes the pictures of a study from the output that its run has kept: sessions in the order given, in each by image, then
/// by view. A picture that cannot be shown is listed and passed over. Memory is bounded by the budget, plus some small
/// pictures.
///
/// # Errors
/// [`GalleryError`] where there is no work folder to take pictures from, or the sink refuses one.
pub fn gallery<S: GallerySink>(
    options: &GalleryOptions<'_>,
    reporter: &dyn Reporter,
    sink: &mut S,
) -> Result<Gallery, GalleryError<S::Error>> {
    let state = State::open_to_look(&state_file(options.work_dir)).map_err(GalleryHalted::from)?;
    let state = state.ok_or_else(|| GalleryHalted::NoWork(options.work_dir.to_owned()))?;
    let threads = jobs_or_default(options.jobs).get();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(GalleryHalted::from)?;
    let budget = ByteBudget::new(options.image_memory_bytes);
    let mut maker = Maker { options, state, threads, pool, budget, reporter, exemplary: 0, made: Gallery::default() };
    reporter.begin(&Totals { sessions: options.sessions.len(), ..Totals::default() });
    for status in options.sessions {
        if let Err(fact) = maker.session(status, sink)? {
            maker.not_shown(&status.session, None, fact);
        }
        reporter.done(status);
    }
    Ok(maker.made)
}

/// The pictures of a study while they are made.
struct Maker<'a> {
    options: &'a GalleryOptions<'a>,
    state: State,
    threads: usize,
    pool: rayon::ThreadPool,
    budget: ByteBudget,
    reporter: &'a dyn Reporter,
    /// The number of sessions that have had their exemplary picture.
    exemplary: usize,
    made: Gallery,
}

/// A picture to be made.
struct Subject<'a> {
    session: &'a str,
    image: &'a ImageEntry,
    shown: &'a ShownImage,
    view: View,
    /// Whether it is also shown corrected and projected.
    is_exemplary: bool,
}

impl Maker<'_> {
    /// Makes all pictures of a session; the inner error says why there are none.
    fn session<S: GallerySink>(
        &mut self,
        status: &SessionStatus,
        sink: &mut S,
    ) -> Result<Result<(), String>, GalleryError<S::Error>> {
        let name = status.session.as_str();
        let kept = self.state.output(name, Stage::Measure).map_err(GalleryHalted::from)?;
        let output: SessionOutput = match kept.as_deref().map(serde_json::from_str) {
            Some(Ok(output)) => output,
            _ if status.failed || status.sizes == 0 => return Ok(Ok(())),
            _ => return Ok(Err("the work folder does not have it; run the study again".to_owned())),
        };
        if output.shown.images.is_empty() {
            return Ok(Ok(())); // nothing was measured
        }
        let opened = SessionReader::open(&recording_of(self.options.work_dir, name));
        let listed = opened.and_then(|mut reader| Ok((reader.images()?, reader)));
        let (images, mut reader) = match listed {
            Ok(listed) => listed,
            Err(error) => return Ok(Err(error.to_string())),
        };
        let subjects = self.subjects(name, &output, &images);
        self.exemplary += usize::from(subjects.iter().any(|subject| subject.is_exemplary));
        self.reporter.bytes_to_read(name, subjects.iter().map(|subject| subject.image.bytes).sum());
        for some in subjects.chunks(AHEAD * self.threads) {
            if let Some(signal) = self.options.stop.signal() {
                return Err(GalleryHalted::Stopped { signal }.into());
            }
            self.hand_on(some, &mut reader, sink)?;
        }
        Ok(Ok(()))
    }

    /// The pictures to be made, in the order of the images' names.
    fn subjects<'s>(&self, name: &'s str, output: &'s SessionOutput, images: &'s [ImageEntry]) -> Vec<Subject<'s>> {
        let by_file: BTreeMap<&str, &ImageEntry> = images.iter().map(|image| (image.file.as_str(), image)).collect();
        let surest = surest(&output.shown, &output.frames).filter(|_| self.exemplary < EXEMPLARY_SESSIONS);
        let subject = |(file, shown): (&'s String, &'s ShownImage)| {
            Some(Subject {
                session: name,
                image: by_file.get(file.as_str())?,
                shown,
                view: output.shown.view(shown)?,
                is_exemplary: surest == Some(file),
            })
        };
        output.shown.images.iter().filter_map(subject).collect()
    }

    /// Reads some pictures one after the other, makes theirs in parallel, and hands them on in order.
    fn hand_on<S: GallerySink>(
        &mut self,
        subjects: &[Subject<'_>],
        reader: &mut SessionReader,
        sink: &mut S,
    ) -> Result<(), GalleryError<S::Error>> {
        let read = |subject: &Subject<'_>| reader.image_bytes(&subject.image.file).map_err(|error| error.to_string());
        let bytes: Vec<Result<Vec<u8>, String>> = subjects.iter().map(read).collect();
        let budget = &self.budget;
        let made: Vec<Result<Vec<GalleryPicture>, String>> = self.pool.install(|| {
            let one = |(subject, bytes): (&Subject<'_>, Result<Vec<u8>, String>)| {
                let _taken = budget.take(subject.decoded_bytes());
                subject.pictures(&bytes?)
            };
            subjects.par_iter().zip(bytes).with_max_len(1).map(one).collect()
        });
        for (subject, made) in subjects.iter().zip(made) {
            self.reporter.bytes_read(subject.session, subject.image.bytes);
            match made {
                Ok(pictures) => {
                    for picture in pictures {
                        sink.picture(picture).map_err(GalleryError::Sink)?;
                        self.made.pictures += 1;
                    }
                }
                Err(fact) => self.not_shown(subject.session, Some(subject.image.file.clone()), fact),
            }
        }
        Ok(())
    }

    fn not_shown(&mut self, session: &str, image: Option<String>, fact: String) {
        self.made.not_shown.push(NotShown { session: session.to_owned(), image, fact });
    }
}

/// The picture whose sizes are the surest: the one of the best rank, or the first.
fn surest<'s>(shown: &'s Shown, frames: &[FrameRow]) -> Option<&'s String> {
    let ranks: BTreeMap<&str, u32> = frames.iter().filter_map(|row| Some((row.image.as_str(), row.rank?))).collect();
    shown.images.keys().min_by_key(|file| ranks.get(file.as_str()).copied().unwrap_or(u32::MAX))
}

impl Subject<'_> {
    fn decoded_bytes(&self) -> u64 {
        BYTES_PER_PIXEL * u64::from(self.image.width_px) * u64::from(self.image.height_px)
    }

    /// The small picture; for an exemplary one all three views.
    fn pictures(&self, bytes: &[u8]) -> Result<Vec<GalleryPicture>, String> {
        let picture = Picture::decode(bytes).map_err(|error| error.to_string())?;
        let (size_px, expected_px) = ([picture.width_px, picture.height_px], self.view.camera().size_px());
        if size_px != expected_px {
            return Err(format!("the picture is {size_px:?} px, but the camera's are {expected_px:?}"));
        }
        if !self.is_exemplary {
            let marked =
                small::reduce(picture, &self.view, self.shown).ok_or("the picture is too flat to be reduced")?;
            return Ok(vec![self.gallery_picture(PictureView::Camera, marked)?]);
        }
        let (source, view) = resample::source(picture, &self.view).ok_or("the picture is too flat to be reduced")?;
        let marks = carried_marks::resampled(self.shown, self.view.camera().size_px(), view.camera().size_px());
        let corrected = corrected::undistort(&source, view.camera(), &marks);
        let plane = plane::project(&source, &view, &marks);
        let camera = small::reduce(source, &view, &marks).ok_or("the picture is too flat to be reduced")?;
        let views =
            [(PictureView::Camera, Some(camera)), (PictureView::Corrected, corrected), (PictureView::Plane, plane)];
        let shown = views.into_iter().filter_map(|(view, marked)| Some(self.gallery_picture(view, marked?)));
        shown.collect()
    }

    fn gallery_picture(&self, view: PictureView, marked: MarkedPicture) -> Result<GalleryPicture, String> {
        let MarkedPicture { picture, marks } = marked;
        Ok(GalleryPicture {
            session: self.session.to_owned(),
            image: self.image.file.clone(),
            view,
            size_px: [picture.width_px, picture.height_px],
            jpeg: picture.to_jpeg(small::QUALITY).map_err(|error| error.to_string())?,
            marks,
        })
    }
}
