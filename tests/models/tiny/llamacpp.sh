#!/usr/bin/env bash
# Builds llama.cpp's own server from the sources of llama-cpp-python and runs llamacpp.py against it. Not part of CI: the build
# takes about a quarter of an hour on two cores. What is built stays under target/llamacpp.
#
#     tests/models/tiny/llamacpp.sh [MOTET [MODELS]]
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
root="$(cd "$here/../../.." && pwd)"
folder="${LLAMACPP_FOLDER:-$root/target/llamacpp}"
mkdir -p "$folder"
cd "$folder"

if [ ! -x venv/bin/cmake ]; then
    python3 -m venv venv
    # What the sources are unpacked and built with, then what the model is made with.
    venv/bin/pip install --quiet cmake ninja scikit-build-core flit-core -r "$here/llamacpp.txt"
fi
PATH="$folder/venv/bin:$PATH"

version=0.3.36
if [ ! -x build/bin/llama-server ]; then
    pip download --quiet --no-deps --no-binary :all: --no-build-isolation -d sdist "llama-cpp-python==$version"
    tar -xzf "sdist/llama_cpp_python-$version.tar.gz" -C sdist
    cmake -S "sdist/llama_cpp_python-$version/vendor/llama.cpp" -B build -G Ninja -DCMAKE_BUILD_TYPE=Release \
        -DBUILD_SHARED_LIBS=OFF -DGGML_NATIVE=OFF -DGGML_OPENMP=OFF -DLLAMA_OPENSSL=OFF -DLLAMA_BUILD_TESTS=OFF \
        -DLLAMA_BUILD_EXAMPLES=OFF -DLLAMA_BUILD_APP=OFF -DLLAMA_BUILD_UI=OFF -DLLAMA_USE_PREBUILT_UI=OFF
    nice -n 19 cmake --build build --target llama-server
fi

motet="${1:-}"
if [ -z "$motet" ]; then
    (cd "$root" && cargo build --quiet --release -p motet)
    motet="$root/target/release/motet"
fi
python "$here/llamacpp.py" build/bin/llama-server "$(cd "$root" && realpath "$motet")" "${2:-3}"
