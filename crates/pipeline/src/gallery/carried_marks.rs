//! Carries marks from one picture to another.

use ingest::Picture;
use model::{GalleryMark, resampled_px};

use crate::session::{ShownImage, ShownMark, ShownObject};

/// A picture with the marks in its own pixels.
pub(super) struct MarkedPicture {
    pub picture: Picture,
    pub marks: Vec<GalleryMark>,
}

/// The marks with their points where `place` puts them. A mark with a point that has no place is left out.
pub(super) fn carried(shown: &ShownImage, place: impl Fn([f64; 2]) -> Option<[f64; 2]>) -> Vec<GalleryMark> {
    let hundredths = |point: [f64; 2]| point.map(|c| (c * 100.0).round() / 100.0);
    let of_object = |object: &ShownObject| {
        let marks = object.marks.iter().filter_map(|mark| {
            let points_px =
                mark.points_px.iter().map(|point| place(*point).map(hundredths)).collect::<Option<Vec<_>>>()?;
            Some(GalleryMark {
                object: object.object.clone(),
                rater: object.rater.clone(),
                feature: mark.feature,
                closed: mark.closed,
                points_px,
            })
        });
        marks.collect::<Vec<_>>()
    };
    shown.objects.iter().flat_map(of_object).collect()
}

/// The marks in a picture that was resampled.
pub(super) fn resampled(shown: &ShownImage, from_px: [u32; 2], to_px: [u32; 2]) -> ShownImage {
    let mut resampled = shown.clone();
    let marks: fn(&mut ShownObject) -> &mut Vec<ShownMark> = |object| &mut object.marks;
    for point in resampled.objects.iter_mut().flat_map(marks).flat_map(|mark| &mut mark.points_px) {
        *point = resampled_px(*point, from_px, to_px);
    }
    resampled
}
