#!/bin/bash
# Runs a command in a network namespace of its own, whose loopback carries multicast. LOSS=50 loses 50 of 1000
# packets, whoever sends them. Needs nft for that (Debian: nftables).
set -euo pipefail
inside='ip link set lo up && ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo
if [ -n "${LOSS:-}" ]; then
    nft add table inet loss
    nft "add chain inet loss input { type filter hook input priority 0 ; }"
    nft add rule inet loss input meta l4proto udp numgen random mod 1000 "<" "$LOSS" drop
fi
exec "$@"'
export CYCLONEDDS_URI='<CycloneDDS><Domain><General><Interfaces><NetworkInterface name="lo" multicast="true"/></Interfaces></General></Domain></CycloneDDS>'
exec unshare --map-root-user --net bash -c "$inside" bash "$@"
