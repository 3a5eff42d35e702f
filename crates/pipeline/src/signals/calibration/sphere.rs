//! Points that should lie on the unit sphere, and the offsets and scales that bring them there.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Vector3;

use super::AxisCalibration;

/// Means of still windows, merged where they are nearly equal, so that memory does not grow with nights on a shelf.
#[derive(Debug, Default)]
pub(super) struct Points {
    /// The number of windows and the sum of their means, by cell of 1/[`CELLS_PER_G`] g.
    cells: BTreeMap<[i16; 3], (u32, Vector3<f64>)>,
}

/// Merging windows inside a cell moves their mean off a sphere by less than 16 mg squared / 8 g: 0.03 mg.
const CELLS_PER_G: f64 = 64.0;
/// Cells of an eighth of g count as one direction each.
const CELLS_PER_DIRECTION: i16 = 8;

impl Points {
    #[expect(clippy::cast_possible_truncation, reason = "a window's mean is below 2 g")]
    pub(super) fn push(&mut self, mean_g: &Vector3<f64>) {
        let cell = [mean_g.x, mean_g.y, mean_g.z].map(|c| (c * CELLS_PER_G).floor() as i16);
        let (windows, sum) = self.cells.entry(cell).or_default();
        *windows += 1;
        *sum += mean_g;
    }

    pub(super) fn windows(&self) -> u64 {
        self.cells.values().map(|(windows, _)| u64::from(*windows)).sum()
    }

    pub(super) fn directions(&self) -> usize {
        let coarse: BTreeSet<[i16; 3]> =
            self.cells.keys().map(|cell| cell.map(|c| c.div_euclid(CELLS_PER_DIRECTION))).collect();
        coarse.len()
    }

    /// The smallest and the largest component of each axis; zeros without a point.
    pub(super) fn reach(&self) -> (Vector3<f64>, Vector3<f64>) {
        let mut means = self.means().map(|(_, mean)| mean);
        let Some(first) = means.next() else { return (Vector3::zeros(), Vector3::zeros()) };
        means.fold((first, first), |(least, most), mean| (least.inf(&mean), most.sup(&mean)))
    }

    /// The mean departure of the length from 1 g after `calibration`, over windows.
    pub(super) fn error_mg(&self, calibration: &AxisCalibration) -> Option<f64> {
        let (mut windows, mut sum) = (0.0, 0.0);
        for (weight, mean) in self.means() {
            windows += weight;
            sum += weight * (calibration.apply(&mean).norm() - 1.0).abs();
        }
        (windows > 0.0).then(|| 1000.0 * sum / windows)
    }

    #[cfg(test)]
    pub(super) fn cells(&self) -> usize {
        self.cells.len()
    }

    /// The number of windows and their mean, by cell.
    fn means(&self) -> impl Iterator<Item = (f64, Vector3<f64>)> {
        self.cells.values().map(|(windows, sum)| (f64::from(*windows), sum / f64::from(*windows)))
    }
}

const MAX_ROUNDS: usize = 2000;
/// The fit has settled when a round changes the calibrated points by less than this (RMS).
const SETTLED_G: f64 = 1e-8;
/// Residuals below this do not weigh more (GGIR).
const SMALLEST_RESIDUAL_G: f64 = 0.01;

/// The closest-point fit after van Hees et al. 2014. Every calibrated point is paired with the point of the unit sphere
/// nearest to it, each axis is regressed on its pair (a line: offset and scale), and that is repeated until nothing moves.
/// Points that stay far from the sphere count less, by 1 over their residual.
pub(super) fn fit(points: &Points) -> AxisCalibration {
    let means: Vec<(f64, Vector3<f64>)> = points.means().collect();
    let mut calibration = AxisCalibration::NONE;
    let mut weights: Vec<f64> = means.iter().map(|(windows, _)| *windows).collect();
    for _ in 0..MAX_ROUNDS {
        let calibrated: Vec<Vector3<f64>> = means.iter().map(|(_, mean)| calibration.apply(mean)).collect();
        let on_sphere: Vec<Vector3<f64>> = calibrated.iter().map(Vector3::normalize).collect();
        for axis in 0..3 {
            let pairs = means.iter().zip(&on_sphere).map(|((_, mean), target)| (mean[axis], target[axis]));
            let Some((intercept, slope)) = line(pairs.zip(&weights)) else { return calibration };
            calibration.scale[axis] = slope;
            calibration.offset_g[axis] = intercept / slope;
        }
        let (mut moved, mut total) = (0.0, 0.0);
        for (((windows, mean), before), (target, weight)) in
            means.iter().zip(&calibrated).zip(on_sphere.iter().zip(&mut weights))
        {
            let after = calibration.apply(mean);
            moved += windows * (after - before).norm_squared();
            total += windows;
            *weight = windows / (after - target).norm().max(SMALLEST_RESIDUAL_G);
        }
        if (moved / total).sqrt() < SETTLED_G {
            break;
        }
    }
    calibration
}

/// Intercept and slope by weighted least squares. None where all x are equal, or the slope is no scale.
fn line<'a>(pairs: impl Iterator<Item = ((f64, f64), &'a f64)> + Clone) -> Option<(f64, f64)> {
    let (mut mass, mut sum_x, mut sum_y) = (0.0, 0.0, 0.0);
    for ((x, y), w) in pairs.clone() {
        mass += w;
        sum_x += w * x;
        sum_y += w * y;
    }
    let (mean_x, mean_y) = (sum_x / mass, sum_y / mass);
    let (mut xx, mut xy) = (0.0, 0.0);
    for ((x, y), w) in pairs {
        xx += w * (x - mean_x).powi(2);
        xy += w * (x - mean_x) * (y - mean_y);
    }
    let slope = xy / xx;
    (slope.is_finite() && slope > 0.0).then_some((mean_y - slope * mean_x, slope))
}
