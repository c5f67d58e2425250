#!/bin/bash
# Runs a command in a network namespace of its own, whose loopback carries multicast. LOSS=50 loses 50 of
# 1000 packets that Cyclone DDS sends.
set -euo pipefail
inside='ip link set lo up && ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo
exec "$@"'
export CYCLONEDDS_URI='<CycloneDDS><Domain><General><Interfaces><NetworkInterface name="lo" multicast="true"/></Interfaces></General><Internal><Test><XmitLossiness>'"${LOSS:-0}"'</XmitLossiness></Test></Internal></Domain></CycloneDDS>'
exec unshare --map-root-user --net bash -c "$inside" bash "$@"
