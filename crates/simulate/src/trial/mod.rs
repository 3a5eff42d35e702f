//! A bench without pictures: containers of known size, measured through sensors, cameras and raters that err.
//!
//! Each session has a device with errors of its own, an object, and a few images of it. The projection is exact geometry, and
//! the readings have the errors that `[uncertainty]` states. So this tests the mathematics of sizes and their uncertainties:
//! whether intervals hold the truth, which method is better, and whether the best one is chosen. It says nothing about whether
//! the stated uncertainties are those of a real device.

mod device;
mod measured;
mod scene;
mod score;

use model::{InputSigma, Method, ObjectMarks, Pose, Quantity, View};
use nalgebra::Point2;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use device::Device;
use measured::measure;
pub use scene::Subject;
use scene::Thing;
pub use score::{Level, Line, Score, score};

/// The settings of a trial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Seed of all randomness.
    pub seed: u64,
    /// Number of sessions per subject. Each has an object and a device of its own.
    pub sessions: u32,
    /// Number of images per session.
    pub images: u32,
    /// Standard uncertainties of devices, signals and marks. Errors are drawn with them, and the measurement knows them.
    pub sigma: InputSigma,
}

impl Default for Options {
    fn default() -> Self {
        Self { seed: 1, sessions: 1000, images: 4, sigma: InputSigma::default() }
    }
}

/// A measured size with its truth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trial {
    /// The container that was measured.
    pub subject: Subject,
    /// The quantity that was measured.
    pub quantity: Quantity,
    /// The method.
    pub method: Method,
    /// Whether the size comes from one image or from all of the session.
    pub level: Level,
    /// The true size.
    pub true_mm: f64,
    /// The measured size.
    pub predicted_mm: f64,
    /// Its stated standard uncertainty.
    pub sigma_mm: f64,
    /// Whether the method claims that its assumptions hold.
    pub claims: bool,
}

/// The sizes of a trial. The same options give the same sizes.
#[must_use]
pub fn run(options: &Options) -> Vec<Trial> {
    let sessions: Vec<(Subject, u32)> =
        Subject::ALL.iter().flat_map(|subject| (0..options.sessions).map(|i| (*subject, i))).collect();
    sessions.into_par_iter().enumerate().flat_map_iter(|(n, (subject, _))| session(options, subject, n)).collect()
}

/// An image as it is measured.
struct Image {
    view: View,
    marks: ObjectMarks,
}

/// The range of pitch in which images are taken: half of the range that the paper's bench and wearers span.
const PITCH_DEG: std::ops::Range<f64> = 40.0..70.0;
const ROLL_DEG: std::ops::Range<f64> = -10.0..10.0;
const CAMERA_HEIGHT_MM: std::ops::Range<f64> = 250.0..500.0;
/// How far the container stands from the point where the camera looks, in mm along X and Y.
const OFF_AXIS_MM: std::ops::Range<f64> = -30.0..30.0;
/// How often a scene that does not fit into the picture is drawn anew at most.
const ATTEMPTS: usize = 200;

fn session(options: &Options, subject: Subject, number: usize) -> Vec<Trial> {
    let mut random = ChaCha8Rng::seed_from_u64(options.seed);
    random.set_stream(number as u64);
    for _ in 0..ATTEMPTS {
        let camera_height_mm = random.random_range(CAMERA_HEIGHT_MM);
        let thing = Thing::draw(&mut random, subject, camera_height_mm);
        let Some(device) = Device::draw(&mut random, &options.sigma) else { continue };
        let images: Vec<Image> = (0..options.images)
            .filter_map(|_| (0..ATTEMPTS).find_map(|_| image(&mut random, &device, &thing, camera_height_mm)))
            .collect();
        if images.len() == options.images as usize {
            return measure(&thing, &images, &options.sigma);
        }
    }
    Vec::new()
}

fn image(random: &mut ChaCha8Rng, device: &Device, thing: &Thing, camera_height_mm: f64) -> Option<Image> {
    let pitch_rad = random.random_range(PITCH_DEG).to_radians();
    let roll_rad = random.random_range(ROLL_DEG).to_radians();
    let pose = Pose::new(pitch_rad, roll_rad, camera_height_mm / pitch_rad.sin()).ok()?;
    let center_mm = Point2::new(
        random.random_range(OFF_AXIS_MM),
        pose.range_mm() * pitch_rad.cos() + random.random_range(OFF_AXIS_MM),
    );
    let seen = thing.seen(pose, center_mm)?;
    let pixels = device.marked(random, pose, &seen)?;
    Some(Image { view: device.read(random, pose)?, marks: seen.marks(&pixels) })
}
