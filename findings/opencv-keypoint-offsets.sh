#!/usr/bin/env bash
# One would expect: the keypoint on a symmetric blob lies at its centre, and a mirrored picture has mirrored keypoints.
# What happens: SIFT's keypoints lie 0.25 px right of and below the blob's centre; with `enable_precise_upscale`, which is
#   off unless asked for, they lie on it. ORB's keypoints move by their level: a picture and its mirror image disagree by
#   twice the offset, by nothing at level 0, by 0.2 px at level 1, and in the picture here by more than 2 px at levels 5 to 7.
# Why it matters here: a point that is a quarter of a pixel off moves sizes on the table; corners of boards, and points that
#   link pictures, need a refinement of their own.
# Source: https://github.com/opencv/opencv/issues/23123 (SIFT, open); ORB: measured here
# Needs: python3 3.11.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check opencv-python-headless==5.0.0.93 numpy==2.4.6
"$folder/venv/bin/python" - <<'END'
import sys

import cv2
import numpy

print(f"OpenCV {cv2.__version__}")
STEP, COUNT = 96, 6


def blobs():
    """A picture of Gaussian blobs, and their centres in pixels, (0, 0) being the centre of the first."""
    random = numpy.random.default_rng(1)
    side = STEP * (COUNT + 1)
    rows, columns = numpy.mgrid[0:side, 0:side].astype(float)
    picture, centres = numpy.full((side, side), 60.0), []
    for row in range(1, COUNT + 1):
        for column in range(1, COUNT + 1):
            x, y = numpy.array([column, row]) * STEP + random.uniform(-0.5, 0.5, 2)
            picture += 150 * numpy.exp(-((columns - x) ** 2 + (rows - y) ** 2) / (2 * 2.0**2))
            centres.append((x, y))
    return numpy.round(picture).astype(numpy.uint8), numpy.array(centres)


def squares():
    """Bright squares on a dark ground, with edges as a lens leaves them."""
    picture = numpy.full((720, 720), 60, numpy.uint8)
    for row in range(1, 9):
        for column in range(1, 9):
            picture[row * 80 - 15 : row * 80 + 15, column * 80 - 15 : column * 80 + 15] = 200
    return cv2.GaussianBlur(picture, (0, 0), 0.7)


def nearest_offsets(points, others, within_px):
    offsets = []
    for point in points:
        by_other = others - point
        offset = by_other[numpy.argmin(numpy.hypot(*by_other.T))]
        if numpy.hypot(*offset) < within_px:
            offsets.append(offset)
    return numpy.array(offsets)


changed = False
picture, centres = blobs()
for precise, expected in ((False, 0.25), (True, 0.0)):
    found = cv2.SIFT_create(enable_precise_upscale=precise).detect(picture, None)
    offsets = nearest_offsets(centres, numpy.array([keypoint.pt for keypoint in found]), 2.0)
    x, y = offsets.mean(axis=0)
    print(f"SIFT, enable_precise_upscale {precise}: {len(offsets)} blobs, mean offset {x:+.3f}, {y:+.3f} px")
    changed |= len(offsets) != COUNT**2 or abs(x - expected) > 0.02 or abs(y - expected) > 0.02

picture = squares()
orb = cv2.ORB_create(nfeatures=20000, nlevels=8, edgeThreshold=10)
found, mirrored = orb.detect(picture, None), orb.detect(numpy.ascontiguousarray(picture[:, ::-1]), None)
last_column = picture.shape[1] - 1
twice = []
for level in range(8):
    points = numpy.array([keypoint.pt for keypoint in found if keypoint.octave == level])
    back = numpy.array([(last_column - k.pt[0], k.pt[1]) for k in mirrored if k.octave == level])
    twice.append(numpy.median(nearest_offsets(points, back, 4.0)[:, 0]))
print("ORB, picture against mirrored picture, px in x by level:", " ".join(f"{offset:.2f}" for offset in twice))
changed |= twice[0] != 0.0 or abs(twice[1] - 0.2) > 0.02 or min(abs(offset) for offset in twice[5:]) < 2.0
sys.exit("changed: expected SIFT 0.25 px off unless precise, ORB off by level" if changed else 0)
END
echo "as before"
