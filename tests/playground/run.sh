#!/usr/bin/env bash
# Builds the playground, and compares and uses it in headless Chromium. Takes the motet command, and a folder for pictures if they are
# wanted; skips itself where there is no Node, no Chromium or no target for WebAssembly.
set -euo pipefail
cd "$(dirname "$0")/../.."
motet="$(realpath "${1:-target/release/motet}")"
if ! command -v node >/dev/null || ! (cd view && npm ci --silent --no-audit --no-fund >/dev/null 2>&1); then
    echo 'there is no node with npm, or npm cannot install the libraries of the page: skipped'
    exit 0
fi
if ! rustup target list --installed 2>/dev/null | grep -q wasm32-unknown-unknown && ! rustup target add wasm32-unknown-unknown >/dev/null 2>&1; then
    echo 'there is no target for WebAssembly: skipped'
    exit 0
fi
motet/playground/build.sh
chromium="$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)"
if [ -z "$chromium" ]; then
    echo 'there is no Chromium: the playground was built, and is not used'
    exit 0
fi
CHROMIUM="$chromium" exec node tests/playground/playground.mjs "$motet" "${CARGO_TARGET_DIR:-target}/playground" "${@:2}"
