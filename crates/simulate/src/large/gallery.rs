//! The pictures of one container, which are drawn once from a few poses, and then taken again and again in other light.

use model::{Camera, Pose, View};
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

use super::objects::Object;
use crate::error::SimulateError;
use crate::render::{Picture, Renderer};
use crate::sensors::HeadPose;
use crate::study::LabeledLine;

/// Number of poses of each container within 5 degrees of 55. There are as many outside the target window of 55 +- 7.5 degrees.
pub(super) const NEAR_POSES: usize = 4;
const NEAR_PITCH_DEG: (f64, f64) = (50.0, 60.0);
const FAR_PITCHES_DEG: [(f64, f64); 2] = [(37.0, 46.0), (64.0, 73.0)];
const ROLL_DEG: (f64, f64) = (-4.0, 4.0);
const CAMERA_HEIGHT_MM: (f64, f64) = (360.0, 480.0);

/// Range of the exposure, as a factor of the light.
const EXPOSURE: (f64, f64) = (0.85, 1.08);
/// Range of the gain of each colour, as a factor of the exposure.
const WHITE_BALANCE: (f64, f64) = (0.97, 1.03);

/// SD of a pixel's noise, in levels.
const NOISE_LEVELS: f64 = 1.5;
/// Number of values before the noise repeats. It is prime, so that the noise does not line up with the rows of a picture.
const NOISE_VALUES: usize = 65_537;

/// A container as it is seen from one pose.
#[derive(Debug, Clone)]
pub(super) struct Sight {
    pub head: HeadPose,
    pub picture: Picture,
    pub marks: Vec<LabeledLine>,
}

/// The sights of one container. The first [`NEAR_POSES`] of them lie near the target pitch.
#[derive(Debug, Clone)]
pub(super) struct Gallery {
    pub sights: Vec<Sight>,
}

impl Gallery {
    pub(super) fn draw(
        object: &Object,
        camera: &Camera,
        renderer: &Renderer,
        random: &mut ChaCha8Rng,
    ) -> Result<Self, SimulateError> {
        let far = FAR_PITCHES_DEG.into_iter().cycle().take(NEAR_POSES);
        let bands = std::iter::repeat_n(NEAR_PITCH_DEG, NEAR_POSES).chain(far);
        let sights = bands
            .map(|band_deg| sight(object, camera, renderer, head_pose(random, band_deg)))
            .collect::<Result<_, _>>()?;
        Ok(Self { sights })
    }
}

/// A random pose in round numbers: pitch and roll in hundredths of a degree, and the range in whole mm.
fn head_pose(random: &mut ChaCha8Rng, (from_deg, to_deg): (f64, f64)) -> HeadPose {
    let hundredths = |value: f64| (value * 100.0).round() / 100.0;
    let pitch_deg = hundredths(random.random_range(from_deg..to_deg));
    let roll_deg = hundredths(random.random_range(ROLL_DEG.0..ROLL_DEG.1));
    let camera_height_mm = random.random_range(CAMERA_HEIGHT_MM.0..CAMERA_HEIGHT_MM.1);
    HeadPose { pitch_deg, roll_deg, range_mm: (camera_height_mm / pitch_deg.to_radians().sin()).round() }
}

fn sight(object: &Object, camera: &Camera, renderer: &Renderer, head: HeadPose) -> Result<Sight, SimulateError> {
    let place = || format!("{} at {} degrees", object.name, head.pitch_deg);
    let pose = Pose::new(head.pitch_deg.to_radians(), head.roll_deg.to_radians(), head.range_mm)
        .map_err(|source| SimulateError::Pose { place: place(), source })?;
    let view = View::new(*camera, pose);
    let marks = object.marks(&view).map_err(|source| SimulateError::View { place: place(), source })?;
    let [width, height] = camera.size_px().map(f64::from);
    let is_outside = |end: &nalgebra::Point2<f64>| !(0.0..width).contains(&end.x) || !(0.0..height).contains(&end.y);
    if let Some(end) = marks.iter().flat_map(|line| line.ends_px).find(is_outside) {
        return Err(SimulateError::OutsidePicture { place: place(), x: end.x, y: end.y });
    }
    Ok(Sight { head, picture: renderer.render(&object.scene(&view), &pose), marks })
}

/// The noise that all pictures of a study share. Each picture begins at another place of it.
#[derive(Debug, Clone)]
pub(super) struct Noise {
    levels: Vec<i16>,
}

impl Noise {
    pub(super) fn new(random: &mut ChaCha8Rng) -> Self {
        #[expect(clippy::cast_possible_truncation, reason = "a few levels")]
        let level = |_| (NOISE_LEVELS * random.sample::<f64, _>(StandardNormal)).round() as i16;
        Self { levels: (0..NOISE_VALUES).map(level).collect() }
    }

    /// The picture in other light and with other noise.
    pub(super) fn taken_anew(&self, picture: &Picture, random: &mut ChaCha8Rng) -> Picture {
        let exposure = random.random_range(EXPOSURE.0..EXPOSURE.1);
        let gains: [f64; 3] = std::array::from_fn(|_| exposure * random.random_range(WHITE_BALANCE.0..WHITE_BALANCE.1));
        let curves = gains.map(curve);
        let offset = random.random_range(0..self.levels.len());
        let mut noise = self.levels.iter().cycle().skip(offset);
        let mut rgb = Vec::with_capacity(picture.rgb.len());
        for pixel in picture.rgb.chunks_exact(3) {
            let levels = pixel.iter().zip(&curves).zip(&mut noise);
            rgb.extend(levels.map(|((level, curve), noise)| to_byte(curve[usize::from(*level)] + noise)));
        }
        Picture { rgb, ..*picture }
    }
}

/// For each level, the level that it becomes when the light is `gain` times as strong.
#[expect(clippy::cast_possible_truncation, reason = "at most some hundred")]
fn curve(gain: f64) -> Vec<i16> {
    (0..=u8::MAX).map(|level| (f64::from(level) * gain).round() as i16).collect()
}

#[expect(clippy::cast_sign_loss, reason = "clamped to 0..=255")]
fn to_byte(level: i16) -> u8 {
    level.clamp(0, 255) as u8
}
