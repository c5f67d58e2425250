#!/usr/bin/env bash
# The extension in a real VS Code in a browser: the error of a policy in its Problems panel, a hover, a lens, and a
# quick fix. Not part of CI: it installs some 300 MB. Takes the command `motet` and a folder for the pictures; needs
# Node 20, npm, Chromium (`chromium` or the variable CHROMIUM) and Python 3.
set -euo pipefail
motet="$(realpath "$1")"
pictures="$(realpath -m "${2:-target/vscode/pictures}")"
here="$(cd "$(dirname "$0")" && pwd)"
root="$(cd "$here/../../.." && pwd)"
work="$(realpath -m "${CODE_SERVER_FOLDER:-$root/target/vscode}")"
mkdir -p "$work" "$pictures"

if [ ! -d "$work/server/node_modules/code-server" ]; then
    mkdir -p "$work/server"
    (
        cd "$work/server"
        npm init -y >/dev/null
        # The last of its line for Node 20. Its install scripts would download, so the native parts are built here.
        npm install --silent --no-audit --no-fund --ignore-scripts code-server@4.99.4
        (
            cd node_modules/code-server/lib/vscode
            npm install --silent --no-audit --no-fund --omit=dev --ignore-scripts
            npm rebuild --silent @vscode/spdlog native-watchdog
        )
        npm rebuild --silent argon2
    )
fi
if [ ! -d "$work/browser/node_modules/playwright-core" ]; then
    mkdir -p "$work/browser"
    (cd "$work/browser" && npm init -y >/dev/null && npm install --silent --no-audit --no-fund playwright-core@1.65.1)
fi

run="$(mktemp -d)"
server=
finish() {
    if [ -n "$server" ]; then kill "$server" 2>/dev/null || true; fi
    rm -rf "$run"
}
trap finish EXIT
mkdir -p "$run/extensions" "$run/data/User" "$run/home"
cp -r "$root/editors/vscode" "$run/extensions/motet.motet-0.1.0"
(cd "$run/extensions/motet.motet-0.1.0" && npm install --silent --no-audit --no-fund --omit=dev)
cat >"$run/data/User/settings.json" <<JSON
{"motet.path": "$motet", "security.workspace.trust.enabled": false, "workbench.startupEditor": "none",
 "telemetry.telemetryLevel": "off", "editor.codeLens": true, "window.menuBarVisibility": "hidden"}
JSON
printf 'robot = "hsr"\nscene = "kitchen"\n' >"$run/home/motet.toml"
cp "$here/fetch.motet" "$run/home/"

port="$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')"
XDG_CACHE_HOME="$run/cache" node "$work/server/node_modules/code-server/out/node/entry.js" --auth none \
    --bind-addr "127.0.0.1:$port" --user-data-dir "$run/data" --extensions-dir "$run/extensions" \
    --disable-telemetry --disable-update-check "$run/home" >"$run/log" 2>&1 &
server=$!
PLAYWRIGHT="$work/browser" timeout 180 node "$here/check.mjs" "http://127.0.0.1:$port/?folder=$run/home" "$pictures" \
    || { tail -40 "$run/log"; exit 1; }
