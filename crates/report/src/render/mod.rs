//! Tables as text of several kinds.

mod csv;
pub(crate) mod display;
mod latex;
mod markdown;
mod terminal;

pub use self::csv::csv;
pub(crate) use self::csv::{header, record};
pub use latex::latex;
pub use markdown::markdown;
pub(crate) use markdown::markdown_text;
pub use terminal::{terminal, terminal_set};
