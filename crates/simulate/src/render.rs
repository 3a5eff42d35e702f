//! Renders pictures of a scene by a camera at a pose.

use jpeg_encoder::{ColorType, Encoder, SamplingFactor};
use model::{Camera, Pose};
use nalgebra::{Matrix3, Point2, Point3, Vector3};
use rayon::prelude::*;

use crate::error::SimulateError;
use crate::scene::{Colour, Part, Ray, Scene};

/// Quality of the JPEG pictures, from 1 to 100.
pub(crate) const JPEG_QUALITY: u8 = 75;

/// Number of sub-pixels along each side of a pixel that shows an edge.
const EDGE_SUBPIXELS: u32 = 3;

/// A renderer of pictures by one camera. It computes the ray of every pixel once, since the inverse of a lens costs more than
/// all the rest.
pub struct Renderer {
    camera: Camera,
    /// Rays in the camera frame, row by row; none where the lens shows nothing.
    rays: Vec<Option<Vector3<f32>>>,
}

/// A picture of red, green and blue bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Width in pixels.
    pub width_px: u32,
    /// Height in pixels.
    pub height_px: u32,
    /// The bytes: red, green and blue of each pixel, row by row.
    pub rgb: Vec<u8>,
}

impl Renderer {
    /// A renderer for `camera`, which holds about 16 bytes per pixel.
    #[must_use]
    pub fn new(camera: Camera) -> Self {
        let [width, height] = camera.size_px();
        let rays = (0..height)
            .into_par_iter()
            .flat_map_iter(|y| (0..width).map(move |x| (x, y)))
            .map(|(x, y)| {
                let ray = camera.ray_through(Point2::new(f64::from(x), f64::from(y))).ok()?;
                Some(ray.cast::<f32>())
            })
            .collect();
        Self { camera, rays }
    }

    /// The picture of `scene` from `pose`, with one ray per pixel, and more where a pixel shows an edge between two parts.
    #[must_use]
    pub fn render(&self, scene: &Scene, pose: &Pose) -> Picture {
        let [width_px, height_px] = self.camera.size_px();
        let shot = Shot {
            camera: &self.camera,
            scene,
            origin: Point3::new(0.0, 0.0, pose.camera_height_mm()),
            world_from_camera: pose.world_from_camera(),
        };
        let seen: Vec<(Part, Colour)> =
            self.rays.par_iter().map(|ray| shot.seen_along(ray.map(|ray| ray.cast::<f64>()))).collect();
        let width = width_px as usize;
        let mut rgb = vec![0; 3 * seen.len()];
        rgb.par_chunks_mut(3 * width).zip(0..height_px).for_each(|(row, y)| {
            for (pixel, x) in row.chunks_exact_mut(3).zip(0..width_px) {
                let at = y as usize * width + x as usize;
                let colour = if is_edge(&seen, width, at) { shot.supersampled(x, y) } else { seen[at].1 };
                pixel.copy_from_slice(&colour.map(to_byte));
            }
        });
        Picture { width_px, height_px, rgb }
    }
}

/// A picture that is being taken.
struct Shot<'a> {
    camera: &'a Camera,
    scene: &'a Scene,
    origin: Point3<f64>,
    world_from_camera: Matrix3<f64>,
}

impl Shot<'_> {
    fn seen_along(&self, in_camera: Option<Vector3<f64>>) -> (Part, Colour) {
        in_camera.map_or((Part::Nothing, [0.0; 3]), |in_camera| {
            let direction = self.world_from_camera * in_camera;
            self.scene.seen_along(&Ray { origin: self.origin, direction })
        })
    }

    /// The mean colour over a grid of sub-pixels.
    #[expect(clippy::cast_precision_loss, reason = "a handful of sub-pixels")]
    fn supersampled(&self, x: u32, y: u32) -> Colour {
        let offsets = (0..EDGE_SUBPIXELS).map(|i| (f64::from(i) + 0.5) / f64::from(EDGE_SUBPIXELS) - 0.5);
        let mut sum = [0.0; 3];
        for dy in offsets.clone() {
            for dx in offsets.clone() {
                let pixel = Point2::new(f64::from(x) + dx, f64::from(y) + dy);
                let (_, colour) = self.seen_along(self.camera.ray_through(pixel).ok());
                sum = [sum[0] + colour[0], sum[1] + colour[1], sum[2] + colour[2]];
            }
        }
        sum.map(|c| c / (EDGE_SUBPIXELS * EDGE_SUBPIXELS) as f32)
    }
}

/// Whether a pixel and one of its four neighbours show different parts. (Pixels at the left and right border are compared
/// with the end of the neighbouring row, which costs a few samples and does no harm.)
fn is_edge(seen: &[(Part, Colour)], width: usize, at: usize) -> bool {
    let part = seen[at].0;
    [at.checked_sub(1), at.checked_add(1), at.checked_sub(width), at.checked_add(width)]
        .into_iter()
        .flatten()
        .filter_map(|neighbour| seen.get(neighbour))
        .any(|(other, _)| *other != part)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 0..=255")]
fn to_byte(level: f32) -> u8 {
    level.round().clamp(0.0, 255.0) as u8
}

impl Picture {
    /// The picture as JPEG of quality 75 with 4:2:0 chroma. `place` names it in errors.
    ///
    /// # Errors
    /// [`SimulateError::TooLarge`] and [`SimulateError::Jpeg`].
    pub fn to_jpeg(&self, place: &str) -> Result<Vec<u8>, SimulateError> {
        self.to_jpeg_of_quality(place, JPEG_QUALITY)
    }

    /// The picture as JPEG of a quality from 1 to 100, as [`Picture::to_jpeg`] makes it.
    ///
    /// # Errors
    /// [`SimulateError::TooLarge`] and [`SimulateError::Jpeg`].
    pub fn to_jpeg_of_quality(&self, place: &str, quality: u8) -> Result<Vec<u8>, SimulateError> {
        let (Ok(width), Ok(height)) = (u16::try_from(self.width_px), u16::try_from(self.height_px)) else {
            let (width_px, height_px) = (self.width_px, self.height_px);
            return Err(SimulateError::TooLarge { place: place.to_owned(), width_px, height_px });
        };
        let mut bytes = Vec::new();
        // The file is baseline with the standard Huffman tables and one scan, as cameras write it. With optimised tables this encoder
        // writes a scan per channel, which zune-jpeg 0.5.15 decodes wrongly when the chroma is subsampled.
        let mut encoder = Encoder::new(&mut bytes, quality);
        encoder.set_sampling_factor(SamplingFactor::F_2_2);
        encoder
            .encode(&self.rgb, width, height, ColorType::Rgb)
            .map_err(|source| SimulateError::Jpeg { place: place.to_owned(), source })?;
        Ok(bytes)
    }
}
