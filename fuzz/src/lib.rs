//! Entry points for bytes that nobody vouches for, one per parser. `cargo fuzz` feeds them by coverage, `cargo test` feeds
//! them altered files of the corpus (`crates/ingest/tests/ingest/arbitrary_bytes.rs`): both run the same functions.
//!
//! An entry point panics when a promise is broken: bytes are either used or accounted for, times are in order, an error says
//! where. It returns how many things it read, so that a seed which has become useless is noticed.
#![warn(missing_docs)]

mod clocked;
mod config_toml;
mod csv;
mod cursor;
mod cwa;
mod exchange;
mod image;
mod labelme;
mod mcap;
mod mend;
mod packets;
mod timeline;

pub use config_toml::config_toml;
pub use csv::csv;
pub use cwa::cwa;
pub use exchange::exchange;
pub use image::image;
pub use labelme::labelme;
pub use mcap::mcap;
pub use packets::packets;
pub use timeline::timeline;

/// An entry point: bytes in, how many things were read out.
pub type Entry = fn(&[u8]) -> usize;

/// All entry points by the names of their targets, which are also those of their folders in `corpus/`.
pub const TARGETS: [(&str, Entry); 9] = [
    ("config_toml", config_toml),
    ("csv", csv),
    ("cwa", cwa),
    ("exchange", exchange),
    ("image", image),
    ("labelme", labelme),
    ("mcap", mcap),
    ("packets", packets),
    ("timeline", timeline),
];
