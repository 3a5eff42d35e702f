//! Parsers of untrusted bytes, apart from the card's I/O: byte slices and [`std::io::Read`] in, samples and facts out.
//! None of them panics on any input (see `tests/arbitrary_bytes.rs`).

mod convert;
mod csv_file;
mod decimal;
mod fault;
pub mod image_extent;
pub mod image_header;
pub mod image_time;
mod jpeg_extent;
mod jpeg_tables;
mod packet_file;
mod packets;
mod png_extent;

pub use convert::Converter;
pub use csv_file::CsvSamples;
pub use fault::Fault;
pub use packet_file::PacketSamples;
pub use packets::{PacketError, PacketParser};
