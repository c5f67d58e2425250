#!/usr/bin/env bash
# Tests of motet-ros2 against Eclipse Cyclone DDS, in a network namespace of their own: run.sh quick|fetch|physics|soak.
# MOTET and MOTET_ROS2 are the commands; without the second it is built. Skips with a message where a package cannot be installed or no
# namespace can be made.
set -euo pipefail
cd "$(dirname "$0")"
root=$(cd ../../.. && pwd)
target="${CARGO_TARGET_DIR:-$root/target}"
export MOTET="${MOTET:-$target/release/motet}"
which="${1:-quick}"
if ! ./netns.sh true 2>/dev/null; then
    echo 'no network namespace can be made here: skipped'
    exit 0
fi
venv="$target/ros2-venv"
[ -x "$venv/bin/pip" ] || python3 -m venv "$venv"
# Also where the environment stands already: the requirements may have changed since.
"$venv/bin/pip" install --quiet -r requirements.txt || { echo 'the Python packages cannot be installed: skipped'; exit 0; }
if [ -z "${MOTET_ROS2:-}" ]; then
    CARGO_TARGET_DIR="$target" cargo build --locked --quiet -p motet-ros2
    export MOTET_ROS2="$target/debug/motet-ros2"
fi
# `--driver ros2:…` finds the driver in PATH.
export PATH="$venv/bin:$(dirname "$MOTET_ROS2"):$PATH" PYTHONPATH="$root/runtime/mujoco:."
pytest=("$venv/bin/python" -m pytest -p no:cacheprovider -q -rs)
case "$which" in
    quick) ./netns.sh "${pytest[@]}" test_driver.py test_steps.py test_layouts.py test_tasks.py ;;
    fetch) ./netns.sh "${pytest[@]}" test_physics.py -k fetch_mug ;;
    physics) ./netns.sh "${pytest[@]}" test_physics.py ;;
    soak)
        GOALS=200 ./netns.sh "${pytest[@]}" -s test_driver.py -k random
        GOALS=200 LOSS=50 ./netns.sh "${pytest[@]}" -s test_driver.py -k random
        ;;
    *) echo "run.sh quick|fetch|physics|soak"; exit 2 ;;
esac
