//! File patterns of a profile.

use globset::{GlobBuilder, GlobSet, GlobSetBuilder};

/// Patterns relative to the card: `*` stays within a folder, `**` does not; upper and lower case differ.
#[derive(Debug, Clone)]
pub struct Patterns(GlobSet);

/// A pattern that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("'{pattern}' is not a file pattern: {why}")]
pub struct PatternError {
    pattern: String,
    why: String,
}

impl Patterns {
    /// Compiles patterns.
    ///
    /// # Errors
    /// [`PatternError`] names the first one that cannot be used.
    pub fn new(patterns: &[String]) -> Result<Self, PatternError> {
        let error = |pattern: &str, error: &globset::Error| PatternError {
            pattern: pattern.to_owned(),
            why: error.kind().to_string(),
        };
        let mut set = GlobSetBuilder::new();
        for pattern in patterns {
            set.add(GlobBuilder::new(pattern).literal_separator(true).build().map_err(|e| error(pattern, &e))?);
        }
        set.build().map(Self).map_err(|e| error(&patterns.join(" "), &e))
    }

    /// Whether a path relative to the card, with `/`, fits one of them.
    #[must_use]
    pub fn fits(&self, path: &str) -> bool {
        self.0.is_match(path)
    }
}
