//! A likely circle fitted to the edges along it, and how much of it they cover.

use nalgebra::{SMatrix, SVector};

use super::buckets::Buckets;
use super::ground::GroundEdge;
use super::votes::Disc;

/// The circle is divided into as many bins.
pub(super) const BINS: usize = 72;
/// A part of a fit: how wide the ring around the circle is in which edges count, in radii, for how many steps, and whether
/// the circle may look oval.
struct Pass {
    width: f32,
    steps: u8,
    oval: bool,
}

/// A fit, from rough to fine.
const PASSES: [Pass; 4] = [
    Pass { width: 0.12, steps: 2, oval: false },
    Pass { width: 0.06, steps: 2, oval: false },
    Pass { width: 0.03, steps: 3, oval: true },
    Pass { width: 0.0, steps: 3, oval: true },
];
/// Least width of the ring, in scaled pixels; of the last pass.
pub(super) const RING_PX: f32 = 1.5;
/// An edge of a circle points to its centre within 18 degrees.
const LEAST_COSINE: f32 = 0.95;
/// Edges with less than this cosine (40 degrees off) certainly belong to something else.
const OTHER_COSINE: f32 = 0.766;
/// Edges that a fit may meet lie in a ring of this width around its start, in radii ...
const GATHERED: f32 = 0.25;
/// ... and point to its start's centre within about 30 degrees.
const GATHERED_COSINE: f32 = 0.86;
/// After the rough steps, edges further from the circle than this are left out.
const KEPT: f32 = 0.12;
/// The ring about the rim in which other edges are counted, in radii.
const AROUND: f32 = 0.25;
/// A circle with less edge in its ring after the rough steps, relative to its length, is given up ...
const LEAST_START: f32 = 0.25;
/// ... and one with less along it in the end.
const LEAST_SHARE: f32 = 0.2;
/// Circles with less of their bins covered are not looked at further.
const LEAST_COVERAGE: f64 = 0.3;
/// Share of a bin's length that must be edges.
const BIN_SHARE: f32 = 0.4;

/// A fitted circle and its support.
#[derive(Debug, Clone)]
pub(super) struct Arc {
    pub disc: Disc,
    /// How far it is from round: radius = R + a cos 2t + b sin 2t, in mm.
    pub oval: [f64; 2],
    /// Per bin, from angle 0 on: 1 where brighter lies outside, -1 where inside, 0 where no edge is.
    pub bins: [i8; BINS],
    /// Share of all bins that have an edge.
    pub coverage: f64,
    /// Root mean square distance of the edges from the circle, in scaled pixels.
    pub residual_px: f64,
    /// Mean strength of the edges, in levels per scaled pixel.
    pub contrast: f64,
    /// Length of other edges (not along circles about this centre) per area around the rim, times the ring's width: the
    /// chance that a place on the rim has an edge along it that means nothing.
    pub chance: f64,
    /// Length of the rim in scaled pixels.
    pub perimeter_px: f64,
}

/// Edge relative to a circle: distance from its centre, and cosine between its normal and the radius (positive where
/// brighter lies outside).
fn relative(e: &GroundEdge, disc: &Disc) -> (f32, f32) {
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    let (dx, dy) = (e.x - disc.x as f32, e.y - disc.y as f32);
    let distance = (dx * dx + dy * dy).sqrt().max(1e-6);
    (distance, (dx * e.nx + dy * e.ny) / distance)
}

/// Whether an edge is further than this from the circle (mm): told without a root.
#[expect(clippy::cast_possible_truncation, reason = "mm")]
fn is_off(e: &GroundEdge, disc: &Disc, least: f32) -> bool {
    let (dx, dy, radius) = (e.x - disc.x as f32, e.y - disc.y as f32, disc.radius as f32);
    let squared = dx * dx + dy * dy;
    let (inner, outer) = ((radius - least).max(0.0), radius + least);
    !(inner * inner..=outer * outer).contains(&squared)
}

