//! CWA files of Axivity loggers: a real one against a foreign decoding, synthetic ones there and back, damaged ones.

mod damage;
mod real;
mod round_trip;
mod times;
pub mod writer;

use aim_batch_ingest::parse::cwa::{Block, CwaBlocks, CwaFacts};
use aim_batch_ingest::timeline::{BlockStamp, BlockTimes, SampleTimes};
use jiff::tz::TimeZone;

/// The blocks of a file, and what the reader says of it.
fn read(file: &[u8]) -> (Vec<Block>, CwaFacts) {
    let mut reader = CwaBlocks::new(file);
    let blocks = std::iter::from_fn(|| reader.next_block()).collect();
    (blocks, reader.finish().0)
}

/// The blocks of a file with their times, the logger's clock taken for UTC.
fn read_timed(file: &[u8]) -> Vec<(Block, BlockTimes)> {
    let (blocks, _) = read(file);
    let mut places = SampleTimes::new();
    let stamp = |block: &Block| BlockStamp {
        sequence: Some(block.sequence),
        time_ns: i64::try_from(TimeZone::UTC.to_timestamp(block.stamp).unwrap().as_nanosecond()).unwrap(),
        index: block.stamp_index,
        samples: block.samples.len(),
        nominal_rate_hz: block.nominal_rate_hz,
    };
    let mut times: Vec<BlockTimes> = blocks.iter().filter_map(|block| places.push(stamp(block))).collect();
    times.extend(places.finish());
    blocks.into_iter().zip(times).collect()
}

/// Samples per second between the first sample of the first block and that of the last.
fn measured_rate_hz(blocks: &[(Block, BlockTimes)]) -> f64 {
    let samples: usize = blocks[..blocks.len() - 1].iter().map(|(block, _)| block.samples.len()).sum();
    let (first, last) = (blocks[0].1.first_sample_time_ns, blocks[blocks.len() - 1].1.first_sample_time_ns);
    samples as f64 * 1e9 / (last - first) as f64
}
