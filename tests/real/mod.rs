//! Real photographs with known sizes: by `measure`, and by a whole study made of them.
//!
//! The photographs are public sets and not part of this repository; AIM_BATCH_REAL_DATA names the folder that holds them.
//! docs/accuracy.md tells where each comes from and what these tests measured. Poses are given (they stand in for the
//! sensors), marks are corner and edge points found by other programs.

mod auto;
mod boards;
mod discs;
mod rims;
mod squares;
mod study;

use std::path::PathBuf;

use serde_json::Value;

use crate::support::{assert_exit, label_me, run, stdout};

/// One photograph, its pose, and what is marked on it.
pub struct Photo {
    pub path: PathBuf,
    pub camera: String,
    pub pitch_deg: f64,
    pub roll_deg: f64,
    pub range_mm: f64,
    pub kind: &'static str,
    pub shape: &'static str,
    pub rim_height_mm: Option<f64>,
    pub shapes: Vec<Value>,
}

/// A camera file.
pub fn camera_file(size: [u64; 2], focal_px: [f64; 2], principal_px: [f64; 2], lens: &str) -> String {
    format!(
        "schema_version = 1\nname = \"c\"\nwidth_px = {}\nheight_px = {}\nfocal_px = {focal_px:?}\n\
         principal_px = {principal_px:?}\n[lens]\n{lens}\n",
        size[0], size[1],
    )
}

impl Photo {
    /// Sizes by `aim-batch measure`, method `ray`: object, quantity, mm. Every mark must have an answer.
    pub fn measure(&self) -> Vec<(String, String, f64)> {
        self.measure_where_possible()
            .into_iter()
            .map(|(object, quantity, mm)| (object, quantity, mm.unwrap()))
            .collect()
    }

    /// The same, with nothing for a size that has a mark which the lens does not show.
    pub fn measure_where_possible(&self) -> Vec<(String, String, Option<f64>)> {
        let folder = tempfile::tempdir().unwrap();
        let (camera, marks) = (folder.path().join("cam.toml"), folder.path().join("marks.json"));
        std::fs::write(&camera, &self.camera).unwrap();
        std::fs::write(&marks, label_me(self.shapes.clone()).to_string()).unwrap();
        let mut arguments: Vec<String> = ["measure", self.path.to_str().unwrap(), "--json"].map(String::from).into();
        let mut option = |name: &str, value: &str| arguments.push(format!("--{name}={value}"));
        option("camera", camera.to_str().unwrap());
        option("marks", marks.to_str().unwrap());
        option("pitch", &self.pitch_deg.to_string());
        option("roll", &self.roll_deg.to_string());
        option("range", &self.range_mm.to_string());
        option("kind", self.kind);
        option("shape", self.shape);
        if let Some(rim_height_mm) = self.rim_height_mm {
            option("rim-height", &rim_height_mm.to_string());
        }
        let output = run(&arguments);
        let rows: Vec<Value> = serde_json::from_str(&stdout(&output)).unwrap();
        let unanswered = rows.iter().filter(|row| row["predicted_mm"].is_null()).count();
        assert_exit(
            &output,
            if unanswered == 0 {
                0
            } else if unanswered < rows.len() {
                3
            } else {
                1
            },
        );
        let by_ray = rows.iter().filter(|row| row["method"] == "ray");
        let text = |value: &Value| value.as_str().unwrap().to_owned();
        by_ray.map(|r| (text(&r["object"]), text(&r["quantity"]), r["predicted_mm"].as_f64())).collect()
    }
}

/// Bias, spread and worst case of errors in per cent, on one line.
pub fn summary(what: &str, errors_pct: &[f64]) -> model::ErrorStats {
    let stats = model::ErrorStats::from_errors(errors_pct).unwrap();
    println!(
        "{what}: n {}, bias {:+.2} %, SD {:.2} %, mean |error| {:.2} %, median |error| {:.2} %, worst {:+.2} %",
        stats.n,
        stats.mean,
        stats.sample_sd.unwrap_or(f64::NAN),
        stats.mean_absolute,
        stats.median_absolute,
        stats.worst,
    );
    stats
}

pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

pub fn point(value: &Value) -> [f64; 2] {
    [number(&value[0]), number(&value[1])]
}

pub fn cases(path: PathBuf) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}
