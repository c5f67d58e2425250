#!/usr/bin/env bash
# Builds the page anew and compares it with the committed one, then looks at runs in headless Chromium. Takes the motet command; skips
# itself where there is no Node, no npm or no Chromium.
set -euo pipefail
cd "$(dirname "$0")/../.."
motet="$(realpath "${1:-target/release/motet}")"
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
    echo 'there is no node with npm: skipped'
    exit 0
fi
if ! (cd view && npm ci --silent --no-audit --no-fund >/dev/null 2>&1); then
    echo 'npm cannot install the libraries of the page: skipped'
    exit 0
fi
(cd view && npm run --silent check)
if ! command -v chromium >/dev/null && [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
    (apt-get update && apt-get install --yes --no-install-recommends chromium) >/dev/null 2>&1 || true
fi
chromium="$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)"
if [ -z "$chromium" ]; then
    echo 'there is no Chromium: the page was built, and is not looked at'
    exit 0
fi
CHROMIUM="$chromium" exec node tests/view/page.mjs "$motet" "${@:2}"
