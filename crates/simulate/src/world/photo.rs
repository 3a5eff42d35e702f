//! Photographs of a world: rays through a lens, blur, vignetting, exposure and noise.

use model::Camera;
use nalgebra::{Matrix3, Point2, Point3, Vector2, Vector3};
use rayon::prelude::*;

use super::chance::{mixed, normal, share};
use super::light::Sight;
use super::{Rgb, World};
use crate::render::Picture;
use crate::scene::Ray;

/// Number of sub-pixels along each side of a pixel that shows one surface, which is all lit or all unlit.
const PLAIN: u32 = 2;
/// Number of sub-pixels along each side of any other pixel.
const EDGE: u32 = 5;

/// Place and orientation of the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Its place.
    pub origin_mm: Point3<f64>,
    /// The rotation that takes directions in the camera frame to the world frame.
    pub world_from_camera: Matrix3<f64>,
}

/// The properties of the camera that turn light into levels of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exposure {
    /// Level of a white surface in full light as a share of the highest level, before the tone curve.
    pub gain: f64,
    /// Gains of red, green and blue (the white balance).
    pub balance: Rgb,
    /// Share of the light that is lost in the corners.
    pub vignetting: f64,
    /// Motion of the picture while it is taken, in pixels.
    pub motion_px: Vector2<f64>,
    /// SD of the lens's blur, in pixels.
    pub blur_px: f64,
    /// SD of the noise of a black pixel, as a share of the highest level.
    pub read_noise: f64,
    /// Number of electrons that fill a pixel. Its shot noise is the square root of the number that it holds.
    pub full_well: f64,
}

/// The picture of a world. The same seed gives the same bytes, for any number of threads.
#[must_use]
pub fn photograph(world: &World, camera: &Camera, station: &Station, exposure: &Exposure, seed: u64) -> Picture {
    let [width_px, height_px] = camera.size_px();
    let shot = Shot { world, camera, station, seed };
    let light: Vec<[f32; 3]> = (0..height_px)
        .into_par_iter()
        .flat_map_iter(|y| (0..width_px).map(move |x| (x, y)))
        .map(|(x, y)| shot.pixel(x, y).map(narrow))
        .collect();
    let light = blurred(light, width_px as usize, exposure);
    let noise = mixed(seed ^ 0xB10C);
    let mut rgb = vec![0; 3 * light.len()];
    rgb.par_chunks_mut(3 * width_px as usize).zip(light.par_chunks(width_px as usize)).zip(0..height_px).for_each(
        |((row, light), y)| {
            for ((bytes, light), x) in row.chunks_exact_mut(3).zip(light).zip(0..width_px) {
                let own = noise.wrapping_add((u64::from(y) << 32) | u64::from(x));
                bytes.copy_from_slice(&exposure.developed(*light, camera, [x, y], own));
            }
        },
    );
    Picture { width_px, height_px, rgb }
}

struct Shot<'a> {
    world: &'a World,
    camera: &'a Camera,
    station: &'a Station,
    seed: u64,
}

impl Shot<'_> {
    /// The mean light of a pixel.
    fn pixel(&self, x: u32, y: u32) -> Rgb {
        let at = Point2::new(f64::from(x), f64::from(y));
        let Ok((ray, by_pixel)) = self.camera.ray_and_derivative(at) else {
            return [0.0; 3];
        };
        let own = mixed(self.seed ^ (u64::from(y) << 32 | u64::from(x)));
        let sight = |sub: u32, side: u32| {
            let lot = own.wrapping_add(u64::from(side << 8 | sub) << 20);
            let jitter = |place: u32, salt: u64| (f64::from(place) + share(lot ^ salt)) / f64::from(side);
            let offset = Vector2::new(jitter(sub % side, 1), jitter(sub / side, 2)).add_scalar(-0.5);
            // The parts of the lamp come in another order than the parts of the pixel, so that the two are not correlated.
            let part = (sub * 7 + 3) % (side * side);
            let direction = self.station.world_from_camera * (ray + by_pixel * offset);
            let ray = Ray { origin: self.station.origin_mm, direction };
            self.world.sight(&ray, [jitter(part % side, 3), jitter(part / side, 4)])
        };
        let few: [Sight; (PLAIN * PLAIN) as usize] = std::array::from_fn(|sub| sight(narrow_index(sub), PLAIN));
        let is_plain = few.iter().all(|s| s.met == few[0].met && s.is_lit == few[0].is_lit);
        if is_plain { mean(few.into_iter()) } else { mean((0..EDGE * EDGE).map(|sub| sight(sub, EDGE))) }
    }
}

fn mean(sights: impl ExactSizeIterator<Item = Sight>) -> Rgb {
    #[expect(clippy::cast_precision_loss, reason = "a handful of sub-pixels")]
    let number = sights.len() as f64;
    // A highlight fills its own sub-pixel only, since no sensor counts beyond twice the highest level.
    let sum = sights.fold([0.0; 3], |sum: Rgb, s| std::array::from_fn(|i| sum[i] + s.light[i].min(2.0)));
    sum.map(|c| c / number)
}

