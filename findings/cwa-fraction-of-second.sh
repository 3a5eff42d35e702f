#!/usr/bin/env bash
# One would expect: readers of Axivity's CWA files give each sample the time that its block states, to a fraction of a second.
# What happens: newer loggers put the fraction of the stamp's second, in 1/32768 s, where older ones put their number, and
#   mark it by the top bit; the index of the stamped sample is moved back by the whole samples in the fraction. Two current
#   readers leave the fraction out, and the whole recording comes out too early by part of a sample: 31 ms of 40 ms in the file
#   here, whose first sample lies 1/32 s after a whole second. Open Movement's own package of 2021 counts the whole samples
#   in 16 bits, which overflow: samples come out up to 1.6 s late, and those after the last stamp all have that stamp's time.
#   With numpy 2 it ends in an OverflowError.
# Why it matters here: images are given pitch and range by time. Where another reader's times differ from ours, this is why.
# Source: https://github.com/openmovementproject/openmovement/blob/master/Docs/ax3/ax3-technical.md (deviceFractional)
# Needs: python3 3.11.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check \
    cwa-reader-rs==0.5.0 scikit-digital-health==0.17.18 numpy==2.4.6 pandas==3.1.1
python3 -m venv "$folder/venv-2021"
"$folder/venv-2021/bin/pip" install --quiet --disable-pip-version-check openmovement==0.0.1 numpy==1.26.4 pandas==2.2.3
cd "$folder"
cat > logger.py <<'END'
"""Writes logger.cwa: samples at 25 Hz, the first 1/32 s after ten o'clock."""

import datetime
import struct

RATE_HZ, RATE_CODE, PER_BLOCK, BLOCKS, STAMPED = 25, 0x48, 80, 12, 40
START = datetime.datetime(2026, 1, 15, 10)


def packed(time):
    """The time to a second, as CWA packs it into 32 bits."""
    fields = ((time.year - 2000, 26), (time.month, 22), (time.day, 17), (time.hour, 12), (time.minute, 6), (time.second, 0))
    return sum(value << shift for value, shift in fields)


def header():
    block = bytearray(1024)
    struct.pack_into("<2sHBHI", block, 0, b"MD", 1020, 0x17, 7, 7)
    struct.pack_into("<II", block, 13, packed(START), packed(START + datetime.timedelta(days=1)))
    struct.pack_into("<BIB", block, 36, RATE_CODE, packed(START), 50)
    block[64:512] = b" " * 448
    return bytes(block)


def data_block(number):
    """80 samples of three 16-bit numbers; the stamp is of the one in the middle."""
    seconds, samples = divmod(number * PER_BLOCK + STAMPED, RATE_HZ)
    fraction = 1024 + -(-samples * 32768 // RATE_HZ)  # of 32768; its whole samples are `samples`
    time = packed(START + datetime.timedelta(seconds=seconds))
    stamp = 0x8000 | fraction, 7, number, time, 0, 256, 0, 200, RATE_CODE, 0x32, STAMPED - samples, PER_BLOCK
    words = struct.pack("<2sHHIIIHHBBBBhH", b"AX", 508, *stamp)
    words += b"".join(struct.pack("<3h", number * PER_BLOCK + sample - 480, 0, 256) for sample in range(PER_BLOCK))
    return words + struct.pack("<H", -sum(struct.unpack("<255H", words)) % 65536)


with open("logger.cwa", "wb") as file:
    file.write(header() + b"".join(data_block(number) for number in range(BLOCKS)))
END
cat > reading.py <<'END'
"""Reads logger.cwa by the package that is named, and says how far its times are off."""

import importlib.metadata
import sys

import numpy

package, least_ms, most_ms = sys.argv[1], float(sys.argv[2]), float(sys.argv[3])
if package == "cwa-reader-rs":
    from cwa_reader_rs import read_cwa_file

    frame = read_cwa_file("logger.cwa")
    times_s, x = frame.index.values.astype("datetime64[ns]").astype(numpy.int64) / 1e9, frame.acc_x.values
elif package == "scikit-digital-health":
    from skdh.io import ReadCwa

    reading = ReadCwa().predict(file="logger.cwa", tz_name=None)
    times_s, x = reading["time"], reading["accel"][:, 0]
else:
    from openmovement.load import CwaData

    with CwaData("logger.cwa") as recording:
        times_s, x = recording.get_sample_values()[:, :2].T

index = numpy.arange(960)
late_ms = (times_s - (1_768_471_200 + 1 / 32 + index / 25)) * 1e3
same = numpy.allclose(x, (index - 480) / 256)
print(f"{package} {importlib.metadata.version(package)}: {len(times_s)} samples, values as written: {same},", end=" ")
print(f"times off by {late_ms.min():+.1f} to {late_ms.max():+.1f} ms")
held = same and abs(late_ms.min() - least_ms) < 1 and abs(late_ms.max() - most_ms) < 1
sys.exit(0 if held else f"changed: expected {least_ms} to {most_ms} ms")
END
venv/bin/python logger.py
venv/bin/python -W ignore reading.py cwa-reader-rs -31.25 -31.25
venv/bin/python -W ignore reading.py scikit-digital-health -31.25 -31.25
venv-2021/bin/python -W ignore reading.py openmovement -1560 1600
echo "as before"
