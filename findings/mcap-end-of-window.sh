#!/usr/bin/env bash
# One would expect: the readers of MCAP's own project give the same messages for the same start and end.
# What happens: `endTime` of the JavaScript reader counts a message at the end, `end_time` of the Python reader does not.
#   Windows that touch have a message at their border twice in the one, once in the other. Python now has other names, of
#   which `ending_at` and `ending_before` say which is meant; JavaScript has not.
# Why it matters here: an image or packet just at the end of a window is seen by a viewer in JavaScript, and not by the
#   script in Python beside it. Counts of the two differ by one.
# Source: https://github.com/foxglove/mcap/issues/1276, https://github.com/foxglove/mcap/pull/1805
# Needs: python3 3.11, node 18.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mcap==1.6.0
cd "$folder"
npm install --silent --no-audit --no-fund --prefix "$folder" @mcap/core@2.2.2 > npm.log 2>&1
cat > reading.py <<'END'
import importlib.metadata

from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer

with open("range.mcap", "wb") as file:
    writer = Writer(file, compression=CompressionType.NONE)
    writer.start("", "")
    channel = writer.register_channel("/range", "json", writer.register_schema("range", "jsonschema", b"{}"))
    for second in range(5):
        writer.add_message(channel, second * 10**9, b"{}", second * 10**9)
    writer.finish()


def seconds(**window):
    with open("range.mcap", "rb") as file:
        return ",".join(str(m.log_time // 10**9) for _, _, m in make_reader(file).iter_messages(**window))


print("mcap", importlib.metadata.version("mcap"))
print("start_time 1 s, end_time 3 s:", seconds(start_time=10**9, end_time=3 * 10**9))
print("starting_at 1 s, ending_at 3 s:", seconds(starting_at=10**9, ending_at=3 * 10**9))
END
cat > reading.mjs <<'END'
import { readFileSync } from "node:fs";
import { McapIndexedReader } from "@mcap/core";

const bytes = readFileSync("range.mcap");
const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, length) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + length))),
};
const reader = await McapIndexedReader.Initialize({ readable });
const seconds = [];
for await (const message of reader.readMessages({ startTime: 1_000_000_000n, endTime: 3_000_000_000n })) {
  seconds.push(message.logTime / 1_000_000_000n);
}
console.log("@mcap/core", JSON.parse(readFileSync("node_modules/@mcap/core/package.json", "utf8")).version);
console.log("startTime 1 s, endTime 3 s:", seconds.join(","));
END
venv/bin/python -W ignore reading.py | tee python.txt
node reading.mjs | tee node.txt
if ! grep -q "end_time 3 s: 1,2$" python.txt || ! grep -q "ending_at 3 s: 1,2,3$" python.txt ||
    ! grep -q "endTime 3 s: 1,2,3$" node.txt; then
    echo "changed: expected the message at 3 s from JavaScript's endTime and not from Python's end_time" >&2
    exit 1
fi
echo "as before"
