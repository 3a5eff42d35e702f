//! A plate. It is flat, as in the paper's model, with a shading that makes its rim look raised.

use nalgebra::{Point2, Vector3};

use super::{Hit, Part, Ray};

/// The outline of a plate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outline {
    /// A disc.
    Circle,
    /// A square with sides along X and Y.
    Square,
}

/// A plate on the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plate {
    /// Centre on the table.
    pub center_mm: Point2<f64>,
    /// Half the diameter or side.
    pub half_width_mm: f64,
    /// Its outline.
    pub outline: Outline,
}

impl Plate {
    /// The distance of a point from the centre as a share of the half width (1 at the edge), and the direction outwards.
    fn reach(&self, point: Point2<f64>) -> (f64, Vector3<f64>) {
        let from_center = point - self.center_mm;
        let (reach_mm, outwards) = match self.outline {
            Outline::Circle => (from_center.norm(), from_center / from_center.norm().max(1e-9)),
            Outline::Square if from_center.x.abs() > from_center.y.abs() => {
                (from_center.x.abs(), nalgebra::Vector2::new(from_center.x.signum(), 0.0))
            }
            Outline::Square => (from_center.y.abs(), nalgebra::Vector2::new(0.0, from_center.y.signum())),
        };
        (reach_mm / self.half_width_mm, outwards.push(0.0))
    }

    /// The surface of the plate that the ray meets.
    pub(super) fn hit(&self, ray: &Ray) -> Option<Hit> {
        let distance = ray.to_level(0.0)?;
        let (reach, outwards) = self.reach(ray.point_at(distance).xy());
        if reach > 1.0 {
            return None;
        }
        // The apparent slope along the profile: a flat well, a step up at two thirds, a rim that rises a little, and a rolled lip.
        let slope = 0.55 * bump(reach, 0.66, 0.05) + 0.12 * bump(reach, 0.86, 0.16) - 0.5 * bump(reach, 0.99, 0.025);
        let normal = (Vector3::z() - outwards * slope).normalize();
        let openness = 0.94 + 0.06 * (reach * reach).min(1.0) - 0.08 * bump(reach, 0.63, 0.05);
        Some(Hit { distance, part: Part::Floor, normal, openness })
    }

    /// The distance of a point of the table from the plate, in mm; 0 or negative inside.
    pub(super) fn distance_outside(&self, point: Point2<f64>) -> f64 {
        match self.outline {
            Outline::Circle => (point - self.center_mm).norm() - self.half_width_mm,
            Outline::Square => {
                let outside = (point - self.center_mm).abs().map(|d| (d - self.half_width_mm).max(0.0));
                outside.norm()
            }
        }
    }
}

fn bump(x: f64, center: f64, width: f64) -> f64 {
    (-((x - center) / width).powi(2)).exp()
}