/// A circle on its way, and how far from round it is allowed to look.
#[derive(Clone, Copy)]
pub(super) struct Trial {
    pub disc: Disc,
    pub oval: [f64; 2],
    pub most_oval: f64,
}

impl Trial {
    /// How far the curve is from the circle at most, in mm, and a little more.
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    fn most_off(&self) -> f32 {
        self.oval[0].hypot(self.oval[1]) as f32 + 1e-2
    }

    /// Distance of an edge outside the curve in mm, and the direction to it from the centre.
    fn off(&self, e: &GroundEdge, distance: f32) -> (f32, [f64; 2]) {
        let d = f64::from(distance);
        let (cos, sin) = ((f64::from(e.x) - self.disc.x) / d, (f64::from(e.y) - self.disc.y) / d);
        let oval = self.oval[0] * (cos * cos - sin * sin) + self.oval[1] * 2.0 * cos * sin;
        #[expect(clippy::cast_possible_truncation, reason = "mm")]
        ((d - self.disc.radius - oval) as f32, [cos, sin])
    }

    /// For an edge that runs along circles about the centre: its distance outside the curve in mm, and its bin.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "bins")]
    pub(super) fn along(&self, e: &GroundEdge) -> Option<(f32, usize)> {
        let (distance, cosine) = relative(e, &self.disc);
        if cosine.abs() < LEAST_COSINE {
            return None;
        }
        let (off, [cos, sin]) = self.off(e, distance);
        let turn = sin.atan2(cos).rem_euclid(std::f64::consts::TAU) / std::f64::consts::TAU;
        Some((off, ((turn * BINS as f64) as usize).min(BINS - 1)))
    }
}

/// Fits a likely circle to the edges near it; none when it has too few, or runs away. `most_oval`: how far from round,
/// relative to its radius, it may look for an error of the pose.
pub(super) fn fit(buckets: &Buckets, start: &Disc, most_oval: f64) -> Option<Arc> {
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    let radius = start.radius as f32;
    let mut near: Vec<GroundEdge> = Vec::new();
    buckets.near_rim(start, GATHERED * radius, |e| {
        if relative(e, start).1.abs() > GATHERED_COSINE {
            near.push(*e);
        }
    });
    let mut trial = Trial { disc: *start, oval: [0.0; 2], most_oval: 0.0 };
    for Pass { width, steps, oval } in PASSES {
        if oval && trial.most_oval <= 0.0 {
            if share(&near, &trial, width) < LEAST_START {
                return None;
            }
            trial.most_oval = most_oval;
            near.retain(|e| (relative(e, &trial.disc).0 / radius - 1.0).abs() < KEPT);
        }
        for _ in 0..steps {
            trial = step(&near, &trial, width)?;
            let moved = (trial.disc.x - start.x).hypot(trial.disc.y - start.y);
            if moved > 0.3 * start.radius || !(0.75..1.33).contains(&(trial.disc.radius / start.radius)) {
                return None;
            }
        }
    }
    if share(&near, &trial, 0.0) < LEAST_SHARE {
        return None;
    }
    let arc = support(&near, &trial);
    if arc.coverage < LEAST_COVERAGE {
        return None;
    }
    Some(support(&buckets.ring(&trial.disc, AROUND * radius), &trial))
}

/// Length of the edges along a circle, relative to it.
fn share(edges: &[GroundEdge], trial: &Trial, width: f32) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    let radius = trial.disc.radius as f32;
    let oval = trial.most_off();
    let along = |e: &&GroundEdge| {
        let ring = (width * radius).max(RING_PX * e.scale);
        if is_off(e, &trial.disc, ring + oval) {
            return false;
        }
        let (distance, cosine) = relative(e, &trial.disc);
        cosine.abs() >= LEAST_COSINE && trial.off(e, distance).0.abs() <= ring
    };
    edges.iter().filter(along).map(|e| e.length).sum::<f32>() / (std::f32::consts::TAU * radius)
}

