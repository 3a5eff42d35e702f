//! Oddities of the images that were used: one note per oddity and session.

use model::{Orientation, Problem, ProblemCode};

use crate::card::{Place, Remarks, amount, size};
use crate::summary::ImageEntry;

/// Oddities of a session's images.
#[derive(Debug, Default)]
pub(super) struct ImageTally {
    bytes_after: Tally,
    stray_bytes: Tally,
    wrong_extension: Tally,
    one_time: Tally,
    turned: Tally,
}

/// The images with one oddity.
#[derive(Debug, Default)]
struct Tally {
    images: usize,
    bytes: u64,
    first: String,
}

impl Tally {
    fn add(&mut self, file: &str, bytes: u64) {
        if self.images == 0 {
            file.clone_into(&mut self.first);
        }
        self.images += 1;
        self.bytes += bytes;
    }
}

impl ImageTally {
    /// Counts an image that was used.
    pub fn add(&mut self, image: &ImageEntry, remarks: Remarks) {
        let (file, bytes) = (image.file.as_str(), image.bytes);
        if image.orientation != Orientation::Upright {
            self.turned.add(file, bytes);
        }
        if remarks.bytes_after > 0 {
            self.bytes_after.add(file, remarks.bytes_after);
        }
        if remarks.stray_bytes > 0 {
            self.stray_bytes.add(file, remarks.stray_bytes);
        }
        if remarks.has_wrong_extension {
            self.wrong_extension.add(file, bytes);
        }
        if remarks.has_one_time {
            self.one_time.add(file, bytes);
        }
    }

    /// The notes, each at the first image that it is about.
    pub fn notes(&self, place: &Place) -> Vec<Problem> {
        let Self { bytes_after, stray_bytes, wrong_extension, one_time, turned } = self;
        let after = format!(
            "{} behind the end marker of {} image{}, which are used; the bytes are kept as they are",
            size(bytes_after.bytes),
            bytes_after.images,
            if bytes_after.images == 1 { "" } else { "s" }
        );
        let after_remedy = "look at the picture: a device may write its own data there, a damaged card garbage";
        let stray = format!(
            "{} before markers of {} JPEG image{}, which are used; decoders pass over them",
            size(stray_bytes.bytes),
            stray_bytes.images,
            if stray_bytes.images == 1 { "" } else { "s" }
        );
        let stray_remedy = "look at the picture: a camera may write so, a damaged card as well";
        let extension = format!(
            "the extension is that of another encoding: {}, read as what the first bytes say",
            amount(wrong_extension.images, "image", wrong_extension.bytes)
        );
        let one = format!(
            "only the name or only EXIF gives the time of {}, so nothing checks it",
            amount(one_time.images, "image", one_time.bytes)
        );
        let one_remedy = "declare images.time from the one that all images have, if that is how the device writes them";
        let turn = format!(
            "EXIF tells viewers to turn or mirror {}; they are measured as they are stored, and marks are carried over",
            amount(turned.images, "image", turned.bytes)
        );
        let turn_remedy = "if marks are refused for it, say in which frame they are ([marks] frame in study.toml)";
        [
            (ProblemCode::TurnedImages, turned, turn, turn_remedy),
            (ProblemCode::BytesAfterImage, bytes_after, after, after_remedy),
            (ProblemCode::StrayBytesInImage, stray_bytes, stray, stray_remedy),
            (ProblemCode::WrongExtension, wrong_extension, extension, "rename them if another program must read them"),
            (ProblemCode::TimeFromOneSource, one_time, one, one_remedy),
        ]
        .into_iter()
        .filter(|(_, tally, ..)| tally.images > 0)
        .map(|(code, tally, fact, remedy)| place.note(code, &tally.first, fact, remedy))
        .collect()
    }
}
