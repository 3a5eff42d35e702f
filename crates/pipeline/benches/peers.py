"""Parses what the benchmark asks for, as a scientist would with numpy and pandas: times in ns and g.

Reads lines 'HOW FILE' and answers each with the number of samples.
"""

import sys

import numpy as np
import pandas as pd

PACKET = np.dtype([("stamp_s", "<f8"), ("counts", "<i2", (4, 1022))])
STEPS_NS = np.round(np.arange(1022) * 1e9 / 128).astype(np.int64)


def packets_at_once(file):
    packets = np.fromfile(file, PACKET)
    times = ((packets["stamp_s"] * 1e9).astype(np.int64)[:, None] + STEPS_NS).ravel()
    counts = packets["counts"][:, :3].transpose(0, 2, 1).reshape(-1, 3)
    kept = ~(counts == -1).all(axis=1)
    return times[kept], (counts[kept] * 0.001).astype(np.float32)


def packets_each(file):
    times, values = [], []
    for packet in np.fromfile(file, PACKET):
        counts = packet["counts"][:3]
        kept = ~(counts == -1).all(axis=0)
        times.append((int(packet["stamp_s"] * 1e9) + STEPS_NS)[kept])
        values.append((counts[:, kept] * 0.001).astype(np.float32))
    return np.concatenate(times), np.concatenate(values, axis=1).T


def csv_pandas(file):
    table = pd.read_csv(file)
    times = (table["time_s"] * 1e9).astype(np.int64)
    return times.to_numpy(), table[["x_g", "y_g", "z_g"]].to_numpy(np.float32)


def csv_numpy(file):
    table = np.loadtxt(file, delimiter=",", skiprows=1)
    return (table[:, 0] * 1e9).astype(np.int64), table[:, 1:].astype(np.float32)


print("ready", flush=True)
for line in sys.stdin:
    how, file = line.strip().split(" ", 1)
    times, values = globals()[how](file)
    assert len(times) == len(values)
    print(len(times), flush=True)
