//! The true places of the containers in the images of a simulated study.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::Context as _;
use model::{Kind, ObjectMarks, Pose, View, median};
use nalgebra::Point2;

/// A rim is a container's if, on the plane of its true level, half of its points lie within this share of the radius from
/// where they should be.
const RIGHT: f64 = 0.12;

/// A round container.
pub struct Object {
    pub name: String,
    pub kind: Kind,
    pub diameter_mm: f64,
    /// Height above the table at which its rim is widest.
    pub level_mm: f64,
}

/// A round container in an image.
struct Place {
    object: String,
    center_mm: Point2<f64>,
    radius_mm: f64,
    level_mm: f64,
}

/// An image with its true pose.
pub struct Seen {
    pub view: View,
    places: Vec<Place>,
}

impl Seen {
    /// The container whose rim, or its inner edge, these marks follow; none where they follow no container's.
    pub fn container_of(&self, marks: &ObjectMarks) -> Option<String> {
        let off = |place: &Place| {
            let points = marks.marks.iter().flat_map(|mark| mark.points_px().iter().copied());
            let offs = points.filter_map(|point| {
                let at = self.view.on_plane(point, place.level_mm).ok()?;
                Some(((at - place.center_mm).norm() / place.radius_mm - 1.0).abs())
            });
            Some(offs.collect::<Vec<f64>>()).filter(|offs| !offs.is_empty()).map_or(f64::INFINITY, median)
        };
        let nearest = self.places.iter().min_by(|a, b| off(a).total_cmp(&off(b)))?;
        (off(nearest) < RIGHT).then(|| nearest.object.clone())
    }
}

/// The truth of a study.
pub struct Truth {
    /// The images by session and file.
    pub sessions: BTreeMap<String, BTreeMap<String, Seen>>,
    objects: BTreeMap<(String, String), Object>,
}

impl Truth {
    pub fn read(study: &Path) -> anyhow::Result<Self> {
        let file = study.join("truth.parquet");
        let (rows, _) = report::read_truth(&file).with_context(|| format!("{}", file.display()))?;
        let spec = pipeline::Study::load(study, |_| {})?.camera_spec;
        let camera = spec.camera()?;
        let (mut sessions, mut objects) = (BTreeMap::<_, BTreeMap<String, Seen>>::new(), BTreeMap::new());
        for row in rows {
            let pose = Pose::new(row.pitch_deg.to_radians(), row.roll_deg.to_radians(), row.range_mm)?;
            let images = sessions.entry(row.session.clone()).or_default();
            let seen =
                images.entry(row.image).or_insert_with(|| Seen { view: View::new(camera, pose), places: Vec::new() });
            let (Some(name), Some(kind), Some(diameter_mm), Some(level_mm), Some(x), Some(y)) =
                (row.object, row.kind, row.true_diameter_mm, row.rim_level_mm, row.center_x_mm, row.center_y_mm)
            else {
                continue;
            };
            let (center_mm, radius_mm) = (Point2::new(x, y), 0.5 * diameter_mm);
            seen.places.push(Place { object: name.clone(), center_mm, radius_mm, level_mm });
            objects.insert((row.session, name.clone()), Object { name, kind, diameter_mm, level_mm });
        }
        Ok(Self { sessions, objects })
    }

    /// The round containers of a session.
    pub fn containers<'a>(&'a self, session: &'a str) -> impl Iterator<Item = &'a Object> {
        self.objects.iter().filter(move |((of, _), _)| of == session).map(|(_, object)| object)
    }
}
