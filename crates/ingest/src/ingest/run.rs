//! The ingest of one session, step by step.

use std::path::Path;

use jiff::Timestamp;
use model::{Camera, Problem, ProblemCode, UtcNs};

use super::clock_problems::clock_problems;
use super::image_tally::ImageTally;
use super::read_ahead::read_ahead;
use super::{common_time, dropped, recordings};
use crate::card::{Anchoring, Card, CardFile, Inputs, Layout, Patterns, Place, Stream, TakenImage, judge_image};
use crate::error::IngestError;
use crate::key::{self, INGEST_VERSION};
use crate::mcap_file::metadata::Facts;
use crate::mcap_file::{Keep, SessionWriter, WriteError};
use crate::profile::Images;
use crate::progress::IngestProgress;
use crate::source::SessionSource;
use crate::summary::{Counts, DroppedImage, ImageEntry, IngestSummary};
use crate::timeline::{Block, StreamFacts, Timeline};

/// The ingest of one session under way.
pub(super) struct Run<'a> {
    source: &'a SessionSource,
    out: &'a Path,
    place: &'a Place,
    progress: &'a dyn IngestProgress,
    keep: Keep,
    writer: SessionWriter,
    pub inputs: Inputs,
    pub problems: Vec<Problem>,
    counts: Counts,
    timeline: Timeline,
    dropped: Vec<DroppedImage>,
}

impl<'a> Run<'a> {
    pub fn new(
        source: &'a SessionSource,
        out: &'a Path,
        keep: Keep,
        place: &'a Place,
        progress: &'a dyn IngestProgress,
    ) -> Result<Self, IngestError> {
        Ok(Self {
            source,
            out,
            place,
            progress,
            keep,
            writer: SessionWriter::create(out, keep).map_err(|error| write_error(out, error))?,
            inputs: Inputs::default(),
            problems: Vec::new(),
            counts: Counts::default(),
            timeline: Timeline::default(),
            dropped: Vec::new(),
        })
    }

    /// Writes the samples of all sensors, one sensor after the other.
    pub fn sensors(&mut self, card: &Card) -> Result<(), IngestError> {
        let profile = &self.source.profile;
        let acceleration = match &profile.acceleration {
            Some(declared) => {
                let files = self.files_of("accelerometer", &declared.files, card)?;
                Some(self.sensor(Layout::of_acceleration(declared)?, files, SessionWriter::acceleration)?)
            }
            None => self.undeclared("acceleration"),
        };
        let range = match &profile.range {
            Some(declared) => {
                let files = self.files_of("range sensor", &declared.files, card)?;
                Some(self.sensor(Layout::of_range(declared)?, files, SessionWriter::range)?)
            }
            None => self.undeclared("range"),
        };
        self.counts.acceleration = acceleration.as_ref().map_or(0, |facts| facts.samples);
        self.counts.range = range.as_ref().map_or(0, |facts| facts.samples);
        self.timeline = Timeline::new(acceleration, range);
        self.problems.extend(clock_problems(&self.timeline, self.place));
        Ok(())
    }

    /// Writes the samples of one sensor.
    fn sensor(
        &mut self,
        layout: Layout,
        files: Vec<CardFile>,
        write: impl Fn(&mut SessionWriter, Block, &[String]) -> Result<(), WriteError>,
    ) -> Result<StreamFacts, IngestError> {
        let source = self.source;
        let anchoring = Anchoring {
            spec: source.profile.clock.as_ref(),
            session: source.clock_zero_utc.and_then(utc_ns),
            zone: &source.time_zone,
        };
        let mut stream = Stream::new(layout, files, anchoring, self.place, self.progress);
        while let Some(block) = stream.next_block() {
            write(&mut self.writer, block, stream.extra()).map_err(|error| write_error(self.out, error))?;
        }
        self.writer.end_of_sensor().map_err(|error| write_error(self.out, error))?;
        self.problems.append(&mut stream.problems);
        self.inputs.bytes += stream.inputs.bytes;
        self.inputs.sha256.append(&mut stream.inputs.sha256);
        Ok(stream.finish())
    }

    fn files_of(&mut self, sensor: &str, patterns: &[String], card: &Card) -> Result<Vec<CardFile>, IngestError> {
        let files = card.fitting(&Patterns::new(patterns).map_err(IngestError::Pattern)?);
        self.report_absent(sensor, patterns, files.is_empty());
        Ok(files)
    }

