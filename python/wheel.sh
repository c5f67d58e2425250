#!/usr/bin/env bash
# Builds the wheel, with the compiled module and the command `motet`, into target/wheels: wheel.sh [PROFILE]. The profile `release` shares
# its builds with the command `motet`; `wheel`, the default, is smaller. Compares the stub of the module with the one that maturin
# generates. Needs a Rust toolchain, strip of binutils, and maturin and wheel of tests/requirements.txt.
set -euo pipefail
cd "$(dirname "$0")/.."
folder="$(mkdir -p "${CARGO_TARGET_DIR:-target}" && cd "${CARGO_TARGET_DIR:-target}" && pwd)"
export CARGO_TARGET_DIR="$folder"
how=(--locked --quiet --profile "${1:-wheel}" -m python/Cargo.toml)

rm -rf "$folder"/{wheels,stubs,unpacked}
# The generator of the stub reads symbols that nobody else needs.
maturin build "${how[@]}" --out "$folder/unpacked" -- -C strip=none
maturin generate-stubs "${how[@]}" --out "$folder/stubs" -- -C strip=none
if ! diff -u python/motet/_motet.pyi "$folder/stubs/motet/_motet.pyi"; then
    echo "the stub is not that of the module: cp $folder/stubs/motet/_motet.pyi python/motet/" >&2
    exit 1
fi
python3 -m wheel unpack --dest "$folder/unpacked" "$folder"/unpacked/*.whl
strip "$folder"/unpacked/motet-*/motet/_motet.*.so
mkdir "$folder/wheels"
python3 -m wheel pack --dest-dir "$folder/wheels" "$folder"/unpacked/motet-*/
ls -l "$folder"/wheels/*.whl
