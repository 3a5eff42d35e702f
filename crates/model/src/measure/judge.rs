//! Judges whether marks fit each other, and what they are marks of, as well as their uncertainty allows.

use nalgebra::{Matrix3, Point2, RowVector3, Vector2, Vector3};

use super::MeasureError;
use super::place::MarkPlace;
use crate::circle::{Circle, algebraic_fit};
use crate::container::Method;
use crate::located::Located;
use crate::sensed::Sensed;
use crate::sigma::{InputSigma, Sensitivity};
use crate::source::{SOURCES, SourceCovariance};
use crate::view::View;

/// Marks of one size that differ by more than this many standard uncertainties of their difference contradict each other.
pub(super) const APART: f64 = 6.0;
/// An uncertainty of marks that no picture contradicts.
const ANYWHERE_PX: f64 = 1e6;
/// Nobody sets points more exactly than this, whatever `mark_px` says.
const LEAST_MARK_PX: f64 = 1.0;
/// Points whose RMS distance from their circle is this many times the expected one put the circle in doubt.
pub(super) const DOUBTED: f64 = 2.0;
/// With more than this there is no circle.
pub(super) const REFUSED: f64 = 4.0;
/// A single point further off than this many times the expected distance is a stray one.
const STRAY: f64 = 3.0;
/// The share of the points that must follow the circle.
const MOST: f64 = 0.8;
/// With fewer distinct points nothing shows whether they follow a circle.
pub(super) const FEWEST: usize = 6;
/// The number of points from which circles are tried.
const TRIED: usize = 20;

/// The uncertainties by which marks are judged.
#[derive(Debug, Clone)]
pub(crate) struct Judge {
    inputs: InputSigma,
    common: SourceCovariance,
}

/// Marks that were left out, since they contradict the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeftOut {
    /// The number of lines or outlines that were left out.
    pub marks: usize,
    /// The size by the one that is furthest off, in mm.
    pub furthest_mm: f64,
    /// That mark.
    pub furthest: MarkPlace,
}

/// The numbers of the sizes at both ends, where sizes contradict each other and none is in the majority.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Contradiction {
    pub smallest: usize,
    pub largest: usize,
}

impl Contradiction {
    /// The error of these sizes.
    pub(super) fn error(self, sizes: &[Sensed], place: impl Fn(usize) -> MarkPlace) -> MeasureError {
        let Self { smallest, largest } = self;
        MeasureError::MarksDisagree {
            marks: sizes.len(),
            smallest_mm: sizes[smallest].value,
            largest_mm: sizes[largest].value,
            smallest: place(smallest),
            largest: place(largest),
        }
    }
}

/// Points about a circle.
pub(super) struct Ring<'a> {
    pub located: &'a [Located],
    pub circle: Circle,
}

/// The distances of points from their circle, in px of the picture.
pub(super) struct Misfit {
    /// The RMS distance.
    pub rms_px: f64,
    /// The RMS distance that the uncertainties of marks and pose would give.
    pub expected_px: f64,
}

impl Misfit {
    pub(super) fn ratio(&self) -> f64 {
        self.rms_px / self.expected_px
    }
}

impl Judge {
    /// The judge by these uncertainties, and no less than the usual ones of the pose: a study that states its pose too surely must
    /// not refuse honest marks.
    pub(crate) fn new(inputs: &InputSigma) -> Self {
        let usual = InputSigma::default();
        let inputs = InputSigma {
            mark_px: inputs.mark_px.max(LEAST_MARK_PX),
            pitch_rad: inputs.pitch_rad.max(usual.pitch_rad),
            tilt_rad: inputs.tilt_rad.max(usual.tilt_rad),
            mount_rad: inputs.mount_rad.max(usual.mount_rad),
            ..*inputs
        };
        Self { inputs, common: inputs.common() }
    }

    /// The judge of a method's sizes. [`Method::Paper`] takes the roll as zero, so that the whole roll is an error of its pose.
    pub(crate) fn of_method(method: Method, view: &View, inputs: &InputSigma) -> Self {
        match method {
            Method::Paper => {
                let tilt_rad = inputs.tilt_rad.max(view.pose().roll_rad().abs());
                Self::new(&InputSigma { tilt_rad, ..*inputs })
            }
            Method::Ray | Method::Coaxial | Method::Joint | Method::Best => Self::new(inputs),
        }
    }

    /// A judge that takes all marks as they are, for views that are known to be wrong, as those of a calibration on its way are.
    pub(crate) fn trusting() -> Self {
        Self::new(&InputSigma { mark_px: ANYWHERE_PX, ..InputSigma::NONE })
    }

    /// The standard uncertainty of a number that was computed from marks.
    pub(super) fn sigma(&self, number: &Sensed) -> f64 {
        let by_source = number.by_source;
        let sensitivity = Sensitivity { by_source, marks_mm_per_px: number.by_mark.norm() };
        sensitivity.sigma(&self.inputs).total_mm
    }

    /// The numbers of the sizes that agree with the middle one, which are all of them as a rule. `leeway_mm` gives, for two numbers of
    /// sizes, by how much these may differ for other reasons than their marks.
    ///
    /// # Errors
    /// [`Contradiction`] where they are not the majority.
    pub(super) fn agreeing(
        &self,
        sizes: &[Sensed],
        leeway_mm: impl Fn(usize, usize) -> f64,
    ) -> Result<Vec<usize>, Contradiction> {
        let mut order: Vec<usize> = (0..sizes.len()).collect();
        order.sort_by(|a, b| sizes[*a].value.total_cmp(&sizes[*b].value));
        let (&[smallest, ..], &[.., largest]) = (order.as_slice(), order.as_slice()) else { return Ok(Vec::new()) };
        let middle = order[(order.len() - 1) / 2];
        let agrees = |i: usize| {
            let terms = [(1.0, &sizes[i]), (-1.0, &sizes[middle])];
            let apart = Sensed::of_numbers(sizes[i].value - sizes[middle].value, terms, sizes[i].points());
            i == middle || apart.value.abs() <= APART * self.sigma(&apart) + leeway_mm(i, middle)
        };
        let kept: Vec<usize> = (0..sizes.len()).filter(|i| agrees(*i)).collect();
        if 2 * kept.len() > sizes.len() { Ok(kept) } else { Err(Contradiction { smallest, largest }) }
    }