/// Fits again, from close by.
pub(super) fn refit(buckets: &Buckets, start: &Arc, most_oval: f64) -> Option<Arc> {
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    let radius = start.disc.radius as f32;
    let near = buckets.ring(&start.disc, 0.3 * radius);
    let mut trial = Trial { disc: start.disc, oval: start.oval, most_oval };
    for width in [0.02, 0.0, 0.0, 0.0] {
        trial = step(&near, &trial, width)?;
    }
    Some(support(&near, &trial))
}

/// One Gauss-Newton step with Tukey's weights, of centre and radius and, where the circle may look oval, of that.
fn step(edges: &[GroundEdge], trial: &Trial, width: f32) -> Option<Trial> {
    if trial.most_oval > 0.0 {
        let (mut normal, mut right) = normal_equations(edges, trial, width, |cos, sin| {
            SVector::<f64, 5>::from([cos, sin, 1.0, cos * cos - sin * sin, 2.0 * cos * sin])
        });
        let sigma = 0.5 * trial.most_oval * trial.disc.radius;
        for i in 3..5 {
            normal[(i, i)] += 1.0 / (sigma * sigma);
            right[i] -= trial.oval[i - 3] / (sigma * sigma);
        }
        let change = normal.cholesky()?.solve(&right);
        moved(trial, [change[0], change[1], change[2]], [change[3], change[4]])
    } else {
        let (normal, right) =
            normal_equations(edges, trial, width, |cos, sin| SVector::<f64, 3>::from([cos, sin, 1.0]));
        let change = normal.cholesky()?.solve(&right);
        moved(trial, [change[0], change[1], change[2]], [0.0; 2])
    }
}

/// The normal equations of the edges' distances from the curve. `row`: derivatives by the unknowns in a direction.
fn normal_equations<const N: usize>(
    edges: &[GroundEdge],
    trial: &Trial,
    width: f32,
    row: impl Fn(f64, f64) -> SVector<f64, N>,
) -> (SMatrix<f64, N, N>, SVector<f64, N>) {
    let (mut normal, mut right) = (SMatrix::<f64, N, N>::zeros(), SVector::<f64, N>::zeros());
    #[expect(clippy::cast_possible_truncation, reason = "mm")]
    let radius = trial.disc.radius as f32;
    let oval = trial.most_off();
    for e in edges {
        let ring = (width * radius).max(RING_PX * e.scale);
        if is_off(e, &trial.disc, ring + oval) {
            continue;
        }
        let (distance, cosine) = relative(e, &trial.disc);
        if cosine.abs() < LEAST_COSINE {
            continue;
        }
        let (off, [cos, sin]) = trial.off(e, distance);
        if off.abs() >= ring {
            continue;
        }
        let tukey = (1.0 - (off / ring).powi(2)).powi(2);
        // An edge stands for its length; its place is uncertain by pixels.
        let weight = f64::from(tukey * e.length / (e.scale * e.scale * e.scale));
        let row = row(cos, sin);
        let weighted = row * weight;
        for i in 0..N {
            for j in i..N {
                normal[(i, j)] += row[i] * weighted[j];
            }
        }
        right += weighted * f64::from(off);
    }
    normal.fill_lower_triangle_with_upper_triangle();
    // Too short an arc does not fix a circle: keep it still rather than let it run.
    let damping = 1e-3 * normal[(2, 2)];
    for i in 0..3 {
        normal[(i, i)] += damping;
    }
    (normal, right)
}

/// A circle after a step; none where it has gone astray.
fn moved(trial: &Trial, disc: [f64; 3], oval: [f64; 2]) -> Option<Trial> {
    let disc = Disc { x: trial.disc.x + disc[0], y: trial.disc.y + disc[1], radius: trial.disc.radius + disc[2] };
    let mut oval = [trial.oval[0] + oval[0], trial.oval[1] + oval[1]];
    let (size, most) = (oval[0].hypot(oval[1]), trial.most_oval * disc.radius);
    if size > most {
        oval = oval.map(|o| o * most / size);
    }
    (disc.radius > 0.0 && disc.x.is_finite() && disc.y.is_finite()).then_some(Trial { disc, oval, ..*trial })
}

