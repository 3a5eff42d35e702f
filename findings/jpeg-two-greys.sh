#!/usr/bin/env bash
# One would expect: reading a JPEG as grey gives what reading it in colour and then converting to grey gives, within a level.
# What happens: a decoder that is asked for grey returns the luma plane as it is stored; on the way over colour, chroma at
#   half resolution is spread over the edge first, and colours outside of 0 to 255 are cut off. With 4:2:0, along the rim of a
#   white plate on a red cloth, the two greys differ by more than 20 levels of 255; with 4:4:4 by a few.
#   OpenCV and Pillow agree with each other on either way.
# Why it matters here: the edge of a rim is looked for in pictures that were decoded to colour. A program beside it that reads
#   grey sees another edge, just where a rim is, and the two need not agree on its place.
# Source: ITU-T T.871, clause 7; https://docs.opencv.org/4.x/d4/da8/group__imgcodecs.html (notes on IMREAD_GRAYSCALE)
# Needs: python3 3.11.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check \
    opencv-python-headless==5.0.0.93 numpy==2.4.6 pillow==13.0.0
"$folder/venv/bin/python" - <<'END'
import io
import sys

import cv2
import numpy
import PIL
import PIL.Image

print(f"OpenCV {cv2.__version__}, Pillow {PIL.__version__}")
plate = numpy.full((160, 160, 3), (0, 0, 230), numpy.uint8)  # blue, green, red: a red cloth
cv2.circle(plate, (80, 80), 50, (250, 250, 250), -1)


def greys(sampling):
    """The picture by luma plane and by colour, by OpenCV and by Pillow."""
    options = [cv2.IMWRITE_JPEG_QUALITY, 95, cv2.IMWRITE_JPEG_SAMPLING_FACTOR, sampling]
    _, jpeg = cv2.imencode(".jpg", plate, options)
    stored = PIL.Image.open(io.BytesIO(jpeg.tobytes()))
    stored.draft("L", stored.size)
    by_colour = PIL.Image.open(io.BytesIO(jpeg.tobytes())).convert("L")
    return {
        "OpenCV, luma": cv2.imdecode(jpeg, cv2.IMREAD_GRAYSCALE),
        "OpenCV, colour": cv2.cvtColor(cv2.imdecode(jpeg, cv2.IMREAD_COLOR), cv2.COLOR_BGR2GRAY),
        "Pillow, luma": numpy.asarray(stored),
        "Pillow, colour": numpy.asarray(by_colour),
    }


def apart(one, other):
    return int(numpy.abs(one.astype(int) - other.astype(int)).max())


changed = False
for name, sampling, least, most in (
    ("4:2:0", cv2.IMWRITE_JPEG_SAMPLING_FACTOR_420, 15, 255),
    ("4:4:4", cv2.IMWRITE_JPEG_SAMPLING_FACTOR_444, 0, 8),
):
    grey = greys(sampling)
    ways = apart(grey["OpenCV, luma"], grey["OpenCV, colour"])
    luma = apart(grey["OpenCV, luma"], grey["Pillow, luma"])
    colour = apart(grey["OpenCV, colour"], grey["Pillow, colour"])
    print(f"{name}: luma against colour up to {ways} levels; OpenCV against Pillow {luma} by luma, {colour} by colour")
    changed |= not least <= ways <= most or luma > 1 or colour > 1
sys.exit("changed: expected the two ways to differ with 4:2:0" if changed else 0)
END
echo "as before"
