//! Containers, and the points of them that a rater marks.

use std::f64::consts::TAU;

use model::{Container, Feature, Kind, Mark, ObjectMarks, Pose, Quantity, Shape, Wall};
use nalgebra::{Point2, Point3, Vector2};
use rand::Rng;
use rand_chacha::ChaCha8Rng;

/// A sort of container on the table, with the marks that it gets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Subject {
    /// A round plate: points along its rim, and a line across.
    RoundPlate,
    /// A square plate: its corners.
    SquarePlate,
    /// A rectangular box: its corners, and a height line.
    Box,
    /// A round bowl with an upright wall: a height line on its near side, rim and base.
    UprightBowl,
    /// A round bowl with a straight, sloped wall: a height line on its far side, rim and base.
    SlopedBowl,
    /// A round bowl with a curved wall, marked as one with a sloped wall.
    CurvedBowl,
}

impl Subject {
    /// All sorts.
    pub const ALL: [Self; 6] =
        [Self::RoundPlate, Self::SquarePlate, Self::Box, Self::UprightBowl, Self::SlopedBowl, Self::CurvedBowl];

    /// The name of the sort in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::RoundPlate => "round plate",
            Self::SquarePlate => "square plate",
            Self::Box => "box",
            Self::UprightBowl => "upright bowl",
            Self::SlopedBowl => "sloped bowl",
            Self::CurvedBowl => "curved bowl",
        }
    }
}

/// A container of known size.
#[derive(Debug, Clone, Copy)]
pub(super) struct Thing {
    pub subject: Subject,
    /// Radius of a round rim, half of a square's side, or half of a rectangle's short side.
    pub half_mm: f64,
    /// Half of a rectangle's long side.
    pub half_long_mm: f64,
    pub height_mm: f64,
    pub base_radius_mm: f64,
    /// Power of the height with which the radius grows.
    pub curve: f64,
    /// Its turn on the table, in radians.
    pub turn_rad: f64,
}

/// The points that are marked, and their grouping into marks.
pub(super) struct Seen {
    pub points_mm: Vec<Point3<f64>>,
    groups: Vec<(Group, usize)>,
}

#[derive(Clone, Copy)]
enum Group {
    Line(Quantity),
    Outline(Feature),
}

impl Thing {
    /// A random container of everyday size, for a camera at this height.
    pub(super) fn draw(random: &mut ChaCha8Rng, subject: Subject, camera_height_mm: f64) -> Self {
        let tallest_mm = (0.3 * camera_height_mm).min(110.0);
        let half_mm = random.random_range(35.0..75.0);
        let flat = matches!(subject, Subject::RoundPlate | Subject::SquarePlate);
        let half_mm = if flat { half_mm * 1.4 } else { half_mm };
        let upright = matches!(subject, Subject::UprightBowl | Subject::Box);
        let base_share = if upright { 1.0 } else { random.random_range(0.4..0.75) };
        let curve = if subject == Subject::CurvedBowl { random.random_range(0.4..0.8) } else { 1.0 };
        Self {
            subject,
            half_mm,
            half_long_mm: half_mm * random.random_range(1.2..1.6),
            height_mm: if flat { 0.0 } else { random.random_range(0.4..1.0) * tallest_mm },
            base_radius_mm: half_mm * base_share,
            curve,
            turn_rad: random.random_range(0.0..TAU),
        }
    }

    /// The knowledge about the container that the measurement starts from. It includes an upright wall, but not a sloped one.
    pub(super) fn container(&self) -> Container {
        let (kind, shape, wall) = match self.subject {
            Subject::RoundPlate => (Kind::Plate, Shape::Circle, None),
            Subject::SquarePlate => (Kind::Plate, Shape::Square, None),
            Subject::Box => (Kind::Box, Shape::Rectangle, None),
            Subject::UprightBowl => (Kind::Bowl, Shape::Circle, Some(Wall::Vertical)),
            Subject::SlopedBowl | Subject::CurvedBowl => (Kind::Bowl, Shape::Circle, None),
        };
        Container { kind, shape, rim_height_mm: None, wall }
    }

