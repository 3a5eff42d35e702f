//! Sizes of found rims, by the code that measures people's marks.

mod rims;
mod square;

/// The places of an edge share an error of about this many pixels, outward or inward: rims are rounded, lenses blur.
pub(super) const SHARED_PX: f64 = 0.5;
