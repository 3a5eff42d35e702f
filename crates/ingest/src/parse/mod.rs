//! Parsers of untrusted bytes, apart from the card's I/O: byte slices and [`std::io::Read`] in, samples and facts out.
//! No parser panics, whatever the input (`fuzz/`).

mod convert;
mod csv_columns;
mod csv_file;
mod csv_rows;
pub mod cwa;
mod cwa_file;
mod decimal;
mod exif_time;
mod fault;
pub mod image_extent;
pub mod image_header;
pub mod image_orientation;
pub mod image_time;
mod jpeg_extent;
mod jpeg_segments;
mod jpeg_tables;
mod no_target;
mod packet_file;
mod packets;
mod png_extent;
mod possible;
mod raw;
mod scalar;
pub(crate) mod written_time;

pub use convert::Converter;
pub use csv_file::{CsvLayout, CsvSamples};
pub use cwa_file::{CwaLayout, CwaSamples};
pub use fault::Fault;
pub use no_target::NoTargetReadings;
pub use packet_file::PacketSamples;
pub use packets::{PacketError, PacketParser};
pub use raw::{RawBlock, Stamps};
pub(crate) use written_time::names_zone;
