//! Pictures for reports, of rendered scenes whose truth is known.

use std::convert::Infallible;
use std::path::PathBuf;

use model::{Camera, GalleryMark, GalleryPicture, GallerySink, LensModel, PictureView, Pose, View};
use nalgebra::{Point2, Point3};
use pipeline::{Gallery, GalleryError, GalleryHalted, GalleryOptions, Silent, Stop};
use serde_json::Value;
use simulate::render::Renderer;
use simulate::scene::{Outline, Plate, Scene, Solid};

use super::auto::undecodable;
use crate::support::{Shot, StudyFolder, aim_batch, assert_exit, label_me, line, outline};

/// A wide lens, so that a mark at its wrong place would be far from the rim.
const CAMERA: &str = "schema_version = 1\nname = \"c\"\nwidth_px = 1000\nheight_px = 750\nfocal_px = [520.0, 520.0]\n\
     principal_px = [508.0, 366.0]\n[lens]\nmodel = \"division\"\nlambda = -0.25\n";
const OBJECTS: &str = "object,kind,shape,true_diameter_mm\nplate,plate,circle,230.0\n";
const RADIUS_MM: f64 = 115.0;
const RANGE_MM: f64 = 480.0;
/// The factor by which the gallery's pictures are reduced.
const REDUCED: f64 = 0.64;

fn camera() -> Camera {
    let lens = LensModel::Division(model::lens::Division { lambda: -0.25 });
    Camera::new([1000, 750], [520.0, 520.0], [508.0, 366.0], 0.0, lens).unwrap()
}

/// A picture of a plate, and the view that it was taken from.
struct Taken {
    view: View,
    center_mm: Point2<f64>,
}

fn taken(pitch_deg: f64) -> Taken {
    let view = View::new(camera(), Pose::new(pitch_deg.to_radians(), 0.0, RANGE_MM).unwrap());
    Taken { view, center_mm: view.on_plane(Point2::new(540.0, 400.0), 0.0).unwrap() }
}

impl Taken {
    fn on_rim(&self, degrees: i32) -> [f64; 2] {
        let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
        let at = Point3::new(self.center_mm.x + RADIUS_MM * cos, self.center_mm.y + RADIUS_MM * sin, 0.0);
        let pixel = self.view.pixel_of(at).unwrap();
        [pixel.x, pixel.y]
    }

    fn shot(&self, marks: Option<Value>) -> Shot {
        let plate = Plate { center_mm: self.center_mm, half_width_mm: RADIUS_MM, outline: Outline::Circle };
        let scene = Scene { solid: Solid::Plate(plate), colour: [230.0, 228.0, 220.0] };
        let pose = self.view.pose();
        Shot {
            picture: Renderer::new(camera()).render(&scene, pose).to_jpeg("x.jpg").unwrap(),
            extension: "jpg",
            pitch_deg: pose.pitch_rad().to_degrees(),
            roll_deg: 0.0,
            range_mm: RANGE_MM,
            marks,
        }
    }

    /// The marks that a careful person would make.
    fn marks(&self) -> Value {
        let rim: Vec<[f64; 2]> = (0..36).map(|i| self.on_rim(10 * i)).collect();
        label_me(vec![outline("plate/rim", &rim), line("plate/diameter", [self.on_rim(0), self.on_rim(180)])])
    }
}

#[derive(Default)]
struct Taker(Vec<GalleryPicture>);

impl GallerySink for Taker {
    type Error = Infallible;

    fn picture(&mut self, picture: GalleryPicture) -> Result<(), Infallible> {
        self.0.push(picture);
        Ok(())
    }
}

/// Runs, and gives the results' file.
#[track_caller]
fn run(study: &StudyFolder, options: &[&str]) -> PathBuf {
    let out = study.path().join("out/r.parquet");
    let ran = aim_batch().arg("run").arg(study.path()).arg("--out").arg(&out).args(options).output().unwrap();
    assert_exit(&ran, 0);
    out
}

