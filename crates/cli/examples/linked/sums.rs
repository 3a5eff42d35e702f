//! Sums over the containers of all studies.

use std::fmt::{Display, Formatter};

use model::{Kind, ResultRow, median};

use crate::truth::Object;

#[derive(Default)]
pub struct Sums {
    containers: usize,
    found: usize,
    names: usize,
    rims: usize,
    kinds: usize,
    /// Numbers of names whose rims are of one, of several, and of no container.
    of_one: usize,
    of_several: usize,
    of_none: usize,
    frames: Vec<f64>,
    fused: Vec<Fused>,
}

/// A fused diameter.
struct Fused {
    error_pct: f64,
    /// The absolute error, in units of the predicted standard uncertainty.
    off: f64,
    /// The absolute error of the height of the rim's plane.
    height_mm: f64,
    height_pct: f64,
    true_kind: Kind,
    is_kind_right: bool,
}

impl Sums {
    /// Adds a name that rims of so many containers have.
    pub fn name(&mut self, containers: usize) {
        match containers {
            0 => self.of_none += 1,
            1 => self.of_one += 1,
            _ => self.of_several += 1,
        }
    }

    /// Adds a container with so many names, found rims, and found rims of the right kind.
    pub fn container(&mut self, names: usize, rims: usize, kinds: usize) {
        self.containers += 1;
        self.found += usize::from(names > 0);
        self.names += names;
        self.rims += rims;
        self.kinds += kinds;
    }

    /// Adds a diameter that was measured in one image.
    pub fn frame(&mut self, row: &ResultRow, object: &Object) {
        self.frames.extend(row.predicted_mm.map(|mm| 100.0 * (mm / object.diameter_mm - 1.0).abs()));
    }

    /// Adds the fused diameter of a container's most frequent name, and returns a text about it.
    pub fn fused(&mut self, row: &ResultRow, object: &Object) -> String {
        let (Some(mm), Some(sigma_mm), Some(height_mm)) = (row.predicted_mm, row.sigma_mm, row.plane_z_mm) else {
            return "not measured".to_owned();
        };
        let error_pct = 100.0 * (mm / object.diameter_mm - 1.0);
        self.fused.push(Fused {
            error_pct: error_pct.abs(),
            off: (mm - object.diameter_mm).abs() / sigma_mm,
            height_mm: (height_mm - object.level_mm).abs(),
            height_pct: 100.0 * (height_mm / object.level_mm - 1.0).abs(),
            true_kind: object.kind,
            is_kind_right: row.kind == object.kind,
        });
        let level_mm = object.level_mm;
        format!("{mm:5.1} mm ({error_pct:+5.1} %, sigma {sigma_mm:4.1} mm), rim {height_mm:4.1} of {level_mm:4.1} mm")
    }

    fn of_fused(&self, value: impl Fn(&Fused) -> f64) -> String {
        quantiles_text(self.fused.iter().map(value).collect())
    }
}

impl Display for Sums {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let fused = self.fused.len();
        let right = self.fused.iter().filter(|fused| fused.is_kind_right).count();
        let within = |k: f64| self.fused.iter().filter(|fused| fused.off <= k).count();
        let bowls = self.fused.iter().filter(|fused| fused.true_kind == Kind::Bowl).map(|fused| fused.height_pct);
        writeln!(f, "containers found: {} of {}, in {} images", self.found, self.containers, self.rims)?;
        writeln!(f, "names of one, several, no container: {}, {}, {}", self.of_one, self.of_several, self.of_none)?;
        writeln!(f, "names per container found: {:.2}", ratio(self.names, self.found))?;
        writeln!(
            f,
            "kind right: of images {:.0} %, of fused {right} of {fused}",
            100.0 * ratio(self.kinds, self.rims)
        )?;
        writeln!(f, "diameter of one image, absolute error in %: {}", quantiles_text(self.frames.clone()))?;
        writeln!(f, "diameter fused, absolute error in %: {}", self.of_fused(|fused| fused.error_pct))?;
        writeln!(f, "fused diameters within 1, 1.96 sigma: {}, {} of {fused}", within(1.0), within(1.96))?;
        writeln!(f, "height of the rim, absolute error in mm: {}", self.of_fused(|fused| fused.height_mm))?;
        writeln!(f, "height of bowls, absolute error in %: {}", quantiles_text(bowls.collect()))
    }
}

#[expect(clippy::cast_precision_loss, reason = "some thousand rims")]
fn ratio(part: usize, whole: usize) -> f64 {
    part as f64 / whole.max(1) as f64
}

/// Median, 95 % quantile, and greatest of the values as text.
fn quantiles_text(mut values: Vec<f64>) -> String {
    values.sort_by(f64::total_cmp);
    let Some(worst) = values.last() else { return "none".to_owned() };
    let q95 = values[(values.len() * 95).div_ceil(100) - 1];
    format!("median {:.2}, q95 {q95:.2}, worst {worst:.2} ({} values)", median(values.clone()), values.len())
}
