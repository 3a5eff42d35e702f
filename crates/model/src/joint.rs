//! The height and the wall slope of one bowl from several pictures.

use nalgebra::{Matrix2, Vector2};

use crate::fusion::{Part, Share, combined_sigma, parts_of_sum};
use crate::marks::ObjectMarks;
use crate::measure::{HeightLine, Judge, MeasureError, Numbered, camera_height, possible_height};
use crate::sensed::Sensed;
use crate::sigma::{InputSigma, Sensitivity, SizeSigma};
use crate::view::View;

/// A wall as one picture shows it: on Z = 0 its foot is at the distance a from the point under the camera, and its rim at the
/// distance b.
///
/// With c the height of the camera, a rim that is H above the table and overhangs its foot by s is seen at
/// b (c - H) = c (a + s). So b - a = H b / c + s, which is a straight line over pictures, with the slope H and the intercept s.
#[derive(Debug, Clone, PartialEq)]
pub struct Sight {
    view: View,
    /// b - a, in mm.
    projected: Sensed,
    /// b / c, the cotangent of the depression of the ray to the rim.
    cotangent: Sensed,
}

impl Sight {
    /// The cotangent of the depression at which the rim is seen.
    #[must_use]
    pub fn cotangent(&self) -> f64 {
        self.cotangent.value
    }

    /// The derivatives of weight (b - a - H b / c), where H is `height_mm`.
    fn sensitivity(&self, height_mm: f64, weight: f64) -> Sensitivity {
        let terms = [(weight, &self.projected), (-weight * height_mm, &self.cotangent)];
        let residual = Sensed::of_numbers(0.0, terms, self.projected.points());
        Sensitivity { by_source: residual.by_source, marks_mm_per_px: residual.by_mark.norm() }
    }
}

/// The walls that the height lines on one picture show, one for each line that does not contradict the others.
///
/// # Errors
/// [`MeasureError`] when an end of a line has no place on the table, and when lines contradict each other.
pub fn sights(view: &View, marks: &ObjectMarks, inputs: &InputSigma) -> Result<Vec<Sight>, MeasureError> {
    let numbered = Numbered::from_marks(marks);
    let sight = |line: HeightLine| {
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
    let agreeing = numbered.agreeing_height_lines(view, &Judge::new(inputs))?;
    agreeing.into_iter().map(sight).collect()
}

/// The reason why several pictures do not give a height together.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum JointError {
    /// There are fewer than two pictures, and one does not show the slope.
    #[error("the rim is seen in {0} pictures; height and wall slope together need two or more, at different pitches")]
    TooFew(usize),
    /// The rim is seen at nearly the same angle in all pictures.
    #[error(
        "the pictures show the wall from too much the same angle: {height_mm:.0} mm with an uncertainty of {sigma_mm:.0} mm; \
         use pictures whose pitches differ by 10 degrees or more"
    )]
    TooAlike {
        /// The height that the pictures would give.
        height_mm: f64,
        /// The standard uncertainty of that height.
        sigma_mm: f64,
    },
    /// The height is one that the wall cannot have.
    #[error(transparent)]
    Impossible(#[from] MeasureError),
}

impl JointError {
    /// The stable code of the error, which stands in the `flags` of the results.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::TooFew(_) => "too_few_pictures",
            Self::TooAlike { .. } => "pictures_too_alike",
            Self::Impossible(error) => error.problem_code().code(),
        }
    }
}

/// The height and the overhang of a wall from several pictures.
#[derive(Debug, Clone, PartialEq)]
pub struct JointHeight {
    /// Height of the rim above the table.
    pub height_mm: f64,
    /// How far the rim overhangs the foot, away from the wearer.
    pub overhang_mm: f64,
    /// The parts of the height from each picture.
    pub parts: Vec<Part>,
    /// Standard uncertainty of the height.
    pub sigma: SizeSigma,
}

impl JointHeight {
    /// The parts of a size that was measured on the plane at this height in each picture, and then fused. `shares`: the
    /// sizes on the plane, taken as exact. `weights`: those that [`fuse`](crate::fuse()) gave. `camera_heights_mm`: the height of
    /// the camera above the table for each share. Lifting a plane scales it about the point under the camera, so a size
    /// changes by -size / (c - H) per height.
    #[must_use]
    pub fn parts_on_plane(&self, shares: &[Share], weights: &[f64], camera_heights_mm: &[f64]) -> Vec<Part> {
        let by_height: f64 = shares
            .iter()
            .zip(weights)
            .zip(camera_heights_mm)
            .map(|((share, w), c)| -w * share.value_mm / (c - self.height_mm))
            .sum();
        let height_parts = self.parts.iter().map(|part| part.scaled(by_height));
        parts_of_sum(shares, weights).into_iter().chain(height_parts).collect()
    }
}

/// The walls that one picture shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Sights {
    /// One for each height line, at least one.
    pub walls: Vec<Sight>,
    /// The uncertainties of the picture's inputs.
    pub inputs: InputSigma,
    /// The number of the picture.
    pub picture: usize,
}

/// A height is refused when its uncertainty is more than this share of it, beyond which first order has no meaning.
const LARGEST_SHARE: f64 = 0.35;

/// The height and the overhang by a weighted straight line through the sights of all pictures. Each picture must be given only
/// once; the sights of one picture are averaged.
///
/// # Errors
/// [`JointError`] when the pictures do not determine a height.
pub fn joint_height(pictures: &[Sights]) -> Result<JointHeight, JointError> {
    let pictures: Vec<(Sight, &Sights)> =
        pictures.iter().filter_map(|sights| Some((mean_sight(&sights.walls)?, sights))).collect();
    if pictures.len() < 2 {
        return Err(JointError::TooFew(pictures.len()));
    }
    let mut height_mm = 0.0;
    let (mut by_picture, mut overhang_mm) = (Vec::new(), 0.0);
    // The weights depend weakly on the height.
    for _ in 0..3 {
        let (coefficients, solution) = weighted_line(&pictures, height_mm)?;
        by_picture = coefficients;
        height_mm = solution.x;
        overhang_mm = solution.y;
    }
    let part = |((sight, Sights { inputs, picture, .. }), a): (&(Sight, &Sights), &f64)| Part {
        sensitivity: sight.sensitivity(height_mm, *a),
        inputs: *inputs,
        picture: *picture,
    };
    let parts: Vec<Part> = pictures.iter().zip(&by_picture).map(part).collect();
    let sigma = combined_sigma(&parts);
    for (sight, _) in &pictures {
        possible_height(&sight.view, height_mm)?;
    }
    if sigma.total_mm > LARGEST_SHARE * height_mm {
        return Err(JointError::TooAlike { height_mm, sigma_mm: sigma.total_mm });
    }
    Ok(JointHeight { height_mm, overhang_mm, parts, sigma })
}

/// The mean of the sights of one picture; `None` when there are none.
fn mean_sight(sights: &[Sight]) -> Option<Sight> {
    let mean = |number: fn(&Sight) -> &Sensed| {
        Sensed::mean(&sights.iter().map(|sight| number(sight).clone()).collect::<Vec<_>>())
    };
    Some(Sight { view: sights.first()?.view, projected: mean(|s| &s.projected)?, cotangent: mean(|s| &s.cotangent)? })
}

/// The derivative of the height by each picture's b - a, and the solution (H, s) of the weighted normal equations.
fn weighted_line(pictures: &[(Sight, &Sights)], height_mm: f64) -> Result<(Vec<f64>, Vector2<f64>), JointError> {
    let weights: Vec<f64> = pictures
        .iter()
        .map(|(sight, Sights { inputs, .. })| {
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
