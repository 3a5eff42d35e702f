//! Height and wall slope of one bowl from several pictures.

use nalgebra::{Matrix2, Vector2};

use crate::fusion::{Share, combined};
use crate::marks::ObjectMarks;
use crate::measure::{HeightLine, MeasureError, Numbered, camera_height, possible_height};
use crate::sensed::Sensed;
use crate::uncertainty::{InputSigma, Sensitivity, SizeSigma};
use crate::view::View;

/// A wall as one picture shows it: foot at distance a, rim at distance b from the point under the camera, both on Z = 0.
///
/// A rim H above the table that overhangs its foot by s is seen at b with b (c - H) = c (a + s), so that
/// b - a = H b / c + s: a straight line over pictures, with slope H and intercept s.
#[derive(Debug, Clone, PartialEq)]
pub struct Sight {
    view: View,
    /// b - a.
    projected: Sensed,
    /// b / c, the cotangent of the depression of the rim's ray.
    cotangent: Sensed,
}

impl Sight {
    /// Cotangent of the depression at which the rim is seen.
    #[must_use]
    pub fn cotangent(&self) -> f64 {
        self.cotangent.value
    }

    /// What b - a - H b/c changes by.
    fn sensitivity(&self, height_mm: f64, share: f64) -> Sensitivity {
        let terms = [(share, &self.projected), (-share * height_mm, &self.cotangent)];
        let residual = Sensed::of_numbers(0.0, terms, self.projected.points());
        Sensitivity { by_source: residual.by_source, marks_mm_per_px: residual.by_mark.norm() }
    }
}

/// The height lines marked on one picture.
///
/// # Errors
/// [`MeasureError`] where an end has no place on the table.
pub fn sights(view: &View, marks: &ObjectMarks) -> Result<Vec<Sight>, MeasureError> {
    let numbered = Numbered::from_marks(marks);
    let of_line = |line: HeightLine| {
        let [foot, rim] = line.distances(view, numbered.points)?;
        let above = camera_height(view, numbered.points);
        let cotangent = rim.value / above.value;
        Ok(Sight {
            view: *view,
            projected: Sensed::of_numbers(rim.value - foot.value, [(1.0, &rim), (-1.0, &foot)], numbered.points),
            cotangent: Sensed::of_numbers(
                cotangent,
                [(1.0 / above.value, &rim), (-cotangent / above.value, &above)],
                numbered.points,
            ),
        })
    };
    numbered.height_lines().map(of_line).collect()
}

/// Why several pictures do not give a height together.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum JointError {
    /// One picture shows no slope.
    #[error("the rim is seen in {0} pictures; height and wall slope together need two or more, at different pitches")]
    TooFew(usize),
    /// The rim is seen under all but the same angle.
    #[error(
        "the pictures show the wall from too much the same angle: {height_mm:.0} mm with an uncertainty of {sigma_mm:.0} mm; \
         use pictures whose pitches differ by 10 degrees or more"
    )]
    TooAlike {
        /// The height that they would give.
        height_mm: f64,
        /// Its standard uncertainty.
        sigma_mm: f64,
    },
    /// A height that the wall cannot have.
    #[error(transparent)]
    Impossible(#[from] MeasureError),
}

impl JointError {
    /// Stable code, as in the `flags` of the results.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::TooFew(_) => "too_few_pictures",
            Self::TooAlike { .. } => "pictures_too_alike",
            Self::Impossible(error) => error.code(),
        }
    }
}

/// Height and overhang from several pictures.
#[derive(Debug, Clone, PartialEq)]
pub struct JointHeight {
    /// Height of the rim.
    pub height_mm: f64,
    /// How far the rim overhangs its foot, away from the wearer.
    pub overhang_mm: f64,
    /// What the height changes by through each picture.
    pub shares: Vec<Sensitivity>,
    /// Uncertainties of each picture.
    pub inputs: Vec<InputSigma>,
    /// Its uncertainty.
    pub sigma: SizeSigma,
}

