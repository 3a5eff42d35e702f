//! Circles fitted to marked points.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use nalgebra::storage::Owned;
use nalgebra::{DVector, Dyn, Matrix3, Matrix3x2, OMatrix, Point2, RowVector2, U3, Vector3};

/// A circle on a plane, in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    /// The centre.
    pub center_mm: Point2<f64>,
    /// The radius.
    pub radius_mm: f64,
}

/// A fitted circle with its derivatives by the points.
#[derive(Debug, Clone, PartialEq)]
pub struct CircleFit {
    /// The circle.
    pub circle: Circle,
    /// Derivatives of centre x, centre y and radius (rows) by x and y of each point (columns). They follow from the implicit
    /// function theorem on the normal equations, without terms in the residuals, and so hold for points near the circle.
    pub by_point: Vec<Matrix3x2<f64>>,
}

/// The reason why points do not give a circle.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CircleError {
    /// There are fewer than the three points that a circle needs.
    #[error("{0} points do not fix a circle; mark at least 3, better 8 or more, spread around the rim")]
    TooFewPoints(usize),
    /// The points lie on a line or on one spot.
    #[error("the points lie on a line or on one spot; spread them around the rim")]
    Degenerate,
    /// The points are the corners of a box whose sides are level and plumb in the picture, as tools draw one around a thing.
    #[error(
        "its 4 points are the corners of an upright box, which is drawn around a round edge and does not follow it; mark at least 6 \
         points along the edge"
    )]
    UprightBox,
    /// The points do not follow a circle.
    #[error(
        "the {points} points lie {misfit_px:.1} px (RMS) off the best circle, where marks and pose explain {expected_px:.1} px; if the \
         edge is round, correct the points, and keep other edges out of the outline"
    )]
    NotRound {
        /// The number of points.
        points: usize,
        /// RMS distance of the points from the circle, in px of the picture.
        misfit_px: f64,
        /// The RMS distance that the uncertainties of marks and pose would give.
        expected_px: f64,
    },
}

/// The least-squares circle through points on a plane.
///
/// `scatter_mm(point, direction)` is the standard deviation of a point along a unit direction, up to a common factor: on a
/// plane that is seen at a slant, an error of one pixel is larger far away and along the line of sight. An algebraic fit (Kasa
/// 1976) is the start of a geometric one, which minimises the radial distances in units of their scatter by
/// Levenberg-Marquardt.
///
/// # Errors
/// [`CircleError`] for fewer than three points, or for points on a line.
pub fn fit_circle(
    points_mm: &[Point2<f64>],
    scatter_mm: impl Fn(usize, nalgebra::Vector2<f64>) -> f64,
) -> Result<CircleFit, CircleError> {
    if points_mm.len() < 3 {
        return Err(CircleError::TooFewPoints(points_mm.len()));
    }
    let mut circle = algebraic_fit(points_mm)?;
    let mut by_point = Vec::new();
    // The scatter depends on the direction from the centre, so the second pass uses the first one's centre.
    for _ in 0..2 {
        let weights = points_mm.iter().enumerate().map(|(i, p)| {
            let direction = (p - circle.center_mm).try_normalize(0.0).unwrap_or_else(nalgebra::Vector2::x);
            scatter_mm(i, direction).max(f64::MIN_POSITIVE).recip()
        });
        let weights = DVector::from_iterator(points_mm.len(), weights);
        (circle, by_point) = geometric_fit(points_mm, weights, circle).ok_or(CircleError::Degenerate)?;
    }
    if circle.radius_mm > 0.0 && by_point.iter().flatten().all(|c: &f64| c.is_finite()) {
        Ok(CircleFit { circle, by_point })
    } else {
        Err(CircleError::Degenerate)
    }
}

