//! Sessions of a scene file: the containers on the table, and the poses of the camera.

use nalgebra::{Point2, Rotation2, Vector2};
use serde::Deserialize;

use super::number::{Checked, Count, Name, Percent, Place, Turn, Within, or, point, share};
use crate::laid::walk::Walk;
use crate::sensors::HeadPose;

type Pitch = Within<5, 90>;
type Roll = Within<-60, 60>;
type Height = Within<100, 2000>;
type Images = Count<1, 2000>;

/// Seconds from one picture to the next, where the file gives none.
const PERIOD_S: f64 = 10.0;
const IMAGES: u32 = 24;

/// A session that can be planned.
#[derive(Debug, Clone)]
pub(super) struct Session {
    pub name: String,
    pub participant: Option<String>,
    /// Names of the containers on its table; none where all containers are.
    pub objects: Option<Vec<String>>,
    /// Whether its images show the containers one after the other.
    pub one_at_a_time: bool,
    pub period_s: f64,
    /// Share of its images before the meal is served, and share after it is taken away.
    pub bare: [f64; 2],
    /// Share of the food that is gone in the last image.
    pub eaten: f64,
    pub view: View,
}

/// The motion of the camera.
#[derive(Debug, Clone)]
pub(super) enum View {
    /// It never moves. The number of images, where the file gives it.
    Stand(Stance, Option<u32>),
    /// It has these poses, with one image at each.
    Poses(Vec<Stance>),
    /// It is on a head that wanders.
    Head(Head),
}

/// A pose of the camera, and its place over the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stance {
    pub head: HeadPose,
    pub stand: (Point2<f64>, f64),
}

