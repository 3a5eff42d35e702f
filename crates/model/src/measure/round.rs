//! Circles on level planes with their derivatives, and the heights that two of them give.

use nalgebra::{Point2, Vector2};

use super::MeasureError;
use super::height::height_from_distances;
use super::judge::{DOUBTED, FEWEST, Judge, Misfit, REFUSED, Ring, distinct};
use super::numbered::Numbered;
use crate::circle::{CircleError, CircleFit, fit_circle};
use crate::doubt::Doubt;
use crate::located::Located;
use crate::marks::Feature;
use crate::sensed::Sensed;
use crate::view::View;

/// A circle that was fitted to marks on a plane, with its derivatives.
pub(super) struct Round {
    /// World X and Y of the centre, in mm.
    pub center: [Sensed; 2],
    /// The radius, in mm.
    pub radius: Sensed,
    /// The number of points that lie far off the others' circle, and were left out.
    pub strays: usize,
    /// Whether the points show that they follow a circle.
    pub doubt: Option<Doubt>,
}

/// The sides of a box that a tool drew are level and plumb to this, coordinates being rounded. Nobody clicks as exactly.
const UPRIGHT_PX: f64 = 1.0;

/// Whether points are the four corners of an upright box, in order; the first may stand again at the end.
fn is_upright_box(points_px: &[(usize, Point2<f64>)]) -> bool {
    let corners: Vec<Point2<f64>> = match points_px {
        [first, .., last] if points_px.len() == 5 && first.1 == last.1 => points_px[..4].iter().map(|p| p.1).collect(),
        [_, _, _, _] => points_px.iter().map(|p| p.1).collect(),
        _ => return false,
    };
    let is_side = |i: usize, axis: usize| (corners[i] - corners[(i + 1) % 4])[axis].abs() <= UPRIGHT_PX;
    [0, 1].into_iter().any(|axis| (0..4).all(|i| is_side(i, if i % 2 == 0 { axis } else { 1 - axis })))
}

impl Round {
    /// The circle through points that were marked along a level edge. Each is weighted by the length that one pixel covers at
    /// its place. A few points that lie far off the circle of the others are left out.
    ///
    /// # Errors
    /// [`MeasureError`] where a point has no place on the plane, and where the points do not fix or follow a circle.
    pub(super) fn through(
        view: &View,
        feature: Feature,
        points_px: &[(usize, Point2<f64>)],
        plane_z: &Sensed,
        judge: &Judge,
    ) -> Result<Self, MeasureError> {
        let located: Vec<Located> = points_px
            .iter()
            .map(|(_, pixel)| Located::on_plane(view, *pixel, plane_z.value))
            .collect::<Result<_, _>>()?;
        let marks: Vec<usize> = points_px.iter().map(|(mark, _)| *mark).collect();
        let no_circle = |source| MeasureError::Circle { feature, source };
        if is_upright_box(points_px) {
            return Err(no_circle(CircleError::UprightBox));
        }
        let fit = fit_located(&located).map_err(no_circle)?;
        let misfit = judge.misfit(&Ring { located: &located, circle: fit.circle });
        let few = (distinct(points_px.iter().map(|(_, pixel)| *pixel)) < FEWEST).then_some(Doubt::FewOutlinePoints);
        if misfit.ratio() <= DOUBTED {
            return Ok(Self::fitted(&fit, &marks, &located, plane_z, few));
        }
        if let Some(round) = Self::without_strays(&marks, &located, plane_z, judge, misfit.expected_px) {
            return Ok(round);
        }
        if misfit.ratio() > REFUSED {
            let Misfit { rms_px: misfit_px, expected_px } = misfit;
            return Err(no_circle(CircleError::NotRound { points: points_px.len(), misfit_px, expected_px }));
        }
        Ok(Self::fitted(&fit, &marks, &located, plane_z, Some(Doubt::OutlineNotRound)))
    }

