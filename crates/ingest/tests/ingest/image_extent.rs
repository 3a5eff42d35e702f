//! The walk through a picture's structure: where it ends, and what breaks it.

use aim_batch_ingest::Picture;
use aim_batch_ingest::parse::image_extent::{ImageDamage, ImageExtent, extent};
use aim_batch_ingest::parse::image_header::{self, Encoding};
use proptest::prelude::*;

use crate::support::{jpeg, jpeg_with_exif, noisy_jpeg, png};

fn of_jpeg(bytes: &[u8]) -> Result<ImageExtent, ImageDamage> {
    extent(Encoding::Jpeg, bytes)
}

fn whole(bytes: &[u8]) -> Result<ImageExtent, ImageDamage> {
    Ok(ImageExtent { bytes: bytes.len(), has_more_pictures: false, stray_bytes: 0 })
}

/// A segment with its marker and length.
fn segment(code: u8, content: &[u8]) -> Vec<u8> {
    [&[0xff, code], &(content.len() as u16 + 2).to_be_bytes()[..], content].concat()
}

/// Tables whose shortest code is `dc` and `ac`, one component, then the scan's data and the end marker.
fn scan(dc: u8, ac: u8, header_tail: [u8; 3], data: &[u8]) -> Vec<u8> {
    let table = |class_id: u8, symbol: u8| {
        let mut counts = [0; 16];
        counts[0] = 1;
        [&[class_id][..], &counts, &[symbol]].concat()
    };
    let tables = segment(0xc4, &[table(0x00, dc), table(0x10, ac)].concat());
    let header = segment(0xda, &[&[1, 1, 0x00][..], &header_tail].concat());
    [&[0xff, 0xd8][..], &tables, &header, data, &[0xff, 0xd9]].concat()
}

const BASELINE: [u8; 3] = [0, 63, 0];

#[test]
fn a_whole_picture_ends_at_its_end_marker_whatever_follows() {
    for picture in [jpeg(32, 24, 9), noisy_jpeg(320, 240), jpeg_with_exif(Some("2025:06:01 12:00:00"), None, None)] {
        assert_eq!(of_jpeg(&picture), whole(&picture));
        let followed = [&picture[..], b"\xff\xd9 anything"].concat();
        assert_eq!(of_jpeg(&followed), whole(&picture));
    }
    let picture = png(32, 24);
    assert_eq!(extent(Encoding::Png, &picture), whole(&picture));
    assert_eq!(extent(Encoding::Png, &[&picture[..], b"anything"].concat()), whole(&picture));
}

#[test]
fn a_thumbnail_inside_a_segment_is_not_the_picture() {
    let (picture, thumbnail) = (noisy_jpeg(64, 48), jpeg(16, 12, 9));
    let outer = [&picture[..2], &segment(0xe1, &thumbnail), &picture[2..]].concat();
    assert_eq!(of_jpeg(&outer), whole(&outer));
    let cut = of_jpeg(&outer[..outer.len() - 1]).unwrap_err();
    assert_eq!(cut, ImageDamage::NoEnd { bytes: outer.len() - 1, marker: "ff d9" });
}

#[test]
fn stuffing_restart_markers_fill_bytes_and_further_scans_are_passed() {
    let data = [0x12, 0xff, 0x00, 0x34, 0xff, 0xd0, 0x56, 0xff, 0xd7, 0x78, 0xff, 0xff];
    let picture = scan(4, 1, BASELINE, &data);
    assert_eq!(of_jpeg(&picture), whole(&picture), "fill bytes before the end marker");
    let second = [segment(0xc4, &[]), segment(0xda, &[1, 1, 0, 1, 5, 0]), vec![0xaa; 9]].concat();
    let progressive = scan(4, 1, [0, 0, 0], &[&[0x11; 5][..], &second].concat());
    assert_eq!(of_jpeg(&progressive), whole(&progressive));
}

#[test]
fn every_cut_of_a_picture_is_seen() {
    for (encoding, picture) in [(Encoding::Jpeg, noisy_jpeg(64, 48)), (Encoding::Png, png(32, 24))] {
        for end in 0..picture.len() {
            assert!(extent(encoding, &picture[..end]).is_err(), "{encoding:?} cut after {end} bytes");
        }
    }
}

