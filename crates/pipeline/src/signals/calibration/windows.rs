//! Still windows in a stream of samples.

use ingest::Sample;
use model::UtcNs;
use nalgebra::Vector3;

use super::GravityCalibration;
use super::sphere::Points;
use super::stats::AxisStats;

/// Length of a window (van Hees et al. 2014).
const WINDOW_S: f64 = 10.0;
/// A window in which each axis has a smaller SD is still (van Hees et al. 2014: 13 mg).
const MAX_SD_G: f64 = 0.013;
/// Means beyond this are clipped samples (GGIR).
const MAX_MEAN_G: f64 = 2.0;
/// A longer step ends a window: nothing is known of what happened in it.
const GAP_S: f64 = 0.5;
/// Fewer samples in a window do not tell an SD.
const MIN_SAMPLES: u32 = 50;

/// Collects still windows from samples in the order of time: constant work and no allocation for each sample, one point for
/// each still window.
#[derive(Debug, Default)]
pub(in crate::signals) struct StillWindows {
    /// The times of the first and the last sample of the open window.
    open: Option<(UtcNs, UtcNs)>,
    stats: AxisStats,
    points: Points,
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
        self.open = Some((start, time));
    }

    /// Ends a window of full length.
    fn close(&mut self) {
        let (mean, sd) = (self.stats.mean(), self.stats.sd());
        // A comparison with NaN is false: such a window is not still.
        let still = sd.iter().all(|sd| *sd < MAX_SD_G) && mean.iter().all(|mean| mean.abs() < MAX_MEAN_G);
        if still && self.stats.n() >= MIN_SAMPLES {
            self.points.push(&mean);
        }
        self.open = None;
    }

    /// The calibration by the windows so far. The last window, which is not full, is left out.
    pub(in crate::signals) fn calibration(&self) -> GravityCalibration {
        GravityCalibration::from_points(&self.points)
    }
}
