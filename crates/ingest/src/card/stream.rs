//! All samples of one sensor of a card.

use std::collections::VecDeque;
use std::fs::File;

use model::Problem;

use super::decoder::{Decoder, Layout};
use super::hashing::{HashingReader, Inputs, open_hashing};
use super::{CardFile, Place};
use crate::parse::{Fault, PacketError};
use crate::profile::{AccelerationStream, RangeStream};
use crate::progress::IngestProgress;
use crate::sample::Sample;

/// Streams the samples of one sensor through its files, a packet or some rows at a time. Files come in the order of their
/// first samples; times may still go back where files overlap.
pub(crate) struct Stream<'a> {
    layout: Layout,
    place: &'a Place,
    progress: &'a dyn IngestProgress,
    waiting: VecDeque<CardFile>,
    current: Option<OpenFile<'a>>,
    batch: Vec<Sample>,
    next: usize,
    pub inputs: Inputs,
    pub problems: Vec<Problem>,
}

struct OpenFile<'a> {
    file: CardFile,
    decoder: Decoder<HashingReader<'a>>,
    has_samples: bool,
}

impl<'a> Stream<'a> {
    pub fn acceleration(
        stream: &AccelerationStream,
        files: Vec<CardFile>,
        place: &'a Place,
        progress: &'a dyn IngestProgress,
    ) -> Result<Self, PacketError> {
        Layout::of_acceleration(stream).map(|layout| Self::new(layout, files, place, progress))
    }

    pub fn range(
        stream: &RangeStream,
        files: Vec<CardFile>,
        place: &'a Place,
        progress: &'a dyn IngestProgress,
    ) -> Result<Self, PacketError> {
        Layout::of_range(stream).map(|layout| Self::new(layout, files, place, progress))
    }

    fn new(layout: Layout, mut files: Vec<CardFile>, place: &'a Place, progress: &'a dyn IngestProgress) -> Self {
        let first_time = |file: &CardFile| Decoder::new(File::open(&file.path).ok()?, &layout).first_time();
        files.sort_by_cached_key(|file| (first_time(file), file.name.clone()));
        Self {
            layout,
            place,
            progress,
            waiting: files.into(),
            current: None,
            batch: Vec::new(),
            next: 0,
            inputs: Inputs::default(),
            problems: Vec::new(),
        }
    }

    /// The next sample, without taking it.
    pub fn peek(&mut self) -> Option<Sample> {
        while self.next >= self.batch.len() {
            self.next = 0;
            self.batch.clear();
            if !self.fill() {
                return None;
            }
        }
        self.batch.get(self.next).copied()
    }

    /// Takes the sample that [`Self::peek`] shows.
    pub fn advance(&mut self) {
        self.next += 1;
    }

    /// Reads on: into the batch, or to the next file. False after the last file.
    fn fill(&mut self) -> bool {
        if let Some(open) = &mut self.current {
            if open.decoder.next_batch(&mut self.batch) {
                open.has_samples |= !self.batch.is_empty();
                return true;
            }
            // The last call of a batch may still have given samples.
            open.has_samples |= !self.batch.is_empty();
            self.close();
            return true;
        }
        let Some(file) = self.waiting.pop_front() else { return false };
        match open_hashing(&file, self.progress) {
            Ok(reader) => {
                let decoder = Decoder::new(reader, &self.layout);
                self.current = Some(OpenFile { file, decoder, has_samples: false });
            }
            Err(error) => {
                self.inputs.add_unreadable(&file);
                self.report(&file.name, &Fault::Unreadable { offset: 0, message: error.to_string() });
            }
        }
        true
    }

    fn close(&mut self) {
        let Some(open) = self.current.take() else { return };
        let (mut faults, reader) = open.decoder.finish();
        if let Err(error) = self.inputs.add(&open.file, reader)
            && !faults.iter().any(|fault| matches!(fault, Fault::Unreadable { .. }))
        {
            faults.push(Fault::Unreadable { offset: 0, message: error.to_string() });
        }
        if faults.is_empty() && !open.has_samples {
            faults.push(Fault::NoSamples);
        }
        for fault in &faults {
            self.report(&open.file.name, fault);
        }
    }

    fn report(&mut self, file: &str, fault: &Fault) {
        self.problems.push(self.place.problem(fault.code(), file, fault.to_string(), fault.remedy()));
    }
}
