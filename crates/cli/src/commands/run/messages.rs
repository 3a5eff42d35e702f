//! The messages of `run` about the marks and recordings that it also writes.

use std::path::Path;

use pipeline::{Annotated, MarksWritten, NotAnnotated};

use crate::commands::print_message;
use crate::logging::LogFormat;

/// Reports how many files of marks there are now, and how many were left as they are.
pub fn print_marks(written: MarksWritten, folder: &Path, format: LogFormat) {
    let MarksWritten { files, corrected, of_other_run } = written;
    let place = folder.join("auto");
    if format == LogFormat::Json {
        tracing::info!(files, corrected, of_other_run, "marks of rims that were found, in {}", place.display());
        return;
    }
    print_message(&format!("marks of rims that were found: {files} files for LabelMe in {}\n", place.display()));
    if corrected > 0 {
        print_message(&format!(
            "{corrected} more hold what a person has made or corrected, and were left as they are\n  -> in the study's marks/ they \
             count, also with --marks auto\n"
        ));
    }
    if of_other_run > 0 {
        print_message(&format!(
            "{of_other_run} more hold the rims of another run, and were left as they are\n  -> give --write-marks another folder \
             for those of this run\n"
        ));
    }
}

/// Reports how many recordings for viewers there are now, and which sessions have none.
pub fn print_annotated(annotated: &Annotated, format: LogFormat) {
    let Annotated { folder, made, kept, failed } = annotated;
    if format == LogFormat::Json {
        for NotAnnotated { session, fact } in failed {
            tracing::warn!(session, "no annotated recording: {fact}");
        }
        tracing::info!(made, kept, failed = failed.len(), "annotated recordings, in {}", folder.display());
        return;
    }
    print_message(&format!("annotated recordings: {made} written, {kept} unchanged in {}\n", folder.display()));
    for NotAnnotated { session, fact } in failed {
        print_message(&format!("session '{session}' has none: {fact}\n"));
    }
}