#[test]
fn a_second_picture_behind_the_first_is_announced() {
    let picture = noisy_jpeg(64, 48);
    let first = [&picture[..2], &segment(0xe2, b"MPF\0II*\0"), &picture[2..]].concat();
    let both = [&first[..], &picture].concat();
    assert_eq!(of_jpeg(&both), Ok(ImageExtent { bytes: first.len(), has_more_pictures: true, stray_bytes: 0 }));
}

#[test]
fn a_block_of_zeros_is_damage_from_4096_bytes_on() {
    let noise = |count: usize| (0..count).map(|i| (i % 251) as u8 + 1).collect::<Vec<u8>>();
    for before in [0, 1, 2047, 2048, 5000] {
        let picture =
            |zeros: usize| scan(4, 1, BASELINE, &[noise(before).as_slice(), &vec![0; zeros], &noise(3000)].concat());
        let at = picture(0).len() - 3000 - 2;
        assert_eq!(of_jpeg(&picture(4095)), whole(&picture(4095)), "{before}");
        assert_eq!(of_jpeg(&picture(4096)), Err(ImageDamage::Zeros { at, bytes: 4096 }), "{before}");
        assert_eq!(of_jpeg(&picture(9000)), Err(ImageDamage::Zeros { at, bytes: 9000 }), "{before}");
    }
    let mut to_the_end = noisy_jpeg(320, 240);
    let (at, length) = (to_the_end.len() - 5000, to_the_end.len());
    to_the_end[at..].fill(0);
    assert!(matches!(of_jpeg(&to_the_end), Err(ImageDamage::Zeros { at: from, .. }) if from <= at && length > from));
}

/// A covered lens, written with tables made for it: 'no difference' and 'end of block' are both the bit 0.
#[test]
fn zeros_that_mean_an_even_colour_are_no_damage() {
    let zeros = vec![0; 20_000];
    for (dc, ac, header) in [(0, 0, BASELINE), (0, 9, [0, 0, 0]), (9, 9, [0, 0, 0x10]), (9, 0xe0, [1, 63, 0])] {
        let picture = scan(dc, ac, header, &zeros);
        assert_eq!(of_jpeg(&picture), whole(&picture), "{dc} {ac} {header:?}");
    }
    for (dc, ac, header) in [(0, 1, BASELINE), (2, 0, BASELINE), (0, 0xf0, BASELINE), (9, 0, [0, 0, 0])] {
        assert!(matches!(of_jpeg(&scan(dc, ac, header, &zeros)), Err(ImageDamage::Zeros { .. })), "{dc} {ac}");
    }
}

/// The same from an encoder: all black, in sequence and progressive, with and without tables made for the picture.
#[test]
fn even_pictures_of_an_encoder_are_whole() {
    use jpeg_encoder::{ColorType, Encoder};
    for (optimized, progressive) in [(false, false), (true, false), (false, true), (true, true)] {
        let mut picture = Vec::new();
        let mut encoder = Encoder::new(&mut picture, 90);
        encoder.set_optimized_huffman_tables(optimized);
        encoder.set_progressive(progressive);
        encoder.encode(&vec![0; 1800 * 1400 * 3], 1800, 1400, ColorType::Rgb).unwrap();
        let has_zeros = picture.windows(4096).any(|window| window.iter().all(|byte| *byte == 0));
        assert_eq!(
            has_zeros,
            optimized || progressive,
            "the test is of zeros: optimized {optimized}, progressive {progressive}"
        );
        assert_eq!(of_jpeg(&picture), whole(&picture), "optimized {optimized}, progressive {progressive}");
    }
}

