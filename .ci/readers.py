"""Opens what aim-batch wrote with other programs' libraries, and compares it with the cards and with docs/results.md.

Usage: readers.py STUDY MCAP_DIR RESULTS.parquet DICTIONARY.md TRUTH.parquet SIMULATE.md

The cards are decoded here anew, from the published packet facts (aim2-packets: int16, channel-major, 1022 samples, f64
stamp of the first sample in UTC seconds, -1 for 'no sample'), so that writer and reader cannot share a mistake.
"""

import hashlib
import json
import re
import sys
import tomllib
from pathlib import Path

import duckdb
import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.compute
import pyarrow.parquet as pq
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

RATE_HZ = 128
SAMPLES = 1022
G_PER_COUNT = 0.001

problems = []


def check(holds, place, fact):
    if not holds:
        problems.append(f"{place}: {fact}")


# --- Cards -----------------------------------------------------------------------------------------------------------


def packets(card, pattern, channels):
    """Times in ns and counts of all samples of a card that are not missing, in the order of the files."""
    packet = np.dtype([("stamp_s", "<f8"), ("counts", "<i2", (channels, SAMPLES))])
    times, counts = [], []
    for file in sorted(card.glob(pattern)):
        for one in np.fromfile(file, packet):
            kept = ~(one["counts"][: min(channels, 3)] == -1).all(axis=0)
            start_ns = round(float(one["stamp_s"]) * 1e9)
            times.append((start_ns + np.round(np.arange(SAMPLES) * 1e9 / RATE_HZ).astype(np.int64))[kept])
            counts.append(one["counts"].T[kept])
    return np.concatenate(times), np.concatenate(counts)


def camera_of(study, session):
    own = tomllib.loads((study / "cards" / session / "session.toml").read_text()).get("camera")
    name = own or tomllib.loads((study / "study.toml").read_text())["camera"]
    return tomllib.loads((study / "devices" / f"{name}.toml").read_text())


# --- MCAP ------------------------------------------------------------------------------------------------------------


def messages(path):
    """Messages by topic, each as (sequence, time in ns, decoded message), and metadata by name."""
    topics = {}
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for _, channel, message, decoded in reader.iter_decoded_messages():
            topics.setdefault(channel.topic, []).append((message.sequence, message.log_time, decoded))
        statistics = reader.get_summary().statistics
        check(statistics.message_count == sum(map(len, topics.values())), path.name, "the message count is wrong")
        metadata = {record.name: record.metadata for record in reader.iter_metadata()}
    return topics, metadata


def samples_of(found, fields):
    """Times in ns and values of the samples in block messages, as docs/devices.md describes them."""
    times, values = [], []
    for _, log_time, message in found:
        columns = np.array([getattr(message, field) for field in fields], dtype=np.float64).T
        offsets = np.round(np.arange(len(columns)) * message.step_ns) if message.step_ns > 0 else message.offset_ns
        times.append(log_time + np.asarray(offsets, dtype=np.int64))
        values.append(columns)
    return np.concatenate(times), np.concatenate(values)


def check_samples(place, found, times_ns, values, fields):
    check(bool(found), place, "no messages")
    if not found:
        return 0
    longest_ns = max(samples_of([one], fields)[0][-1] - one[1] for one in found)
    check(longest_ns < 1_000_000_000, place, f"a message spans {longest_ns} ns, so that a window of time within it seems empty")
    found_ns, decoded = samples_of(found, fields)
    check(len(found_ns) == len(times_ns), place, f"{len(found_ns)} samples, the card has {len(times_ns)}")
    if len(found_ns) != len(times_ns):
        return 0
    order = np.argsort(times_ns, kind="stable")
    worst_ns = np.abs(found_ns - times_ns[order]).max()
    # A stamp in f64 seconds resolves 0.24 microseconds in this century.
    check(worst_ns < 1000, place, f"times differ from the card's by up to {worst_ns} ns")
    same = np.allclose(decoded, values[order], rtol=1e-6, atol=1e-6, equal_nan=True)  # stored as 32-bit floats
    check(same, place, "values differ from the card's")
    return len(found_ns)


def check_images(place, topics, card):
    images = {sequence: message.data for sequence, _, message in topics.get("/camera/image", [])}
    files = {sequence: message.file for sequence, _, message in topics.get("/camera/file", [])}
    on_card = sorted(path.relative_to(card).as_posix() for path in card.glob("IMAGES/*.JPG"))
    check(sorted(files.values()) == on_card, place, f"images {sorted(files.values())}, the card has {on_card}")
    check(images.keys() == files.keys(), place, "the list of images does not name every image")
    for sequence in images.keys() & files.keys():
        file = card / files[sequence]
        same = file.is_file() and images[sequence] == file.read_bytes()
        check(same, place, f"{files[sequence]} is not the file on the card, byte for byte")


