//! CWA files of the Axivity loggers AX3 and AX6: a header of 1024 bytes, then data blocks of 512 bytes.
//!
//! - [`Block::parse`] reads one block; [`CwaBlocks`] streams those of a file and steps over damage.
//! - A logger's true rate is off the nominal one by a percent or so: [`timeline`](crate::timeline) places every sample from
//!   the blocks' stamps.
//!
//! # Conventions
//! - Numbers are little-endian. Acceleration is in g and angular rate in degrees per second, on the sensor's own axes.
//! - A stamp is the logger's own clock: civil time without a zone.
//! - A block whose checksum fails is not used.
//!
//! Source: the format tables of the Open Movement project (`Docs/ax3/cwa.md`), and what its readers and GGIRread make
//! of them where the tables leave it open.
//!
//! # Example
//! ```no_run
//! use aim_batch_ingest::parse::cwa::CwaBlocks;
//!
//! let file = std::fs::File::open("recording.cwa")?;
//! let mut blocks = CwaBlocks::new(file);
//! while let Some(block) = blocks.next_block() {
//!     println!("sample {} at {}: {:?}", block.stamp_index, block.stamp, block.samples);
//! }
//! let (facts, _file) = blocks.finish();
//! println!("{} blocks, {} bytes lost", facts.blocks, facts.bytes_lost);
//! # Ok::<(), std::io::Error>(())
//! ```

mod block;
mod blocks;
mod facts;
mod fields;
mod header;
mod samples;
mod window;

pub use block::{BLOCK_BYTES, Block, BlockError};
pub use blocks::CwaBlocks;
pub use facts::{BadBlocks, CwaFacts, ReadFailure, SequenceJump, TruncatedBlock};
pub use header::{HEADER_BYTES, Hardware, Header};
