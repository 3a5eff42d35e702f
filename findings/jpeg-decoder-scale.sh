#!/usr/bin/env bash
# One would expect: a JPEG that is decoded at 1/2, 1/4 or 1/8 of its size gives the means of the pixels that become one.
# What happens: libjpeg-turbo does so within 2 levels of 255. `scale()` of the crate jpeg-decoder is off by more than 30 levels
#   at 1/2 on fine texture, and at 1/8 darker by 0.4 of a level in the mean.
# Why it matters here: rims are searched in pictures of reduced size. Decoding them so would be the quick way, and would
#   make cloth and food noisier than they are.
# Source: https://github.com/image-rs/jpeg-decoder/pull/117 (how it is made)
# Needs: cargo, python3 3.11 (for libjpeg-turbo, in OpenCV).
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check opencv-python-headless==5.0.0.93 numpy==2.4.6
mkdir "$folder/src"
cat > "$folder/Cargo.toml" <<'END'
[package]
name = "finding"
version = "0.0.0"
edition = "2024"

[dependencies]
jpeg-decoder = { version = "=0.3.2", default-features = false }
END
cat > "$folder/src/main.rs" <<'END'
//! Decodes texture.jpg at a half, a quarter and an eighth of its size, and writes the grey pixels.

fn main() {
    let jpeg = std::fs::read("texture.jpg").expect("is there");
    for part in [2, 4, 8] {
        let mut decoder = jpeg_decoder::Decoder::new(&jpeg[..]);
        let (width, height) = decoder.scale(256 / part, 256 / part).expect("has a size");
        assert_eq!((width, height), (256 / part, 256 / part));
        std::fs::write(format!("{part}.grey"), decoder.decode().expect("decodes")).expect("is written");
    }
}
END
cat > "$folder/texture.py" <<'END'
import cv2
import numpy

texture = numpy.random.default_rng(1).integers(64, 192, (256, 256)).astype(numpy.uint8)
cv2.imwrite("texture.jpg", texture, [cv2.IMWRITE_JPEG_QUALITY, 95])
END
cat > "$folder/compare.py" <<'END'
import sys

import cv2
import numpy

print(f"jpeg-decoder 0.3.2; libjpeg-turbo of OpenCV {cv2.__version__}; grey levels from the means of the decoded pixels:")
full = cv2.imread("texture.jpg", cv2.IMREAD_GRAYSCALE).astype(float)
changed = False
for part, mode, least in (
    (2, cv2.IMREAD_REDUCED_GRAYSCALE_2, 20.0),
    (4, cv2.IMREAD_REDUCED_GRAYSCALE_4, 8.0),
    (8, cv2.IMREAD_REDUCED_GRAYSCALE_8, 0.0),
):
    side = 256 // part
    means = full.reshape(side, part, side, part).mean(axis=(1, 3))
    crate = numpy.fromfile(f"{part}.grey", numpy.uint8).reshape(side, side) - means
    turbo = cv2.imread("texture.jpg", mode) - means
    print(f"1/{part}: jpeg-decoder up to {numpy.abs(crate).max():.1f}, mean {crate.mean():+.2f};", end=" ")
    print(f"libjpeg-turbo up to {numpy.abs(turbo).max():.1f}, mean {turbo.mean():+.2f}")
    changed |= numpy.abs(crate).max() < least or numpy.abs(turbo).max() > 2.0
    changed |= part == 8 and not -0.6 < crate.mean() < -0.2
sys.exit("changed: expected jpeg-decoder far from the means at 1/2 and 1/4, and darker at 1/8" if changed else 0)
END
export CARGO_TARGET_DIR="$folder/target"
cargo build --quiet --manifest-path "$folder/Cargo.toml"
cd "$folder"
venv/bin/python texture.py
target/debug/finding
venv/bin/python compare.py
echo "as before"
