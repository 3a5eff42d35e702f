//! Packets: both orders, both byte orders, missing samples, truncated files, bad stamps.

use aim_batch_ingest::Sample;
use aim_batch_ingest::parse::{Converter, Fault, PacketError, PacketParser, PacketSamples};
use aim_batch_ingest::profile::{Axis, Endian, HeaderField, PacketLayout, SampleOrder, Scalar};
use model::UtcNs;

const STAMP_S: f64 = 1_700_000_000.25;
const STAMP_NS: i64 = 1_700_000_000_250_000_000;

fn field(name: &str, scalar: Scalar) -> HeaderField {
    HeaderField { field: name.to_owned(), scalar }
}

fn layout(order: SampleOrder, endian: Endian) -> PacketLayout {
    PacketLayout {
        header: vec![field("serial", Scalar::U16), field("stamp", Scalar::F64), field("flags", Scalar::U8)],
        endian,
        sample_type: Scalar::I16,
        channels: ["x", "y", "optical", "z"].map(str::to_owned).to_vec(),
        samples: 3,
        order,
        missing: Some(-1.0),
    }
}

fn converter() -> Converter {
    // Device right, down, forward = sensor +y, -x, +z.
    let axes = [Axis::PlusY, Axis::MinusX, Axis::PlusZ];
    Converter::Acceleration { g_per_count: 0.5, zero_g_counts: [2.0, 0.0, -4.0], axes }
}

/// A packet: serial, stamp, flags, then values in file order.
fn packet(endian: Endian, values: &[i16]) -> Vec<u8> {
    let little = endian == Endian::Little;
    let mut bytes = if little { 9_u16.to_le_bytes() } else { 9_u16.to_be_bytes() }.to_vec();
    bytes.extend(if little { STAMP_S.to_le_bytes() } else { STAMP_S.to_be_bytes() });
    bytes.push(1);
    bytes.extend(values.iter().flat_map(|v| if little { v.to_le_bytes() } else { v.to_be_bytes() }));
    bytes
}

fn expected() -> Vec<Sample> {
    // Counts (x, y, z): (2, 10, 0), missing, (-1, -1, 6).
    let sample = |ns, g| Sample::Acceleration { time: UtcNs(STAMP_NS + ns), g };
    vec![sample(0, [5.0, 0.0, 2.0]), sample(200_000_000, [-0.5, 1.5, 5.0])]
}

#[test]
fn both_orders_and_both_byte_orders_give_the_same_samples() {
    let channel_major = [2, -1, -1, 10, -1, -1, 70, 71, 72, 0, -1, 6];
    let interleaved = [2, 10, 70, 0, -1, -1, 71, -1, -1, -1, 72, 6];
    for endian in [Endian::Little, Endian::Big] {
        for (order, values) in [(SampleOrder::ChannelMajor, channel_major), (SampleOrder::Interleaved, interleaved)] {
            let parser = PacketParser::new(&layout(order, endian), 10.0, converter()).unwrap();
            let mut samples = Vec::new();
            parser.parse(&packet(endian, &values), &mut samples).unwrap();
            assert_eq!(samples, expected(), "{order:?} {endian:?}");
        }
    }
}

#[test]
fn every_type_of_stamp_gives_its_time() {
    let stamped = |scalar: Scalar, stamp: &[u8]| {
        let layout = PacketLayout {
            header: vec![field("stamp", scalar)],
            channels: vec!["range".to_owned()],
            samples: 1,
            ..layout(SampleOrder::ChannelMajor, Endian::Little)
        };
        let parser = PacketParser::new(&layout, 10.0, Converter::Range { mm_per_count: 2.0 }).unwrap();
        let mut samples = Vec::new();
        parser.parse(&[stamp, &300_i16.to_le_bytes()].concat(), &mut samples).map(|()| samples)
    };
    let at = |ns: i64| Ok(vec![Sample::Range { time: UtcNs(ns), mm: 600.0 }]);
    let whole = 1_700_000_000_000_000_000;
    assert_eq!(stamped(Scalar::U32, &1_700_000_000_u32.to_le_bytes()), at(whole));
    assert_eq!(stamped(Scalar::U64, &1_700_000_000_u64.to_le_bytes()), at(whole));
    assert_eq!(stamped(Scalar::I64, &1_700_000_000_i64.to_le_bytes()), at(whole));
    assert_eq!(stamped(Scalar::F64, &STAMP_S.to_le_bytes()), at(STAMP_NS));
    for bad in [f64::NAN, f64::INFINITY, -1.0, 1e300] {
        assert!(matches!(stamped(Scalar::F64, &bad.to_le_bytes()), Err(PacketError::Stamp(_))), "{bad}");
    }
    assert!(matches!(stamped(Scalar::I64, &(-5_i64).to_le_bytes()), Err(PacketError::Stamp(_))));
    assert!(matches!(stamped(Scalar::U64, &u64::MAX.to_le_bytes()), Err(PacketError::Stamp(_))));
}

#[test]
fn a_slice_that_is_not_one_packet_is_refused() {
    let parser = PacketParser::new(&layout(SampleOrder::Interleaved, Endian::Big), 10.0, converter()).unwrap();
    let mut samples = Vec::new();
    assert_eq!(parser.parse(&[0; 34], &mut samples), Err(PacketError::Length { expected: 35, got: 34 }));
    assert!(samples.is_empty());
}

#[test]
fn the_whole_packets_of_a_truncated_file_are_used() {
    let parser = PacketParser::new(&layout(SampleOrder::ChannelMajor, Endian::Little), 10.0, converter()).unwrap();
    let one = packet(Endian::Little, &[2, -1, -1, 10, -1, -1, 70, 71, 72, 0, -1, 6]);
    let mut unstamped = one.clone();
    unstamped[2..10].copy_from_slice(&f64::NAN.to_le_bytes());
    let file = [&one[..], &unstamped, &one, &one[..20]].concat();
    let mut packets = PacketSamples::new(file.as_slice(), parser);
    let mut samples = Vec::new();
    while packets.next_batch(&mut samples) {}
    assert_eq!(samples, [expected(), expected()].concat());
    let (faults, _) = packets.finish();
    assert_eq!(
        faults,
        [
            Fault::BadStamp { packets: 1, first_offset: 35, first: "NaN".to_owned() },
            Fault::TruncatedPacket { packet: 4, offset: 105, expected: 35, got: 20 },
        ]
    );
}
