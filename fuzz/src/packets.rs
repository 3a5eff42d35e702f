//! Files of binary packets, of any layout that a profile may declare.
//!
//! Input: 16 bytes of settings (in the order in which they are taken below), then the file.

use std::path::Path;

use ingest::Profile;
use ingest::parse::{Converter, Fault, PacketParser, PacketSamples};
use ingest::profile::{
    AccelerationStream, Axis, Endian, Epoch, HeaderField, PacketLayout, PacketStamp, RangeStream, SampleOrder, Scalar,
    StampAt, Step, TimeUnit,
};
use model::UtcNs;

use crate::clocked::{Clocked, Setting, zone};
use crate::cursor::{Cursor, Pieces};

const SCALARS: [Scalar; 10] = [
    Scalar::F64,
    Scalar::I16,
    Scalar::U32,
    Scalar::U64,
    Scalar::I64,
    Scalar::I32,
    Scalar::U16,
    Scalar::F32,
    Scalar::I8,
    Scalar::U8,
];

/// Packets: bytes are used or accounted for; what the profile's check accepts, the parser takes.
pub fn packets(input: &[u8]) -> usize {
    let mut cursor = Cursor::new(input);
    let layout = layout(&mut cursor);
    let (is_range, fineness, zone_code, rate_code) = (cursor.u8() & 1 == 1, cursor.u8(), cursor.u8(), cursor.u8());
    let file = cursor.rest();
    let rate_hz = f64::from(rate_code) * 8.0;
    let profile = profile(&layout, is_range, rate_hz);
    if profile.check(Path::new("x.toml")).is_err() {
        return 0;
    }
    let (extra, converter) = match (&profile.acceleration, &profile.range) {
        (Some(stream), _) => (&stream.extra, Converter::from(stream)),
        (None, Some(stream)) => (&stream.extra, Converter::from(stream)),
        (None, None) => return 0,
    };
    let parser = PacketParser::new(&layout, extra, converter).expect("what the check accepts, the parser takes");
    let size = parser.packet_bytes();
    let epoch = layout.stamp.epoch;
    let unit_ns = i128::from(layout.stamp.unit.ns());
    let mut clocked = Clocked::new(Setting {
        epoch,
        wrap_ns: layout.stamp.wrap_bits.map(|bits| (1 << bits) * unit_ns),
        zone: zone(zone_code),
        anchor: Some(UtcNs(1_748_779_200_000_000_000)),
        step: layout.step,
        rate_hz,
        gap_s: 0.5,
    });
    let mut packets = PacketSamples::new(Pieces::new(file, fineness), parser);
    let mut used = 0;
    while let Some(block) = packets.next_block() {
        used += 1;
        clocked.push(block);
    }
    check_account(file.len(), used, size, &packets.finish().0);
    clocked.finish()
}

/// Every byte is in a packet that was used, or in a fault.
fn check_account(file_bytes: usize, used: usize, size: usize, faults: &[Fault]) {
    let cut = faults.iter().find_map(|fault| match fault {
        Fault::TruncatedPacket { got, samples, .. } if *samples > 0 => Some(*got),
        _ => None,
    });
    let lost: u64 = faults.iter().map(Fault::lost_bytes).sum();
    let whole = used - usize::from(cut.is_some());
    let told = whole as u64 * size as u64 + cut.unwrap_or(0) as u64 + lost;
    assert_eq!(told, file_bytes as u64, "{used} packets of {size} bytes, {faults:?}");
}

fn layout(cursor: &mut Cursor<'_>) -> PacketLayout {
    let flags = cursor.u8();
    let flag = |bit: u8| flags & (1 << bit) != 0;
    let [stamp, sequence, value] = [(); 3].map(|()| cursor.pick(&SCALARS));
    let unit = cursor.pick(&[TimeUnit::S, TimeUnit::Ms, TimeUnit::Us, TimeUnit::Ns]);
    let at = cursor.pick(&[StampAt::First, StampAt::Last, StampAt::End]);
    let epoch = cursor.pick(&[Epoch::Unix, Epoch::Boot, Epoch::Local, Epoch::LocalAtStart]);
    let wrap_bits = Some(u32::from(cursor.u8())).filter(|bits| *bits > 0);
    let shift = usize::from(cursor.u8());
    let samples = match cursor.u16() {
        u16::MAX => usize::MAX / 4,
        samples => usize::from(samples),
    };
    let field = |field: &str, scalar| HeaderField { field: field.to_owned(), scalar };
    let mut header = vec![field("stamp", stamp)];
    if flag(0) {
        header.insert(usize::from(flag(1)), field("sequence", sequence));
    }
    let mut channels = ["x", "y", "z", "range", "optical"].map(str::to_owned).to_vec();
    channels.rotate_left(shift % 5);
    PacketLayout {
        header,
        stamp: PacketStamp { unit, at, epoch, wrap_bits },
        step: if flag(2) { Step::Stamps } else { Step::Nominal },
        endian: if flag(3) { Endian::Big } else { Endian::Little },
        sample_type: value,
        channels,
        samples,
        order: if flag(4) { SampleOrder::Interleaved } else { SampleOrder::ChannelMajor },
        missing: flag(5).then_some(-1.0),
    }
}

fn profile(layout: &PacketLayout, is_range: bool, rate_hz: f64) -> Profile {
    let files = vec!["*.BIN".to_owned()];
    let extra = vec!["optical".to_owned()];
    let packets = Some(layout.clone());
    let mut profile = Profile {
        schema_version: 1,
        name: "any".to_owned(),
        version: "1".to_owned(),
        mount_pitch_deg: 0.0,
        clock: Some(ingest::profile::ClockSpec { anchor: ingest::profile::Anchor::Session {} }),
        acceleration: None,
        range: None,
        images: None,
    };
    if is_range {
        profile.range = Some(RangeStream {
            files,
            rate_hz,
            gap_s: None,
            mm_per_count: 1.0,
            no_target: None,
            extra,
            packets,
            csv: None,
        });
    } else {
        profile.acceleration = Some(AccelerationStream {
            files,
            rate_hz,
            gap_s: None,
            g_per_count: 0.001,
            zero_g_counts: [1.0, 2.0, 3.0],
            full_scale_g: None,
            axes: [Axis::PlusX, Axis::MinusZ, Axis::PlusY],
            extra,
            packets,
            csv: None,
            cwa: None,
        });
    }
    profile
}