/// The circle of Kasa's fit, which solves x^2 + y^2 = 2 a x + 2 b y + c in the least-squares sense, about the centroid.
pub(crate) fn algebraic_fit(points_mm: &[Point2<f64>]) -> Result<Circle, CircleError> {
    #[expect(clippy::cast_precision_loss, reason = "a count of marks is far below 2^53")]
    let n = points_mm.len() as f64;
    let centroid = points_mm.iter().fold(nalgebra::Vector2::zeros(), |sum, p| sum + p.coords) / n;
    let scale = points_mm.iter().map(|p| (p.coords - centroid).norm()).fold(0.0, f64::max);
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(CircleError::Degenerate);
    }
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for p in points_mm {
        let q = (p.coords - centroid) / scale;
        let row = Vector3::new(2.0 * q.x, 2.0 * q.y, 1.0);
        normal += row * row.transpose();
        right += row * q.norm_squared();
    }
    // For points on a line the normal matrix does not have full rank.
    let eigenvalues = normal.symmetric_eigenvalues();
    if eigenvalues.min() <= 1e-10 * eigenvalues.max() {
        return Err(CircleError::Degenerate);
    }
    let solution = normal.cholesky().ok_or(CircleError::Degenerate)?.solve(&right);
    let radius = (solution.z + solution.x.powi(2) + solution.y.powi(2)).sqrt();
    Ok(Circle { center_mm: Point2::from(centroid + solution.xy() * scale), radius_mm: radius * scale })
}

/// The circle that minimises the weighted radial distances, and its derivatives by the points; `None` where there is none.
fn geometric_fit(
    points_mm: &[Point2<f64>],
    weights: DVector<f64>,
    start: Circle,
) -> Option<(Circle, Vec<Matrix3x2<f64>>)> {
    let parameters = Vector3::new(start.center_mm.x, start.center_mm.y, start.radius_mm);
    let problem = RadialDistances { points_mm, weights, parameters };
    let (solved, report) = LevenbergMarquardt::new().minimize(problem);
    // A fit that cannot be improved within rounding counts; one that ran out of steps or of finite numbers does not.
    let settled = report.termination.was_successful()
        || matches!(report.termination, TerminationReason::NoImprovementPossible(_));
    let jacobian = solved.jacobian().filter(|_| settled)?;
    let inverse_normal = jacobian.tr_mul(&jacobian).try_inverse()?;
    // With n the unit vector from the centre to point i and w its weight, the residual of that point changes by w n with the
    // point, and row i of the Jacobian is -w (n, 1).
    let by_point = (0..points_mm.len()).map(|i| {
        let row = jacobian.row(i);
        inverse_normal * row.transpose() * RowVector2::new(row[0], row[1])
    });
    let p = solved.parameters;
    Some((Circle { center_mm: Point2::new(p.x, p.y), radius_mm: p.z }, by_point.collect()))
}

/// The least-squares problem whose residuals are the weighted distances of the points from the circle.
struct RadialDistances<'a> {
    points_mm: &'a [Point2<f64>],
    weights: DVector<f64>,
    /// Centre x, centre y and radius, in mm.
    parameters: Vector3<f64>,
}

impl LeastSquaresProblem<f64, Dyn, U3> for RadialDistances<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, U3>;
    type ParameterStorage = Owned<f64, U3>;

    fn set_params(&mut self, parameters: &Vector3<f64>) {
        self.parameters = *parameters;
    }

    fn params(&self) -> Vector3<f64> {
        self.parameters
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let (center, radius) = (self.parameters.xy(), self.parameters.z);
        let radial = |(p, w): (&Point2<f64>, &f64)| ((p.coords - center).norm() - radius) * w;
        let values = self.points_mm.iter().zip(self.weights.iter()).map(radial);
        Some(DVector::from_iterator(self.points_mm.len(), values))
    }

    fn jacobian(&self) -> Option<OMatrix<f64, Dyn, U3>> {
        let center = self.parameters.xy();
        let mut jacobian = OMatrix::<f64, Dyn, U3>::zeros(self.points_mm.len());
        for (i, (p, w)) in self.points_mm.iter().zip(self.weights.iter()).enumerate() {
            let direction = (p.coords - center).try_normalize(0.0)?;
            jacobian.set_row(i, &(nalgebra::RowVector3::new(-direction.x, -direction.y, -1.0) * *w));
        }
        Some(jacobian)
    }
}