    /// The circle of most of the points; `None` where they do not follow one either.
    fn without_strays(
        marks: &[usize],
        located: &[Located],
        plane_z: &Sensed,
        judge: &Judge,
        expected_px: f64,
    ) -> Option<Self> {
        let near = judge.followers(located, expected_px)?;
        let marks: Vec<usize> = near.iter().map(|i| marks[*i]).collect();
        let strays = located.len() - near.len();
        let located: Vec<Located> = near.iter().map(|i| located[*i]).collect();
        let fit = fit_located(&located).ok()?;
        let misfit = judge.misfit(&Ring { located: &located, circle: fit.circle });
        let round = Self::fitted(&fit, &marks, &located, plane_z, None);
        (misfit.ratio() <= DOUBTED).then_some(Self { strays, ..round })
    }

    fn fitted(fit: &CircleFit, marks: &[usize], located: &[Located], plane_z: &Sensed, doubt: Option<Doubt>) -> Self {
        let sensed = |value: f64, row: usize| {
            let terms =
                marks.iter().zip(located).zip(&fit.by_point).map(|((mark, place), by_point)| {
                    (*mark, place, Vector2::new(by_point[(row, 0)], by_point[(row, 1)]))
                });
            Sensed::of_places(value, terms, plane_z)
        };
        Self {
            center: [sensed(fit.circle.center_mm.x, 0), sensed(fit.circle.center_mm.y, 1)],
            radius: sensed(fit.circle.radius_mm, 2),
            strays: 0,
            doubt,
        }
    }

    /// The distance of the centre from the point under the camera, in mm.
    fn distance(&self) -> Sensed {
        let [x, y] = &self.center;
        let distance_mm = x.value.hypot(y.value);
        let share = |c: &Sensed| if distance_mm > 0.0 { c.value / distance_mm } else { 0.0 };
        Sensed::of_numbers(distance_mm, [(share(x), x), (share(y), y)], x.points())
    }
}

fn fit_located(located: &[Located]) -> Result<CircleFit, CircleError> {
    let places: Vec<_> = located.iter().map(|l| l.point_mm).collect();
    fit_circle(&places, |i, direction| located[i].by_pixel.tr_mul(&direction).norm())
}

/// A round bowl seen as two circles about one vertical axis.
pub(super) struct Coaxial {
    /// Height of the rim above the base, in mm.
    pub height: Sensed,
    /// Radius of the rim less that of the base, per height: 0 for a vertical wall.
    pub wall_slope: f64,
    /// The number of points of both outlines that were left out.
    pub strays: usize,
    /// The doubts about the outlines.
    pub doubts: Vec<Doubt>,
}

/// The bowl whose rim and base are circles about one vertical axis; `None` where not both are outlined. On Z = 0 the rim is
/// seen scaled by k = c / (c - H) about the point under the camera, where c is the height of the camera. So k = |rim centre| /
/// |base centre| and H = c (1 - 1/k), whatever the shape of the wall between them.
pub(super) fn coaxial(view: &View, marks: &Numbered<'_>, judge: &Judge) -> Option<Result<Coaxial, MeasureError>> {
    let (rim_px, base_px) = (marks.along(Feature::Rim), marks.along(Feature::Base));
    if rim_px.is_empty() || base_px.is_empty() {
        return None;
    }
    let table = Sensed::exact(0.0, marks.points);
    let both = Round::through(view, Feature::Rim, &rim_px, &table, judge)
        .and_then(|rim| Ok((rim, Round::through(view, Feature::Base, &base_px, &table, judge)?)));
    Some(both.and_then(|(rim, base)| {
        let (rim_distance, base_distance) = (rim.distance(), base.distance());
        // Under the camera the distance has no direction, and a first-order uncertainty has no meaning.
        if base_distance.value <= UNDER_CAMERA * base.radius.value {
            return Err(MeasureError::BaseUnderCamera);
        }
        let height = height_from_distances(view, &base_distance, &rim_distance)?;
        let rim_radius_mm = rim.radius.value * base_distance.value / rim_distance.value;
        Ok(Coaxial {
            wall_slope: (rim_radius_mm - base.radius.value) / height.value,
            height,
            strays: rim.strays + base.strays,
            doubts: rim.doubt.into_iter().chain(base.doubt).collect(),
        })
    }))
}

/// A base counts as under the camera when its centre is nearer to the point under the camera than this share of its radius.
const UNDER_CAMERA: f64 = 0.1;
