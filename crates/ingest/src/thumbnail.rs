//! Small grey pictures, for those who compare pictures and need no detail.

use crate::picture::{self, PictureError};

/// A small grey picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Thumbnail {
    /// Width.
    pub width_px: u32,
    /// Height.
    pub height_px: u32,
    /// Brightness, row by row from the top left.
    pub grey: Vec<u8>,
}

/// Decodes a JPEG or PNG picture and shrinks it until neither side exceeds `max_px` (at least 1). A smaller picture is
/// enlarged, so that all pictures of one shape come out in one size.
///
/// # Errors
/// [`PictureError`] when the bytes are no picture, are damaged, or the picture is too large.
pub fn thumbnail(bytes: &[u8], max_px: u32) -> Result<Thumbnail, PictureError> {
    let grey = picture::decode(bytes)?.thumbnail(max_px.max(1), max_px.max(1)).to_luma8();
    Ok(Thumbnail { width_px: grey.width(), height_px: grey.height(), grey: grey.into_raw() })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use std::io::Cursor;

    use super::*;

    fn png(width: u32, height: u32, grey: impl Fn(u32, u32) -> u8) -> Vec<u8> {
        let picture = image::GrayImage::from_fn(width, height, |x, y| image::Luma([grey(x, y)]));
        let mut bytes = Vec::new();
        picture.write_to(&mut Cursor::new(&mut bytes), image::ImageFormat::Png).unwrap();
        bytes
    }

    #[test]
    fn shape_and_brightness_stay() {
        let found = thumbnail(&png(640, 480, |_, y| if y < 240 { 200 } else { 40 }), 32).unwrap();
        assert_eq!((found.width_px, found.height_px, found.grey.len()), (32, 24, 32 * 24));
        assert!(found.grey[..32 * 11].iter().all(|g| *g == 200) && found.grey[32 * 13..].iter().all(|g| *g == 40));
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        let whole = png(64, 64, |x, y| (x * y) as u8);
        assert!(thumbnail(&whole, 8).is_ok());
        assert!(thumbnail(&whole[..whole.len() / 2], 8).is_err());
        assert!(thumbnail(b"not a picture", 8).is_err());
        assert!(thumbnail(&[], 8).is_err());
    }
}
