#!/usr/bin/env bash
# Robots against one NATS server with faults: run.sh quick|soak. Installs nats-server where it is missing, and skips
# with a message where that is not possible.
set -euo pipefail
cd "$(dirname "$0")"
root=$(cd ../../.. && pwd)
target="${CARGO_TARGET_DIR:-$root/target}"
motet="${MOTET:-$target/release/motet}"
if ! command -v nats-server >/dev/null; then
    (apt-get update -qq && apt-get install -y -qq nats-server) >/dev/null 2>&1 || true
fi
if ! command -v nats-server >/dev/null; then
    echo 'nats-server is not here and cannot be installed: skipped'
    exit 0
fi
CARGO_TARGET_DIR="$target/fleet" cargo build --locked --quiet --manifest-path "$root/cli/fleet/Cargo.toml"
soak=(python3 soak.py --folder "$target/fleet-soak" --motet "$motet" --fleet "$target/fleet/debug/motet-fleet")
case "${1:-quick}" in
    quick) "${soak[@]}" --all ;;
    soak)
        "${soak[@]}" --robots 20 --orders 2000 --secs 600 --server-kills 5 --agent-kills 20 --run-kills 15 --link-cuts 2 \
            --cut 60 --swaps 50 --patience 300 --all
        ;;
    *) echo "run.sh quick|soak"; exit 2 ;;
esac
