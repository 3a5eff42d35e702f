//! Seeds of what recordings and cards of packets are made of.

use aim_batch_ingest::Profile;

use super::{Seeds, named};
use crate::support::{NOON_S, Study, jpeg};

/// Sessions of a few samples and one picture of 32 x 24 px.
pub(super) fn mcap() -> Seeds {
    let session = |profile: &str, files: &[(&str, Vec<u8>)]| {
        let mut study = Study::new(profile);
        shorten(&mut study.source.profile);
        files.iter().for_each(|(name, bytes)| study.write(name, bytes));
        study.ingest();
        std::fs::read(study.out()).unwrap()
    };
    let values = |from: u16, n: u16| (from..from + n).flat_map(u16::to_le_bytes);
    let packet = |at: f64, from, n| (NOON_S as f64 + at).to_le_bytes().into_iter().chain(values(from, n)).collect();
    let acceleration = |at: f64| -> Vec<u8> { packet(at, 0, 32) };
    let range = |at: f64| -> Vec<u8> { packet(at, 400, 8) };
    let even = [0.0, 0.0625, 0.125];
    let set_back: Vec<f64> = [100.0, 100.0625].into_iter().chain((0..12).map(|i| 0.0625 * f64::from(i))).collect();
    let file = |packet: &dyn Fn(f64) -> Vec<u8>, at: &[f64]| at.iter().flat_map(|at| packet(*at)).collect::<Vec<u8>>();
    vec![
        named("sensors.mcap", session("aim2-packets", &[("SENSORS/ACC.BIN", file(&acceleration, &even))])),
        named("set-back.mcap", session("aim2-packets", &[("SENSORS/RNG.BIN", file(&range, &set_back))])),
        named("images.mcap", session("aim2-packets", &[("IMAGES/20250601T120000Z.JPG", jpeg(32, 24, 9))])),
    ]
}

/// Packets of 8 samples.
fn shorten(profile: &mut Profile) {
    let streams = [
        profile.acceleration.as_mut().and_then(|stream| stream.packets.as_mut()),
        profile.range.as_mut().and_then(|stream| stream.packets.as_mut()),
    ];
    streams.into_iter().flatten().for_each(|packets| packets.samples = 8);
}

/// Settings of `fuzz/src/packets.rs`, then the file.
pub(super) fn packets() -> Seeds {
    let values = |n: i16| (0..n).flat_map(|i| (100 * i).to_le_bytes());
    // x, y, z, range and optical, 8 samples of 16 bits, stamped in seconds (f64).
    let seconds = |at: f64| (NOON_S as f64 + at).to_le_bytes().into_iter().chain(values(40)).collect::<Vec<u8>>();
    let settings = |flags: u8, stamp: u8, unit: u8, at: u8, epoch: u8, wrap: u8, is_range: u8| {
        [flags, stamp, 2, 1, unit, at, epoch, wrap, 0, 8, 0, is_range, 0, 0, 16]
    };
    let file = |at: &[f64]| at.iter().flat_map(|at| seconds(*at)).collect::<Vec<u8>>();
    let even = file(&[0.0, 0.0625, 0.125, 0.1875, 0.25, 0.3125]);
    let mut zeros = even.clone();
    zeros[88..264].fill(0);
    let mut lost = even.clone();
    lost.drain(200..211);
    let numbered = |i: u32| [&(62 * i).to_le_bytes()[..], &i.to_le_bytes(), &values(40).collect::<Vec<u8>>()].concat();
    let counter: Vec<u8> = [0, 1, 2, 4, 3, 3, 5].into_iter().flat_map(numbered).collect();
    let seed = |settings: [u8; 15], file: &[u8]| [&settings[..], file].concat();
    vec![
        named("even", seed(settings(32, 0, 0, 0, 0, 0, 0), &even)),
        named("stamps", seed(settings(4, 0, 0, 2, 0, 0, 1), &file(&[0.0, 0.063, 0.126, 0.4, 0.463]))),
        named("zeros", seed(settings(0, 0, 0, 0, 0, 0, 1), &zeros)),
        named("lost-bytes", seed(settings(16, 0, 0, 0, 0, 0, 1), &lost)),
        named("cut", seed(settings(16, 0, 0, 1, 0, 0, 0), &even[..300])),
        named("set-back", seed(settings(0, 0, 0, 0, 3, 0, 1), &file(&[100.0, 100.0625, 0.0, 0.0625, 0.125]))),
        named("counter", seed(settings(1, 2, 1, 0, 1, 32, 0), &counter)),
    ]
}

/// Settings of `fuzz/src/timeline.rs`, then blocks: form, step of the stamp, samples, and what the form needs.
pub(super) fn timeline() -> Seeds {
    let seed = |settings: [u8; 5], blocks: &[Vec<u8>]| [&settings[..], &blocks.concat()].concat();
    // Eight samples at 100 Hz, the stamp so many steps of 10 ms after the last one.
    let packet = |steps: i16| [&[8][..], &steps.to_le_bytes(), &[8, 0, 0]].concat();
    let with_holes = |steps: i16| [&[9][..], &steps.to_le_bytes(), &[8, 3, 0, 0]].concat();
    let each = |steps: i16, at: &[i8]| {
        let at: Vec<u8> = at.iter().map(|at| at.cast_unsigned()).collect();
        [&[10][..], &steps.to_le_bytes(), &[at.len() as u8], &at].concat()
    };
    let counted = |first: i16| [&[12][..], &first.to_le_bytes(), &[50]].concat();
    let again = vec![14, 0, 0, 0];
    let steps = |steps: &[i16]| steps.iter().map(|steps| packet(*steps)).collect::<Vec<_>>();
    vec![
        named("even", seed([0, 0, 0, 0, 0], &steps(&[0, 8, 8, 8, 8, 8]))),
        named("stamps", seed([2, 3, 0, 1, 0], &steps(&[0, 8, 8, 9, 200, 8, 7]))),
        named("late", seed([0, 0, 0, 0, 0], &steps(&[0, 8, 16, -8, 16, 8, 8, 8, 8, 8, 8, 8, 8, -64, 72, 8]))),
        named("set-back", seed([0, 0, 0, 0, 0], &steps(&[0, 8, 8, -5000, 8, 8, 8, 8, 8, 8, 8, 8, 8, 8]))),
        named("twice", seed([0, 0, 0, 0, 0], &[packet(0), again.clone(), packet(8), again, with_holes(8)])),
        named("each", seed([0, 0, 0, 0, 0], &[each(0, &[0, 1, 2, 5]), each(50, &[0, -3, 4, 4]), each(9, &[0])])),
        named("counted", seed([0, 1, 0, 0, 0], &[counted(0), counted(50), vec![7, 0, 1, 0], counted(100)])),
        named("wrapping", seed([0, 1, 12, 0, 0], &[vec![0x88, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 8, 0, 0], packet(8)])),
    ]
}
