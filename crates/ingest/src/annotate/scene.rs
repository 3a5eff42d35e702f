//! The camera above the table, and what was marked on it. Viewers take metres.

use foxglove::messages::line_primitive::Type;
use foxglove::messages::scene_entity_deletion::Type as Deletion;
use foxglove::messages::{
    Color, FrameTransform, LinePrimitive, Point3, Pose, Quaternion, SceneEntity, SceneEntityDeletion, SceneUpdate,
    TextPrimitive, Vector3,
};
use model::{UtcNs, View};
use nalgebra::{Point2, Rotation3, UnitQuaternion};

use super::{ImageNotes, MarkNote, colour, label};
use crate::mcap_file::{CAMERA_FRAME, timestamp};

/// The world frame: origin on the table vertically under the camera; X right, Y forward, Z up. It turns and moves with the
/// wearer, since neither yaw nor place is observable.
const TABLE_FRAME: &str = "table";
/// The table is drawn this far to each side and to the front, in steps of a tenth.
const TABLE_M: f64 = 0.5;
const LINES: i32 = 5;

/// The place of the camera in the world frame.
pub(super) fn transform(view: &View, time: UtcNs) -> FrameTransform {
    let world_from_camera = Rotation3::from_matrix_unchecked(view.pose().world_from_camera());
    let [x, y, z, w] = UnitQuaternion::from_rotation_matrix(&world_from_camera).coords.into();
    FrameTransform {
        timestamp: timestamp(time),
        parent_frame_id: TABLE_FRAME.to_owned(),
        child_frame_id: CAMERA_FRAME.to_owned(),
        translation: Some(Vector3 { x: 0.0, y: 0.0, z: view.pose().camera_height_mm() / 1000.0 }),
        rotation: Some(Quaternion { x, y, z, w }),
    }
}

/// The table, and what was marked at this image in place of what was there before.
pub(super) fn update(view: &View, notes: &ImageNotes<'_>, raters: &[String], time: UtcNs) -> SceneUpdate {
    let all = SceneEntityDeletion { timestamp: timestamp(time), r#type: Deletion::All.into(), id: String::new() };
    let entity = |id: String, lines, texts| SceneEntity {
        timestamp: timestamp(time),
        frame_id: TABLE_FRAME.to_owned(),
        id,
        lines,
        texts,
        ..SceneEntity::default()
    };
    let marked = notes.marks.iter().enumerate().filter_map(|(number, mark)| {
        let points = on_plane(view, mark)?;
        let colour = colour(raters, &mark.rater);
        let text = text(&points, label(notes, &mark.object, &mark.rater), colour);
        let kind = if mark.closed { Type::LineLoop } else { Type::LineStrip };
        let line = line(kind, points, colour, 0.002);
        Some(entity(format!("{}/{}/{number}", mark.rater, mark.object), vec![line], vec![text]))
    });
    let table = entity("table".to_owned(), vec![grid(view)], Vec::new());
    SceneUpdate { deletions: vec![all], entities: std::iter::once(table).chain(marked).collect() }
}

/// It is none where the mark lies on no level plane, or the view does not show it there.
fn on_plane(view: &View, mark: &MarkNote) -> Option<Vec<Point3>> {
    let z_mm = mark.plane_z_mm?;
    let point = |[x, y]: &[f64; 2]| {
        let at_mm = view.on_plane(Point2::new(*x, *y), z_mm).ok()?;
        Some(Point3 { x: at_mm.x / 1000.0, y: at_mm.y / 1000.0, z: z_mm / 1000.0 })
    };
    mark.points_px.iter().map(point).collect()
}

/// Squares of 10 cm around where the camera looks.
fn grid(view: &View) -> LinePrimitive {
    let ahead_m = view.pose().range_mm() * view.pose().pitch_rad().cos() / 1000.0;
    let mut points = Vec::new();
    for i in -LINES..=LINES {
        let aside = TABLE_M * f64::from(i) / f64::from(LINES);
        points.extend([-TABLE_M, TABLE_M].map(|y| Point3 { x: aside, y: ahead_m + y, z: 0.0 }));
        points.extend([-TABLE_M, TABLE_M].map(|x| Point3 { x, y: ahead_m + aside, z: 0.0 }));
    }
    line(Type::LineList, points, Color { r: 0.6, g: 0.6, b: 0.6, a: 0.6 }, 0.001)
}

fn line(kind: Type, points: Vec<Point3>, colour: Color, thickness: f64) -> LinePrimitive {
    LinePrimitive {
        r#type: kind.into(),
        pose: Some(upright_at(0.0, 0.0, 0.0)),
        thickness,
        points,
        color: Some(colour),
        ..LinePrimitive::default()
    }
}

/// In the middle of what it names.
fn text(points: &[Point3], text: String, color: Color) -> TextPrimitive {
    let mean = |of: fn(&Point3) -> f64| points.iter().map(of).sum::<f64>() / points.len().max(1) as f64;
    let pose = Some(upright_at(mean(|p| p.x), mean(|p| p.y), mean(|p| p.z)));
    TextPrimitive { pose, billboard: true, font_size: 12.0, scale_invariant: true, color: Some(color), text }
}

fn upright_at(x: f64, y: f64, z: f64) -> Pose {
    Pose { position: Some(Vector3 { x, y, z }), orientation: Some(Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 }) }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use model::{Camera, LensModel, Pose as CameraPose};

    use super::*;

    /// The optical axis meets the table at the range ahead, whatever the pose.
    #[test]
    fn the_camera_looks_at_the_table() {
        let camera = Camera::new([640, 480], [500.0, 500.0], [320.0, 240.0], 0.0, LensModel::None).unwrap();
        for (pitch_deg, roll_deg) in [(55.0_f64, 0.0_f64), (30.0, 12.0), (89.0, -170.0)] {
            let pose = CameraPose::new(pitch_deg.to_radians(), roll_deg.to_radians(), 500.0).unwrap();
            let found = transform(&View::new(camera, pose), UtcNs(0));
            let (Quaternion { x, y, z, w }, at) = (found.rotation.unwrap(), found.translation.unwrap());
            let turn = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
            let looked_at = nalgebra::Vector3::new(at.x, at.y, at.z) + turn * nalgebra::Vector3::new(0.0, 0.0, 0.5);
            let ahead = 0.5 * pitch_deg.to_radians().cos();
            assert!((looked_at - nalgebra::Vector3::new(0.0, ahead, 0.0)).norm() < 1e-12, "{pitch_deg} {looked_at}");
        }
    }
}
