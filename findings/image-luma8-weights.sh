#!/usr/bin/env bash
# One would expect: grey by the crate image is the grey that the JPEG itself stores.
# What happens: `to_luma8` weighs red, green and blue by Rec. 709 (0.2126, 0.7152, 0.0722); JPEG stores its luma by the older
#   weights of Rec. 601 (0.299, 0.587, 0.114), which OpenCV and Pillow use too. Pure green differs by 32 levels of 255,
#   pure red by 22.
# Why it matters here: a threshold or an edge in grey that is fitted with OpenCV is another one in Rust. Whoever compares greys
#   must take them from one source.
# Source: https://github.com/image-rs/image/issues/1554 (open); ITU-T T.871, clause 7
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
image = { version = "=0.25.10", default-features = false, features = ["jpeg"] }
zune-jpeg = "=0.5.15"
END
cat > "$folder/src/main.rs" <<'END'
use image::codecs::jpeg::JpegEncoder;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// Grey of a JPEG of one colour: as it is stored, and by `to_luma8`.
fn greys(colour: [u8; 3]) -> (u8, u8) {
    let mut jpeg = Vec::new();
    let picture = image::RgbImage::from_pixel(16, 16, image::Rgb(colour));
    JpegEncoder::new_with_quality(&mut jpeg, 100).encode_image(&picture).expect("encodes");
    let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::Luma);
    let stored = JpegDecoder::new_with_options(ZCursor::new(&jpeg), options).decode().expect("decodes")[0];
    let by_image = image::load_from_memory(&jpeg).expect("decodes").to_luma8().get_pixel(0, 0)[0];
    (stored, by_image)
}

fn main() {
    println!("image 0.25.10, luma plane by zune-jpeg 0.5.15");
    let mut changed = false;
    for (name, colour, stored_before, by_image_before) in [
        ("red", [255, 0, 0], 76, 54),
        ("green", [0, 255, 0], 150, 182),
        ("blue", [0, 0, 255], 29, 18),
        ("white", [255, 255, 255], 255, 255),
    ] {
        let (stored, by_image) = greys(colour);
        println!("{name}: the JPEG stores {stored}, to_luma8 gives {by_image}");
        changed |= stored.abs_diff(stored_before) > 1 || by_image.abs_diff(by_image_before) > 1;
    }
    if changed {
        eprintln!("changed: expected 76 and 54, 150 and 182, 29 and 18, 255 and 255");
        std::process::exit(1);
    }
}
END
export CARGO_TARGET_DIR="$folder/target"
cargo run --quiet --manifest-path "$folder/Cargo.toml"
echo "as before"
