//! How well the pictures of a study with truth.json (sessions, images with pose, heading and place) are tied:
//! `cargo run --release -p aim-batch-ties --example tied -- STUDY CAMERA.toml [PITCH_ERROR_DEG] [RANGE_FACTOR]`
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "an example for developers")]

use std::time::Instant;

use aim_batch_ties::{Disc, Feature, features, register, tie};
use ingest::Picture;
use model::{Pose, View};
use nalgebra::{Point2, Rotation2, Vector2};
use serde_json::Value;

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

struct Shot {
    features: Vec<Feature>,
    heading_rad: f64,
    foot: Vector2<f64>,
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let pitch_error = args.get(2).map_or(0.0, |text| text.parse::<f64>().unwrap());
    let range_factor = args.get(3).map_or(1.0, |text| text.parse::<f64>().unwrap());
    let camera = ingest::camera::read_file(args[1].as_ref()).unwrap().camera().unwrap();
    let truth: Value = serde_json::from_slice(&std::fs::read(format!("{}/truth.json", args[0])).unwrap()).unwrap();
    let mut all: Vec<Vec<Shot>> = Vec::new();
    for session in truth["sessions"].as_array().unwrap() {
        let mut shots = Vec::new();
        for image in session["images"].as_array().unwrap() {
            let path = format!(
                "{}/cards/{}/{}",
                args[0],
                session["session"].as_str().unwrap(),
                image["file"].as_str().unwrap()
            );
            let picture = Picture::decode(&std::fs::read(path).unwrap()).unwrap();
            let pitch = (number(&image["pitch_deg"]) + pitch_error).to_radians();
            let pose = Pose::new(
                pitch,
                number(&image["roll_deg"]).to_radians(),
                range_factor * number(&image["axis_range_mm"]),
            )
            .unwrap();
            let view = View::new(camera, pose);
            let mut discs = Vec::new();
            for container in image["containers"].as_array().unwrap() {
                let pixels: Vec<Point2<f64>> = container["rim_px"]
                    .as_array()
                    .unwrap()
                    .iter()
                    .map(|p| Point2::new(number(&p[0]), number(&p[1])))
                    .collect();
                let on: Vec<Point2<f64>> = pixels.iter().filter_map(|p| view.on_plane(*p, 0.0).ok()).collect();
                if on.is_empty() {
                    continue;
                }
                let center_mm = Point2::from(on.iter().map(|p| p.coords).sum::<Vector2<f64>>() / on.len() as f64);
                let radius_mm = on.iter().map(|p| (p - center_mm).norm()).fold(0.0, f64::max) + 10.0;
                discs.push(Disc { center_mm, radius_mm });
            }
            let start = Instant::now();
            let features = features(&picture, &view, &discs);
            println!("  {} features in {:.0} ms", features.len(), start.elapsed().as_secs_f64() * 1e3);
            let place = &image["camera_mm"];
            shots.push(Shot {
                features,
                heading_rad: number(&image["heading_deg"]).to_radians(),
                foot: Vector2::new(number(&place[0]), number(&place[1])),
            });
        }
        println!("session {} on {}", session["session"], session["table"]);
        for a in 0..shots.len() {
            for b in a + 1..shots.len() {
                let start = Instant::now();
                let found = register(&shots[a].features, &shots[b].features);
                let ms = start.elapsed().as_secs_f64() * 1e3;
                let turn = shots[b].heading_rad - shots[a].heading_rad;
                let shift = Rotation2::new(-shots[a].heading_rad) * (shots[b].foot - shots[a].foot);
                match found {
                    None => println!("  {a} {b}: none ({ms:.0} ms)"),
                    Some(r) => println!(
                        "  {a} {b}: {} of {}, turn {:+.1} deg (true {:+.1}), shift ({:.0}, {:.0}) off by {:.1} mm ({ms:.0} ms)",
                        r.inliers.len(),
                        r.candidates,
                        r.turn_rad.to_degrees(),
                        turn.to_degrees(),
                        r.shift_mm.x,
                        r.shift_mm.y,
                        (r.shift_mm - shift).norm()
                    ),
                }
            }
        }
        let features: Vec<Vec<Feature>> = shots.iter().map(|shot| shot.features.clone()).collect();
        let ties = tie(&features);
        println!(
            "  tied {:?}, {} points, links {:?}",
            ties.placed.iter().map(Option::is_some).collect::<Vec<_>>(),
            ties.points.len(),
            ties.registered
        );
        all.push(shots);
    }
    let (mut pairs, mut wrong) = (0, 0);
    for (s, one) in all.iter().enumerate() {
        for other in &all[s + 1..] {
            for a in one {
                for b in other {
                    pairs += 1;
                    if let Some(r) = register(&a.features, &b.features) {
                        wrong += 1;
                        println!("  false: {} of {}", r.inliers.len(), r.candidates);
                    }
                }
            }
        }
    }
    println!("pairs of different sessions: {pairs}, registered {wrong}");
}