/// The edges along a circle.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "bins")]
fn support(edges: &[GroundEdge], trial: &Trial) -> Arc {
    let disc = &trial.disc;
    let radius = disc.radius as f32;
    let (mut bright_outside, mut bright_inside) = ([0.0_f32; BINS], [0.0_f32; BINS]);
    let (mut squares, mut contrast, mut length) = (0.0_f64, 0.0_f64, 0.0_f64);
    let (mut other, mut scales, mut count) = (0.0_f64, 0.0_f64, 0_usize);
    for e in edges {
        let (distance, cosine) = relative(e, disc);
        let off = trial.off(e, distance).0.abs();
        if off < 0.25 * radius {
            scales += f64::from(e.scale);
            count += 1;
            if cosine.abs() < OTHER_COSINE {
                other += f64::from(e.length);
            }
        }
        if cosine.abs() < LEAST_COSINE || off > RING_PX * e.scale {
            continue;
        }
        let angle = (e.y - disc.y as f32).atan2(e.x - disc.x as f32).rem_euclid(std::f32::consts::TAU);
        let bin = ((angle / std::f32::consts::TAU * BINS as f32) as usize).min(BINS - 1);
        if cosine > 0.0 {
            bright_outside[bin] += e.length
        } else {
            bright_inside[bin] += e.length
        }
        let l = f64::from(e.length);
        squares += l * f64::from(off / e.scale).powi(2);
        contrast += l * f64::from(e.contrast);
        length += l;
    }
    let mut bins = [0_i8; BINS];
    for (i, bin) in bins.iter_mut().enumerate() {
        if bright_outside[i].max(bright_inside[i]) >= bin_length(radius) {
            *bin = if bright_outside[i] > bright_inside[i] { 1 } else { -1 };
        }
    }
    let covered = bins.iter().filter(|b| **b != 0).count();
    let scale = scales / (count.max(1)) as f64;
    let ring_area = std::f64::consts::TAU * disc.radius * 0.5 * disc.radius;
    // Other edges fill directions from 40 to 90 degrees off, those that would be taken for the rim's 0 to 18 degrees.
    let alike = other / ring_area * (18.0 / 50.0);
    Arc {
        disc: *disc,
        oval: trial.oval,
        bins,
        coverage: covered as f64 / BINS as f64,
        residual_px: (squares / length.max(1e-9)).sqrt(),
        contrast: contrast / length.max(1e-9),
        chance: (alike * 2.0 * f64::from(RING_PX) * scale).min(1.0),
        perimeter_px: std::f64::consts::TAU * disc.radius / scale.max(1e-9),
    }
}

/// Length of edges that covers a bin of a circle.
#[expect(clippy::cast_precision_loss, reason = "bins")]
pub(super) fn bin_length(radius: f32) -> f32 {
    BIN_SHARE * std::f32::consts::TAU * radius / BINS as f32
}

impl Arc {
    /// The same about the same centre, larger.
    pub(super) fn scaled(&self, ratio: f64) -> Self {
        let disc = Disc { radius: self.disc.radius * ratio, ..self.disc };
        Self { disc, oval: self.oval.map(|o| o * ratio), ..self.clone() }
    }

    /// The place of the curve at an angle about its centre (radians from X), in mm on the plane Z = 0.
    pub(super) fn at(&self, angle: f64) -> [f64; 2] {
        let radius = self.disc.radius + self.oval[0] * (2.0 * angle).cos() + self.oval[1] * (2.0 * angle).sin();
        [self.disc.x + radius * angle.cos(), self.disc.y + radius * angle.sin()]
    }
}
