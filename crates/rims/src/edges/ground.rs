//! Edges carried to the table plane.
//!
//! A level circle at any height above the table appears on the plane Z = 0 as a circle too: lifting a plane is a scaling
//! about the point under the camera. So one plane serves for rims of all heights.

use model::View;
use nalgebra::{Point2, Vector2, Vector3};

use super::chains::chains;
use super::edge::{Edge, Edges};
use super::scaled::Scaled;

/// Rays are worked out exactly this many scaled pixels apart, and interpolated between: lenses bend slowly.
const GRID_STEP: usize = 8;
/// Rays flatter than this (sine of the depression) are left out: a level circle is seen there as a line.
const LEAST_DEPRESSION_SINE: f64 = 0.17;
/// The tangent of a chain comes from the edges this many places before and after.
const CHORD: usize = 4;

/// An edge on the plane Z = 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GroundEdge {
    /// Place in mm.
    pub x: f32,
    pub y: f32,
    /// Unit normal of the edge on the plane, towards brighter.
    pub nx: f32,
    pub ny: f32,
    /// Length of the chain that it stands for, in mm.
    pub length: f32,
    /// Millimetres per scaled pixel along the normal.
    pub scale: f32,
    /// Millimetres per scaled pixel in the worst direction.
    pub worst_scale: f32,
    /// Strength of the edge in levels per scaled pixel.
    pub contrast: f32,
}

/// Interpolates rays in the world frame.
struct Rays {
    columns: usize,
    rows: usize,
    in_world: Vec<Option<Vector3<f64>>>,
    camera_height_mm: f64,
}

impl Rays {
    #[expect(clippy::cast_precision_loss, reason = "pixels of a picture")]
    fn of(view: &View, scaled: &Scaled) -> Self {
        let (columns, rows) = (scaled.width / GRID_STEP + 2, scaled.height / GRID_STEP + 2);
        let world_from_camera = view.pose().world_from_camera();
        let node = |i: usize| scaled.in_full((i * GRID_STEP) as f64);
        let in_world = (0..rows)
            .flat_map(|row| (0..columns).map(move |column| Point2::new(node(column), node(row))))
            .map(|pixel| Some(world_from_camera * view.camera().ray_through(pixel).ok()?))
            .collect();
        Self { columns, rows, in_world, camera_height_mm: view.pose().camera_height_mm() }
    }

    /// The place on Z = 0 that a place of the scaled picture shows.
    #[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "pixels")]
    fn on_ground(&self, x: f64, y: f64) -> Option<Shown> {
        let (u, v) = (x.max(0.0) / GRID_STEP as f64, y.max(0.0) / GRID_STEP as f64);
        // By way of i32, which is quicker.
        let (column, row) = ((u as i32 as usize).min(self.columns - 2), (v as i32 as usize).min(self.rows - 2));
        let (u, v) = (u - column as f64, v - row as f64);
        let ray = |c: usize, r: usize| self.in_world[(row + r) * self.columns + column + c];
        let (first, second, third, fourth) = (ray(0, 0)?, ray(1, 0)?, ray(0, 1)?, ray(1, 1)?);
        let (top, bottom) = (first * (1.0 - u) + second * u, third * (1.0 - u) + fourth * u);
        let ray = top * (1.0 - v) + bottom * v;
        if ray.z >= 0.0 || ray.z * ray.z <= LEAST_DEPRESSION_SINE * LEAST_DEPRESSION_SINE * ray.norm_squared() {
            return None;
        }
        let per_px = 1.0 / GRID_STEP as f64;
        let by_x = ((second - first) * (1.0 - v) + (fourth - third) * v) * per_px;
        let by_y = (bottom - top) * per_px;
        let stretch = self.camera_height_mm / -ray.z;
        let at = ray.xy() * stretch;
        let moved = |by: Vector3<f64>| by.xy() * stretch - at * (by.z / ray.z);
        Some(Shown { at, right: moved(by_x), down: moved(by_y) })
    }
}

/// A place on Z = 0 that the picture shows, in mm, and how far from it the next pixels to the right and below are.
#[derive(Clone, Copy)]
struct Shown {
    at: Vector2<f64>,
    right: Vector2<f64>,
    down: Vector2<f64>,
}

/// Neighbours on a chain that make one piece.
const PIECE: usize = 2;

/// What lies on the plane Z = 0.
#[derive(Default)]
pub(crate) struct Ground {
    /// Every edge of the chains.
    pub edges: Vec<GroundEdge>,
    /// The same, a few neighbours to a piece: enough to see where circles may be.
    pub pieces: Vec<GroundEdge>,
}

/// Several neighbours on a chain as one.
fn piece(edges: &[GroundEdge]) -> GroundEdge {
    let sum = |of: fn(&GroundEdge) -> f32| edges.iter().map(of).sum::<f32>();
    #[expect(clippy::cast_precision_loss, reason = "a handful of edges")]
    let mean = |of: fn(&GroundEdge) -> f32| sum(of) / edges.len() as f32;
    let (nx, ny) = (sum(|e| e.nx), sum(|e| e.ny));
    let size = (nx * nx + ny * ny).sqrt().max(1e-6);
    GroundEdge {
        x: mean(|e| e.x),
        y: mean(|e| e.y),
        nx: nx / size,
        ny: ny / size,
        length: sum(|e| e.length),
        scale: mean(|e| e.scale),
        worst_scale: mean(|e| e.worst_scale),
        contrast: mean(|e| e.contrast),
    }
}

/// The chains of a picture's edges on the plane Z = 0.
pub(crate) fn ground_edges(view: &View, scaled: &Scaled) -> Ground {
    let found = Edges::of(scaled);
    let rays = Rays::of(view, scaled);
    let mut ground = Ground::default();
    let mut places: Vec<(Edge, Option<Shown>)> = Vec::new();
    for chain in chains(&found) {
        let before = ground.edges.len();
        places.clear();
        places.extend(chain.iter().map(|i| {
            let e = found.edges[*i as usize];
            (e, rays.on_ground(f64::from(e.x), f64::from(e.y)))
        }));
        for i in 0..places.len() {
            let (before, after) = (i.saturating_sub(CHORD), (i + CHORD).min(places.len() - 1));
            let (e, here) = places[i];
            let (first, last) = (places[before], places[after]);
            let (Some(here), Some(start), Some(end)) = (here, first.1, last.1) else { continue };
            let chord = end.at - start.at;
            let (wide_px, high_px) = (f64::from(last.0.x - first.0.x), f64::from(last.0.y - first.0.y));
            let chord_px = (wide_px * wide_px + high_px * high_px).sqrt();
            let Shown { at: here, right, down } = here;
            let along = chord.norm() / chord_px;
            if !(along > 0.0 && along.is_finite()) {
                continue;
            }
            let tangent = chord.normalize();
            #[expect(clippy::cast_precision_loss, reason = "a handful of edges")]
            let length = chord.norm() / (after - before) as f64;
            #[expect(clippy::cast_possible_truncation, reason = "mm on a table")]
            ground.edges.push(GroundEdge {
                x: here.x as f32,
                y: here.y as f32,
                nx: tangent.y as f32,
                ny: -tangent.x as f32,
                length: length as f32,
                scale: (right.perp(&down).abs() / along) as f32,
                worst_scale: right.norm().max(down.norm()) as f32,
                contrast: (e.gx * e.gx + e.gy * e.gy).sqrt(),
            });
        }
        ground.pieces.extend(ground.edges[before..].chunks(PIECE).map(piece));
    }
    ground
}
