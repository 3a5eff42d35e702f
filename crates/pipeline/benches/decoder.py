"""Decodes JPEG pictures in colour with libjpeg-turbo, by way of OpenCV.

Reads lines 'TIMES FILE', decodes the file so often from memory, and answers with the number of bytes of the picture.
"""

import re
import sys

import cv2
import numpy as np

cv2.setNumThreads(1)
jpeg = re.search(r"JPEG: *(.*libjpeg-turbo.*)", cv2.getBuildInformation())
assert jpeg, "this OpenCV decodes JPEG with something else"

print(f"ready {jpeg[1]} in OpenCV {cv2.__version__}", flush=True)
for line in sys.stdin:
    times, file = line.strip().split(" ", 1)
    jpeg = np.fromfile(file, np.uint8)
    for _ in range(int(times)):
        picture = cv2.imdecode(jpeg, cv2.IMREAD_COLOR)
    print(picture.size, flush=True)
