"""Opens exported marks with COCO's own reader and with Python's XML reader, and compares them with the LabelMe files.

Usage: marks_readers.py STUDY RATER EXPORT.json EXPORT.xml
"""

import json
import sys
import xml.etree.ElementTree as ElementTree
from collections import Counter
from pathlib import Path

import numpy as np
from pycocotools.coco import COCO


def labelme(study, rater):
    """Every mark: picture (without extension), label, points."""
    marks = []
    for path in sorted((study / "marks" / rater).glob("*/*.json")):
        for shape in json.loads(path.read_text())["shapes"]:
            marks.append((f"{path.parent.name}/{path.stem}", shape["label"], tuple(map(tuple, shape["points"]))))
    return marks


def picture(name):
    """SESSION/IMAGES/NAME.JPG as SESSION/NAME."""
    path = Path(name)
    return f"{path.parts[0]}/{path.stem}"


def from_coco(path):
    coco = COCO(str(path))
    marks = []
    for one in coco.loadAnns(coco.getAnnIds()):
        image, category = coco.loadImgs(one["image_id"])[0], coco.loadCats(one["category_id"])[0]
        if one["segmentation"]:
            points = np.reshape(one["segmentation"][0], (-1, 2))
            pixels = int(coco.annToMask(one).sum())
            edge = np.abs(np.diff(points, axis=0, append=points[:1])).sum()
            assert abs(pixels - one["area"]) <= edge, f"annotation {one['id']}: {pixels} px, area {one['area']}"
        else:
            points = np.reshape(one["keypoints"], (-1, 3))[:, :2]
            assert one["num_keypoints"] == len(points) == len(category["keypoints"])
        box = np.array([*points.min(axis=0), *np.ptp(points, axis=0)])
        assert np.allclose(box, one["bbox"]), f"annotation {one['id']}: bbox {one['bbox']}, expected {box}"
        marks.append((picture(image["file_name"]), category["name"], tuple(map(tuple, points.tolist()))))
    return marks


def from_cvat(path):
    root = ElementTree.parse(path).getroot()
    assert root.tag == "annotations" and root.findtext("version") == "1.1"
    labels = {label.findtext("name") for label in root.iter("label")}
    marks = []
    for image in root.iter("image"):
        for shape in image:
            assert shape.tag in ("polygon", "polyline") and shape.get("label") in labels
            points = tuple(tuple(map(float, point.split(","))) for point in shape.get("points").split(";"))
            marks.append((picture(image.get("name")), shape.get("label"), points))
    return marks


def main(study, rater, coco, cvat):
    expected = Counter(labelme(Path(study), rater))
    for name, marks in (("COCO", from_coco(coco)), ("CVAT", from_cvat(cvat))):
        assert Counter(marks) == expected, f"{name}: {len(marks)} marks differ from {expected.total()} of LabelMe"
    print(f"{expected.total()} marks of {rater} are the same in LabelMe, COCO and CVAT files")


if __name__ == "__main__":
    main(*sys.argv[1:])
