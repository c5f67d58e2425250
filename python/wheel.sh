#!/usr/bin/env bash
# Builds the wheel, with the compiled module and the command `motet`, into target/wheels, and compares the stub of the module with
# the one that maturin generates. Needs a Rust toolchain, strip of binutils, and maturin and wheel of tests/requirements.txt.
set -euo pipefail
cd "$(dirname "$0")/.."
folder="$(mkdir -p "${CARGO_TARGET_DIR:-target}" && cd "${CARGO_TARGET_DIR:-target}" && pwd)"
export CARGO_TARGET_DIR="$folder"

rm -rf "$folder"/{wheels,stubs,unpacked}
maturin build --locked --quiet --release -m python/Cargo.toml --out "$folder/unpacked"
maturin generate-stubs --locked --quiet --profile release -m python/Cargo.toml --out "$folder/stubs"
if ! diff -u python/motet/_motet.pyi "$folder/stubs/motet/_motet.pyi"; then
    echo "the stub is not that of the module: cp $folder/stubs/motet/_motet.pyi python/motet/" >&2
    exit 1
fi

# The generator reads symbols that nobody else needs.
python3 -m wheel unpack --dest "$folder/unpacked" "$folder"/unpacked/*.whl
strip "$folder"/unpacked/motet-*/motet/_motet.*.so
mkdir "$folder/wheels"
python3 -m wheel pack --dest-dir "$folder/wheels" "$folder"/unpacked/motet-*/
ls -l "$folder"/wheels/*.whl