def check_calibration(place, topics, camera):
    found = [message for _, _, message in topics.get("/camera/calibration", [])]
    check(len(found) == 1, place, f"{len(found)} calibrations, expected 1")
    if len(found) != 1:
        return
    focal = camera.get("focal_px") or [camera["focal_mm"] * scale for scale in camera["scale_px_per_mm"]]
    (fx, fy), (cx, cy) = focal, camera["principal_px"]
    expected = [fx, camera.get("skew_px", 0.0), cx, 0.0, fy, cy, 0.0, 0.0, 1.0]
    check(np.allclose(found[0].K, expected, rtol=1e-12), place, f"K = {list(found[0].K)}, expected {expected}")
    size = (found[0].width, found[0].height)
    check(size == (camera["width_px"], camera["height_px"]), place, f"picture size {size}")
    lens = camera["lens"]
    if lens["model"] == "radial":  # Eq. (3) is plumb_bob's first coefficient, in focal lengths
        k1 = lens["k1"] if "k1" in lens else lens["k_per_mm2"] * camera["focal_mm"] ** 2
        check(np.allclose(found[0].D, [k1, 0, 0, 0, 0], rtol=1e-12), place, f"D = {list(found[0].D)}, expected k1 = {k1}")
        check(found[0].distortion_model == "plumb_bob", place, f"lens model {found[0].distortion_model}")


def check_metadata(place, metadata, card):
    for record in ["aim_batch.session", "aim_batch.profile", "aim_batch.camera", "aim_batch.inputs"]:
        check(record in metadata, place, f"no metadata record {record}")
    inputs = metadata.get("aim_batch.inputs", {})
    of_card = {name: digest for name, digest in inputs.items() if (card / name).is_file()}
    sensors = {path.relative_to(card).as_posix() for path in [*card.glob("SENSORS/*.BIN"), *card.glob("IMAGES/*.JPG")]}
    check(sensors <= of_card.keys(), place, f"no SHA-256 of {sorted(sensors - of_card.keys())}")
    for name, digest in of_card.items():
        check(hashlib.sha256((card / name).read_bytes()).hexdigest() == digest, place, f"SHA-256 of {name} is wrong")


def check_session(study, path):
    session, card = path.stem, study / "cards" / path.stem
    topics, metadata = messages(path)
    times_ns, counts = packets(card, "SENSORS/ACC*.BIN", 4)
    g = counts[:, :3] * G_PER_COUNT
    optical = np.where(counts[:, 3:] == -1, np.nan, counts[:, 3:])
    samples = 0
    for topic, values, fields in [("/imu/acceleration", g, ["x_g", "y_g", "z_g"]), ("/extra/optical", optical, ["value"])]:
        samples += check_samples(f"{session} {topic}", topics.get(topic, []), times_ns, values, fields)
    times_ns, mm = packets(card, "SENSORS/RNG*.BIN", 1)
    samples += check_samples(f"{session} /range", topics.get("/range", []), times_ns, mm.astype(float), ["range_mm"])
    check_images(session, topics, card)
    check_calibration(session, topics, camera_of(study, session))
    check_metadata(session, metadata, card)
    return {"samples": samples} | {topic: len(found) for topic, found in topics.items()}


# --- Parquet ---------------------------------------------------------------------------------------------------------

ARROW_TYPES = {
    "text": {pa.string(), pa.large_string(), pa.string_view()},
    "float64": {pa.float64()},
    "uint32": {pa.uint32()},
    "bool": {pa.bool_()},
    "timestamp[us, UTC]": {pa.timestamp("us", tz="UTC")},
}
PANDAS_TYPES = {"float64": "float64", "uint32": "uint32", "bool": "bool", "timestamp[us, UTC]": "datetime64[us, UTC]"}
DUCKDB_TYPES = {
    "text": {"VARCHAR"},
    "float64": {"DOUBLE"},
    "uint32": {"UINTEGER"},
    "bool": {"BOOLEAN"},
    "timestamp[us, UTC]": {"TIMESTAMP WITH TIME ZONE"},
}
UNITS = ("_mm", "_deg", "_pct", "_mg")
RATIOS = ("wall_slope", "weight", "chi_squared", "confidence", "rim_in_picture", "rim_seen")  # numbers without a unit


def dictionary(path, file):
    """Columns of one file as docs/results.md has them: name -> (type, may be empty)."""
    section = path.read_text().split(f"## {file}\n")[1].split("\n## ")[0]
    rows = re.findall(r"^\| `(\w+)` \| (.+?) \| (may be|never) \|", section, re.MULTILINE)
    return {name: (kind, empty == "may be") for name, kind, empty in rows}


