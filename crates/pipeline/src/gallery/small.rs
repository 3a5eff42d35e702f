//! The picture as the camera took it, made small.

use ingest::Picture;
use model::{View, resampled_px};

use super::carried_marks::{MarkedPicture, carried};
use crate::session::ShownImage;

/// The longer side of a picture as it is shown.
pub(super) const SIDE_PX: u32 = 640;
/// The quality of its JPEG file: about 40 kB.
pub(super) const QUALITY: u8 = 75;

/// The small picture with its marks; `view` is that of the whole picture. None where nothing is left of a side.
pub(super) fn reduce(picture: Picture, view: &View, shown: &ShownImage) -> Option<MarkedPicture> {
    let picture = picture.reduced(SIDE_PX);
    let size_px = [picture.width_px, picture.height_px];
    let whole_px = view.camera().size_px();
    let marks = carried(shown, |point| Some(resampled_px(point, whole_px, size_px)));
    (!size_px.contains(&0)).then_some(MarkedPicture { picture, marks })
}
