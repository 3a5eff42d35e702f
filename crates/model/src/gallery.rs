//! Pictures that show where sizes come from: pipeline makes them, report shows them.

use crate::marks::Feature;

/// How a picture is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PictureView {
    /// As the camera took it.
    Camera,
    /// With the lens corrected: straight lines are straight (Fig. 9 of the paper).
    Corrected,
    /// Projected on the table plane Z = 0, with a grid in mm (Fig. 10 of the paper).
    Plane,
}

/// A mark as it lies in a picture that is shown.
#[derive(Debug, Clone, PartialEq)]
pub struct GalleryMark {
    /// Name of the object.
    pub object: String,
    /// Who marked.
    pub rater: String,
    /// What of the object it shows.
    pub feature: Feature,
    /// Whether the last point joins the first.
    pub closed: bool,
    /// Its points, in pixels of the picture as shown.
    pub points_px: Vec<[f64; 2]>,
}

/// A picture made to be looked at, with the marks on it.
#[derive(Debug, Clone, PartialEq)]
pub struct GalleryPicture {
    /// Name of the session.
    pub session: String,
    /// File of the image, relative to the card, as in the results.
    pub image: String,
    /// How it is shown.
    pub view: PictureView,
    /// Width and height as shown.
    pub size_px: [u32; 2],
    /// The picture, as a JPEG file.
    pub jpeg: Vec<u8>,
    /// What was marked in it.
    pub marks: Vec<GalleryMark>,
}

/// Takes the pictures of a study, session by session in the order of their names, in a session by image, then by view.
pub trait GallerySink {
    /// Why a picture could not be taken.
    type Error: std::error::Error + Send + Sync + 'static;

    /// Takes a picture.
    ///
    /// # Errors
    /// When it cannot be stored.
    fn picture(&mut self, picture: GalleryPicture) -> Result<(), Self::Error>;
}
