#!/usr/bin/env bash
# One would expect: what Rerun makes of a recording still holds the camera's lens, or says that it does not.
# What happens: of foxglove.CameraCalibration only size and K arrive, as a pinhole camera. The lens (D, distortion_model) and
#   the rectified camera (R, P) are gone without a warning, and the message itself is not kept beside it: the file cannot be
#   turned back. `rerun mcap check --full` calls the recording whole.
# Why it matters here: the camera is part of what was measured with. An .rrd file is for looking, never the archive.
# Source: https://docs.foxglove.dev/docs/sdk/schemas/camera-calibration, https://github.com/rerun-io/rerun/issues/2315 (open)
# Needs: python3 3.11.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check rerun-sdk==0.41.0 foxglove-sdk==0.30.3
cd "$folder"
export HOME="$folder" NO_COLOR=1
venv/bin/rerun analytics disable > analytics.log 2>&1
cat > writing.py <<'END'
import foxglove
from foxglove.channels import CameraCalibrationChannel
from foxglove.messages import CameraCalibration, Timestamp

START_S = 1_768_471_200
writer = foxglove.open_mcap("camera.mcap")
camera = CameraCalibration(
    timestamp=Timestamp(START_S, 0),
    frame_id="camera",
    width=640,
    height=480,
    distortion_model="plumb_bob",
    D=[-0.312345, 0.101234, 0.0, 0.0, 0.0],
    K=[501.25, 0, 320, 0, 501.25, 240, 0, 0, 1],
    R=[1, 0, 0, 0, 1, 0, 0, 0, 1],
    P=[433.75, 0, 320, 0, 0, 433.75, 240, 0, 0, 0, 1, 0],
)
CameraCalibrationChannel("/camera/calibration").log(camera, log_time=START_S * 10**9)
writer.close()
END
venv/bin/python -W ignore writing.py
venv/bin/rerun --version
venv/bin/rerun mcap check --full camera.mcap 2>&1 | tee check.txt
venv/bin/rerun mcap convert camera.mcap -o camera.rrd 2>&1 | tee convert.txt
venv/bin/rerun rrd print -vvv --entity /camera/calibration camera.rrd > printed.txt 2> print.log
echo "components of the camera:"
grep -oE "component: [A-Za-z]+:[a-z_]+" printed.txt | sort -u
changed=0
grep -qE "^ok .*/camera/calibration" check.txt || changed=1
if grep -qiE "distortion|lens|unsupported" convert.txt; then changed=1; fi
grep -q "501.25" printed.txt || changed=1
for number in 0.312345 0.101234 433.75; do
    if grep -q "$number" printed.txt; then
        echo "$number is there"
        changed=1
    fi
done
if [ "$changed" = 1 ]; then
    echo "changed: expected K and the size alone, and no warning" >&2
    exit 1
fi
echo "K is there; D and P are not"
echo "as before"
