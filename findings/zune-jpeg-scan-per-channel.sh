#!/usr/bin/env bash
# One would expect: a baseline JPEG gives the same pixels whether its channels lie in one scan or in a scan each; the standard
#   asks every baseline decoder for both.
# What happens: zune-jpeg 0.5.15, which the crate image 0.25.10 decodes with, returns wrong pixels and no error where there is
#   a scan for each channel and the colours are stored at half the width and height (4:2:0): differences over the whole
#   range, in grey too. 4:4:4 and 4:2:2 are right; jpeg-decoder is right with all three.
#   The crate jpeg-encoder writes such files as soon as it is asked for optimised Huffman tables.
# Why it matters here: pictures are decoded by zune-jpeg. What we write has standard tables and one scan; a picture that other
#   software has stored anew may come out wrong, without an error.
# Source: https://github.com/etemesi254/zune-image/issues/422 (mended after 0.5.15); ITU-T T.81, table 1 and A.2
# Needs: cargo.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/src"
cat > "$folder/Cargo.toml" <<'END'
[package]
name = "finding"
version = "0.0.0"
edition = "2024"

[dependencies]
jpeg-decoder = { version = "=0.3.2", default-features = false }
jpeg-encoder = "=0.7.1"
zune-jpeg = "=0.5.15"
END
cat > "$folder/src/main.rs" <<'END'
use jpeg_encoder::{ColorType, Encoder, SamplingFactor};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

const WIDTH: u16 = 128;
const HEIGHT: u16 = 96;

fn jpeg(rgb: &[u8], sampling: SamplingFactor, scan_per_channel: bool) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, 95);
    encoder.set_sampling_factor(sampling);
    encoder.set_optimized_huffman_tables(scan_per_channel);
    encoder.encode(rgb, WIDTH, HEIGHT, ColorType::Rgb).expect("encodes");
    bytes
}

fn by_zune(jpeg: &[u8], colours: ColorSpace) -> Vec<u8> {
    let options = DecoderOptions::default().jpeg_set_out_colorspace(colours);
    JpegDecoder::new_with_options(ZCursor::new(jpeg), options).decode().expect("decodes without an error")
}

fn by_jpeg_decoder(jpeg: &[u8]) -> Vec<u8> {
    jpeg_decoder::Decoder::new(jpeg).decode().expect("decodes")
}

fn apart(one: &[u8], other: &[u8]) -> u8 {
    one.iter().zip(other).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
}

fn main() {
    let rgb: Vec<u8> = (0..HEIGHT)
        .flat_map(|y| (0..WIDTH).flat_map(move |x| [2 * x as u8, (y * 5 / 2) as u8, 255 - 2 * x as u8]))
        .collect();
    println!("zune-jpeg 0.5.15, jpeg-decoder 0.3.2, jpeg-encoder 0.7.1; one scan against a scan for each channel:");
    let mut changed = false;
    for (name, sampling, is_wrong) in [
        ("4:4:4", SamplingFactor::F_1_1, false),
        ("4:2:2", SamplingFactor::F_2_1, false),
        ("4:2:0", SamplingFactor::F_2_2, true),
    ] {
        let (one, each) = (jpeg(&rgb, sampling, false), jpeg(&rgb, sampling, true));
        let scans = |bytes: &[u8]| bytes.windows(2).filter(|pair| *pair == [0xff, 0xda]).count();
        let zune = apart(&by_zune(&one, ColorSpace::RGB), &by_zune(&each, ColorSpace::RGB));
        let grey = apart(&by_zune(&one, ColorSpace::Luma), &by_zune(&each, ColorSpace::Luma));
        let other = apart(&by_jpeg_decoder(&one), &by_jpeg_decoder(&each));
        let scans = [scans(&one), scans(&each)];
        println!("{name}: {scans:?} scans; differences up to: zune {zune}, its grey {grey}, jpeg-decoder {other}");
        let as_before = if is_wrong { zune > 100 && grey > 50 } else { zune == 0 && grey == 0 };
        changed |= !as_before || other != 0 || scans != [1, 3];
    }
    if changed {
        eprintln!("changed: expected 4:2:0 to be wrong by zune-jpeg, and nothing else");
        std::process::exit(1);
    }
}
END
export CARGO_TARGET_DIR="$folder/target"
cargo run --quiet --manifest-path "$folder/Cargo.toml"
echo "as before"
