#!/usr/bin/env bash
# One would expect: tables that are read or put together from several Parquet files keep no statement that is true of one of
#   them only, or refuse where the files' statements differ.
# What happens: pyarrow gives the whole the key-value metadata of the first part, by read_table of a list or folder, by a
#   dataset and by concat_tables, and writes them out with it: rows of one study under the hash and settings of another.
#   The order of the list decides which.
# Why it matters here: results.parquet says in its metadata by which study and settings its rows were made. Several
#   of them put together by pyarrow look like one run. DuckDB's COPY writes none of it.
# Source: https://arrow.apache.org/docs/python/dataset.html (the first file sets the schema); the metadata: measured here
# Needs: python3 3.11.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pyarrow==26.0.1 duckdb==2.0.1
cd "$folder"
venv/bin/python - <<'END'
import pathlib
import sys

import duckdb
import pyarrow
import pyarrow.dataset
import pyarrow.parquet

print(f"pyarrow {pyarrow.__version__}, duckdb {duckdb.__version__}")
pathlib.Path("parts").mkdir()
for study, size_mm in (("a", 250.0), ("b", 180.0)):
    table = pyarrow.table({"size_mm": [size_mm]}).replace_schema_metadata({"study": study})
    pyarrow.parquet.write_table(table, f"parts/{study}.parquet")
b_first = ["parts/b.parquet", "parts/a.parquet"]
duckdb.sql("COPY (SELECT * FROM 'parts/*.parquet') TO 'duckdb.parquet'")

WHOLES = {
    "read_table of a folder": (pyarrow.parquet.read_table("parts"), "a"),
    "read_table of a list, b first": (pyarrow.parquet.read_table(b_first), "b"),
    "dataset": (pyarrow.dataset.dataset("parts").to_table(), "a"),
    "concat_tables, b first": (pyarrow.concat_tables([pyarrow.parquet.read_table(part) for part in b_first]), "b"),
    "duckdb's COPY": (pyarrow.parquet.read_table("duckdb.parquet"), None),
}
changed = False
for name, (whole, expected) in WHOLES.items():
    pyarrow.parquet.write_table(whole, "whole.parquet")
    said = (pyarrow.parquet.read_schema("whole.parquet").metadata or {}).get(b"study")
    said = said and said.decode()
    print(f"{name}: {whole.num_rows} rows, written again as study {said}")
    changed |= said != expected or whole.num_rows != 2
sys.exit("changed: expected the first part's study from pyarrow and none from duckdb" if changed else 0)
END
echo "as before"
