//! All samples of one sensor of a card.

use std::collections::VecDeque;

use model::{Problem, ProblemCode};

use super::decoder::{Decoder, Layout};
use super::hashing::{HashingReader, Inputs, open_hashing};
use super::sensor_files::{Anchoring, count_rows, in_order, shared_stamps};
use super::{CardFile, Place};
use crate::parse::{Fault, RawBlock};
use crate::progress::IngestProgress;
use crate::timeline::{Block, ClockError, Line, Spreader, Stepper, StreamFacts};

/// Streams the blocks of one sensor in order of time, files in the order of their first samples.
pub(crate) struct Stream<'a> {
    layout: Layout,
    place: &'a Place,
    progress: &'a dyn IngestProgress,
    anchoring: Anchoring<'a>,
    waiting: VecDeque<CardFile>,
    current: Option<OpenFile<'a>>,
    stepper: Stepper,
    line: Line,
    at_end: bool,
    has_opened: bool,
    pub inputs: Inputs,
    pub problems: Vec<Problem>,
}

struct OpenFile<'a> {
    file: CardFile,
    decoder: Decoder<HashingReader<'a>>,
    /// Where rows are spread over a declared time: how many are a second.
    rows_per_s: Option<f64>,
    /// Where rows share stamps.
    spreader: Option<Spreader>,
    samples: u64,
    missing: u64,
    unclocked: u64,
    clock_error: Option<ClockError>,
}

impl OpenFile<'_> {
    /// The next packet or batch, its rows spread where they share stamps. None at the end of the file.
    fn next_block(&mut self) -> Option<RawBlock> {
        let raw = self.decoder.next_block();
        match (&mut self.spreader, raw) {
            (None, raw) => raw,
            (Some(spreader), Some(raw)) => Some(spreader.push(raw)),
            (Some(spreader), None) => spreader.finish(),
        }
    }
}

impl<'a> Stream<'a> {
    pub fn new(
        layout: Layout,
        files: Vec<CardFile>,
        anchoring: Anchoring<'a>,
        place: &'a Place,
        progress: &'a dyn IngestProgress,
    ) -> Self {
        let (files, twice) = in_order(files, &layout, &anchoring);
        let mut stream = Self {
            stepper: Stepper::new(layout.clock(anchoring.zone), layout.step, layout.rate_hz),
            line: Line::new(layout.rate_hz, layout.gap_s),
            layout,
            place,
            progress,
            anchoring,
            waiting: files.into(),
            current: None,
            at_end: false,
            has_opened: false,
            inputs: Inputs::default(),
            problems: Vec::new(),
        };
        for (file, same_as) in &twice {
            stream.pass_over(file, same_as);
        }
        stream
    }

    /// Names of the channels that are carried along.
    pub fn extra(&self) -> &[String] {
        &self.layout.extra
    }

    /// The next block.
    pub fn next_block(&mut self) -> Option<Block> {
        loop {
            if let Some(block) = self.line.pop() {
                return Some(block);
            }
            if self.at_end {
                return None;
            }
            self.read_on();
        }
    }

    /// The account of the sensor's clock.
    pub fn finish(self) -> StreamFacts {
        let mut facts = self.line.finish();
        facts.times_declared = self.layout.is_counted();
        if facts.times_declared && self.layout.rows_over_s().is_none() {
            facts.measured_rate_hz = None;
        }
        facts
    }

    fn read_on(&mut self) {
        let Some(open) = &mut self.current else {
            match self.waiting.pop_front() {
                Some(file) => self.open(file),
                None => {
                    self.stepper.finish().into_iter().for_each(|block| self.line.push(block));
                    self.line.end();
                    self.at_end = true;
                }
            }
            return;
        };
        let Some(mut raw) = open.next_block() else {
            self.close();
            return;
        };
        raw.declared_rate_hz = open.rows_per_s.or(raw.declared_rate_hz);
        open.missing += raw.missing;
        let samples = raw.len() as u64;
        match self.stepper.push(raw) {
            Ok(block) => {
                let refused = self.stepper.take_refused();
                let left_out = refused.as_ref().map_or(0, |(left_out, _)| *left_out);
                open.unclocked += left_out;
                open.clock_error = open.clock_error.take().or(refused.map(|(_, error)| error));
                open.samples += samples - left_out;
                block.into_iter().for_each(|block| self.line.push(block));
            }
            Err(error) => {
                open.unclocked += samples;
                open.clock_error.get_or_insert(error);
            }
        }
    }

