#!/usr/bin/env bash
# Public descriptions of robots through `motet robots add`, compared with the official xacro (`pip install xacro`):
#     run.sh MOTET PACKAGES [XACRO]
# PACKAGES holds checkouts of ur_description, tiago_robot, pmb2_robot, pal_urdf_utils, pal_gripper, pal_hey5, pr2_common,
# stretch_ros2, realsense-ros and ros2_robotiq_gripper. With XACRO, a program that expands a xacro and finds these packages,
# each expansion is compared with its own.
set -euo pipefail
motet=$(realpath "$1") packages=$(realpath "$2") xacro="${3:-}"
here=$(cd "$(dirname "$0")" && pwd)
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT

try() {
    local name=$1 file=$2
    shift 2
    echo "== $name"
    local flags=()
    for argument in "$@"; do flags+=(--arg "$argument"); done
    "$motet" robots add "$packages/$file" --packages "$packages" --to "$out/$name" "${flags[@]}" 2>/dev/null
    "$motet" robots check "$out/$name" 2>/dev/null | tail -8 | cut -c1-200
    if [ -n "$xacro" ]; then
        "$xacro" "$packages/$file" "$@" >"$out/$name.urdf"
        python3 "$here/compare.py" "$out/$name.urdf" "$out/$name/robot.urdf"
    fi
}

try ur5e ur_description/urdf/ur.urdf.xacro ur_type:=ur5e name:=ur5e
cp "$here/ur5e_robotiq.urdf.xacro" "$packages/ur5e_robotiq.urdf.xacro"
try ur5e_robotiq ur5e_robotiq.urdf.xacro
rm "$packages/ur5e_robotiq.urdf.xacro"
try tiago tiago_robot/tiago_description/robots/tiago.urdf.xacro end_effector:=pal-gripper
try pr2 pr2_common/pr2_description/robots/pr2.urdf.xacro
try stretch stretch_ros2/stretch_description/batch/irma/urdf/stretch_description_standard.xacro
