//! Statistics that say how good sizes and their uncertainties are.

mod agreement;
mod bootstrap;
mod coverage;
mod paired;
mod summary;

pub use agreement::{Agreement, agreement};
pub use bootstrap::{Interval, bootstrap};
pub use coverage::{Coverage, coverage};
pub use paired::{Paired, paired};
pub use summary::{ErrorSummary, quantile};
