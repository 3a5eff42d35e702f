"""Opens annotated recordings with programs that are not ours: mcap and protobuf, and the command line of Rerun.

Usage: viewers.py ANNOTATED_DIR RESULTS.parquet
"""

import math
import os
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

import pandas as pd
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

LOOP, STRIP = 2, 3  # foxglove.PointsAnnotation.Type

problems = []


def check(holds, place, fact):
    if not holds:
        problems.append(f"{place}: {fact}")


def messages(path):
    """Messages by topic: time in ns -> decoded message (several: the last)."""
    topics, count = {}, Counter()
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for schema, channel, message, decoded in reader.iter_decoded_messages():
            check(schema.encoding == channel.message_encoding == "protobuf", path.name, f"{channel.topic}: no protobuf")
            topics.setdefault(channel.topic, {})[message.log_time] = decoded
            count[channel.topic] += 1
        statistics = reader.get_summary().statistics
        check(statistics.message_count == count.total(), path.name, "the message count is wrong")
    return topics, count


def check_frames(place, topics, frames):
    """Every recorded image has its numbers, and they are those of frames.parquet."""
    found = topics.get("/frame", {})
    check(found.keys() == topics.get("/camera/image", {}).keys(), place, "not every image has its numbers")
    by_file = {row.image: row for row in frames.itertuples()}
    for message in found.values():
        row = by_file.get(message.file)
        check(row is not None and row.reason == message.reason, place, f"{message.file}: reason {message.reason}")
        for name in ["pitch_deg", "roll_deg", "range_mm", "stillness_mg"]:
            ours, theirs = getattr(message, name), getattr(row, name)
            same = (math.isnan(ours) and pd.isna(theirs)) or ours == theirs
            check(same, place, f"{message.file}: {name} {ours}, frames.parquet has {theirs}")


def check_sizes(place, topics, results):
    """The sizes of images are in the results."""
    sizes = results[(results.level == "frame") & results.predicted_mm.notna()]
    known = {(row.object, row.rater, row.quantity, row.predicted_mm) for row in sizes.itertuples()}
    found = [one for topic, some in topics.items() if topic.startswith("/sizes/") for one in some.values()]
    check(bool(found), place, "no sizes")
    for one in found:
        key = (one.object, one.rater, one.quantity, one.size_mm)
        check(key in known, place, f"results.parquet does not have {key}")
        check(math.isnan(one.sigma_mm) or one.low_mm < one.size_mm < one.high_mm, place, f"{key}: bounds")
    return found


def check_overlays(place, topics, found):
    camera = next(iter(topics["/camera/calibration"].values()))
    check(topics["/camera/annotations"].keys() == topics["/camera/image"].keys(), place, "an image without annotations")
    lines = [line for message in topics["/camera/annotations"].values() for line in message.points]
    texts = [text.text for message in topics["/camera/annotations"].values() for text in message.texts]
    check(all(line.type in (LOOP, STRIP) and len(line.points) > 1 for line in lines), place, "a mark that is no line")
    inside = [0 <= p.x <= camera.width and 0 <= p.y <= camera.height for line in lines for p in line.points]
    check(sum(inside) > 0.9 * len(inside) > 0, place, f"{sum(inside)} of {len(inside)} points are in the pictures")
    for one in found:
        check(any(f"{one.quantity} {one.size_mm:.1f}" in text for text in texts), place, f"no text of {one.size_mm} mm")


def check_space(place, topics):
    """The optical axis, from the camera's place, meets the table ahead of it at the distance of the range."""
    for time, tf in topics.get("/tf", {}).items():
        q, t, frame = tf.rotation, tf.translation, topics["/frame"][time]
        check(abs(q.x**2 + q.y**2 + q.z**2 + q.w**2 - 1) < 1e-9, place, "a rotation that is none")
        axis_z = 1 - 2 * (q.x**2 + q.y**2)
        pitch_deg = math.degrees(math.asin(-axis_z))
        check(abs(pitch_deg - frame.pitch_deg) < 0.01, place, f"the camera looks {pitch_deg} deg down")
        height_m = frame.range_mm / 1000 * math.sin(math.radians(frame.pitch_deg))
        check(abs(t.z - height_m) < 1e-4, place, f"the camera is {t.z} m above the table, expected {height_m}")
        check(len(topics["/scene"][time].entities) > 1, place, "nothing stands on the table")


def rerun(*arguments):
    """What Rerun's command line says; its exit code must be 0."""
    program = Path(sys.executable).with_name("rerun")
    environment = {**os.environ, "RERUN_ANALYTICS": "0", "NO_COLOR": "1"}
    done = subprocess.run([program, *arguments], capture_output=True, text=True, env=environment, check=False)
    check(done.returncode == 0, f"rerun {' '.join(map(str, arguments))}", done.stdout + done.stderr)
    return done.stdout + done.stderr


def check_rerun(path, topics):
    info, checked = rerun("mcap", "info", path), rerun("mcap", "check", "--full", path)
    for topic in topics:
        check(topic in info, path.name, f"rerun does not list {topic}")
    listed = [line.split() for line in checked.splitlines() if any(f" {topic} " in line for topic in topics)]
    check(len(listed) == len(topics), path.name, f"rerun checks {len(listed)} topics of {len(topics)}")
    check(all(words[0] == "ok" for words in listed), path.name, f"rerun has objections:\n{checked}")
    with tempfile.TemporaryDirectory() as folder:
        rrd = Path(folder) / "session.rrd"
        rerun("mcap", "convert", path, "-o", rrd)
        check("without error" in rerun("rrd", "verify", rrd), path.name, "the converted file does not verify")
        printed = rerun("rrd", "print", "-v", rrd)
        for archetype in ["EncodedImage", "Pinhole", "Transform3D", "TextLog"]:
            check(archetype in printed, path.name, f"rerun shows no {archetype}")
        for field in ["FrameNumbers:message", "SizeNumbers:message"]:
            check(field in printed, path.name, f"rerun has nothing to plot from {field}")


def main(folder, results):
    sizes = pd.read_parquet(results)
    frames = pd.read_parquet(results.with_name("frames.parquet"))
    files = sorted(folder.glob("*.annotated.mcap"))
    check(len(files) == frames.session.nunique(), folder.name, f"{len(files)} files")
    total = Counter()
    for path in files:
        session = path.name.removesuffix(".annotated.mcap")
        topics, count = messages(path)
        for topic, number in count.items():
            total[topic.split("/")[1]] += number
        check_frames(session, topics, frames[frames.session == session])
        found = check_sizes(session, topics, sizes[sizes.session == session])
        check_overlays(session, topics, found)
        check_space(session, topics)
        check_rerun(path, topics)
    for problem in problems:
        print(f"viewers: {problem}", file=sys.stderr)
    print(f"viewers: {len(files)} annotated recordings, read by mcap and rerun; {dict(total)}; {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*map(Path, sys.argv[1:])))
