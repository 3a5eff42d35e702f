#!/usr/bin/env bash
# One would expect: a row that DuckDB finds in a table is also found when the same table lies in a Parquet file.
# What happens: in a Parquet file by pyarrow or polars, `isnan(x)` finds no row, and `x > 5` loses the rows with NaN, which
#   DuckDB orders above every number. The smallest and largest value in the footer leave NaN out, as the format asks, and
#   DuckDB takes them for all that there is. `read_parquet(..., can_have_nan = true)` finds the rows.
# Why it matters here: results.parquet is meant for DuckDB too. A size that is not known is therefore empty, never NaN.
# Source: https://github.com/duckdb/duckdb/issues/25521 (open), https://github.com/duckdb/duckdb/pull/17883 (the option)
# Needs: python3 3.11.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check duckdb==2.0.1 pyarrow==26.0.1 polars==2.1.0
cd "$folder"
venv/bin/python - <<'END'
import math
import sys

import duckdb
import polars
import pyarrow
import pyarrow.parquet

print(f"duckdb {duckdb.__version__}, pyarrow {pyarrow.__version__}, polars {polars.__version__}")
sizes = pyarrow.table({"row": [1, 2, 3], "x": [1.0, math.nan, 4.0]})
pyarrow.parquet.write_table(sizes, "pyarrow.parquet")
polars.DataFrame(sizes).write_parquet("polars.parquet")

SOURCES = {
    "table": ("sizes", [2]),
    "file by pyarrow": ("'pyarrow.parquet'", []),
    "file by polars": ("'polars.parquet'", []),
    "file by pyarrow, can_have_nan": ("read_parquet('pyarrow.parquet', can_have_nan = true)", [2]),
}
changed = False
for name, (source, expected) in SOURCES.items():
    for condition in ("isnan(x)", "x > 5"):
        rows = [row for (row,) in duckdb.sql(f"SELECT row FROM {source} WHERE {condition}").fetchall()]
        print(f"{name}: rows where {condition}: {rows}")
        changed |= rows != expected
sys.exit("changed: expected row 2 from the table and with can_have_nan, none from the files" if changed else 0)
END
echo "as before"
