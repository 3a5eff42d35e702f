//! Still windows in a stream of samples.

use ingest::Sample;
use model::UtcNs;
use nalgebra::Vector3;

use super::GravityCalibration;
use super::rails::Rails;
use super::sphere::Points;
use super::stats::AxisStats;

/// Length of a window (van Hees et al. 2014).
const WINDOW_S: f64 = 10.0;
/// A window in which each axis has a smaller SD is still (van Hees et al. 2014: 13 mg).
const MAX_SD_G: f64 = 0.013;
/// A longer step ends a window: nothing is known of what happened in it.
const GAP_S: f64 = 0.5;
/// Fewer samples in a window do not tell an SD.
const MIN_SAMPLES: u32 = 50;

/// A still window: the mean and the SD of each axis, g.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    pub mean: Vector3<f64>,
    pub sd: Vector3<f64>,
}

/// Collects still windows from samples in the order of time: constant work for each sample, 48 bytes for each still window (0.4 MB a day).
#[derive(Debug, Default)]
pub(in crate::signals) struct StillWindows {
    /// The times of the first and the last sample of the open window.
    open: Option<(UtcNs, UtcNs)>,
    stats: AxisStats,
    /// The smallest and the largest sample of each axis so far.
    extremes: Option<(Vector3<f64>, Vector3<f64>)>,
    windows: Vec<Window>,
}

impl StillWindows {
    /// Takes the next sample of the session; those of other sensors are passed over.
    pub(in crate::signals) fn push_sample(&mut self, sample: &Sample) {
        if let Sample::Acceleration { time, g } = sample {
            self.push(*time, &Vector3::from(*g));
        }
    }

    /// Takes the next sample, in g.
    pub(in crate::signals) fn push(&mut self, time: UtcNs, value_g: &Vector3<f64>) {
        if let Some((start, last)) = self.open {
            if time.seconds_since(last) > GAP_S {
                self.open = None;
            } else if time.seconds_since(start) >= WINDOW_S {
                self.close();
            }
        }
        let start = match self.open {
            Some((start, _)) => start,
            None => {
                self.stats = AxisStats::default();
                time
            }
        };
        self.stats.push(value_g);
        let (least, most) = self.extremes.unwrap_or((*value_g, *value_g));
        self.extremes = Some((least.inf(value_g), most.sup(value_g)));
        self.open = Some((start, time));
    }

    /// Ends a window of full length.
    fn close(&mut self) {
        let (mean, sd) = (self.stats.mean(), self.stats.sd());
        // A comparison with NaN is false: such a window is not still.
        let still = sd.iter().all(|sd| *sd < MAX_SD_G) && mean.iter().all(|mean| mean.is_finite());
        if still && self.stats.n() >= MIN_SAMPLES {
            self.windows.push(Window { mean, sd });
        }
        self.open = None;
    }

    /// The calibration by the windows so far. The last window, which is not full, is left out, and so are those in which an axis stands at
    /// the sensor's rail.
    pub(in crate::signals) fn calibration(&self) -> GravityCalibration {
        let rails = Rails::new(&self.windows, self.extremes.unwrap_or_default());
        let (mut points, mut at_rail) = (Points::default(), 0);
        for window in &self.windows {
            match rails.hold(window) {
                true => at_rail += 1,
                false => points.push(&window.mean),
            }
        }
        GravityCalibration::from_points(&points, at_rail)
    }
}
