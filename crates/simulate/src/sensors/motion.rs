//! A head that rests around each picture and moves in between.

/// The pose of the camera on a head.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeadPose {
    /// Depression of the optical axis below the horizontal.
    pub pitch_deg: f64,
    /// Roll about that axis, positive clockwise as the wearer sees it.
    pub roll_deg: f64,
    /// Distance to the table along that axis.
    pub range_mm: f64,
}

/// The motion of a head: poses in the order of time. Between the rests at two poses the head turns smoothly from one to the next.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// The middle of each rest, in seconds since the start of the recording, and the pose.
    pub rests: Vec<(f64, HeadPose)>,
    /// Half the length of a rest.
    pub half_rest_s: f64,
}

impl Motion {
    /// The motion of a head (or a test bench) that never moves.
    #[must_use]
    pub fn fixed(pose: HeadPose) -> Self {
        Self { rests: vec![(0.0, pose)], half_rest_s: 0.0 }
    }

    /// The pose at a time in seconds since the start of the recording. Before the first and after the last rest the head keeps
    /// still. None where there is no rest.
    #[must_use]
    pub fn pose_at(&self, time_s: f64) -> Option<HeadPose> {
        let next = self.rests.partition_point(|(rest_s, _)| *rest_s <= time_s);
        let (Some(before), after) = (self.rests.get(next.saturating_sub(1)), self.rests.get(next)) else {
            return None;
        };
        let (Some(after), true) = (after, next > 0) else {
            return Some(before.1);
        };
        let (leaves_s, arrives_s) = (before.0 + self.half_rest_s, after.0 - self.half_rest_s);
        let t = ((time_s - leaves_s) / (arrives_s - leaves_s)).clamp(0.0, 1.0);
        let share = t * t * t * (10.0 + t * (6.0 * t - 15.0)); // no jerk at either end
        let between = |a: f64, b: f64| a + share * (b - a);
        Some(HeadPose {
            pitch_deg: between(before.1.pitch_deg, after.1.pitch_deg),
            roll_deg: between(before.1.roll_deg, after.1.roll_deg),
            range_mm: between(before.1.range_mm, after.1.range_mm),
        })
    }
}
