#!/usr/bin/env bash
# Builds the core of BehaviorTree.CPP 4 and a runner with leaves that log, and compares the calls of exported trees with those of
# the engine. Takes the folder of the sources, or BTCPP_SOURCE; without one it clones them. Says so where that cannot be done, and
# builds once a version.
set -euo pipefail
cd "$(dirname "$0")/../../.."
version=4.10.0
place="${CARGO_TARGET_DIR:-target}/btcpp"
source="${1:-${BTCPP_SOURCE:-$place/source}}"
if ! command -v g++ >/dev/null; then
    echo 'there is no g++: skipped'
    exit 0
fi
mkdir -p "$place"
if [ ! -e "$source/include/behaviortree_cpp/bt_factory.h" ]; then
    if ! GIT_TERMINAL_PROMPT=0 git clone --quiet --depth 1 --branch "$version" \
        https://github.com/BehaviorTree/BehaviorTree.CPP "$source"; then
        echo "the sources of BehaviorTree.CPP $version cannot be had: skipped"
        exit 0
    fi
fi
source="$(cd "$source" && pwd)"
grep -q "VERSION $version " "$source/CMakeLists.txt" || { echo "$source is not version $version"; exit 1; }

# Neither Groot2's server nor SQLite: the trees, their parser and the nodes. An assertion of the library stops a tree that ends while
# it is halted, so there are none.
flags=(-std=c++17 -O1 -DNDEBUG -w "-DBTCPP_LIBRARY_VERSION=\"$version\"" "-I$source/include")
for part in '' /minitrace /tinyxml2 /minicoro /flatbuffers; do flags+=("-I$source/3rdparty$part"); done
objects="$place/$version"
mkdir -p "$objects"
# Prints the sources of the core, one a line.
sources() {
    find "$source/src" -name '*.cpp' | grep -vE '(WIN|manual_node)\.cpp$|/loggers/(groot2|bt_sqlite|bt_minitrace|bt_file)' | sort
    echo "$source/3rdparty/tinyxml2/tinyxml2.cpp"
}
build() {
    object="$objects/$(basename "$(dirname "$1")")_$(basename "$1" .cpp).o"
    [ -e "$object" ] || { g++ "${flags[@]}" -c "$1" -o "$object.part" && mv "$object.part" "$object"; }
}
if [ ! -e "$objects/libbtcpp.a" ]; then
    echo "building BehaviorTree.CPP $version"
    running=0
    while read -r file; do
        build "$file" &
        running=$((running + 1))
        if [ "$running" -ge "$(nproc)" ]; then
            wait -n
            running=$((running - 1))
        fi
    done < <(sources)
    wait
    ar rcs "$objects/libbtcpp.a" "$objects"/*.o
fi
g++ "${flags[@]}" tests/peers/btcpp/runner.cpp "$objects/libbtcpp.a" -lpthread -ldl -o "$place/runner"
MOTET_BTCPP_RUNNER="$(cd "$place" && pwd)/runner" cargo test --locked --quiet -p motet-btcpp --test btcpp \
    exported_tree_makes_the_calls_of_the_engine -- --nocapture
