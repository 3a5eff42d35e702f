//! Rims of plates and bowls found without marks.

mod arcs;
mod buckets;
mod chains;
mod edges;
mod ground;
mod scaled;
mod votes;

use ingest::Picture;
use model::View;

use arcs::Arc;
use buckets::Buckets;
use scaled::Scaled;

/// The pose may be wrong by as much, in radians (17 mg of zero-g offset per degree).
const POSE_ERROR_RAD: f64 = 0.03;

/// How far from round a level circle looks for an error of the pose: half of what stretches it, cot(depression) per radian.
fn most_oval(view: &View, disc: &votes::Disc) -> f64 {
    let away = disc.x.hypot(disc.y) / view.pose().camera_height_mm();
    0.01 + 0.5 * POSE_ERROR_RAD * away
}

/// Dump for development.
pub fn dump(picture: &Picture, view: &View) -> Vec<[f64; 9]> {
    let t = std::time::Instant::now();
    let lap = |what: &str| eprintln!("{what} {:.1} ms", t.elapsed().as_secs_f64() * 1e3);
    let scaled = Scaled::of(picture);
    lap("scaled");
    let edges = ground::ground_edges(view, &scaled);
    lap(&format!("edges {}", edges.len()));
    let likely = votes::likely_discs(&edges, [25.0, 330.0]);
    lap(&format!("votes {}", likely.len()));
    let buckets = Buckets::new(&edges);
    let mut arcs: Vec<(Arc, f32)> =
        likely.iter().filter_map(|(disc, share)| Some((arcs::fit(&buckets, disc, most_oval(view, disc))?, *share))).collect();
    lap("fit");
    arcs.sort_by(|a, b| b.0.coverage.total_cmp(&a.0.coverage));
    arcs.iter()
        .map(|(a, share)| {
            let polarity: i32 = a.bins.iter().map(|b| i32::from(*b)).sum();
            [
                a.disc.x,
                a.disc.y,
                a.disc.radius,
                a.coverage,
                a.residual_px,
                a.contrast,
                a.chance,
                f64::from(*share),
                f64::from(polarity) / 72.0,
            ]
        })
        .collect()
}