def check_parquet(path, columns, rows):
    place, table = path.name, pq.read_table(path)
    check(len(columns) > 10, place, "the data dictionary has no such section")
    check(table.column_names == list(columns), place, f"columns {table.column_names}, the dictionary has {list(columns)}")
    frame = pd.read_parquet(path)
    duck = dict(duckdb.sql(f"SELECT column_name, column_type FROM (DESCRIBE FROM '{path}')").fetchall())
    duck_rows = duckdb.sql(f"SELECT count(*) FROM '{path}'").fetchall()[0][0]
    check(table.num_rows == len(frame) == duck_rows, place, f"rows: {table.num_rows}, {len(frame)} and {duck_rows}")
    check(table.num_rows == rows if rows else table.num_rows > 0, place, f"{table.num_rows} rows, expected {rows or 'some'}")
    for name, (kind, may_be_empty) in columns.items():
        if name not in table.column_names:
            continue
        at = f"{place} {name}"
        arrow_type = table.schema.field(name).type
        check(arrow_type in ARROW_TYPES[kind], at, f"pyarrow reads {arrow_type}, the dictionary says {kind}")
        check(duck.get(name) in DUCKDB_TYPES[kind], at, f"DuckDB reads {duck.get(name)}, the dictionary says {kind}")
        # pandas has no integers with empty cells.
        expected = "float64" if kind == "uint32" and table[name].null_count else PANDAS_TYPES.get(kind)
        check(expected in (None, str(frame[name].dtype)), at, f"pandas reads {frame[name].dtype}, expected {expected}")
        check(may_be_empty or table[name].null_count == 0, at, f"{table[name].null_count} empty cells, expected none")
        check(kind != "float64" or name.endswith(UNITS) or name in RATIOS, at, "a number without its unit in the name")
    check_times(place, path, frame)
    return table


def check_times(place, path, frame):
    """The times can be computed with: their span and order, and the number of whole minutes, are the same in every reader."""
    times = pq.read_table(path, columns=["time_utc"])["time_utc"]
    known = frame["time_utc"].dropna()
    first, last = known.min(), known.max()
    minutes = known.dt.floor("min").nunique()
    span_us = int((last - first) / pd.Timedelta(microseconds=1))
    bounds = pa.compute.min_max(times).as_py()
    check(int((bounds["max"] - bounds["min"]) / pd.Timedelta(microseconds=1)) == span_us, place, "pyarrow has another span of times")
    in_duckdb = duckdb.sql(
        f"SELECT epoch_us(max(time_utc)) - epoch_us(min(time_utc)), date_diff('microsecond', min(time_utc), max(time_utc)), "
        f"epoch(max(time_utc) - min(time_utc)), count(DISTINCT date_trunc('minute', time_utc)), "
        f"count(*) FILTER (time_utc > TIMESTAMPTZ '{first.isoformat()}') FROM '{path}'"
    ).fetchall()[0]
    expected = (span_us, span_us, span_us / 1e6, minutes, int((known > first).sum()))
    check(in_duckdb == expected, place, f"DuckDB computes with times: {in_duckdb}, pandas {expected}")


def check_run_metadata(path, table):
    place, metadata = path.name, table.schema.metadata or {}
    run = metadata.get(b"aim_batch.run")
    check(run is not None, place, "no key-value metadata aim_batch.run")
    if run is None:
        return
    keys = json.loads(run).keys()
    wanted = {"program", "study", "settings", "tables", "sessions", "inputs_sha256"}
    check(wanted <= keys, place, f"aim_batch.run lacks {sorted(wanted - keys)}")
    in_duckdb = duckdb.sql(f"SELECT decode(value) FROM parquet_kv_metadata('{path}') WHERE decode(key) = 'aim_batch.run'")
    check(in_duckdb.fetchall() == [(run.decode(),)], place, "DuckDB reads other metadata than pyarrow")


def check_truth(path, columns):
    table = check_parquet(path, columns, None)
    made_from = json.loads((table.schema.metadata or {}).get(b"aim_batch.simulate", b"{}"))
    check({"program", "seed"} <= made_from.keys(), path.name, f"aim_batch.simulate is {made_from}")
    return table


def main(study, mcap_dir, results, dictionary_md, truth, simulate_md):
    sessions = sorted(path.name for path in (study / "cards").iterdir() if path.is_dir())
    files = sorted(mcap_dir.glob("*.mcap"))
    check([path.stem for path in files] == sessions, mcap_dir.name, f"{[p.stem for p in files]}, expected {sessions}")
    totals = {}
    for path in files:
        for topic, count in check_session(study, path).items():
            totals[topic] = totals.get(topic, 0) + count
    images = len(list(study.glob("cards/*/IMAGES/*.JPG")))
    sizes = check_parquet(results, dictionary(dictionary_md, "results.parquet"), None)
    frames = check_parquet(results.with_name("frames.parquet"), dictionary(dictionary_md, "frames.parquet"), images)
    check_run_metadata(results, sizes)
    check_run_metadata(results.with_name("frames.parquet"), frames)
    truths = check_truth(truth, dictionary(simulate_md, "truth.parquet"))
    for problem in problems:
        print(f"readers: {problem}", file=sys.stderr)
    print(f"readers: {len(files)} MCAP files; {totals}; {sizes.num_rows} sizes, {frames.num_rows} frames;", end=" ")
    print(f"{truths.num_rows} rows of truth;", end=" ")
    print(f"{len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*map(Path, sys.argv[1:])))