    /// The misfit of points from a circle that was fitted to them. A wrong pose makes an ellipse of a circle: the part of such
    /// errors that no circle takes up is expected as well.
    pub(super) fn misfit(&self, ring: &Ring<'_>) -> Misfit {
        let count = ring.located.len();
        let rows: Vec<RowVector3<f64>> = ring.rows().collect();
        let normal: Matrix3<f64> = rows.iter().map(|row| row.transpose() * row).sum();
        let inverse = normal.try_inverse().unwrap_or_else(Matrix3::zeros);
        // The radial shift of each point by each source, less what the three parameters of the circle take up of it.
        let shifts: Vec<_> =
            ring.radial().map(|(place, direction, scatter)| direction.tr_mul(&place.by_source) / scatter).collect();
        let taken_up = inverse
            * rows
                .iter()
                .zip(&shifts)
                .map(|(row, shift)| row.transpose() * shift)
                .sum::<nalgebra::SMatrix<f64, 3, SOURCES>>();
        let mut covariance = self.common;
        for (i, variance) in crate::sigma::NOISY.iter().zip(self.inputs.noise().iter()) {
            covariance[(i.index(), i.index())] += variance;
        }
        let by_pose: f64 = rows
            .iter()
            .zip(&shifts)
            .map(|(row, shift)| {
                let left = shift - row * taken_up;
                (left * covariance * left.transpose()).x
            })
            .sum();
        #[expect(clippy::cast_precision_loss, reason = "a count of marks is far below 2^53")]
        let (n, free) = (count as f64, count.saturating_sub(3).max(1) as f64);
        let rms_px = (ring.distances_px().map(|d| d * d).sum::<f64>() / n).sqrt();
        let expected_px = ((self.inputs.mark_px.powi(2) * free + by_pose.max(0.0)) / n).sqrt();
        Misfit { rms_px, expected_px }
    }

    /// The numbers of the points that follow one circle, where all but a few of them do; `None` where no circle has as many.
    pub(super) fn followers(&self, located: &[Located], expected_px: f64) -> Option<Vec<usize>> {
        let limit_px = STRAY * expected_px.max(self.inputs.mark_px);
        let count = located.len();
        let tried: Vec<usize> = (0..count.min(TRIED)).map(|i| i * count / count.min(TRIED)).collect();
        let mut best: Option<(usize, f64, Vec<usize>)> = None;
        for (a, i) in tried.iter().enumerate() {
            for (b, j) in tried.iter().enumerate().skip(a + 1) {
                for k in tried.iter().skip(b + 1) {
                    let three = [*i, *j, *k].map(|n| located[n].point_mm);
                    let Ok(circle) = algebraic_fit(&three) else { continue };
                    let distances: Vec<f64> = Ring { located, circle }.distances_px().map(f64::abs).collect();
                    let near: Vec<usize> = (0..count).filter(|n| distances[*n] <= limit_px).collect();
                    let sum: f64 = near.iter().map(|n| distances[*n]).sum();
                    let better = |(most, least, _): &(usize, f64, Vec<usize>)| (near.len(), -sum) > (*most, -*least);
                    if best.as_ref().is_none_or(better) {
                        best = Some((near.len(), sum, near));
                    }
                }
            }
        }
        let (_, _, near) = best?;
        #[expect(clippy::cast_precision_loss, reason = "a count of marks is far below 2^53")]
        let enough = near.len() >= FEWEST && near.len() as f64 >= MOST * count as f64;
        enough.then_some(near)
    }
}

impl<'a> Ring<'a> {
    /// Each point with its direction from the centre, and the length in mm that one pixel covers along it.
    fn radial(&self) -> impl Iterator<Item = (&'a Located, Vector2<f64>, f64)> {
        let center = self.circle.center_mm;
        self.located.iter().map(move |place| {
            let direction = (place.point_mm - center).try_normalize(0.0).unwrap_or_else(Vector2::x);
            (place, direction, place.by_pixel.tr_mul(&direction).norm().max(f64::MIN_POSITIVE))
        })
    }

    /// The signed distances of the points from the circle, in px.
    fn distances_px(&self) -> impl Iterator<Item = f64> {
        let Circle { center_mm, radius_mm } = self.circle;
        self.radial().map(move |(place, _, scatter)| ((place.point_mm - center_mm).norm() - radius_mm) / scatter)
    }

    /// The derivatives of these distances by centre and radius, but for their sign.
    fn rows(&self) -> impl Iterator<Item = RowVector3<f64>> {
        self.radial().map(|(_, direction, scatter)| Vector3::new(direction.x, direction.y, 1.0).transpose() / scatter)
    }
}

/// The number of points that are not the same as an earlier one.
pub(super) fn distinct(points_px: impl Iterator<Item = Point2<f64>>) -> usize {
    let mut all: Vec<[u64; 2]> = points_px.map(|p| [p.x.to_bits(), p.y.to_bits()]).collect();
    all.sort_unstable();
    all.dedup();
    all.len()
}
