//! Outer edges of rendered plates, from circles that are wrong in all the ways in which the search may be.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use ingest::Picture;
use model::{Camera, LensModel, Pose, View};
use nalgebra::{Point2, Point3};
use simulate::render::Renderer;
use simulate::scene::{Outline, Plate, Scene, Solid};

use super::outer_edge;
use crate::circles::{Arc, BINS, Disc};

/// A plate on the table, 230 mm wide, at 55 degrees, and its picture of so many pixels across.
fn plate(width_px: u32) -> (View, Picture, Point2<f64>) {
    let (width, focal) = (f64::from(width_px), 0.65 * f64::from(width_px));
    let size = [width_px, width_px * 3 / 4];
    let camera = Camera::new(size, [focal; 2], [0.5 * width, 0.375 * width], 0.0, LensModel::None).unwrap();
    let view = View::new(camera, Pose::new(55_f64.to_radians(), 0.0, 480.0).unwrap());
    let center_mm = view.on_plane(Point2::new(0.52 * width, 0.36 * width), 0.0).unwrap();
    let plate = Plate { center_mm, half_width_mm: 115.0, outline: Outline::Circle };
    let scene = Scene { solid: Solid::Plate(plate), colour: [230.0, 228.0, 220.0] };
    let rendered = Renderer::new(camera).render(&scene, view.pose());
    (view, Picture { width_px: rendered.width_px, height_px: rendered.height_px, rgb: rendered.rgb }, center_mm)
}

/// A circle as the search finds it, of this radius, centre and oval.
fn found(view: &View, disc: Disc, oval: [f64; 2], factor: usize) -> Arc {
    let place = |i: u32| {
        let angle = f64::from(i) / 360.0 * std::f64::consts::TAU;
        let (x, y) = (disc.x + disc.radius * angle.cos(), disc.y + disc.radius * angle.sin());
        view.pixel_of(Point3::new(x, y, 0.0)).unwrap()
    };
    let perimeter_px = (0..360).map(|i| (place(i + 1) - place(i)).norm()).sum::<f64>() / factor as f64;
    let bins = [1; BINS];
    Arc { disc, oval, bins, coverage: 1.0, residual_px: 0.3, contrast: 20.0, chance: 0.01, perimeter_px }
}

/// An oval that comes from edges of two circles is given up, a wrong radius and centre are mended, at any scale.
#[test]
fn the_edge_is_found_from_a_circle_that_is_wrong_and_oval() {
    for (width_px, factor) in [(720, 1), (1440, 3)] {
        let (view, picture, center) = plate(width_px);
        for (radius, oval, aside) in [(111.0, [0.0, 0.0], 1.5), (112.0, [2.0, 1.0], 0.0), (117.0, [-2.0, 1.5], -1.0)] {
            let disc = Disc { x: center.x + aside, y: center.y + aside, radius };
            let arc = outer_edge(&picture, &view, found(&view, disc, oval, factor), factor);
            assert!((arc.disc.radius / 115.0 - 1.0).abs() < 0.006, "{width_px} px from {radius}: {:?}", arc.disc);
            assert!((arc.disc.x - center.x).hypot(arc.disc.y - center.y) < 1.2, "{width_px} px: {:?}", arc.disc);
            assert!(arc.oval[0].hypot(arc.oval[1]) < 1e-9, "{width_px} px from {oval:?}: {:?}", arc.oval);
        }
    }
}

/// Where a pose that is wrong makes every level circle oval, the oval stays.
#[test]
fn a_circle_that_a_wrong_pose_makes_oval_is_followed() {
    let (right, picture, center) = plate(1440);
    let pose = Pose::new(57_f64.to_radians(), 0.0, right.pose().range_mm()).unwrap();
    let view = View::new(*right.camera(), pose);
    // What the rim looks like by the wrong pose: its half-axes along the camera's heading and across.
    let seen = |x: f64, y: f64| {
        let px = right.pixel_of(Point3::new(center.x + x, center.y + y, 0.0)).unwrap();
        view.on_plane(px, 0.0).unwrap()
    };
    let (far, near, left, other) = (seen(0.0, 115.0), seen(0.0, -115.0), seen(-115.0, 0.0), seen(115.0, 0.0));
    let (along, across) = (0.5 * (far - near).norm(), 0.5 * (left - other).norm());
    let middle = nalgebra::center(&far, &near);
    let oval = [0.5 * (across - along), 0.0];
    let disc = Disc { x: middle.x, y: middle.y, radius: 0.5 * (along + across) };
    let arc = outer_edge(&picture, &view, found(&view, disc, oval, 3), 3);
    assert!((arc.disc.radius / disc.radius - 1.0).abs() < 0.01, "{:?} from {disc:?}, oval {oval:?}", arc.disc);
}

#[test]
fn a_picture_without_edges_leaves_the_circle_as_it_is() {
    let (view, picture, center) = plate(720);
    let grey = Picture { rgb: vec![90; picture.rgb.len()], ..picture };
    let arc = found(&view, Disc { x: center.x, y: center.y, radius: 115.0 }, [1.0, 0.0], 1);
    let after = outer_edge(&grey, &view, arc.clone(), 1);
    assert_eq!((after.disc.radius, after.oval), (arc.disc.radius, arc.oval));
}
