#!/usr/bin/env bash
# Builds the playground into a folder (target/playground by default): the module, the page and the examples. Needs the target
# wasm32-unknown-unknown and Node with npm. A server for static files can serve the folder.
set -euo pipefail
cd "$(dirname "$0")/../.."
target="${CARGO_TARGET_DIR:-target}"
out="${1:-$target/playground}"
rustup target list --installed 2>/dev/null | grep -q wasm32-unknown-unknown || rustup target add wasm32-unknown-unknown
cargo build --locked --profile wasm --target wasm32-unknown-unknown -p motet-playground
(cd view && { [ -d node_modules ] || npm ci --silent --no-audit --no-fund; })
mkdir -p "$out"
cp "$target/wasm32-unknown-unknown/wasm/motet_playground.wasm" "$out/motet.wasm"
node view/build.mjs --playground "$out"