    pub(super) fn truth_mm(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Diameter | Quantity::Width => 2.0 * self.half_mm,
            Quantity::Length => 2.0 * self.half_long_mm,
            Quantity::Height => self.height_mm,
        }
    }

    fn radius_mm(&self, z_mm: f64) -> f64 {
        self.base_radius_mm + (self.half_mm - self.base_radius_mm) * (z_mm / self.height_mm).powf(self.curve)
    }

    /// The points that a rater marks when the container stands at `center_mm`; none where too little of the base can be seen.
    pub(super) fn seen(&self, pose: Pose, center_mm: Point2<f64>) -> Option<Seen> {
        let mut seen = Seen { points_mm: Vec::new(), groups: Vec::new() };
        match self.subject {
            Subject::RoundPlate => {
                seen.outline(Feature::Rim, self.circle(center_mm, self.half_mm, 0.0));
                let across = Vector2::new(self.turn_rad.cos(), self.turn_rad.sin()) * self.half_mm;
                seen.line(Quantity::Diameter, [(center_mm - across, 0.0), (center_mm + across, 0.0)]);
            }
            Subject::SquarePlate => seen.outline(Feature::Rim, self.corners(center_mm, self.half_mm).to_vec()),
            Subject::Box => {
                let corners = self.corners(center_mm, self.half_long_mm);
                let nearest = corners.iter().min_by(|a, b| a.coords.xy().norm().total_cmp(&b.coords.xy().norm()))?.xy();
                seen.line(Quantity::Height, [(nearest, 0.0), (nearest, self.height_mm)]);
                seen.outline(Feature::Rim, corners.to_vec());
            }
            Subject::UprightBowl | Subject::SlopedBowl | Subject::CurvedBowl => {
                // The near wall of an upright bowl shows its foot from outside, and the far wall of an open bowl from inside.
                let away = center_mm.coords.normalize() * if self.subject == Subject::UprightBowl { -1.0 } else { 1.0 };
                let foot = center_mm + away * self.base_radius_mm;
                seen.line(Quantity::Height, [(foot, 0.0), (center_mm + away * self.half_mm, self.height_mm)]);
                seen.outline(Feature::Rim, self.circle(center_mm, self.half_mm, self.height_mm));
                let base = self.circle(center_mm, self.base_radius_mm, 0.0);
                let base: Vec<_> = base.into_iter().filter(|p| self.shows(pose, center_mm, *p)).collect();
                if base.len() < FEWEST_OF_BASE {
                    return None;
                }
                seen.outline(Feature::Base, base);
            }
        }
        Some(seen)
    }

    fn circle(&self, center_mm: Point2<f64>, radius_mm: f64, z_mm: f64) -> Vec<Point3<f64>> {
        let at = |i: u32| {
            let (sin, cos) = (self.turn_rad + TAU * f64::from(i) / f64::from(AROUND)).sin_cos();
            Point3::new(center_mm.x + radius_mm * cos, center_mm.y + radius_mm * sin, z_mm)
        };
        (0..AROUND).map(at).collect()
    }

    fn corners(&self, center_mm: Point2<f64>, half_long_mm: f64) -> [Point3<f64>; 4] {
        let half_long_mm = if self.subject == Subject::SquarePlate { self.half_mm } else { half_long_mm };
        let (sin, cos) = self.turn_rad.sin_cos();
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(a, b)| {
            let (x, y) = (a * self.half_mm, b * half_long_mm);
            Point3::new(center_mm.x + cos * x - sin * y, center_mm.y + sin * x + cos * y, self.height_mm)
        })
    }

    /// Whether the camera sees a point of the base: through the mouth, or past the outside of the wall.
    fn shows(&self, pose: Pose, center_mm: Point2<f64>, point_mm: Point3<f64>) -> bool {
        let camera_mm = Point3::new(0.0, 0.0, pose.camera_height_mm());
        let at = |z_mm: f64| {
            let on_way = point_mm + (camera_mm - point_mm) * (z_mm / camera_mm.z);
            ((on_way.xy() - center_mm).norm(), self.radius_mm(z_mm))
        };
        let heights = || (1..=STEPS_UP).map(|i| self.height_mm * f64::from(i) / f64::from(STEPS_UP)).map(at);
        heights().all(|(way, wall)| way <= wall + 1e-9) || heights().all(|(way, wall)| way >= wall - 1e-9)
    }
}

/// Number of points that a rater sets around a circle.
const AROUND: u32 = 16;
/// Least number of points of a base that is outlined. Fewer say little about its centre.
const FEWEST_OF_BASE: usize = 7;
/// Number of heights at which the way of light past a curved wall is checked.
const STEPS_UP: u32 = 12;

impl Seen {
    fn line(&mut self, quantity: Quantity, ends: [(Point2<f64>, f64); 2]) {
        self.points_mm.extend(ends.map(|(p, z_mm)| Point3::new(p.x, p.y, z_mm)));
        self.groups.push((Group::Line(quantity), 2));
    }

    fn outline(&mut self, feature: Feature, points_mm: Vec<Point3<f64>>) {
        self.groups.push((Group::Outline(feature), points_mm.len()));
        self.points_mm.extend(points_mm);
    }

    /// The marks, from the pixels of their points.
    pub(super) fn marks(&self, pixels: &[Point2<f64>]) -> ObjectMarks {
        let mut rest = pixels;
        let mut marks = Vec::new();
        for (group, count) in &self.groups {
            let (points, others) = rest.split_at((*count).min(rest.len()));
            rest = others;
            marks.extend(match (group, points) {
                (Group::Line(quantity), &[a, b]) => Some(Mark::Line { quantity: *quantity, ends_px: [a, b] }),
                (Group::Line(_), _) => None,
                (Group::Outline(feature), _) => Some(Mark::Outline { feature: *feature, points_px: points.to_vec() }),
            });
        }
        ObjectMarks { object: "object".to_owned(), marks }
    }
}
