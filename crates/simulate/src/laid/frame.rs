//! A picture to be taken: its world, its camera and its truth.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;

use model::{Camera, Kind, Pose, Quantity, Shape, View};
use nalgebra::{Point2, Point3, Rotation2, Vector2};

use super::things::Vessel;
use super::ware::Ware;
use crate::error::SimulateError;
use crate::render::Picture;
use crate::scene::Ray;
use crate::sensors::HeadPose;
use crate::study::LabeledLine;
use crate::world::World;
use crate::world::photo::{Exposure, Station, photograph};

/// Number of places along a rim at which it is checked whether something hides the rim.
const RIM_PLACES: u32 = 90;
/// A surface as near as this to such a place is the rim itself.
const RIM_ITSELF_MM: f64 = 12.0;

/// Half of the angle of the range sensor's cone (VL53L0X data sheet: 25 degrees).
const HALF_CONE_RAD: f64 = 12.5 * PI / 180.0;
/// Number of rings of the cone, and of rays in each ring.
const CONE_RAYS: (u32, u32) = (6, 16);

/// A container that stands in a world.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// Its name.
    pub object: Arc<str>,
    /// Its form.
    pub ware: Ware,
    /// The point where its axis meets the table, in the frame of [`Frame::world`].
    pub at_mm: Point2<f64>,
    /// Its turn about the axis, in radians.
    pub turn_rad: f64,
}

/// A picture to be taken.
#[derive(Debug, Clone)]
pub struct Frame {
    /// Seconds since the session's start.
    pub time_s: f64,
    /// The world that it shows.
    pub world: World,
    /// The containers in that world.
    pub placed: Vec<Placed>,
    /// The drinking glasses beside them.
    pub vessels: Vec<Vessel>,
    /// The pose of the camera.
    pub head: HeadPose,
    /// The place of the camera above the table in mm, and its turn about Z in radians.
    pub stand: (Point2<f64>, f64),
    /// The exposure of the camera.
    pub exposure: Exposure,
    /// Seed of rays and noise.
    pub seed: u64,
}

/// The truth of a container in a picture. The world frame is that of the picture's pose, with the camera above the origin.
#[derive(Debug, Clone, PartialEq)]
pub struct Truth {
    /// Name, as in objects.csv.
    pub object: Arc<str>,
    /// Whether it is a plate, a bowl or a box.
    pub kind: Kind,
    /// Whether its outline is a circle, a square or a rectangle.
    pub shape: Shape,
    /// Diameter of a round container.
    pub true_diameter_mm: Option<f64>,
    /// Side of a square, or short side of a rectangle.
    pub true_width_mm: Option<f64>,
    /// Long side of a rectangle.
    pub true_length_mm: Option<f64>,
    /// Height from the table to the top.
    pub true_height_mm: f64,
    /// Height at which the rim is widest.
    pub rim_level_mm: f64,
    /// X, to the right, of the point where the axis meets the table.
    pub center_x_mm: f64,
    /// Y, away from the wearer, of that point.
    pub center_y_mm: f64,
    /// Turn of the long side from the right towards the direction away from the wearer; 0 for round containers.
    pub turn_deg: f64,
    /// Share of the rim that is inside the picture, from 0 to 1.
    pub rim_in_picture: f64,
    /// Share of the rim that is inside the picture and not hidden, from 0 to 1.
    pub rim_seen: f64,
}

impl Frame {
    /// The view of `camera` at the pose of the picture.
    ///
    /// # Errors
    /// [`SimulateError::Pose`], which would be a fault of the preset.
    pub fn view(&self, camera: &Camera) -> Result<View, SimulateError> {
        let HeadPose { pitch_deg, roll_deg, range_mm } = self.head;
        let pose = Pose::new(pitch_deg.to_radians(), roll_deg.to_radians(), range_mm);
        let pose = pose.map_err(|source| SimulateError::Pose { place: format!("{pitch_deg} degrees"), source })?;
        Ok(View::new(*camera, pose))
    }

    /// The picture, as it is taken.
    #[must_use]
    pub fn photograph(&self, view: &View) -> Picture {
        photograph(&self.world, view.camera(), &self.station(view), &self.exposure, self.seed)
    }

    fn station(&self, view: &View) -> Station {
        Station::new(view.pose(), self.stand.0, self.stand.1)
    }

    /// The truth of each container.
    #[must_use]
    pub fn truths(&self, view: &View) -> Vec<Truth> {
        self.placed.iter().map(|placed| self.truth(view, placed)).collect()
    }

    /// A point of the table in the frame of the view, from its place in the frame of the world.
    #[must_use]
    pub fn in_view(&self, point: Point2<f64>) -> Point2<f64> {
        Rotation2::new(-self.stand.1) * Point2::from(point - self.stand.0)
    }

    fn truth(&self, view: &View, placed: &Placed) -> Truth {
        let ware = &placed.ware;
        let center = self.in_view(placed.at_mm);
        let (in_picture, seen) = self.rim_shares(view, placed);
        Truth {
            object: placed.object.clone(),
            kind: ware.kind,
            shape: ware.shape,
            true_diameter_mm: ware.across_mm(Quantity::Diameter),
            true_width_mm: ware.across_mm(Quantity::Width),
            true_length_mm: ware.across_mm(Quantity::Length),
            true_height_mm: ware.height_mm,
            rim_level_mm: ware.rim_level_mm(),
            center_x_mm: center.x,
            center_y_mm: center.y,
            turn_deg: if ware.is_round() { 0.0 } else { (placed.turn_rad - self.stand.1).to_degrees() },
            rim_in_picture: in_picture,
            rim_seen: seen,
        }
    }

