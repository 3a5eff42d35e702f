//! What a range sensor writes where it sees no target.

use serde::{Deserialize, Serialize};

/// A number or a word that stands for 'no target'.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum NoTarget {
    /// A number, in the unit of the file.
    Number(f64),
    /// A word, which only a CSV file can hold. Upper and lower case are the same.
    Word(String),
}

impl NoTarget {
    /// The number that it is, also where it stands between quotes.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Word(word) => word.trim().parse().ok().filter(|number: &f64| number.is_finite()),
        }
    }
}
