//! Takes the pictures for the page of a report from the work folder of the run that gave the results.

use model::GallerySink;
use pipeline::{GalleryError, GalleryHalted, GalleryOptions, NotShown, Reporter};

use super::print_message;
use crate::exit::Failure;

/// Number of missing pictures that are listed. More are only counted.
const LISTED: usize = 5;

/// Hands all pictures of the sessions to `sink`, and returns whether some could not be shown. Where there is no work folder,
/// the report has no pictures, and a message says so.
pub fn gallery_into<S: GallerySink>(
    options: &GalleryOptions<'_>,
    progress: &dyn Reporter,
    sink: &mut S,
) -> Result<bool, Failure> {
    match pipeline::gallery(options, progress, sink) {
        Ok(made) => {
            print_message(&not_shown(&made.not_shown));
            Ok(!made.not_shown.is_empty())
        }
        Err(GalleryError::Halted(error @ GalleryHalted::NoWork(_))) => {
            print_message(&format!("no pictures in the report: {error}\n  -> give --work, or run the study again\n"));
            Ok(false)
        }
        Err(GalleryError::Halted(error @ GalleryHalted::Stopped { signal })) => {
            Err(Failure::Stopped(signal, error.into()))
        }
        Err(error) => Err(Failure::Failed(error.into())),
    }
}

fn not_shown(all: &[NotShown]) -> String {
    let place =
        |not: &NotShown| not.image.as_ref().map_or(not.session.clone(), |image| format!("{}/{image}", not.session));
    let listed = all.iter().take(LISTED).map(|not| format!("no picture of {}: {}\n", place(not), not.fact));
    let more = all.len().saturating_sub(LISTED);
    listed.chain((more > 0).then(|| format!("and {more} more\n"))).collect()
}
