#!/usr/bin/env bash
# Robots against one NATS server with faults: run.sh quick|soak. Installs nats-server where it is missing, and skips
# with a message where that is not possible. `run.sh s3` copies a journal to the S3 of moto and back.
set -euo pipefail
cd "$(dirname "$0")"
root=$(cd ../../.. && pwd)
target="${CARGO_TARGET_DIR:-$root/target}"
motet="${MOTET:-$target/release/motet}"
fleet="${MOTET_FLEET:-$target/debug/motet-fleet}"
build() { [ -n "${MOTET_FLEET:-}" ] || CARGO_TARGET_DIR="$target" cargo build --locked --quiet --manifest-path "$root/cli/fleet/Cargo.toml"; }
if [ "${1:-}" = s3 ]; then
    venv="$target/moto"
    [ -x "$venv/bin/moto_server" ] || { python3 -m venv "$venv" && "$venv/bin/pip" install --quiet 'moto[s3,server]'; }
    build
    "$venv/bin/moto_server" -H 127.0.0.1 -p 5555 >/dev/null 2>&1 &
    server=$! folder=$(mktemp -d)
    trap 'kill $server; rm -r "$folder"' EXIT
    until curl -sf -o /dev/null -X PUT http://127.0.0.1:5555/journals; do sleep 0.2; done
    export AWS_ACCESS_KEY_ID=x AWS_SECRET_ACCESS_KEY=x AWS_REGION=us-east-1 AWS_ENDPOINT=http://127.0.0.1:5555 AWS_ALLOW_HTTP=true
    "$motet" run "$root/examples/fetch_mug.motet" --robot hsr --scene kitchen --speed max --record "$folder/run" >/dev/null
    "$fleet" journal push "$folder/run" s3://journals/run-1
    "$fleet" journal pull s3://journals/run-1 "$folder/copy"
    rm -f "$folder/run/lock"
    diff -r "$folder/run" "$folder/copy"
    "$motet" replay "$folder/copy"
    exit 0
fi
if ! command -v nats-server >/dev/null; then
    (apt-get update -qq && apt-get install -y -qq nats-server) >/dev/null 2>&1 || true
fi
if ! command -v nats-server >/dev/null; then
    echo 'nats-server is not here and cannot be installed: skipped'
    exit 0
fi
build
page=()
chromium="$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)"
if [ -n "$chromium" ] && command -v node >/dev/null && [ -d "$root/view/node_modules/playwright-core" ]; then
    export CHROMIUM="$chromium"
    page=(--page "$PWD/page.mjs")
else
    echo 'there is no Chromium with the packages of view/: the page is not looked at in a browser'
fi
soak=(python3 soak.py "${page[@]}" --folder "$target/fleet-soak" --motet "$motet" --fleet "$fleet")
case "${1:-quick}" in
    quick) "${soak[@]}" --all ;;
    soak)
        "${soak[@]}" --robots 20 --orders 2000 --secs 600 --server-kills 5 --agent-kills 20 --run-kills 15 --link-cuts 2 \
            --cut 60 --swaps 50 --patience 300 --all
        ;;
    *) echo "run.sh quick|soak|s3"; exit 2 ;;
esac