    /// The share of the rim that lies in the picture, and the share that is seen there.
    fn rim_shares(&self, view: &View, placed: &Placed) -> (f64, f64) {
        let [width, height] = view.camera().size_px().map(f64::from);
        let origin = self.station(view).origin_mm;
        let (mut inside, mut seen) = (0_u32, 0_u32);
        for place in 0..RIM_PLACES {
            let angle = f64::from(place) / f64::from(RIM_PLACES) * TAU;
            let on_rim = placed.rim_point(angle);
            let level = self.in_view(on_rim.xy());
            let pixel = view.pixel_of(Point3::new(level.x, level.y, on_rim.z));
            if pixel.is_ok_and(|p| (0.0..width).contains(&p.x) && (0.0..height).contains(&p.y)) {
                inside += 1;
                seen += u32::from(self.world.is_seen(origin, on_rim, RIM_ITSELF_MM));
            }
        }
        (f64::from(inside) / f64::from(RIM_PLACES), f64::from(seen) / f64::from(RIM_PLACES))
    }

    /// The marks of a rater who never errs: the rim across (both ways, where it is a rectangle), and of a box the height of the wall
    /// nearest to the camera. Marks that would lie outside the picture are left out.
    #[must_use]
    pub fn marks(&self, view: &View) -> Vec<LabeledLine> {
        let [width, height] = view.camera().size_px().map(f64::from);
        let is_inside = |p: &Point2<f64>| (0.0..width).contains(&p.x) && (0.0..height).contains(&p.y);
        let lines =
            self.placed.iter().flat_map(|placed| placed.lines(self.stand.0).map(|line| (placed.object.clone(), line)));
        let drawn = lines.filter_map(|(object, (quantity, ends))| {
            let pixel = |p: Point3<f64>| {
                let level = self.in_view(p.xy());
                view.pixel_of(Point3::new(level.x, level.y, p.z)).ok().filter(is_inside)
            };
            let ends_px = [pixel(ends[0])?, pixel(ends[1])?];
            Some(LabeledLine { object: object.to_string(), quantity, ends_px })
        });
        drawn.collect()
    }

    /// The reading of the range sensor without noise, in mm: the mean distance over its cone, with all that stands in it, weighted
    /// by the light that comes back from matt surfaces (docs/signals.md).
    #[must_use]
    pub fn cone_mm(&self, view: &View) -> f64 {
        let Station { origin_mm, world_from_camera } = self.station(view);
        let (rings, turns) = CONE_RAYS;
        let (mut light, mut sum) = (0.0, 0.0);
        for ring in 0..rings {
            let off = (f64::from(ring) + 0.5) / f64::from(rings) * HALF_CONE_RAD;
            for turn in 0..turns {
                let angle = f64::from(turn) / f64::from(turns) * TAU;
                let ray = nalgebra::Vector3::new(off.sin() * angle.cos(), off.sin() * angle.sin(), off.cos());
                let direction = world_from_camera * ray;
                if let Some(distance) = self.world.distance(&Ray { origin: origin_mm, direction }) {
                    let back = off.sin() * direction.z.abs() / (distance * distance);
                    (light, sum) = (light + back, sum + back * distance);
                }
            }
        }
        if light > 0.0 { sum / light } else { self.head.range_mm }
    }
}

impl Placed {
    /// The point of the rim in a direction. For a rectangle it is where a ray from the middle leaves it.
    fn rim_point(&self, angle: f64) -> Point3<f64> {
        let (half_x, half_y) = (0.5 * self.ware.diameter_mm, 0.5 * self.ware.width_mm);
        let unit = Vector2::new(angle.cos(), angle.sin());
        let reach = if self.ware.is_round() {
            half_x
        } else {
            (half_x / unit.x.abs().max(1e-9)).min(half_y / unit.y.abs().max(1e-9))
        };
        let at = self.at_mm + Rotation2::new(self.turn_rad) * (unit * reach);
        Point3::new(at.x, at.y, self.ware.rim_level_mm())
    }

    /// The quantities, and the ends of the lines that show them to a camera above `stand`.
    fn lines(&self, stand: Point2<f64>) -> impl Iterator<Item = (Quantity, [Point3<f64>; 2])> {
        let across = |angle: f64| [self.rim_point(angle + PI), self.rim_point(angle)];
        let lines: &[(Quantity, f64)] = match self.ware.shape {
            Shape::Circle => &[(Quantity::Diameter, 0.0)],
            Shape::Square => &[(Quantity::Width, 0.0)],
            Shape::Rectangle => &[(Quantity::Length, 0.0), (Quantity::Width, FRAC_PI_2)],
        };
        let far = |point: &Point3<f64>| (point.xy() - stand).norm();
        let middles = [0.0, FRAC_PI_2, PI, -FRAC_PI_2].map(|angle| self.rim_point(angle));
        let near = middles.into_iter().min_by(|a, b| far(a).total_cmp(&far(b)));
        let wall = near.filter(|_| self.ware.kind == Kind::Box);
        let wall = wall.map(|top| (Quantity::Height, [Point3::new(top.x, top.y, 0.0), top]));
        lines.iter().map(move |(quantity, angle)| (*quantity, across(*angle))).chain(wall)
    }
}