#[expect(clippy::cast_possible_truncation, reason = "light of a picture needs no more than 24 bits")]
fn narrow(light: f64) -> f32 {
    light as f32
}

#[expect(clippy::cast_possible_truncation, reason = "a handful of sub-pixels")]
fn narrow_index(sub: usize) -> u32 {
    sub as u32
}

/// The light after motion along a line, and then the blur of the lens (a Gaussian, in one direction after the other).
fn blurred(mut light: Vec<[f32; 3]>, width: usize, exposure: &Exposure) -> Vec<[f32; 3]> {
    let motion = exposure.motion_px;
    let half = (0.5 * motion.norm()).ceil();
    if motion.norm() > 0.3 {
        let steps = (-half * 2.0) as i32..=(half * 2.0) as i32;
        let along = |step: i32| motion * (f64::from(step) / (4.0 * half));
        light = spread(&light, width, &steps.map(|step| (along(step), 1.0)).collect::<Vec<_>>());
    }
    if exposure.blur_px > 0.1 {
        let reach = (3.0 * exposure.blur_px).ceil() as i32;
        let weight = |step: i32| (-0.5 * (f64::from(step) / exposure.blur_px).powi(2)).exp();
        for axis in [Vector2::x(), Vector2::y()] {
            let taps: Vec<_> = (-reach..=reach).map(|step| (axis * f64::from(step), weight(step))).collect();
            light = spread(&light, width, &taps);
        }
    }
    light
}

/// The weighted mean of the light at some offsets. Between pixels it is interpolated from their neighbours (bilinear).
fn spread(light: &[[f32; 3]], width: usize, taps: &[(Vector2<f64>, f64)]) -> Vec<[f32; 3]> {
    let height = light.len() / width.max(1);
    let total: f64 = taps.iter().map(|(_, weight)| weight).sum();
    let at = |x: f64, y: f64| {
        let column = x.clamp(0.0, (width - 1) as f64) as usize;
        light[y.clamp(0.0, (height - 1) as f64) as usize * width + column]
    };
    let corners = |x: f64, y: f64| {
        let (u, v) = (x - x.floor(), y - y.floor());
        [
            (x, y, (1.0 - u) * (1.0 - v)),
            (x + 1.0, y, u * (1.0 - v)),
            (x, y + 1.0, (1.0 - u) * v),
            (x + 1.0, y + 1.0, u * v),
        ]
    };
    (0..light.len())
        .into_par_iter()
        .map(|i| {
            let mut sum = [0.0; 3];
            for (offset, weight) in taps {
                for (x, y, part) in corners((i % width) as f64 + offset.x, (i / width) as f64 + offset.y) {
                    if part > 0.0 {
                        let c = at(x.floor(), y.floor());
                        sum = std::array::from_fn(|k| sum[k] + weight * part * f64::from(c[k]));
                    }
                }
            }
            sum.map(|c: f64| narrow(c / total))
        })
        .collect()
}

impl Exposure {
    /// The levels of a pixel with this light, after vignetting, gain, noise and tone curve.
    fn developed(&self, light: [f32; 3], camera: &Camera, [x, y]: [u32; 2], seed: u64) -> [u8; 3] {
        let [width, height] = camera.size_px().map(f64::from);
        let off = Vector2::new(f64::from(x), f64::from(y)) - Vector2::from(camera.principal_px());
        let corner = off.norm_squared() / (0.25 * (width * width + height * height));
        let kept = 1.0 - self.vignetting * corner.min(1.5) * (1.2 - 0.2 * corner.min(1.5));
        std::array::from_fn(|i| {
            let level = f64::from(light[i]) * self.gain * self.balance[i] * kept;
            let sd = (level.max(0.0) / self.full_well + self.read_noise * self.read_noise).sqrt();
            to_byte(toned(level + sd * normal(seed.wrapping_mul(3).wrapping_add(i as u64))))
        })
    }
}

/// The tone curve, which is that of sRGB with a soft shoulder below white.
fn toned(level: f64) -> f64 {
    let level = level.max(0.0);
    let level = if level > 0.7 { 0.7 + 0.3 * (1.0 - (-(level - 0.7) / 0.3).exp()) } else { level };
    if level <= 0.003_130_8 { 12.92 * level } else { 1.055 * level.powf(1.0 / 2.4) - 0.055 }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 0..=255")]
fn to_byte(level: f64) -> u8 {
    (255.0 * level).round().clamp(0.0, 255.0) as u8
}

impl Station {
    /// The station of a camera at a pose of `model`, moved to a place and turned about Z (from X to Y, in radians).
    #[must_use]
    pub fn new(pose: &model::Pose, at_mm: Point2<f64>, turn_rad: f64) -> Self {
        let turn = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), turn_rad);
        Self {
            origin_mm: Point3::new(at_mm.x, at_mm.y, pose.camera_height_mm()),
            world_from_camera: turn.matrix() * pose.world_from_camera(),
        }
    }
}