fn gallery(out: &std::path::Path, jobs: usize) -> (Vec<GalleryPicture>, Gallery) {
    let sessions = report::Results::read(out).unwrap().metadata.sessions;
    let options = GalleryOptions {
        work_dir: &out.with_extension("work"),
        sessions: &sessions,
        jobs: std::num::NonZeroUsize::new(jobs),
        image_memory_bytes: 1,
        stop: Stop::default(),
    };
    let mut taker = Taker::default();
    let made = pipeline::gallery(&options, &Silent, &mut taker).unwrap();
    assert_eq!(made.pictures, taker.0.len());
    (taker.0, made)
}

fn rims(picture: &GalleryPicture) -> Vec<&GalleryMark> {
    picture.marks.iter().filter(|mark| mark.closed).collect()
}

/// Largest distance in pixels of a mark's points from the true rim, in a picture that shows `view` reduced.
fn off_px(mark: &GalleryMark, taken: &Taken) -> f64 {
    let rim: Vec<[f64; 2]> = (0..360).map(|degrees| taken.on_rim(degrees).map(|c| (c + 0.5) * REDUCED - 0.5)).collect();
    let from_rim = |[x, y]: [f64; 2]| rim.iter().map(|[a, b]| (a - x).hypot(b - y)).fold(f64::INFINITY, f64::min);
    mark.points_px.iter().copied().map(from_rim).fold(0.0, f64::max)
}

/// One session with two images at different pitches; the second is nearer the target.
fn study() -> (StudyFolder, [Taken; 2]) {
    let study = StudyFolder::new("", OBJECTS, CAMERA);
    let taken = [taken(50.0), taken(55.0)];
    study.session("S1", &taken.each_ref().map(|taken| taken.shot(Some(taken.marks()))));
    (study, taken)
}

#[test]
fn marks_lie_on_the_rim_in_every_view() {
    let (study, taken) = study();
    let (pictures, made) = gallery(&run(&study, &["--marks", "both"]), 1);
    assert!(made.not_shown.is_empty(), "{:?}", made.not_shown);
    let views: Vec<PictureView> = pictures.iter().map(|picture| picture.view).collect();
    assert_eq!(views.iter().filter(|view| **view == PictureView::Camera).count(), 2);
    assert_eq!(views.len(), 4, "one of them is exemplary: {views:?}");
    for picture in &pictures {
        assert_eq!(image::load_from_memory(&picture.jpeg).unwrap().to_rgb8().dimensions(), picture.size_px.into());
        assert!(picture.jpeg.len() < 80_000, "{} bytes", picture.jpeg.len());
        assert!(picture.marks.iter().any(|mark| mark.rater == "A" && !mark.closed && mark.points_px.len() == 2));
        assert!(rims(picture).iter().any(|mark| mark.rater == "A") && rims(picture).iter().any(|m| m.rater == "auto"));
    }
    let of_camera: Vec<&GalleryPicture> = pictures.iter().filter(|p| p.view == PictureView::Camera).collect();
    for (picture, taken) in of_camera.into_iter().zip(&taken) {
        assert_eq!(picture.size_px, [640, 480]);
        for mark in rims(picture).into_iter().filter(|mark| mark.object == "plate" || mark.object == "auto-1") {
            assert!(off_px(mark, taken) < 1.2, "{} by {}: {} px", mark.object, mark.rater, off_px(mark, taken));
        }
    }
}

