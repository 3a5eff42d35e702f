//! Numbers that carry their derivatives.

use nalgebra::{DVector, Matrix1x2, Vector2};

use crate::located::Located;
use crate::source::PerSource;

/// A number that was computed from marks and pose, with its derivatives by the sources and by every marked coordinate of the
/// object. Each formula gives its value and its partial derivatives; the chain rule is applied here.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sensed {
    pub value: f64,
    /// Derivatives by the sources.
    pub by_source: PerSource,
    /// Derivatives by x and y of the first marked point, then of the second, and so on.
    pub by_mark: DVector<f64>,
}

impl Sensed {
    /// A number without error.
    pub(crate) fn exact(value: f64, points: usize) -> Self {
        Self { value, by_source: PerSource::zeros(), by_mark: DVector::zeros(2 * points) }
    }

    /// A number that depends on the sources but not on the marks.
    pub(crate) fn of_sources(value: f64, by_source: PerSource, points: usize) -> Self {
        Self { value, by_source, by_mark: DVector::zeros(2 * points) }
    }

    /// `value`, which was computed from other numbers. Each term is the derivative by a number, and that number.
    pub(crate) fn of_numbers<'a>(value: f64, terms: impl IntoIterator<Item = (f64, &'a Self)>, points: usize) -> Self {
        let mut sum = Self::exact(value, points);
        for (derivative, term) in terms {
            sum.by_source += term.by_source * derivative;
            sum.by_mark.axpy(derivative, &term.by_mark, 1.0);
        }
        sum
    }

    /// `value`, which was computed from places on a plane. Each term is the number of a marked point, its place, and the
    /// derivative by that place. `plane_z` is the height of the plane, which may have been measured as well.
    pub(crate) fn of_places<'a>(
        value: f64,
        terms: impl IntoIterator<Item = (usize, &'a Located, Vector2<f64>)>,
        plane_z: &Self,
    ) -> Self {
        let mut by_plane_z = 0.0;
        let mut sum = Self::exact(value, plane_z.points());
        for (mark, place, derivative) in terms {
            let derivative: Matrix1x2<f64> = derivative.transpose();
            sum.by_source += (derivative * place.by_source).transpose();
            let by_pixel = derivative * place.by_pixel;
            sum.by_mark[2 * mark] += by_pixel.x;
            sum.by_mark[2 * mark + 1] += by_pixel.y;
            by_plane_z += derivative.tr_dot(&place.by_plane_z);
        }
        sum.by_source += plane_z.by_source * by_plane_z;
        sum.by_mark.axpy(by_plane_z, &plane_z.by_mark, 1.0);
        sum
    }

    /// The number of marked points of the object.
    pub(crate) fn points(&self) -> usize {
        self.by_mark.len() / 2
    }

    /// The mean of several numbers; `None` when there are none.
    pub(crate) fn mean(numbers: &[Self]) -> Option<Self> {
        let points = numbers.first()?.points();
        #[expect(clippy::cast_precision_loss, reason = "a count of marks is far below 2^53")]
        let share = 1.0 / numbers.len() as f64;
        let value = numbers.iter().map(|n| n.value).sum::<f64>() * share;
        Some(Self::of_numbers(value, numbers.iter().map(|n| (share, n)), points))
    }
}
