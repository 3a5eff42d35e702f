//! The entry points that `cargo fuzz` runs for hours, for a moment in every test run: altered files of the corpus through the same entry
//! points (`fuzz/src/`). They panic when a promise is broken, so there is nothing to assert here.

use fuzz_targets::TARGETS;
use proptest::prelude::*;
use proptest::sample::Index;

use crate::fuzz_seeds::corpus;

/// One change of a file. An [`Index`] is a place in whatever the file is by then.
#[derive(Debug, Clone)]
enum Change {
    /// Another byte.
    Byte(Index, u8),
    /// A bit turned.
    Bit(Index, u8),
    /// A number such as defects sit at, in its place.
    Number(Index, u64, usize),
    /// The end is lost.
    CutOff(Index),
    /// Bytes in the middle are lost.
    Remove(Index, Index),
    /// Bytes are there twice, the second time elsewhere.
    Double(Index, Index, Index),
    /// The end of another file of the corpus.
    Splice(Index, Index, Index),
}

fn changes() -> impl Strategy<Value = Vec<Change>> {
    let at = any::<Index>;
    let numbers = [0, 1, 0x7f, 0x80, 0xff, 0x7fff, 0x8000, 0xffff, 0x7fff_ffff, 0x8000_0000, u64::MAX >> 1, u64::MAX];
    let change = prop_oneof![
        4 => (at(), any::<u8>()).prop_map(|(at, byte)| Change::Byte(at, byte)),
        4 => (at(), 0_u8..8).prop_map(|(at, bit)| Change::Bit(at, bit)),
        3 => (at(), prop::sample::select(numbers.to_vec()), prop::sample::select(vec![1, 2, 4, 8]))
            .prop_map(|(at, number, bytes)| Change::Number(at, number, bytes)),
        1 => at().prop_map(Change::CutOff),
        2 => (at(), at()).prop_map(|(from, to)| Change::Remove(from, to)),
        2 => (at(), at(), at()).prop_map(|(from, to, place)| Change::Double(from, to, place)),
        2 => (at(), at(), at()).prop_map(|(other, from, place)| Change::Splice(other, from, place)),
    ];
    prop::collection::vec(change, 0..6)
}

fn apply(change: &Change, bytes: &mut Vec<u8>, corpus: &[(String, Vec<u8>)]) {
    let place = |index: &Index, bytes: &[u8]| index.index(bytes.len() + 1);
    let stretch = |a: &Index, b: &Index, bytes: &[u8]| {
        let (a, b) = (place(a, bytes), place(b, bytes));
        a.min(b)..a.max(b)
    };
    match change {
        Change::Byte(..) | Change::Bit(..) if bytes.is_empty() => {}
        Change::Byte(at, byte) => *at.get_mut(bytes) = *byte,
        Change::Bit(at, bit) => *at.get_mut(bytes) ^= 1 << bit,
        Change::Number(at, number, size) => {
            let at = place(at, bytes);
            bytes[at..].iter_mut().zip(&number.to_le_bytes()[..*size]).for_each(|(byte, new)| *byte = *new);
        }
        Change::CutOff(at) => bytes.truncate(place(at, bytes)),
        Change::Remove(from, to) => drop(bytes.drain(stretch(from, to, bytes))),
        Change::Double(from, to, at) => {
            let (twice, at) = (bytes[stretch(from, to, bytes)].to_vec(), place(at, bytes));
            bytes.splice(at..at, twice);
        }
        Change::Splice(other, from, at) => {
            let other = &corpus[other.index(corpus.len())].1;
            bytes.truncate(place(at, bytes));
            bytes.extend(&other[place(from, other)..]);
        }
    }
}

/// Runs a target on altered files of its corpus.
fn run(target: &str) {
    let entry = TARGETS.iter().find(|(name, _)| *name == target).unwrap().1;
    let corpus = corpus(target);
    let config = ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() };
    let altered = (any::<Index>(), changes()).prop_map(|(file, changes)| {
        let mut bytes = corpus[file.index(corpus.len())].1.clone();
        changes.iter().for_each(|change| apply(change, &mut bytes, &corpus));
        bytes
    });
    let noise = prop::collection::vec(any::<u8>(), 0..400);
    proptest!(config, |(bytes in prop_oneof![7 => altered, 1 => noise])| {
        entry(&bytes);
    });
}

macro_rules! targets {
    ($($name:ident),*) => {
        $(#[test]
        fn $name() {
            run(stringify!($name));
        })*

        #[test]
        fn every_target_has_its_test() {
            assert_eq!(TARGETS.map(|(name, _)| name), [$(stringify!($name)),*]);
        }
    };
}

targets!(config_toml, csv, cwa, exchange, image, labelme, mcap, packets, timeline);
