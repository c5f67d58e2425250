#!/usr/bin/env bash
# A headless Neovim as a client of `motet lsp`: diagnostics, an edit, hover, completion and formatting. Takes the
# command `motet`. Says so where Neovim cannot be installed.
set -euo pipefail
motet="$(realpath "$1")"
here="$(cd "$(dirname "$0")" && pwd)"

if ! command -v nvim >/dev/null; then
    if [ "$(id -u)" != 0 ] || ! timeout 120 apt-get install -y -qq --no-install-recommends neovim >/dev/null 2>&1; then
        echo 'Neovim cannot be installed: skipped'
        exit 0
    fi
fi

folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
printf 'robot = "hsr"\nscene = "kitchen"\n' >"$folder/motet.toml"
printf 'policy fetch for hsr {\n    go(kitchen_table)\n    handover(mug_1, user)\n}\n' >"$folder/fetch.motet"
cd "$folder"
XDG_CACHE_HOME="$folder" MOTET="$motet" timeout 60 nvim --headless -u NONE -n fetch.motet -c "luafile $here/client.lua"
