//! Circles on level planes with their derivatives, and the heights that two of them give.

use nalgebra::{Point2, Vector2};

use super::MeasureError;
use super::height::height_from_distances;
use super::numbered::Numbered;
use crate::circle::fit_circle;
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
}

impl Round {
    /// The circle through points that were marked along a level edge. Each is weighted by the length that one pixel covers at
    /// its place.
    pub(super) fn through(
        view: &View,
        feature: Feature,
        points_px: &[(usize, Point2<f64>)],
        plane_z: &Sensed,
    ) -> Result<Self, MeasureError> {
        let located: Vec<Located> = points_px
            .iter()
            .map(|(_, pixel)| Located::on_plane(view, *pixel, plane_z.value))
            .collect::<Result<_, _>>()?;
        let places: Vec<_> = located.iter().map(|l| l.point_mm).collect();
        let fit = fit_circle(&places, |i, direction| located[i].by_pixel.tr_mul(&direction).norm())
            .map_err(|source| MeasureError::Circle { feature, source })?;
        let sensed = |value: f64, row: usize| {
            let terms = points_px.iter().zip(&located).zip(&fit.by_point).map(|(((mark, _), place), by_point)| {
                (*mark, place, Vector2::new(by_point[(row, 0)], by_point[(row, 1)]))
            });
            Sensed::of_places(value, terms, plane_z)
        };
        Ok(Self {
            center: [sensed(fit.circle.center_mm.x, 0), sensed(fit.circle.center_mm.y, 1)],
            radius: sensed(fit.circle.radius_mm, 2),
        })
    }

    /// The distance of the centre from the point under the camera, in mm.
    fn distance(&self) -> Sensed {
        let [x, y] = &self.center;
        let distance_mm = x.value.hypot(y.value);
        let share = |c: &Sensed| if distance_mm > 0.0 { c.value / distance_mm } else { 0.0 };
        Sensed::of_numbers(distance_mm, [(share(x), x), (share(y), y)], x.points())
    }
}

/// A round bowl seen as two circles about one vertical axis.
pub(super) struct Coaxial {
    /// Height of the rim above the base, in mm.
    pub height: Sensed,
    /// Radius of the rim less that of the base, per height: 0 for a vertical wall.
    pub wall_slope: f64,
}

/// The bowl whose rim and base are circles about one vertical axis; `None` where not both are outlined. On Z = 0 the rim is
/// seen scaled by k = c / (c - H) about the point under the camera, where c is the height of the camera. So k = |rim centre| /
/// |base centre| and H = c (1 - 1/k), whatever the shape of the wall between them.
pub(super) fn coaxial(view: &View, marks: &Numbered<'_>) -> Option<Result<Coaxial, MeasureError>> {
    let (rim_px, base_px) = (marks.along(Feature::Rim), marks.along(Feature::Base));
    if rim_px.is_empty() || base_px.is_empty() {
        return None;
    }
    let table = Sensed::exact(0.0, marks.points);
    let both = Round::through(view, Feature::Rim, &rim_px, &table)
        .and_then(|rim| Ok((rim, Round::through(view, Feature::Base, &base_px, &table)?)));
    Some(both.and_then(|(rim, base)| {
        let (rim_distance, base_distance) = (rim.distance(), base.distance());
        // Under the camera the distance has no direction, and a first-order uncertainty has no meaning.
        if base_distance.value <= UNDER_CAMERA * base.radius.value {
            return Err(MeasureError::BaseUnderCamera);
        }
        let height = height_from_distances(view, &base_distance, &rim_distance)?;
        let rim_radius_mm = rim.radius.value * base_distance.value / rim_distance.value;
        Ok(Coaxial { wall_slope: (rim_radius_mm - base.radius.value) / height.value, height })
    }))
}

/// A base counts as under the camera when its centre is nearer to the point under the camera than this share of its radius.
const UNDER_CAMERA: f64 = 0.1;
