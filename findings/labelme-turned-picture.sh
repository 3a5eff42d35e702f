#!/usr/bin/env bash
# One would expect: a picture has one size for LabelMe, whether it lies beside the marks or is embedded in them.
# What happens: a picture that EXIF says to turn by 90 degrees is turned when it lies beside the marks, and not when it is
#   embedded. A file of marks that states the stored size (imageWidth, imageHeight) is refused in the first case, one that
#   states the turned size in the second; marks that fit one do not fit the other.
# Why it matters here: marks are pixels of the camera as it stores them. Files of marks for LabelMe need pictures that are not
#   turned, or must state the size that LabelMe sees.
# Source: https://github.com/wkentaro/labelme/pull/305 (turning), https://github.com/wkentaro/labelme/issues/1529 (its export)
# Needs: python3 3.11 (about 730 MB in the temporary folder), libgl1 and libglib2.0-0 of Debian for its PyQt5.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check labelme==6.3.1 pillow==13.0.0
cd "$folder"
cat > reading.py <<'END'
import base64
import io
import json
import sys

import labelme
from labelme._label_file import LabelFileError, read_label_file
from loguru import logger
from PIL import ExifTags, Image

logger.remove()
print(f"labelme {labelme.__version__}")
exif = Image.Exif()
exif[ExifTags.Base.Orientation] = 6
stored = io.BytesIO()
Image.new("RGB", (64, 48), (200, 200, 200)).save(stored, "JPEG", exif=exif)
with open("picture.jpg", "wb") as file:
    file.write(stored.getvalue())


def is_read(embedded, width, height):
    data = base64.b64encode(stored.getvalue()).decode() if embedded else None
    size = {"imageWidth": width, "imageHeight": height}
    marks = {"version": "6.3.1", "flags": {}, "shapes": [], "imagePath": "picture.jpg", "imageData": data, **size}
    with open("marks.json", "w", encoding="utf-8") as file:
        json.dump(marks, file)
    try:
        read_label_file("marks.json")
    except LabelFileError as error:
        return f"refused ({str(error).split(': ', 1)[-1]})"
    return "read"


changed = False
for embedded in (False, True):
    for name, width, height in (("stored", 64, 48), ("turned", 48, 64)):
        got = is_read(embedded, width, height)
        print(f"picture {'embedded' if embedded else 'beside'}, {name} size {width} x {height} stated: {got}")
        changed |= (got == "read") != ((name == "stored") == embedded)
sys.exit("changed: expected the turned size beside, the stored one embedded" if changed else 0)
END
venv/bin/python -W ignore reading.py
echo "as before"