#[test]
fn what_stands_where_nothing_may_stand_is_named() {
    let picture = noisy_jpeg(320, 240);
    let middle = picture.len() / 2;
    let other = [&picture[..middle], &picture].concat();
    let message = of_jpeg(&other).unwrap_err().to_string();
    assert_eq!(message, format!("ff d8 at byte {middle}, expected a marker of JPEG (ff c0 to ff fe)"));
    let cut = of_jpeg(&[&[0xff, 0xd8][..], &segment(0xe1, &[1; 90])[..50]].concat()).unwrap_err().to_string();
    assert_eq!(cut, "the file ends inside segment e1 at byte 2: expected 92 bytes, got 48");
    assert_eq!(of_jpeg(&[0xff, 0xd8, 0xff, 0xd9]), Err(ImageDamage::NoPixels { at: 2 }));
    let mut picture = png(32, 24);
    picture[60] ^= 1;
    assert!(matches!(extent(Encoding::Png, &picture), Err(ImageDamage::Checksum { .. })));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// Bytes of a picture with some altered, cut, and something behind: no panic, no extent beyond the input.
    #[test]
    fn no_extent_is_beyond_the_input(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..8),
        end in any::<prop::sample::Index>(),
        behind in prop::collection::vec(any::<u8>(), 0..40),
        is_png in any::<bool>(),
    ) {
        let (encoding, mut bytes) =
            if is_png { (Encoding::Png, png(32, 24)) } else { (Encoding::Jpeg, noisy_jpeg(64, 48)) };
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        bytes.truncate(end.index(bytes.len() + 1));
        bytes.extend(behind);
        if let Ok(found) = extent(encoding, &bytes) {
            prop_assert!(found.bytes <= bytes.len());
        }
    }

    #[test]
    fn no_bytes_make_it_panic(bytes in prop::collection::vec(prop_oneof![Just(0xff_u8), any::<u8>()], 0..400)) {
        for (encoding, start) in [(Encoding::Jpeg, &b"\xff\xd8\xff"[..]), (Encoding::Png, b"\x89PNG\r\n\x1a\n")] {
            let input = [start, bytes.as_slice()].concat();
            if let Ok(found) = extent(encoding, &input) {
                prop_assert!(found.bytes <= input.len());
            }
        }
    }
}

/// Photographs of several cameras, where there are any: AIM_BATCH_REAL_DATA names their folder.
#[test]
fn real_photographs_are_whole() {
    let Some(folder) = std::env::var_os("AIM_BATCH_REAL_DATA") else {
        println!("skipped: AIM_BATCH_REAL_DATA names no folder of real photographs");
        return;
    };
    let mut count = 0;
    for entry in walkdir::WalkDir::new(folder).into_iter().filter_map(Result::ok).filter(|e| e.file_type().is_file()) {
        let bytes = std::fs::read(entry.path()).unwrap();
        let Some(encoding) = image_header::encoding_of(&bytes) else { continue };
        let found = extent(encoding, &bytes);
        assert!(found.is_ok(), "{}: {found:?}", entry.path().display());
        count += 1;
    }
    println!("{count} photographs are whole");
}

#[test]
fn stray_bytes_before_a_marker_are_passed_over_and_counted() {
    let picture = jpeg(32, 24, 9);
    let tables = picture.windows(2).position(|pair| pair == [0xff, 0xdb]).unwrap();
    let ends = picture.len() - 2;
    for (at, stray, count) in [
        (tables, &b"\0"[..], 1),
        (tables, b"\x12\x34\x56", 3),
        (tables, b"\xff\xff\xff", 0), // fill bytes
        (tables, &[0; 511], 511),
        (ends, b"\xff\xd7", 0), // a restart marker at the end of the scan
    ] {
        let odd = [&picture[..at], stray, &picture[at..]].concat();
        let expected = ImageExtent { bytes: odd.len(), has_more_pictures: false, stray_bytes: count };
        assert_eq!(of_jpeg(&odd), Ok(expected), "{stray:?} at {at}");
        let header = image_header::read(&odd).unwrap();
        assert_eq!((header.width_px, header.height_px), (32, 24), "{stray:?} at {at}");
        assert_eq!(Picture::decode(&odd).unwrap(), Picture::decode(&picture).unwrap(), "{stray:?} at {at}");
    }
    let damaged = [&picture[..tables], &[0; 512], &picture[tables..]].concat();
    assert!(matches!(of_jpeg(&damaged), Err(ImageDamage::Strange { at, .. }) if at == tables));
}

#[test]
fn codings_that_cannot_be_decoded_are_unsupported_and_not_damaged() {
    let picture = jpeg(32, 24, 9);
    let frame = picture.windows(2).position(|pair| pair == [0xff, 0xc0]).unwrap();
    for (place, byte, expected) in [
        (frame + 1, 0xc9, "arithmetic-coded JPEG (marker ff c9) is not supported"),
        (frame + 1, 0xca, "arithmetic-coded JPEG (marker ff ca) is not supported"),
        (frame + 1, 0xc3, "lossless JPEG (marker ff c3) is not supported"),
        (frame + 4, 12, "JPEG with other than 8 bits per sample (marker ff c0) is not supported"),
    ] {
        let mut other = picture.clone();
        other[place] = byte;
        let message = image_header::read(&other).unwrap_err().to_string();
        assert!(message.starts_with(expected), "{message}");
        assert!(!message.contains("damaged"), "{message}");
    }
}
