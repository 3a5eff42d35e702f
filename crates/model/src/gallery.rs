//! Pictures that show where sizes come from: pipeline makes them, and report shows them.

use crate::marks::Feature;

/// A view of a picture: the way in which it is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PictureView {
    /// As the camera took it.
    Camera,
    /// With the lens corrected, so that straight lines are straight (Fig. 9 of the paper).
    Corrected,
    /// Projected on the table plane Z = 0, with a grid in mm (Fig. 10 of the paper).
    Plane,
}

/// A mark in a picture that is shown.
#[derive(Debug, Clone, PartialEq)]
pub struct GalleryMark {
    /// Name of the object.
    pub object: String,
    /// Name of the rater who made the mark.
    pub rater: String,
    /// The feature of the object that it outlines.
    pub feature: Feature,
    /// Whether the last point is joined to the first.
    pub closed: bool,
    /// The points of the mark, in pixels of the picture as it is shown.
    pub points_px: Vec<[f64; 2]>,
}

/// A picture for people to look at, with the marks on it.
#[derive(Debug, Clone, PartialEq)]
pub struct GalleryPicture {
    /// Name of the session.
    pub session: String,
    /// File of the image, relative to the card, as in the results.
    pub image: String,
    /// The way in which the picture is shown.
    pub view: PictureView,
    /// Width and height of the picture as it is shown.
    pub size_px: [u32; 2],
    /// The picture, as a JPEG file.
    pub jpeg: Vec<u8>,
    /// The marks on the picture.
    pub marks: Vec<GalleryMark>,
}

/// A sink for the pictures of a study: it takes them session by session in the order of their names, within a session by image
/// and then by view.
pub trait GallerySink {
    /// The reason why a picture could not be taken.
    type Error: std::error::Error + Send + Sync + 'static;

    /// Takes one picture.
    ///
    /// # Errors
    /// When the picture cannot be stored.
    fn picture(&mut self, picture: GalleryPicture) -> Result<(), Self::Error>;
}