    fn open(&mut self, file: CardFile) {
        if self.has_opened && self.layout.is_counted() && self.anchoring.is_of_session() {
            self.refuse_second(&file);
            return;
        }
        self.has_opened = true;
        self.stepper.set_anchor(self.anchoring.of_file(&file));
        #[expect(clippy::cast_precision_loss, reason = "a file has far fewer than 2^53 rows")]
        let rows_per_s = self.layout.rows_over_s().map(|seconds| count_rows(&file, &self.layout) as f64 / seconds);
        match open_hashing(&file, self.progress) {
            Ok(reader) => {
                let decoder = Decoder::new(reader, &self.layout);
                let spreader = self.spreader(&file);
                let (samples, missing, unclocked, clock_error) = (0, 0, 0, None);
                self.current =
                    Some(OpenFile { file, decoder, rows_per_s, spreader, samples, missing, unclocked, clock_error });
            }
            Err(error) => {
                self.inputs.add_unreadable(&file);
                self.report(&file.name, &Fault::Unreadable { offset: 0, message: error.to_string() });
            }
        }
    }

    /// For a file whose rows share stamps; tells so.
    fn spreader(&mut self, file: &CardFile) -> Option<Spreader> {
        let shared = shared_stamps(file, &self.layout)?;
        let remedy = "let the logger write times with decimals, or declare rows_per_s in place of the column";
        self.problems.push(self.place.note(ProblemCode::StampsShared, &file.name, shared.fact(), remedy));
        Some(Spreader::new(shared))
    }

    fn close(&mut self) {
        let Some(open) = self.current.take() else { return };
        let (mut faults, reader) = open.decoder.finish();
        if let Err(error) = self.inputs.add(&open.file, reader)
            && !faults.iter().any(|fault| matches!(fault, Fault::Unreadable { .. }))
        {
            faults.push(Fault::Unreadable { offset: 0, message: error.to_string() });
        }
        if let Some(error) = open.clock_error {
            faults.push(Fault::NoTime { samples: open.unclocked, first: error.to_string() });
        }
        if let Some(Spreader { left_out: rows @ 1.., first_left_out, .. }) = open.spreader {
            let (first_rows, first_stamp_ns) = first_left_out.unwrap_or_default();
            faults.push(Fault::StampShared { rows, first_rows, first_stamp_ns });
        }
        if faults.is_empty() && open.samples == 0 && open.missing == 0 {
            faults.push(Fault::NoSamples);
        }
        self.line.facts_mut().missing_samples += open.missing;
        for fault in &faults {
            self.line.facts_mut().lost_bytes += fault.lost_bytes();
            self.report(&open.file.name, fault);
        }
    }

    fn report(&mut self, file: &str, fault: &Fault) {
        self.problems.push(self.place.problem(fault.code(), file, fault.to_string(), fault.remedy()));
    }

    /// Two files without times would lie on top of each other.
    fn refuse_second(&mut self, file: &CardFile) {
        self.hash_only(file);
        let fact = "there are no times in these files, and one anchor for all of them: which comes when cannot be told";
        let remedy = "join the files, or let [clock] anchor take each one's time from its name";
        self.problems.push(self.place.problem(ProblemCode::SamplesWithoutTime, &file.name, fact, remedy));
    }

    fn hash_only(&mut self, file: &CardFile) {
        match open_hashing(file, self.progress).and_then(|reader| self.inputs.add(file, reader)) {
            Ok(()) => {}
            Err(_) => self.inputs.add_unreadable(file),
        }
    }

    /// A file that is there twice is hashed, like every input, and not used.
    fn pass_over(&mut self, file: &CardFile, same_as: &CardFile) {
        self.hash_only(file);
        let fact = format!("the file is the same as {}, byte for byte; it is used once", same_as.name);
        self.problems.push(self.place.note(ProblemCode::DuplicateFile, &file.name, fact, "remove one of the two"));
    }
}
