//! One session from end to end: card -> MCAP -> signals -> select -> marks -> measure -> fuse -> rows.
//!
//! [`road`] calls the steps. Each has a module that names its inputs and outputs: `recording` (with [`crate::signals`]),
//! `frames`, `session_marks` (with `auto`, which finds rims), `measurement`, `fuse`.

mod auto;
mod bench;
mod beside;
mod card_progress;
mod found;
mod frames;
mod fuse;
mod lag;
mod ledger;
mod marked;
mod measurement;
mod naming;
mod output;
mod plausible;
mod prepared;
mod problems;
mod recording;
mod road;
mod row;
mod session_marks;
mod shown;
mod surest;
#[cfg(test)]
mod tests;

pub(crate) use auto::{AutoMarks, Search, SearchError};
pub(crate) use card_progress::CardProgress;
pub(crate) use output::{Searched, SessionOutput};
pub(crate) use prepared::Prepared;
pub(crate) use problems::without_host;
pub(crate) use recording::{Recording, read as read_recording};
pub(crate) use road::{
    Measuring, SessionOptions, failed, finish_status, ingest_problem, ingest_without_state, log_problems, run_session,
};
pub(crate) use shown::{Shown, ShownImage, ShownMark, ShownObject};
