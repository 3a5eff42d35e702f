//! File patterns of a profile.

use globset::{GlobBuilder, GlobSet, GlobSetBuilder};

use crate::unicode::nfc;

/// Patterns relative to the card: `*` stays within a folder, `**` does not; upper and lower case differ, Unicode forms do not. Hidden files (a
/// part of the path begins with `.`, as in `._A.JPG` of macOS) fit only if a pattern itself names something hidden.
#[derive(Debug, Clone)]
pub struct Patterns {
    globs: GlobSet,
    fits_hidden: bool,
}

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
        Self::compile(patterns, false)
    }

    /// These patterns, for names in upper or lower case.
    pub(super) fn any_case(patterns: &[String]) -> Result<Self, PatternError> {
        Self::compile(patterns, true)
    }

    fn compile(patterns: &[String], any_case: bool) -> Result<Self, PatternError> {
        let error = |pattern: &str, error: &globset::Error| PatternError {
            pattern: pattern.to_owned(),
            why: error.kind().to_string(),
        };
        let mut set = GlobSetBuilder::new();
        for pattern in patterns {
            let glob = GlobBuilder::new(&nfc(pattern)).literal_separator(true).case_insensitive(any_case).build();
            set.add(glob.map_err(|e| error(pattern, &e))?);
        }
        let globs = set.build().map_err(|e| error(&patterns.join(" "), &e))?;
        Ok(Self { globs, fits_hidden: patterns.iter().any(|pattern| is_hidden(pattern)) })
    }

    /// Whether a path relative to the card, with `/`, fits one of them.
    #[must_use]
    pub fn fits(&self, path: &str) -> bool {
        (self.fits_hidden || !is_hidden(path)) && self.globs.is_match(nfc(path))
    }
}

/// Whether a part of the path begins with a dot.
pub(super) fn is_hidden(path: &str) -> bool {
    path.split('/').any(|part| part.starts_with('.'))
}