    fn undeclared<T>(&mut self, table: &str) -> Option<T> {
        self.report_undeclared(table);
        None
    }

    /// Writes the images in the order of their names; returns what was written, in that order.
    pub fn images(&mut self, card: &Card) -> Result<Vec<ImageEntry>, IngestError> {
        let source = self.source;
        let Some(Images { files, time }) = &source.profile.images else {
            self.report_undeclared("images");
            return Ok(Vec::new());
        };
        let fitting = card.fitting(&Patterns::new(files).map_err(IngestError::Pattern)?);
        self.report_absent("camera", files, fitting.is_empty());
        let mut entries: Vec<ImageEntry> = Vec::new();
        let mut tally = ImageTally::default();
        let progress = self.progress;
        let inputs = read_ahead(&fitting, progress, |file, bytes| {
            let judged = bytes.and_then(|bytes| judge_image(file, bytes, time, &source.time_zone, &source.camera_spec));
            match judged {
                Ok(TakenImage { entry, encoding, bytes, remarks }) => {
                    tally.add(&entry.file, entry.bytes, remarks);
                    self.writer.image(entry.time, encoding, bytes).map_err(|error| write_error(self.out, error))?;
                    entries.push(entry);
                }
                Err(dropped) => self.dropped.push(dropped),
            }
            Ok(())
        })?;
        self.inputs.merge(inputs);
        self.counts.images = entries.len() as u64;
        self.counts.dropped_images = self.dropped.len() as u64;
        self.problems.extend(dropped::problems(&self.dropped, self.place));
        self.problems.extend(tally.notes(self.place));
        let times: Vec<UtcNs> = entries.iter().map(|entry| entry.time).collect();
        self.problems.extend(recordings::note(&times, self.place));
        self.problems.extend(common_time::problems(&times, &self.timeline, &source.profile, self.place));
        Ok(entries)
    }

    /// Writes what is known only at the end, and gives the file its name. `listing`: what the listing of the card gave to tell.
    pub fn finish(
        mut self,
        entries: &[ImageEntry],
        camera: &Camera,
        listing: &[Problem],
    ) -> Result<IngestSummary, IngestError> {
        if self.progress.is_stopped() {
            return Err(IngestError::Stopped); // what was read may end anywhere
        }
        // A session without any message still has its camera; its time then says 1970.
        let start = self.writer.first_time().unwrap_or(UtcNs(0));
        let lists = self.writer.image_list(entries).and_then(|()| self.writer.calibration(camera, start));
        lists.map_err(|error| write_error(self.out, error))?;
        let facts = Facts {
            session: self.source.session.clone(),
            program: self.source.program.clone(),
            ingest_version: INGEST_VERSION,
            key: key::key_as(self.keep, self.source, &self.inputs, listing)?,
            time_zone: key::zone_name(&self.source.time_zone),
            counts: self.counts,
            timeline: self.timeline,
            profile: self.source.profile.clone(),
            camera: self.source.camera_spec.clone(),
            inputs_sha256: self.inputs.sha256,
            dropped_images: self.dropped,
            problems: self.problems,
        };
        self.writer.finish(facts.to_records()?).map_err(|error| write_error(self.out, error))?;
        Ok(IngestSummary {
            session: facts.session,
            key: facts.key,
            files: facts.inputs_sha256.len(),
            bytes: self.inputs.bytes,
            images: facts.counts.images,
            counts: facts.counts,
            dropped_images: facts.dropped_images,
            problems: facts.problems,
        })
    }

    fn report_absent(&mut self, sensor: &str, patterns: &[String], is_absent: bool) {
        if is_absent {
            let fact = format!("no files of the {sensor}: nothing fits {}", patterns.join(" "));
            let remedy = "copy the whole card, or correct the patterns in the device profile (case matters)";
            self.problems.push(self.place.problem(ProblemCode::NoFiles, "", fact, remedy));
        }
    }

    fn report_undeclared(&mut self, table: &str) {
        let fact = format!("device profile '{}' declares no [{table}]", self.source.profile.name);
        let remedy = format!("sizes need it: add a table [{table}] to the profile if the device writes such files");
        self.problems.push(self.place.problem(ProblemCode::NotDeclared, "", fact, remedy));
    }
}

fn utc_ns(time: Timestamp) -> Option<UtcNs> {
    i64::try_from(time.as_nanosecond()).ok().map(UtcNs)
}

fn write_error(path: &Path, source: WriteError) -> IngestError {
    IngestError::Write { path: path.to_owned(), source }
}
