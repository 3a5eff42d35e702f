#!/usr/bin/env bash
# One would expect: two times in UTC with nanoseconds can be subtracted, and reach pandas as times in UTC.
# What happens: a Parquet column `timestamp[ns, UTC]` becomes TIMESTAMPTZ_NS, for which DuckDB has no difference and no age();
#   in pandas the column has lost its zone, while it keeps it as an Arrow table, and in pandas after a cast to microseconds.
# Why it matters here: `time_utc` of results.parquet and frames.parquet is such a column. A query must cast it to TIMESTAMPTZ first.
# Source: https://duckdb.org/docs/stable/sql/data_types/timestamp; the same gap in another function:
#   https://github.com/duckdb/duckdb/issues/25476
# Needs: python3 3.11.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check duckdb==2.0.1 pyarrow==26.0.1 pandas==3.1.1
cd "$folder"
venv/bin/python - <<'END'
import sys

import duckdb
import pandas
import pyarrow
import pyarrow.parquet

print(f"duckdb {duckdb.__version__}, pyarrow {pyarrow.__version__}, pandas {pandas.__version__}")
NOON_NS = 1_767_268_800_000_000_000  # 2026-01-01, 12:00 UTC
times = pyarrow.array([NOON_NS + 123, NOON_NS + 2_500_000_456], pyarrow.timestamp("ns", "UTC"))
pyarrow.parquet.write_table(pyarrow.table({"time_utc": times}), "times.parquet")


def answer(expression):
    try:
        return duckdb.sql(f"SELECT {expression} FROM 'times.parquet'").fetchall()[0][0]
    except duckdb.Error as error:
        return type(error).__name__


EXPECTED = {
    "typeof(max(time_utc))": "TIMESTAMPTZ_NS",
    "max(time_utc) - min(time_utc)": "BinderException",
    "age(max(time_utc), min(time_utc))": "BinderException",
    "epoch_ns(max(time_utc)) - epoch_ns(min(time_utc))": 2_500_000_333,
}
changed = False
for expression, expected in EXPECTED.items():
    got = answer(expression)
    print(f"{expression}: {got}")
    changed |= got != expected

as_pandas = duckdb.sql("SELECT time_utc FROM 'times.parquet'").df().time_utc.dtype
after_cast = duckdb.sql("SELECT time_utc::TIMESTAMPTZ AS time_utc FROM 'times.parquet'").df().time_utc.dtype
as_arrow = duckdb.sql("SELECT time_utc FROM 'times.parquet'").to_arrow_table().schema.field("time_utc").type
print(f"as pandas: {as_pandas}; after a cast to TIMESTAMPTZ: {after_cast}; as Arrow: {as_arrow}")
changed |= as_pandas.kind != "M" or getattr(as_pandas, "tz", None) is not None
changed |= getattr(after_cast, "tz", None) is None or as_arrow.tz is None
sys.exit("changed: expected no difference, no age and no zone in pandas" if changed else 0)
END
echo "as before"
