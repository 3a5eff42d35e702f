//! Packets: both orders, both byte orders, missing samples, truncated files, bad stamps.

use aim_batch_ingest::parse::{Converter, Fault, NoTargetReadings, PacketError, PacketParser, PacketSamples, RawBlock};
use aim_batch_ingest::profile::{
    Axis, Endian, HeaderField, PacketLayout, PacketStamp, SampleOrder, Scalar, StampAt, Step, TimeUnit,
};

use crate::support::{timed, times_and_values};

const STAMP_S: f64 = 1_700_000_000.25;
const STAMP_NS: i64 = 1_700_000_000_250_000_000;

fn field(name: &str, scalar: Scalar) -> HeaderField {
    HeaderField { field: name.to_owned(), scalar }
}

fn layout(order: SampleOrder, endian: Endian) -> PacketLayout {
    PacketLayout {
        header: vec![field("serial", Scalar::U16), field("stamp", Scalar::F64), field("flags", Scalar::U8)],
        stamp: PacketStamp::default(),
        step: Step::Nominal,
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
    Converter::Acceleration { g_per_count: 0.5, zero_g_counts: [2.0, 0.0, -4.0], axes, full_scale_g: Some(1e6) }
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

fn expected() -> Vec<(i64, Vec<f32>)> {
    // Counts (x, y, z): (2, 10, 0), missing, (-1, -1, 6).
    vec![(STAMP_NS, vec![5.0, 0.0, 2.0]), (STAMP_NS + 200_000_000, vec![-0.5, 1.5, 5.0])]
}

fn parser(layout: &PacketLayout) -> PacketParser {
    PacketParser::new(layout, &["optical".to_owned()], converter()).unwrap()
}

fn all<R: std::io::Read>(packets: &mut PacketSamples<R>) -> Vec<RawBlock> {
    std::iter::from_fn(|| packets.next_block()).collect()
}

const VALUES: [i16; 12] = [2, -1, -1, 10, -1, -1, 70, 71, 72, 0, -1, 6];

#[test]
fn both_orders_and_both_byte_orders_give_the_same_samples() {
    let interleaved = [2, 10, 70, 0, -1, -1, 71, -1, -1, -1, 72, 6];
    for endian in [Endian::Little, Endian::Big] {
        for (order, values) in [(SampleOrder::ChannelMajor, VALUES), (SampleOrder::Interleaved, interleaved)] {
            let block = parser(&layout(order, endian)).parse(&packet(endian, &values)).unwrap();
            assert_eq!((block.missing, block.extra.clone()), (1, vec![vec![70.0, 72.0]]), "{order:?} {endian:?}");
            assert_eq!(times_and_values(&timed([block], 10.0)), expected(), "{order:?} {endian:?}");
        }
    }
}

/// A packet of one range sample with that stamp.
fn stamped(scalar: Scalar, unit: TimeUnit, stamp: &[u8]) -> Result<Vec<(i64, Vec<f32>)>, PacketError> {
    let layout = PacketLayout {
        header: vec![field("stamp", scalar)],
        stamp: PacketStamp { unit, ..PacketStamp::default() },
        channels: vec!["range".to_owned()],
        samples: 1,
        ..layout(SampleOrder::ChannelMajor, Endian::Little)
    };
    let parser =
        PacketParser::new(&layout, &[], Converter::Range { mm_per_count: 2.0, no_target: NoTargetReadings::default() })
            .unwrap();
    let block = parser.parse(&[stamp, &300_i16.to_le_bytes()].concat())?;
    Ok(times_and_values(&timed([block], 10.0)))
}

#[test]
fn every_type_and_unit_of_stamp_gives_its_time() {
    let at = |ns: i64| Ok(vec![(ns, vec![600.0])]);
    let whole = 1_700_000_000_000_000_000;
    assert_eq!(stamped(Scalar::U32, TimeUnit::S, &1_700_000_000_u32.to_le_bytes()), at(whole));
    assert_eq!(stamped(Scalar::U64, TimeUnit::Ms, &1_700_000_000_000_u64.to_le_bytes()), at(whole));
    assert_eq!(stamped(Scalar::I64, TimeUnit::Ns, &(whole + 1).to_le_bytes()), at(whole + 1));
    assert_eq!(stamped(Scalar::F64, TimeUnit::S, &STAMP_S.to_le_bytes()), at(STAMP_NS));
    assert_eq!(stamped(Scalar::F64, TimeUnit::Us, &1_700_000_000_250_000_f64.to_le_bytes()), at(STAMP_NS));
    for bad in [f64::NAN, f64::INFINITY, -1.0, 1e300] {
        assert!(matches!(stamped(Scalar::F64, TimeUnit::S, &bad.to_le_bytes()), Err(PacketError::Stamp(_))), "{bad}");
    }
    assert!(matches!(stamped(Scalar::I64, TimeUnit::S, &(-5_i64).to_le_bytes()), Err(PacketError::Stamp(_))));
    assert!(matches!(stamped(Scalar::U64, TimeUnit::S, &u64::MAX.to_le_bytes()), Err(PacketError::Stamp(_))));
}

#[test]
fn a_stamp_may_be_the_first_the_last_or_the_end() {
    let first_ns = |at: StampAt| {
        let stamp = PacketStamp { at, ..PacketStamp::default() };
        let layout = PacketLayout { stamp, ..layout(SampleOrder::ChannelMajor, Endian::Little) };
        let block = parser(&layout).parse(&packet(Endian::Little, &VALUES)).unwrap();
        times_and_values(&timed([block], 10.0))[0].0 - STAMP_NS
    };
    assert_eq!(first_ns(StampAt::First), 0);
    assert_eq!(first_ns(StampAt::Last), -200_000_000);
    assert_eq!(first_ns(StampAt::End), -300_000_000);
}

/// A file of packets of 35 bytes, one second apart.
fn file(packets: u32) -> Vec<u8> {
    let one = |i: u32| {
        let mut bytes = packet(Endian::Little, &VALUES);
        bytes[2..10].copy_from_slice(&(STAMP_S + f64::from(i)).to_le_bytes());
        bytes
    };
    (0..packets).flat_map(one).collect()
}

/// Seconds after the first packet of those that are read, and what was wrong.
fn read(file: &[u8]) -> (Vec<i64>, Vec<Fault>) {
    let mut packets = PacketSamples::new(file, parser(&layout(SampleOrder::ChannelMajor, Endian::Little)));
    let blocks = timed(all(&mut packets), 10.0);
    let seconds = blocks.iter().map(|block| (block.times.first().0 - STAMP_NS) / 1_000_000_000).collect();
    (seconds, packets.finish().0)
}

#[test]
fn the_whole_packets_of_a_truncated_file_are_used() {
    let mut bytes = file(4);
    bytes[35 + 2..35 + 10].copy_from_slice(&f64::NAN.to_le_bytes());
    bytes.truncate(125);
    let (seconds, faults) = read(&bytes);
    assert_eq!(seconds, [0, 2]);
    assert!(
        matches!(
            &faults[..],
            [
                Fault::BadStamp { packets: 1, bytes: 35, first_offset: 35, .. },
                Fault::TruncatedPacket { offset: 105, expected: 35, got: 20, samples: 0 },
            ]
        ),
        "{faults:?}"
    );
}

#[test]
fn of_a_cut_packet_the_samples_that_have_all_channels_are_used() {
    let layout = layout(SampleOrder::Interleaved, Endian::Little);
    let values = [2, 10, 70, 0, 2, 10, 71, 0, 2, 10, 72, 0];
    let cut = &packet(Endian::Little, &values)[..35 - 3];
    let mut packets = PacketSamples::new(cut, parser(&layout));
    assert_eq!(all(&mut packets).iter().map(RawBlock::len).collect::<Vec<_>>(), [2]);
    let faults = packets.finish().0;
    assert!(matches!(faults[..], [Fault::TruncatedPacket { samples: 2, .. }]), "{faults:?}");
}

#[test]
fn a_block_of_zeros_is_left_out_and_counted() {
    let mut bytes = file(5);
    bytes[35..105].fill(0);
    bytes.extend([0; 20]);
    let (seconds, faults) = read(&bytes);
    assert_eq!(seconds, [0, 3, 4]);
    assert_eq!(faults, [Fault::Zeros { bytes: 90, first_offset: 35 }]);
}

#[test]
fn where_bytes_are_lost_the_next_packet_is_found() {
    let mut bytes = file(6);
    bytes.drain(80..91); // inside the third packet
    let (seconds, faults) = read(&bytes);
    assert_eq!(seconds, [0, 1, 3, 4, 5]);
    assert_eq!(faults, [Fault::LostAlignment { bytes: 24, places: 1, first_offset: 70 }]);
}

#[test]
fn where_bytes_are_inserted_the_next_packet_is_found() {
    let bytes = file(6);
    let bytes = [&bytes[..70], &[0xee; 17], &bytes[70..]].concat();
    let (seconds, faults) = read(&bytes);
    assert_eq!(seconds, [0, 2, 3, 4, 5], "whether the second packet is whole cannot be told");
    assert!(matches!(faults[..], [Fault::LostAlignment { bytes: 52, .. }]), "{faults:?}");
}

/// A file that begins with garbage must not be read from a place a few bytes before its packets, where the end of the
/// garbage and the beginning of a stamp make numbers that rise as stamps do (1770062536 s read 3 bytes early are 4608 s).
#[test]
fn garbage_at_the_beginning_of_a_file_does_not_shift_the_packets_behind_it() {
    let layout = PacketLayout {
        header: vec![field("stamp", Scalar::F64)],
        samples: 20,
        ..layout(SampleOrder::ChannelMajor, Endian::Little)
    };
    let size = 8 + 4 * 20 * 2;
    for (hours, bad) in (0..400_u32).map(|i| (6 * i, 1 + i as usize % 12)) {
        let start_s = 1_767_600_000.0 + 3600.0 * f64::from(hours);
        let stamps_s: Vec<f64> = (0..20).map(|i| start_s + 8.0 * f64::from(i)).collect();
        let one = |stamp_s: &f64| stamp_s.to_le_bytes().into_iter().chain([0xb3; 4 * 20 * 2]);
        let mut bytes: Vec<u8> = stamps_s.iter().flat_map(one).collect();
        bytes[..bad * size].fill(0xb3);
        let mut packets = PacketSamples::new(bytes.as_slice(), parser(&layout));
        let blocks = timed(all(&mut packets), 128.0);
        let read_ns: Vec<i64> = blocks.iter().map(|block| block.times.first().0).collect();
        let expected_ns: Vec<i64> = stamps_s[bad..].iter().map(|s| *s as i64 * 1_000_000_000).collect();
        assert_eq!(read_ns, expected_ns, "{bad} bad packets from {start_s} s");
        let faults = packets.finish().0;
        assert!(matches!(&faults[..], [Fault::BadStamp { packets, .. }] if *packets == bad as u64), "{faults:?}");
    }
}

/// Records of 9 bytes, of which a buffer holds many thousands: what was searched once is not searched again.
#[test]
fn a_long_file_of_garbage_takes_no_longer_than_it_is() {
    let layout = PacketLayout {
        header: vec![field("stamp", Scalar::F64)],
        sample_type: Scalar::I8,
        channels: vec!["range".to_owned()],
        samples: 1,
        ..layout(SampleOrder::ChannelMajor, Endian::Little)
    };
    let parser =
        PacketParser::new(&layout, &[], Converter::Range { mm_per_count: 1.0, no_target: NoTargetReadings::default() })
            .unwrap();
    let record = |i: u32| (STAMP_S + f64::from(i)).to_le_bytes().into_iter().chain([7]);
    let records: Vec<u8> = (0..1000).flat_map(record).collect();
    let begun = std::time::Instant::now();
    for garbage in [9 * 20_000, 9 * 400_000] {
        let bytes = [vec![0xb3; garbage], records.clone()].concat();
        let mut packets = PacketSamples::new(bytes.as_slice(), parser.clone());
        assert_eq!(all(&mut packets).len(), 1000);
        let faults = packets.finish().0;
        let lost: u64 = faults.iter().map(Fault::lost_bytes).sum();
        assert_eq!(lost, garbage as u64, "{faults:?}");
    }
    assert!(begun.elapsed().as_secs() < 20, "{:?}", begun.elapsed());
}