/// The walk of a head that wanders.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Head {
    pub walk: Walk,
    pub images: u32,
    pub sway_deg: f64,
    /// Greatest distance from its place over the table, along X and along Y.
    pub shift_mm: f64,
    /// Greatest turn about Z, to either side.
    pub yaw_rad: f64,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SessionFields {
    name: Name,
    participant: Option<Name>,
    objects: Option<Vec<String>>,
    #[serde(default)]
    one_at_a_time: bool,
    period_s: Option<Within<6, 3600>>,
    bare_pct: Option<[Percent; 2]>,
    eaten_pct: Option<Percent>,
    stand: Option<Checked<StandFields, (Stance, Option<u32>)>>,
    poses: Option<Vec<Checked<PoseFields, Stance>>>,
    head: Option<Checked<HeadFields, Head>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StandFields {
    images: Option<Images>,
    pitch_deg: Pitch,
    roll_deg: Option<Roll>,
    height_mm: Height,
    over_mm: Option<[Place; 2]>,
    aim_mm: Option<[Place; 2]>,
    yaw_deg: Option<Turn>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PoseFields {
    pitch_deg: Pitch,
    roll_deg: Option<Roll>,
    height_mm: Height,
    over_mm: Option<[Place; 2]>,
    aim_mm: Option<[Place; 2]>,
    yaw_deg: Option<Turn>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HeadFields {
    images: Option<Images>,
    pitch_deg: Option<[Pitch; 2]>,
    rest_pitch_deg: Option<Pitch>,
    pitch_step_deg: Option<Within<0, 60>>,
    height_mm: Option<[Height; 2]>,
    height_step_mm: Option<Within<0, 500>>,
    roll_deg: Option<[Roll; 2]>,
    sway_deg: Option<Within<0, 5>>,
    shift_mm: Option<Within<0, 500>>,
    yaw_deg: Option<Within<0, 90>>,
}

impl TryFrom<PoseFields> for Stance {
    type Error = &'static str;

    fn try_from(pose: PoseFields) -> Result<Self, Self::Error> {
        let (pitch_deg, height_mm) = (pose.pitch_deg.get(), pose.height_mm.get());
        let pitch_rad = pitch_deg.to_radians();
        let head = HeadPose { pitch_deg, roll_deg: or(pose.roll_deg, 0.0), range_mm: height_mm / pitch_rad.sin() };
        let yaw_rad = or(pose.yaw_deg, 0.0).to_radians();
        let over = match (pose.over_mm, pose.aim_mm) {
            (Some(_), Some(_)) => {
                return Err("both over_mm and aim_mm, expected one of them: where the camera is, or looks");
            }
            (Some(over), None) => point(over),
            (None, Some(aim)) => point(aim) - Rotation2::new(yaw_rad) * Vector2::new(0.0, height_mm / pitch_rad.tan()),
            (None, None) => Point2::origin(),
        };
        Ok(Self { head, stand: (over, yaw_rad) })
    }
}

impl TryFrom<StandFields> for (Stance, Option<u32>) {
    type Error = &'static str;

    fn try_from(fields: StandFields) -> Result<Self, Self::Error> {
        let StandFields { images, pitch_deg, roll_deg, height_mm, over_mm, aim_mm, yaw_deg } = fields;
        let pose = PoseFields { pitch_deg, roll_deg, height_mm, over_mm, aim_mm, yaw_deg };
        Ok((Stance::try_from(pose)?, images.map(Count::get)))
    }
}

impl TryFrom<HeadFields> for Head {
    type Error = String;

    fn try_from(head: HeadFields) -> Result<Self, String> {
        let pitch_deg = range("pitch_deg", head.pitch_deg, (20.0, 80.0))?;
        let sway_deg = or(head.sway_deg, 0.25);
        if pitch_deg.0 - sway_deg < 1.0 || pitch_deg.1 + sway_deg > 89.0 {
            return Err(format!(
                "pitch_deg = {pitch_deg:?} with a sway_deg of {sway_deg}, expected 1 to 89 degrees in all"
            ));
        }
        let height_mm = range("height_mm", head.height_mm, (330.0, 520.0))?;
        let roll_deg = range("roll_deg", head.roll_deg, (-8.0, 8.0))?;
        let rest_pitch_deg = or(head.rest_pitch_deg, f64::clamp(54.0, pitch_deg.0, pitch_deg.1));
        if !(pitch_deg.0..=pitch_deg.1).contains(&rest_pitch_deg) {
            return Err(format!("rest_pitch_deg = {rest_pitch_deg}, expected a pitch of pitch_deg {pitch_deg:?}"));
        }
        let near = |by: f64| (f64::max(rest_pitch_deg - by, pitch_deg.0), f64::min(rest_pitch_deg + by, pitch_deg.1));
        let walk = Walk {
            first_pitch_deg: near(12.0),
            pitch_deg,
            rest_pitch_deg,
            pitch_step_deg: or(head.pitch_step_deg, 22.0),
            first_height_mm: height_mm,
            height_mm,
            height_step_mm: or(head.height_step_mm, 20.0),
            roll_deg,
        };
        Ok(Self {
            walk,
            images: head.images.map_or(IMAGES, Count::get),
            sway_deg,
            shift_mm: or(head.shift_mm, 40.0),
            yaw_rad: or(head.yaw_deg, 14.0).to_radians(),
        })
    }
}

/// The two ends of a range; the default where the file gives none. Fails where the first end is the larger one.
fn range<const LOW: i32, const HIGH: i32>(
    key: &str,
    given: Option<[Within<LOW, HIGH>; 2]>,
    default: (f64, f64),
) -> Result<(f64, f64), String> {
    match given.map(|ends| ends.map(Within::get)) {
        Some([least, most]) if least > most => {
            Err(format!("{key} = [{least}, {most}], expected the smaller one first"))
        }
        Some([least, most]) => Ok((least, most)),
        None => Ok(default),
    }
}

impl TryFrom<SessionFields> for Session {
    type Error = String;

    fn try_from(fields: SessionFields) -> Result<Self, String> {
        let name = fields.name.0;
        let view = match (fields.stand, fields.poses, fields.head) {
            (Some(stand), None, None) => View::Stand(stand.0.0, stand.0.1),
            (None, Some(poses), None) if (1..=2000).contains(&poses.len()) => {
                View::Poses(poses.into_iter().map(|pose| pose.0).collect())
            }
            (None, Some(poses), None) => return Err(format!("'{name}': {} poses, expected 1 to 2000", poses.len())),
            (None, None, Some(head)) => View::Head(head.0),
            _ => return Err(format!("'{name}': expected one of stand, poses and head")),
        };
        let bare = fields.bare_pct.map_or([0.0; 2], |bare| bare.map(share));
        if bare[0] + bare[1] > 1.0 {
            return Err(format!("'{name}': bare_pct, expected no more than 100 together"));
        }
        Ok(Self {
            name,
            participant: fields.participant.map(|participant| participant.0),
            objects: fields.objects,
            one_at_a_time: fields.one_at_a_time,
            period_s: or(fields.period_s, PERIOD_S),
            bare,
            eaten: fields.eaten_pct.map_or(0.0, share),
            view,
        })
    }
}

impl Session {
    /// The number of images where so many objects are on the table.
    pub(super) fn images(&self, objects: usize) -> usize {
        match &self.view {
            View::Stand(_, Some(images)) => *images as usize,
            View::Stand(_, None) => {
                if self.one_at_a_time {
                    objects.max(1)
                } else {
                    1
                }
            }
            View::Poses(poses) => poses.len(),
            View::Head(head) => head.images as usize,
        }
    }
}
