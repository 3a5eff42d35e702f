//! What is said of images that cannot be used.

use model::{FrameReason, Problem};

use crate::card::{Place, amount};
use crate::summary::DroppedImage;

/// One problem per reason, at the first image that has it, with count and bytes.
pub(super) fn problems(dropped: &[DroppedImage], place: &Place) -> Vec<Problem> {
    let of_reason = |reason: &FrameReason| {
        let images: Vec<&DroppedImage> = dropped.iter().filter(|image| image.reason == *reason).collect();
        let first = images.first()?;
        let lost = amount(images.len(), "image", images.iter().map(|image| image.bytes).sum());
        let this = if images.len() == 1 { "" } else { "first: " };
        let fact = format!("{lost} cannot be used; {this}{}", first.detail);
        Some(place.problem(reason.problem_code()?, &first.file, fact, remedy(*reason)))
    };
    FrameReason::ALL.iter().filter_map(of_reason).collect()
}

fn remedy(reason: FrameReason) -> &'static str {
    match reason {
        FrameReason::WrongSize => "give the camera that took these pictures: camera in study.toml or session.toml",
        FrameReason::NoTime => "correct images.time in the device profile, or the file's name",
        FrameReason::TimesDisagree => {
            "find out which is right and take images.time from that one alone, or widen its tolerance_s"
        }
        FrameReason::DamagedImage => {
            "copy the file from the card again; if it stays so, the picture is lost: check the card for bad blocks"
        }
        _ => "copy the file from the card again; if it stays so, the image is lost",
    }
}
