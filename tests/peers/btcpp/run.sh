#!/bin/sh
# Runs random policies in Motet's engine and, exported, in BehaviorTree.CPP: the same actions in the same order.
#
#     tests/peers/btcpp/run.sh FOLDER_OF_BEHAVIORTREE_CPP [COUNT]
#
# The folder holds the sources of version 4.9 or later (git clone https://github.com/BehaviorTree/BehaviorTree.CPP).
# They are built once, without ZeroMQ and SQLite, in target/peers/btcpp; no CMake is needed.
set -eu
peer=$(cd "$1" && pwd)
count=${2:-200}
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
out=$root/target/peers/btcpp
include="-I$peer/include -I$peer/3rdparty -I$peer/3rdparty/minitrace -I$peer/3rdparty/tinyxml2"
include="$include -I$peer/3rdparty/minicoro -I$peer/3rdparty/flatbuffers"
flags="-std=c++17 -O0 -w -DBTCPP_LIBRARY_VERSION=\"4\""
mkdir -p "$out/objects"
sources=$(cd "$peer" && find src 3rdparty/tinyxml2 3rdparty/minitrace -name '*.cpp' |
    grep -v 'groot2_publisher\|sqlite\|_WIN\|manual_node')
for source in $sources; do
    object=$out/objects/$(echo "$source" | tr / _).o
    [ -f "$object" ] || g++ $flags $include -c "$peer/$source" -o "$object"
done
g++ $flags $include "$here/runner.cpp" "$out"/objects/*.o -o "$out/runner" -lpthread -ldl
rm -rf "$out/cases"
cd "$root"
cargo run --quiet -p motet-tests --bin trees -- "$out/cases" "$count"
"$out/runner" "$out/cases"