/// The plate is the largest thing on the sheet, and its margin is 40 mm: that gives the scale.
#[test]
fn on_the_plane_a_plate_is_a_circle_of_its_size() {
    let (study, _) = study();
    let (pictures, _) = gallery(&run(&study, &[]), 2);
    let plane = pictures.iter().find(|picture| picture.view == PictureView::Plane).unwrap();
    let [rim] = rims(plane)[..] else { panic!("one rim: {:?}", plane.marks) };
    let side = |axis: usize| {
        let along = || rim.points_px.iter().map(|point| point[axis]);
        along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min)
    };
    let expected_px = 640.0 * 2.0 * RADIUS_MM / (2.0 * RADIUS_MM + 80.0);
    assert!((side(0) - expected_px).abs() < 3.0 && (side(1) - expected_px).abs() < 3.0, "{} {}", side(0), side(1));
    // The picture shows it there: a bright plate within the rim, the darker table without.
    let shown = image::load_from_memory(&plane.jpeg).unwrap().to_luma8();
    let [width, height] = plane.size_px;
    let center = [0.5 * f64::from(width), 0.5 * f64::from(height)];
    let grey = |share: f64, degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let at = [center[0] + share * 0.5 * side(0) * cos, center[1] + share * 0.5 * side(0) * sin];
        f64::from(shown.get_pixel(at[0] as u32, at[1] as u32).0[0])
    };
    let inside: f64 = (0..36).map(|i| grey(0.96, 10.0 * f64::from(i))).sum::<f64>() / 36.0;
    let outside: f64 = (0..36).map(|i| grey(1.04, 10.0 * f64::from(i))).sum::<f64>() / 36.0;
    assert!(inside > outside + 40.0, "{inside} {outside}");
}

#[test]
fn pictures_are_the_same_for_any_number_of_threads() {
    let (study, _) = study();
    let out = run(&study, &[]);
    let one = gallery(&out, 1).0;
    assert!(one == gallery(&out, 3).0);
    let order: Vec<_> = one.iter().map(|picture| (&picture.session, &picture.image, picture.view)).collect();
    assert!(order.is_sorted(), "{order:?}");
}

/// Where people marked other pictures than the recorded ones.
#[test]
fn marks_are_carried_to_the_recorded_pictures() {
    let taken = taken(55.0);
    let half = |marks: &Value| -> Value {
        let mut marks = marks.clone();
        for point in
            marks["shapes"].as_array_mut().unwrap().iter_mut().flat_map(|s| s["points"].as_array_mut().unwrap())
        {
            *point = serde_json::json!([
                (point[0].as_f64().unwrap() + 0.5) * 0.5 - 0.5,
                (point[1].as_f64().unwrap() + 0.5) * 0.5 - 0.5
            ]);
        }
        marks
    };
    let study = StudyFolder::new("[marks]\ncamera = \"half\"\n", OBJECTS, CAMERA);
    let camera = CAMERA.replace("1000", "500").replace("750", "375").replace("520.0", "260.0");
    study.write("devices/half.toml", camera.replace("508.0", "253.75").replace("366.0", "182.75"));
    study.session("S1", &[taken.shot(Some(half(&taken.marks())))]);
    let (pictures, _) = gallery(&run(&study, &[]), 1);
    let [rim] = rims(&pictures[0])[..] else { panic!("{:?}", pictures[0].marks) };
    assert!(off_px(rim, &taken) < 0.2, "{} px", off_px(rim, &taken));
}

#[test]
fn what_cannot_be_shown_is_told_and_the_others_are_shown() {
    let (study, taken) = study();
    let mut damaged = taken[0].shot(Some(taken[0].marks()));
    (damaged.picture, damaged.extension) = (undecodable(&damaged.picture), "png");
    study.session("S2", &[damaged, taken[1].shot(Some(taken[1].marks()))]);
    study.session("S3", &[taken[1].shot(Some(taken[1].marks()))]);
    let out = run(&study, &[]);
    std::fs::remove_file(out.with_extension("work").join("mcap/S3.mcap")).unwrap();
    let (pictures, made) = gallery(&out, 2);
    let told: Vec<_> = made.not_shown.iter().map(|not| (not.session.as_str(), not.image.is_some())).collect();
    assert_eq!(told, [("S2", true), ("S3", false)]);
    assert!(pictures.iter().any(|p| p.session == "S2") && pictures.iter().all(|p| p.session != "S3"));

    let elsewhere = study.path().join("elsewhere");
    let options = GalleryOptions {
        work_dir: &elsewhere,
        sessions: &[],
        jobs: None,
        image_memory_bytes: 1 << 20,
        stop: Stop::default(),
    };
    let refused = pipeline::gallery(&options, &Silent, &mut Taker::default()).unwrap_err();
    assert!(matches!(&refused, GalleryError::Halted(GalleryHalted::NoWork(_))), "{refused}");
}
