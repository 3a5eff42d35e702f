#!/usr/bin/env bash
# One would expect: cv2.imdecode gives of the bytes of a file what cv2.imread gives of the file.
# What happens: of a JPEG that ends before its end marker, imread gives the picture, with a warning that the file ended too soon;
#   imdecode of the same bytes gives nothing at all. Pillow raises an error, unless it is told to load truncated files.
# Why it matters here: a card that lost power ends its last picture so. Whether such a picture counts must not depend on the call
#   by which it is read; the program drops it and says so (docs/ledger.md), and who counts pictures with OpenCV gets another number.
# Source: https://docs.opencv.org/4.x/d4/da8/group__imgcodecs.html (imdecode: 'reads an image from the specified buffer')
# Needs: python3 3.11.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check opencv-python-headless==5.0.0.93 numpy==2.4.6 pillow==13.0.0
cd "$folder"
venv/bin/python - <<'END'
import io
import sys

import cv2
import numpy
import PIL
from PIL import Image

print(f"OpenCV {cv2.__version__}, Pillow {PIL.__version__}")
rows, columns = numpy.mgrid[0:240, 0:320]
picture = numpy.stack([rows % 256, columns % 256, (rows + columns) % 256], axis=-1).astype(numpy.uint8)
cv2.imwrite("whole.jpg", picture)
whole = open("whole.jpg", "rb").read()
assert whole[-2:] == b"\xff\xd9", "a JPEG ends in its end marker"

changed = False
for name, data, expected in (("whole", whole, (True, True, True)), ("without end marker", whole[:-2], (True, False, False))):
    open("one.jpg", "wb").write(data)
    of_file = cv2.imread("one.jpg") is not None
    of_bytes = cv2.imdecode(numpy.frombuffer(data, numpy.uint8), cv2.IMREAD_COLOR) is not None
    try:
        Image.open(io.BytesIO(data)).load()
        by_pillow = True
    except OSError:
        by_pillow = False
    print(f"{name}: imread {of_file}, imdecode {of_bytes}, Pillow {by_pillow}")
    changed |= (of_file, of_bytes, by_pillow) != expected
sys.exit("changed: expected that only imread gives the cut picture" if changed else 0)
END
echo "as before"
