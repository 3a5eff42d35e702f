//! One picture to be taken: world, camera, and what is true of it.

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

/// Places along a rim that are looked at for what hides it, and how near to one is the rim itself.
const RIM_PLACES: u32 = 90;
const RIM_ITSELF_MM: f64 = 12.0;

/// Half of the range sensor's cone (VL53L0X data sheet: 25 degrees), and rings and rays of it.
const HALF_CONE_RAD: f64 = 12.5 * PI / 180.0;
const CONE_RAYS: (u32, u32) = (6, 16);

/// A container in a world.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// Its name.
    pub object: Arc<str>,
    /// Its form.
    pub ware: Ware,
    /// Where its axis meets the table, in the frame of [`Frame::world`].
    pub at_mm: Point2<f64>,
    /// Its turn about the axis, radians.
    pub turn_rad: f64,
}

/// A picture to be taken.
#[derive(Debug, Clone)]
pub struct Frame {
    /// Seconds since the session's start.
    pub time_s: f64,
    /// What is there.
    pub world: World,
    /// Its containers.
    pub placed: Vec<Placed>,
    /// Drinking glasses beside them.
    pub vessels: Vec<Vessel>,
    /// Pose of the camera.
    pub head: HeadPose,
    /// Where the camera stands above the table, and its turn about Z.
    pub stand: (Point2<f64>, f64),
    /// What the camera does.
    pub exposure: Exposure,
    /// Of rays and noise.
    pub seed: u64,
}

/// What is true of a container in a picture. The world frame is that of the picture's pose: the camera above the origin.
#[derive(Debug, Clone, PartialEq)]
pub struct Truth {
    /// Name, as in objects.csv.
    pub object: Arc<str>,
    /// Plate, bowl or box.
    pub kind: Kind,
    /// Circle, square or rectangle.
    pub shape: Shape,
    /// Of round ones.
    pub true_diameter_mm: Option<f64>,
    /// Side of a square, short side of a rectangle.
    pub true_width_mm: Option<f64>,
    /// Long side of a rectangle.
    pub true_length_mm: Option<f64>,
    /// From the table to the top.
    pub true_height_mm: f64,
    /// Height at which the rim is widest.
    pub rim_level_mm: f64,
    /// Where the axis meets the table.
    pub center_x_mm: f64,
    /// Away from the wearer.
    pub center_y_mm: f64,
    /// Turn of the long side from the right towards away; 0 for what is round.
    pub turn_deg: f64,
    /// Share of the rim inside the picture.
    pub rim_in_picture: f64,
    /// Share of the rim inside the picture and not hidden.
    pub rim_seen: f64,
}

impl Frame {
    /// The camera at its pose.
    ///
    /// # Errors
    /// [`SimulateError::Pose`], which would be a fault of the preset.
    pub fn view(&self, camera: &Camera) -> Result<View, SimulateError> {
        let HeadPose { pitch_deg, roll_deg, range_mm } = self.head;
        let pose = Pose::new(pitch_deg.to_radians(), roll_deg.to_radians(), range_mm);
        let pose = pose.map_err(|source| SimulateError::Pose { place: format!("{pitch_deg} degrees"), source })?;
        Ok(View::new(*camera, pose))
    }

    /// Takes the picture.
    #[must_use]
    pub fn photograph(&self, view: &View) -> Picture {
        photograph(&self.world, view.camera(), &self.station(view), &self.exposure, self.seed)
    }

    fn station(&self, view: &View) -> Station {
        Station::new(view.pose(), self.stand.0, self.stand.1)
    }

    /// What is true of each container.
    #[must_use]
    pub fn truths(&self, view: &View) -> Vec<Truth> {
        self.placed.iter().map(|placed| self.truth(view, placed)).collect()
    }

    /// From the world's frame to that of the view.
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

    /// Shares of the rim that lie in the picture, and that are seen there.
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

    /// The marks of someone who never errs: the rim across, each way if it is a rectangle, and of a box the height of the wall
    /// nearest to the camera. Those that would lie outside the picture are left out.
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

    /// What the range sensor reads here without noise: the mean distance over its cone, weighed by the light that comes back
    /// from matt surfaces (docs/signals.md), over all that stands in it.
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
    /// A point of the rim: of a rectangle, where a ray from its middle leaves it.
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

    /// Quantities and the ends of the lines that show them to a camera above `stand`.
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
