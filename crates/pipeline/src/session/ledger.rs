//! The rows of the ledger, frames.parquet.

use std::collections::BTreeMap;

use ingest::card::{Card, CardFile, Patterns};
use model::{FrameReason, FrameRow, Method, ResultRow};

use super::frames::Session;
use super::session_marks::SessionMarks;
use super::surest::Surest;
use crate::study::{SessionDir, Study};

/// One row for every image of the session: first those with data, by time, then the dropped ones, by file.
pub(super) fn ledger(session: &Session<'_>, marks: &SessionMarks, results: &[ResultRow]) -> Vec<FrameRow> {
    let mut sizes: BTreeMap<&str, u32> = BTreeMap::new();
    // A size by 'best' repeats one by another method.
    let counted = results.iter().filter(|row| row.predicted_mm.is_some() && row.method != Method::Best);
    for file in counted.filter_map(|row| row.image.as_deref()) {
        *sizes.entry(file).or_default() += 1;
    }
    let surest = Surest::of_session(session);
    let with_data = session.frames.iter().enumerate().map(|(number, frame)| FrameRow {
        plate_sigma_mm: surest.sigma_mm(number),
        rank: surest.rank(number),
        time_utc: Some(frame.image.time),
        reason: frame.signals.reason,
        bytes: u32::try_from(frame.image.bytes).unwrap_or(u32::MAX),
        width_px: Some(frame.image.width_px),
        height_px: Some(frame.image.height_px),
        gravity_mg: frame.signals.gravity_mg,
        stillness_mg: frame.signals.stillness_mg,
        pitch_deg: frame.signals.pitch_roll_rad.map(|(pitch, _)| pitch.to_degrees()),
        roll_deg: frame.signals.pitch_roll_rad.map(|(_, roll)| roll.to_degrees()),
        range_mm: frame.signals.range_mm,
        range_spread_mm: frame.signals.range_spread_mm,
        range_samples: frame.signals.range_samples,
        range_distinct: frame.signals.range_distinct,
        flags: frame.signals.flags.iter().map(|flag| flag.code()).collect::<Vec<_>>().join(","),
        raters: count(marks.of_image(&frame.image.file).count()),
        sizes: sizes.get(frame.image.file.as_str()).copied().unwrap_or_default(),
        ..empty_row(session, &frame.image.file, frame.signals.reason)
    });
    let dropped = session.dropped.iter().map(|image| FrameRow {
        time_utc: image.time,
        bytes: u32::try_from(image.bytes).unwrap_or(u32::MAX),
        width_px: image.width_px,
        height_px: image.height_px,
        ..empty_row(session, &image.file, image.reason)
    });
    with_data.chain(dropped).collect()
}

/// One row for every image on the card, by file, for a session of which nothing could be used.
pub(super) fn ledger_of_failed(study: &Study, dir: &SessionDir) -> Vec<FrameRow> {
    let (Some(card_dir), Some(images)) = (&dir.card, &study.profile.images) else { return Vec::new() };
    if !study.holds(card_dir) {
        return Vec::new();
    }
    let (Ok(card), Ok(patterns)) = (Card::list(card_dir), Patterns::new(&images.files)) else { return Vec::new() };
    let row = |file: &CardFile| FrameRow {
        bytes: u32::try_from(file.bytes).unwrap_or(u32::MAX),
        ..FrameRow::without_numbers(&study.spec.name, &dir.name, &file.name, FrameReason::SessionFailed)
    };
    card.fitting(&patterns).iter().map(row).collect()
}

fn empty_row(session: &Session<'_>, file: &str, reason: FrameReason) -> FrameRow {
    let participant = session.spec.participant.clone();
    FrameRow { participant, ..FrameRow::without_numbers(&session.study.spec.name, &session.dir.name, file, reason) }
}

fn count(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}
