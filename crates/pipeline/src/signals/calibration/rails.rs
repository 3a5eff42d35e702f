//! The rails of an accelerometer: the readings at which it, or its converter, stands still whatever it feels.

use nalgebra::Vector3;

use super::windows::Window;
use super::{MAX_OFFSET_G, MAX_SCALE_CHANGE};

/// A rail that the data show is beyond this: at rest on its side, a sensor with a usual offset reads less.
const LEAST_RAIL_G: f64 = 1.2;
/// A window stands at the session's extreme when its mean is so near to it.
const AT_EXTREME_G: f64 = 0.005;
/// An axis at a rail has less noise than this part of the median over all windows.
const QUIET_PART: f64 = 0.1;
/// Below this SD an axis has no noise at all.
const NO_NOISE_G: f64 = 1e-6;
/// One window at an extreme may be chance.
const REPEATED: usize = 2;

/// Where an axis is no measurement. A reading at rest beyond [`Self::most_at_rest_g`] is none of a sensor that the calibration could accept;
/// below that, a rail shows as an extreme of the session that windows repeat without noise.
#[derive(Debug)]
pub(super) struct Rails {
    extremes: (Vector3<f64>, Vector3<f64>),
    /// Axes with less noise than this are quiet.
    quiet_g: Vector3<f64>,
    /// The axes that at least [`REPEATED`] windows have at an extreme.
    repeated: [bool; 3],
}

impl Rails {
    /// The rails of a session with these still windows, whose samples lie between these extremes.
    pub fn new(windows: &[Window], extremes: (Vector3<f64>, Vector3<f64>)) -> Self {
        let median_sd = |axis: usize| model::median(windows.iter().map(|window| window.sd[axis]).collect());
        let quiet_g = match windows {
            [] => Vector3::zeros(),
            _ => Vector3::from_fn(|axis, _| (QUIET_PART * median_sd(axis)).max(NO_NOISE_G)),
        };
        let mut rails = Self { extremes, quiet_g, repeated: [false; 3] };
        rails.repeated =
            [0, 1, 2].map(|axis| windows.iter().filter(|window| rails.is_at_extreme(window, axis)).count() >= REPEATED);
        rails
    }

    /// Whether an axis of the window stands at a rail.
    pub fn hold(&self, window: &Window) -> bool {
        (0..3).any(|axis| {
            window.mean[axis].abs() > Self::most_at_rest_g()
                || (self.repeated[axis] && self.is_at_extreme(window, axis))
        })
    }

    /// The largest reading at rest of a sensor whose offset and scale the calibration accepts: 1.55 g.
    fn most_at_rest_g() -> f64 {
        1.0 / (1.0 - MAX_SCALE_CHANGE) + MAX_OFFSET_G
    }

    fn is_at_extreme(&self, window: &Window, axis: usize) -> bool {
        let (mean, sd) = (window.mean[axis], window.sd[axis]);
        let (least, most) = (self.extremes.0[axis], self.extremes.1[axis]);
        let is_near = (mean - least).abs() < AT_EXTREME_G || (mean - most).abs() < AT_EXTREME_G;
        is_near && mean.abs() > LEAST_RAIL_G && sd < self.quiet_g[axis]
    }
}
