#!/usr/bin/env bash
# Builds the wheel, with the compiled module and the command `motet`, into target/wheels. Needs a Rust toolchain, and maturin on the path.
set -euo pipefail
cd "$(dirname "$0")/.."
folder="$(mkdir -p "${CARGO_TARGET_DIR:-target}" && cd "${CARGO_TARGET_DIR:-target}" && pwd)"

cargo build --locked --quiet --release -p motet-cli
# maturin puts what is in this folder on the path of whoever installs the wheel.
rm -rf python/motet._motet.data
mkdir -p python/motet._motet.data/scripts
cp "$folder/release/motet" python/motet._motet.data/scripts/
trap 'rm -rf python/motet._motet.data' EXIT
rm -rf "$folder/wheels"
CARGO_TARGET_DIR="$folder" maturin build --locked --quiet --release -m python/Cargo.toml --out "$folder/wheels"
ls -l "$folder"/wheels/*.whl
