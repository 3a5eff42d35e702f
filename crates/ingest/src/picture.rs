//! Whole pictures in colour, for those who look for things in them.

use std::io::Cursor;

use image::{DynamicImage, ImageReader, Limits};

/// A picture: red, green and blue bytes, row by row from the top left.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Width.
    pub width_px: u32,
    /// Height.
    pub height_px: u32,
    /// The bytes, three per pixel.
    pub rgb: Vec<u8>,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
#[error("the picture cannot be decoded: {0}")]
pub struct PictureError(#[from] image::ImageError);

/// Decoding may take as much memory as this: a picture of 100 million pixels.
const MAX_BYTES: u64 = 512 << 20;
/// Wider and higher pictures are refused.
const MAX_SIDE_PX: u32 = 1 << 15;

/// Decodes within the limits.
pub(crate) fn decode(bytes: &[u8]) -> Result<DynamicImage, PictureError> {
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(image::ImageError::from)?;
    let mut limits = Limits::default();
    limits.max_alloc = Some(MAX_BYTES);
    limits.max_image_width = Some(MAX_SIDE_PX);
    limits.max_image_height = Some(MAX_SIDE_PX);
    reader.limits(limits);
    Ok(reader.decode()?)
}

impl Picture {
    /// Decodes a JPEG or PNG picture.
    ///
    /// # Errors
    /// [`PictureError`] when the bytes are no picture, are damaged, or the picture is too large.
    pub fn decode(bytes: &[u8]) -> Result<Self, PictureError> {
        let rgb = decode(bytes)?.into_rgb8();
        Ok(Self { width_px: rgb.width(), height_px: rgb.height(), rgb: rgb.into_raw() })
    }

    /// The picture as the bytes of a PNG file.
    ///
    /// # Errors
    /// [`PictureError`] when there is nothing to write (no pixels).
    ///
    /// # Panics
    /// When the bytes do not fill width and height.
    pub fn to_png(&self) -> Result<Vec<u8>, PictureError> {
        let mut bytes = Vec::new();
        let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
        image::ImageEncoder::write_image(
            encoder,
            &self.rgb,
            self.width_px,
            self.height_px,
            image::ExtendedColorType::Rgb8,
        )?;
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;

    #[test]
    fn a_picture_survives_its_way_through_a_file() {
        let rgb = (0..3 * 20 * 10).map(|i| (i % 256) as u8).collect();
        let picture = Picture { width_px: 20, height_px: 10, rgb };
        assert_eq!(Picture::decode(&picture.to_png().unwrap()).unwrap(), picture);
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        assert!(Picture::decode(b"not a picture").is_err());
        assert!(Picture::decode(&[]).is_err());
    }
}
