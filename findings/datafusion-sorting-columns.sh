#!/usr/bin/env bash
# One would expect: ORDER BY gives rows in order, whatever the file says of itself.
# What happens: Parquet's `sorting_columns` belong to a row group and say that its rows are sorted. DataFusion takes them for
#   an order of the whole file and leaves the sort out: two row groups, each sorted, come out one after the other, and
#   LIMIT returns rows that are not the first.
# Why it matters here: a table that is written session by session has sorted row groups. It must not say so.
# Source: https://github.com/apache/parquet-format/blob/master/src/main/thrift/parquet.thrift (RowGroup.sorting_columns),
#   https://github.com/apache/datafusion/pull/19433 (since when)
# Needs: python3 3.11.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check datafusion==55.0.0 pyarrow==26.0.1
cd "$folder"
venv/bin/python - <<'END'
import sys

import datafusion
import pyarrow
import pyarrow.parquet

print(f"datafusion {datafusion.__version__}, pyarrow {pyarrow.__version__}")
sizes = pyarrow.table({"size_mm": [250, 260, 270, 110, 120, 130]})
pyarrow.parquet.write_table(sizes, "plain.parquet", row_group_size=3)
said = [pyarrow.parquet.SortingColumn(0)]
pyarrow.parquet.write_table(sizes, "sorted_groups.parquet", row_group_size=3, sorting_columns=said)

context = datafusion.SessionContext()
for name in ("plain", "sorted_groups"):
    context.register_parquet(name, f"{name}.parquet")


def ordered(name, limit):
    return context.sql(f"SELECT size_mm FROM {name} ORDER BY size_mm LIMIT {limit}").to_pydict()["size_mm"]


EXPECTED = {
    ("plain", 6): [110, 120, 130, 250, 260, 270],
    ("plain", 2): [110, 120],
    ("sorted_groups", 6): [250, 260, 270, 110, 120, 130],
    ("sorted_groups", 2): [250, 260],
}
changed = False
for (name, limit), expected in EXPECTED.items():
    got = ordered(name, limit)
    print(f"{name}: ORDER BY size_mm LIMIT {limit}: {got}")
    changed |= got != expected
sys.exit("changed: expected the wrong order where row groups say that they are sorted, and only there" if changed else 0)
END
echo "as before"
