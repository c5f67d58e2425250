#!/usr/bin/env bash
# Records a run, exports it, and reads it back with the Python package `mcap`. Takes the motet command; skips itself where there
# is no Python, or where the package cannot be had.
set -euo pipefail
cd "$(dirname "$0")/../../.."
motet="${1:-target/release/motet}"
target="${CARGO_TARGET_DIR:-target}"
place="$target/mcap"
if ! python3 -m venv --help >/dev/null 2>&1; then
    echo 'there is no python3 with venv: skipped'
    exit 0
fi
if [ ! -x "$place/venv/bin/python" ] || ! "$place/venv/bin/python" -c 'import mcap' 2>/dev/null; then
    rm -rf "$place/venv"
    if ! { python3 -m venv "$place/venv" && "$place/venv/bin/pip" install --quiet 'mcap>=1.2,<2'; }; then
        echo 'the Python package mcap cannot be had: skipped'
        exit 0
    fi
fi
rm -rf "$place/run"
"$motet" run examples/fetch_mug.motet --robot hsr --scene kitchen --speed max --record "$place/run" >/dev/null
"$motet" replay "$place/run"
"$motet" export mcap "$place/run" -o "$place/run.mcap"
"$place/venv/bin/python" tests/peers/mcap/read.py "$place/run.mcap"
