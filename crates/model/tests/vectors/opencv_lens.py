"""Writes opencv_lens.csv: where OpenCV shows rays through its two lens models.

Usage: python3 opencv_lens.py > opencv_lens.csv     (needs: pip install numpy opencv-python-headless)

The camera matrix is the identity, so points are normalised coordinates (focal length 1). `ray_x, ray_y` is the direction
(x, y, 1). Only rays inside the monotone range are written: outside it OpenCV answers too, but not with an image point
that a lens could show.
"""

import math
import sys

import cv2
import numpy as np

ANGLES = [0.0, 0.3, 1.1, 2.0, 2.9, 3.6, 4.4, 5.5]  # directions around the axis, radians
SHARES = [0.02, 0.25, 0.5, 0.75, 0.95]  # of the largest radius

# k1, k2, p1, p2, k3
PLUMB_BOB = [
    (0.0, 0.0, 0.0, 0.0, 0.0),
    (-0.28, 0.07, 0.0002, 0.00002, 0.0),  # a machine-vision lens
    (-0.41, 0.22, -0.0011, 0.0017, -0.06),  # a wide action camera
    (0.11, -0.24, 0.0006, -0.0004, 0.12),  # a depth camera's colour lens
    (-0.35, 0.0, 0.0, 0.0, 0.0),  # one strong barrel term: folds back early
    (0.25, 0.0, 0.01, -0.02, 0.0),  # a badly centred pincushion
]
# k1, k2, k3, k4
FISHEYE = [
    (0.0, 0.0, 0.0, 0.0),
    (-0.008, -0.012, 0.009, -0.0024),  # a 190-degree lens
    (0.05, -0.02, 0.004, -0.0005),
    (-0.12, 0.03, -0.01, 0.001),
    (0.35, 0.25, 0.1, 0.05),
]


def largest(radius_of, end):
    """The end of the increasing part of `radius_of` on (0, end]."""
    x = np.linspace(0.0, end, 20001)
    falls = np.flatnonzero(np.diff(radius_of(x)) <= 0.0)
    return x[falls[0]] if len(falls) else end


def write(model, coefficients, ideal, distorted):
    k1, k2, p1, p2, k3, k4 = coefficients
    for (x, y), (u, v) in zip(ideal, distorted):
        print(",".join([model, *(repr(float(c)) for c in (k1, k2, p1, p2, k3, k4, x, y, u, v))]))


def rays(limit, radius_of_share):
    return np.array([
        [radius_of_share(share * limit) * math.cos(a), radius_of_share(share * limit) * math.sin(a)]
        for share in SHARES
        for a in ANGLES
    ])


def main():
    print(f"# OpenCV {cv2.__version__}, numpy {np.__version__}: made by opencv_lens.py")
    print("model,k1,k2,p1,p2,k3,k4,ray_x,ray_y,distorted_x,distorted_y")
    zero, eye = np.zeros(3), np.eye(3)
    for k1, k2, p1, p2, k3 in PLUMB_BOB:
        limit = largest(lambda r: r * (1 + k1 * r**2 + k2 * r**4 + k3 * r**6), 1.5)
        ideal = rays(limit, lambda r: r)
        points = np.column_stack([ideal, np.ones(len(ideal))])
        seen, _ = cv2.projectPoints(points, zero, zero, eye, np.array([k1, k2, p1, p2, k3]))
        write("plumb_bob", (k1, k2, p1, p2, k3, 0.0), ideal, seen.reshape(-1, 2))
    for k1, k2, k3, k4 in FISHEYE:
        limit = largest(lambda t: t * (1 + k1 * t**2 + k2 * t**4 + k3 * t**6 + k4 * t**8), math.radians(88))
        ideal = rays(limit, math.tan)
        points = np.column_stack([ideal, np.ones(len(ideal))]).reshape(-1, 1, 3)
        seen, _ = cv2.fisheye.projectPoints(points, zero, zero, eye, np.array([k1, k2, k3, k4]))
        write("fisheye", (k1, k2, 0.0, 0.0, k3, k4), ideal, seen.reshape(-1, 2))


if __name__ == "__main__":
    sys.exit(main())
