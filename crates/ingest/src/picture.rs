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

/// Why there is no JPEG file.
#[derive(Debug, thiserror::Error)]
#[error("a picture of {width_px} x {height_px} px cannot be encoded as JPEG: {source}")]
pub struct JpegError {
    width_px: u32,
    height_px: u32,
    source: jpeg_encoder::EncodingError,
}

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

    /// The picture made smaller, until neither side exceeds `max_px` (at least 1); one that is small enough stays as it is.
    /// Every pixel is the mean of those that it stands for.
    #[must_use]
    pub fn reduced(self, max_px: u32) -> Self {
        let size_px = fitting([self.width_px, self.height_px], max_px.max(1));
        if size_px == [self.width_px, self.height_px] {
            return self;
        }
        let Some(whole) = image::RgbImage::from_raw(self.width_px, self.height_px, self.rgb) else {
            return Self { width_px: 0, height_px: 0, rgb: Vec::new() }; // bytes that do not fill width and height
        };
        let small = image::imageops::thumbnail(&whole, size_px[0], size_px[1]);
        Self { width_px: size_px[0], height_px: size_px[1], rgb: small.into_raw() }
    }

    /// The picture as the bytes of a JPEG file, with colours at half the resolution. `quality`: 1 to 100.
    ///
    /// # Errors
    /// [`JpegError`] when there is nothing to write, or a side exceeds 65535 pixels.
    pub fn to_jpeg(&self, quality: u8) -> Result<Vec<u8>, JpegError> {
        let mut bytes = Vec::new();
        let mut encoder = jpeg_encoder::Encoder::new(&mut bytes, quality.clamp(1, 100));
        encoder.set_sampling_factor(jpeg_encoder::SamplingFactor::F_2_2);
        // Standard Huffman tables and one scan: with optimised tables this encoder writes a scan per channel, which zune-jpeg
        // 0.5.15 decodes wrongly when the chroma is subsampled.
        // A side that does not fit is no size, and refused.
        let [width, height] = [self.width_px, self.height_px].map(|side| u16::try_from(side).unwrap_or(0));
        match encoder.encode(&self.rgb, width, height, jpeg_encoder::ColorType::Rgb) {
            Ok(()) => Ok(bytes),
            Err(source) => Err(JpegError { width_px: self.width_px, height_px: self.height_px, source }),
        }
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

/// Width and height as large as fits; no side is nothing.
fn fitting(size_px: [u32; 2], max_px: u32) -> [u32; 2] {
    let longest = size_px[0].max(size_px[1]);
    if longest <= max_px {
        return size_px;
    }
    let half_up = |side: u32| (2 * u64::from(side) * u64::from(max_px) + u64::from(longest)) / (2 * u64::from(longest));
    size_px.map(|side| u32::try_from(half_up(side)).unwrap_or(max_px).max(1))
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
    fn a_reduced_picture_has_its_shape_and_its_colours() {
        let rgb = (0..200 * 100).flat_map(|i| if i % 200 < 100 { [200, 20, 40] } else { [10, 30, 220] }).collect();
        let picture = Picture { width_px: 200, height_px: 100, rgb };
        assert_eq!(picture.clone().reduced(200), picture);
        let small = picture.reduced(50);
        assert_eq!((small.width_px, small.height_px), (50, 25));
        assert_eq!((&small.rgb[..3], &small.rgb[small.rgb.len() - 3..]), (&[200, 20, 40][..], &[10, 30, 220][..]));
        let again = Picture::decode(&small.to_jpeg(90).unwrap()).unwrap();
        assert_eq!((again.width_px, again.height_px), (50, 25));
        let off = |at: usize| small.rgb[at].abs_diff(again.rgb[at]);
        assert!((0..3).chain(72..75).all(|at| off(at) < 12), "JPEG changes little");
        assert_eq!(fitting([10_000, 3], 100), [100, 1]);
    }

    #[test]
    fn what_is_no_picture_is_no_jpeg() {
        let none = Picture { width_px: 0, height_px: 0, rgb: Vec::new() };
        assert!(none.to_jpeg(75).is_err());
        let too_wide = Picture { width_px: 70_000, height_px: 1, rgb: vec![0; 3 * 70_000] };
        assert!(too_wide.to_jpeg(75).unwrap_err().to_string().contains("70000 x 1 px"));
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        assert!(Picture::decode(b"not a picture").is_err());
        assert!(Picture::decode(&[]).is_err());
    }
}
