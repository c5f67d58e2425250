#!/usr/bin/env bash
# Builds the wheel, with the compiled module and the command `motet`, into target/wheels. Needs a Rust toolchain, and maturin on the path.
set -euo pipefail
cd "$(dirname "$0")/.."
folder="$(mkdir -p "${CARGO_TARGET_DIR:-target}" && cd "${CARGO_TARGET_DIR:-target}" && pwd)"

rm -rf "$folder/wheels"
CARGO_TARGET_DIR="$folder" maturin build --locked --quiet --release --compression-level 9 -m python/Cargo.toml --out "$folder/wheels"
ls -l "$folder"/wheels/*.whl
