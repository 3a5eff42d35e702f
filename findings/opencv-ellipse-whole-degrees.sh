#!/usr/bin/env bash
# One would expect: cv2.ellipse, which takes its angle as a floating-point number, draws an ellipse at that angle.
# What happens: the angle is rounded to whole degrees, also in the form that takes a rotated rectangle, as cv2.fitEllipse
#   returns it. A rim that is fitted to a hundredth of a degree is drawn up to half a degree off, without a word.
# Why it matters here: fitted rims are drawn over pictures to be judged by eye. At half an axis of 600 px, half a degree is
#   more than 4 px, far more than a fit is off. Whoever draws our rims with OpenCV should draw them as polygons.
# Source: https://docs.opencv.org/4.x/d6/d6e/group__imgproc__draw.html (ellipse: double angle)
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
CENTRE, HALF_AXES = (640, 480), (600, 150)


def by_angle(degrees):
    return cv2.ellipse(numpy.zeros((960, 1280), numpy.uint8), CENTRE, HALF_AXES, degrees, 0, 360, 255, 1)


def by_rectangle(degrees):
    axes = tuple(2.0 * half for half in HALF_AXES)
    return cv2.ellipse(numpy.zeros((960, 1280), numpy.uint8), (CENTRE, axes, degrees), 255, 1)


def end_of_long_axis(picture):
    rows, columns = numpy.nonzero(picture)
    farthest = numpy.argmax(numpy.hypot(columns - CENTRE[0], rows - CENTRE[1]) * (columns > CENTRE[0]))
    return columns[farthest], rows[farthest]


changed = False
for name, draw in (("angle", by_angle), ("rotated rectangle", by_rectangle)):
    pictures = {degrees: draw(degrees) for degrees in (10.0, 10.49, 11.0)}
    same = numpy.array_equal(pictures[10.0], pictures[10.49])
    moves = not numpy.array_equal(pictures[10.0], pictures[11.0])
    print(f"{name}: 10.49 degrees draws the pixels of 10 degrees: {same}; 11 degrees draws others: {moves}")
    changed |= not (same and moves)

drawn = end_of_long_axis(by_angle(10.49))
turn = numpy.radians(10.49)
true = CENTRE[0] + HALF_AXES[0] * numpy.cos(turn), CENTRE[1] + HALF_AXES[0] * numpy.sin(turn)
off = numpy.hypot(drawn[0] - true[0], drawn[1] - true[1])
print(f"end of the long axis at 10.49 degrees: {off:.1f} px from where it is")
changed |= not 4.0 < off < 7.0
sys.exit("changed: expected whole degrees" if changed else 0)
END
echo "as before"