impl JointHeight {
    /// Uncertainty of a size that was measured on this height's plane in each picture and then fused. `shares`: the sizes on
    /// the plane taken as exact, with pictures numbered as [`joint_height`] had them; `weights`: as [`fuse`](crate::fuse())
    /// gave them; `camera_heights_mm`: of each share's picture above the table. Lifting a plane scales it about the point
    /// under the camera, so a size changes by -size / (c - H) per height.
    #[must_use]
    pub fn sigma_on_plane(&self, shares: &[Share], weights: &[f64], camera_heights_mm: &[f64]) -> SizeSigma {
        let by_height: f64 = shares
            .iter()
            .zip(weights)
            .zip(camera_heights_mm)
            .map(|((share, w), c)| -w * share.value_mm / (c - self.height_mm))
            .sum();
        let of_sizes = shares.iter().zip(weights).map(|(s, w)| (*w, &s.sensitivity, &s.inputs, s.picture));
        let of_height = self.shares.iter().zip(&self.inputs).enumerate();
        combined(of_sizes.chain(of_height.map(|(picture, (s, inputs))| (by_height, s, inputs, picture))))
    }
}

/// A height whose uncertainty is more than this share of it is none: beyond it, first order means nothing.
const LARGEST_SHARE: f64 = 0.35;

/// Weighted line through the sights of pictures, each with its own inputs. Pictures must be different ones; lines of one
/// picture are averaged before.
///
/// # Errors
/// [`JointError`] where the pictures do not determine a height.
pub fn joint_height(pictures: &[(Vec<Sight>, InputSigma)]) -> Result<JointHeight, JointError> {
    let pictures: Vec<(Sight, &InputSigma)> =
        pictures.iter().filter_map(|(sights, inputs)| Some((mean(sights)?, inputs))).collect();
    if pictures.len() < 2 {
        return Err(JointError::TooFew(pictures.len()));
    }
    let mut height_mm = 0.0;
    let (mut by_picture, mut overhang_mm) = (Vec::new(), 0.0);
    // The weights depend on the height, weakly.
    for _ in 0..3 {
        let (coefficients, solution) = line(&pictures, height_mm)?;
        by_picture = coefficients;
        height_mm = solution.x;
        overhang_mm = solution.y;
    }
    let shares: Vec<Sensitivity> =
        pictures.iter().zip(&by_picture).map(|((sight, _), a)| sight.sensitivity(height_mm, *a)).collect();
    let terms = shares.iter().zip(&pictures).enumerate().map(|(i, (share, (_, inputs)))| (1.0, share, *inputs, i));
    let sigma = combined(terms);
    for (sight, _) in &pictures {
        possible_height(&sight.view, height_mm)?;
    }
    if sigma.total_mm > LARGEST_SHARE * height_mm {
        return Err(JointError::TooAlike { height_mm, sigma_mm: sigma.total_mm });
    }
    let inputs = pictures.iter().map(|(_, inputs)| **inputs).collect();
    Ok(JointHeight { height_mm, overhang_mm, shares, inputs, sigma })
}

fn mean(sights: &[Sight]) -> Option<Sight> {
    let of = |number: fn(&Sight) -> &Sensed| {
        Sensed::mean(&sights.iter().map(|sight| number(sight).clone()).collect::<Vec<_>>())
    };
    Some(Sight { view: sights.first()?.view, projected: of(|s| &s.projected)?, cotangent: of(|s| &s.cotangent)? })
}

/// Derivative of the height by each picture's b - a, and the solution (H, s) of the weighted normal equations.
fn line(pictures: &[(Sight, &InputSigma)], height_mm: f64) -> Result<(Vec<f64>, Vector2<f64>), JointError> {
    let weights: Vec<f64> = pictures
        .iter()
        .map(|(sight, inputs)| {
            let sensitivity = sight.sensitivity(height_mm, 1.0);
            let noise = sensitivity.by_noise().map(|d| d * d).dot(&inputs.noise());
            let marks = (sensitivity.marks_mm_per_px * inputs.mark_px).powi(2);
            (noise + marks).max(1e-12).recip()
        })
        .collect();
    let (mut normal, mut right) = (Matrix2::zeros(), Vector2::zeros());
    for ((sight, _), weight) in pictures.iter().zip(&weights) {
        let row = Vector2::new(sight.cotangent.value, 1.0);
        normal += row * row.transpose() * *weight;
        right += row * (sight.projected.value * weight);
    }
    let alike = JointError::TooAlike { height_mm, sigma_mm: f64::INFINITY };
    let inverse = normal.try_inverse().filter(|m| m.iter().all(|c| c.is_finite())).ok_or(alike)?;
    let by_picture = pictures
        .iter()
        .zip(&weights)
        .map(|((sight, _), weight)| (inverse.row(0) * Vector2::new(sight.cotangent.value, 1.0)).x * weight)
        .collect();
    Ok((by_picture, inverse * right))
}
