#!/usr/bin/env bash
# The TextMate grammar under the engine of VS Code. Says so where the engine cannot be installed.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
root="$(cd "$here/../../.." && pwd)"
folder="$root/target/textmate"
mkdir -p "$folder"
cp "$here/package.json" "$folder/"
if ! (cd "$folder" && timeout 120 npm install --silent --no-audit --no-fund --ignore-scripts >/dev/null 2>&1); then
    echo 'npm cannot install vscode-textmate and vscode-oniguruma: skipped'
    exit 0
fi
node "$here/check.mjs" "$folder" "$root"
