//! The fitted numbers, from `weights.toml` beside this crate's manifest.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

/// The number of features of the confidence of a round rim.
pub const FEATURES: usize = 10;
/// The number of features of the confidence of a rectangle.
pub const SQUARE_FEATURES: usize = 15;
/// The number of features of a pair of edges.
pub const RING_FEATURES: usize = 5;

/// The features of the confidence of a round rim, in the order of [`Evidence::features`](crate::Evidence::features).
pub(crate) const ROUND: [&str; FEATURES] =
    ["constant", "coverage", "false_alarms", "steady", "residual", "far", "longest", "sharp", "contrast", "visible"];
/// The features of the confidence of a rectangle, in the order of [`SquareEvidence::features`](crate::SquareEvidence::features).
pub(crate) const SQUARE: [&str; SQUARE_FEATURES] = [
    "constant",
    "coverage",
    "least_side",
    "steady",
    "beyond",
    "corners",
    "below",
    "least_below",
    "below_alone",
    "clutter",
    "sharp",
    "contrast",
    "rough_in",
    "rough_out",
    "unlike",
];
/// The features of a pair of edges, in the order of [`RingPair::features`](crate::RingPair).
pub(crate) const RING: [&str; RING_FEATURES] = ["constant", "colour", "hue", "inner_seen", "outer_seen"];

/// A set of fitted numbers, and where they are from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FittedSet {
    /// The meaning of the numbers.
    pub about: String,
    /// Seeds of the rendered tables that they were fitted on.
    pub seeds: Vec<u64>,
    /// The number of cases in the fit; 0 where it was not written down.
    pub cases: usize,
    /// The day of the fit, `YYYY-MM-DD`.
    pub date: String,
    /// The examples that write the cases, with their arguments.
    pub cases_from: String,
    /// The outcome of the last time that the set was fitted again from those cases.
    pub refit: String,
    /// Names of the features.
    pub features: Vec<String>,
    /// The number of each feature, in the same order. No unit.
    pub weights: Vec<f64>,
}

/// The file, as the program was built with it.
#[must_use]
pub fn weights_toml() -> &'static str {
    include_str!("../weights.toml")
}

/// All sets of the file by name.
///
/// # Panics
/// Where the file is not of this form: a test holds that it is.
#[must_use]
pub fn fitted_sets() -> BTreeMap<String, FittedSet> {
    toml::from_str(weights_toml()).expect("weights.toml is a part of this crate")
}

/// The numbers of a set in the order of these features.
fn weights<const N: usize>(set: &str, features: [&str; N]) -> [f64; N] {
    let FittedSet { features: names, weights, .. } = &fitted_sets()[set];
    let found = names.iter().zip(weights).collect::<BTreeMap<_, _>>();
    features.map(|feature| *found[&feature.to_owned()])
}

pub(crate) static ROUND_CONFIDENCE: LazyLock<[f64; FEATURES]> = LazyLock::new(|| weights("round_confidence", ROUND));
pub(crate) static SQUARE_CONFIDENCE: LazyLock<[f64; SQUARE_FEATURES]> =
    LazyLock::new(|| weights("square_confidence", SQUARE));
pub(crate) static RING_ODDS: LazyLock<[f64; RING_FEATURES]> = LazyLock::new(|| weights("ring", RING));
/// The logarithm of the odds of a plate against a bowl is so much too large.
pub(crate) static TOO_SURE_OF_KIND: LazyLock<f64> = LazyLock::new(|| weights("kind", ["too_sure"])[0]);
/// Share of what is taken for a bowl's foot or floor that is none, and the same of plates: a plate hides its foot, and prints and
/// food look like its well.
pub(crate) static MISTAKEN: LazyLock<Mistaken> = LazyLock::new(|| {
    let [bowl, plate] = weights("mistaken", ["bowl", "plate"]);
    Mistaken { bowl, plate }
});

/// Shares from 0 to 1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mistaken {
    pub bowl: f64,
    pub plate: f64,
}

#[cfg(test)]
mod tests {
    use super::{
        MISTAKEN, RING, RING_ODDS, ROUND, ROUND_CONFIDENCE, SQUARE, SQUARE_CONFIDENCE, TOO_SURE_OF_KIND, fitted_sets,
    };

    #[test]
    fn the_file_has_every_feature_once_and_no_other() {
        let sets = fitted_sets();
        let expected: [(&str, &[&str]); 5] = [
            ("round_confidence", &ROUND),
            ("square_confidence", &SQUARE),
            ("ring", &RING),
            ("kind", &["too_sure"]),
            ("mistaken", &["bowl", "plate"]),
        ];
        assert_eq!(sets.len(), expected.len());
        for (name, features) in expected {
            let set = &sets[name];
            assert_eq!(set.features, features, "{name}");
            assert_eq!(set.weights.len(), features.len(), "{name}");
            assert!(set.weights.iter().all(|weight| weight.is_finite()) && !set.seeds.is_empty(), "{name}");
        }
    }

    /// More of a rim, steadier, sharper and seen better is likelier one; noise is not. The signs hold whatever a fit gives.
    #[test]
    fn weights_have_the_signs_that_they_must_have() {
        assert!(ROUND_CONFIDENCE[1] > 0.0 && ROUND_CONFIDENCE[4] < 0.0 && ROUND_CONFIDENCE[7] > 0.0);
        assert!(SQUARE_CONFIDENCE[1] > 0.0 && SQUARE_CONFIDENCE[4] < 0.0 && RING_ODDS[4] > 0.0);
        assert!(*TOO_SURE_OF_KIND >= 1.0);
        assert!((0.0..1.0).contains(&MISTAKEN.bowl) && (0.0..1.0).contains(&MISTAKEN.plate));
    }
}
