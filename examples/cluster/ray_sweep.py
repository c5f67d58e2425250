"""Checks the policies of a .jsonl file on a Ray cluster, with the Python package `motet`.

    pip install ray motet
    python ray_sweep.py policies.jsonl --robot hsr --scene kitchen --out verdicts.jsonl

On one machine `motet check policies.jsonl -j N` is simpler and faster.
"""

import argparse
import itertools
import json
import time

import ray

# A packet takes a worker a few tens of milliseconds, so that sending it costs little.
PACKET = 500
# Packets for each worker that are under way: so much is in memory.
AHEAD = 4


@ray.remote
class Checker:
    """A worker that builds the robot and the scene once."""

    def __init__(self, robot, scene):
        import motet

        self.environment = motet.Environment(robot=robot, scene=scene)

    def check(self, packet):
        """A line of the result for each policy: its line in the file, and its diagnostics."""
        lines = []
        for number, policy in packet:
            found = self.environment.check(policy)
            errors = sum(one["severity"] == "error" for one in found)
            lines.append({"line": number, "ok": errors == 0, "errors": errors, "diagnostics": found})
        return lines


def packets(path):
    with open(path, encoding="utf-8") as file:
        numbered = ((number, line) for number, line in enumerate(file, 1) if line.strip())
        while packet := list(itertools.islice(numbered, PACKET)):
            yield packet


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("policies")
    parser.add_argument("--robot", default="hsr")
    parser.add_argument("--scene", default="kitchen")
    parser.add_argument("--out", required=True)
    parser.add_argument("--workers", type=int, help="by default one for each core of the cluster")
    args = parser.parse_args()
    ray.init()
    workers = args.workers or int(ray.cluster_resources()["CPU"])
    pool = ray.util.ActorPool([Checker.remote(args.robot, args.scene) for _ in range(workers)])
    begun, checked, wrong = time.perf_counter(), 0, 0
    waiting = packets(args.policies)
    with open(args.out, "w", encoding="utf-8") as out:
        for packet in itertools.islice(waiting, workers * AHEAD):
            pool.submit(lambda worker, packet: worker.check.remote(packet), packet)
        # Results come in the order of the packets.
        while pool.has_next():
            for line in pool.get_next():
                checked, wrong = checked + 1, wrong + (not line["ok"])
                out.write(json.dumps(line) + "\n")
            for packet in itertools.islice(waiting, 1):
                pool.submit(lambda worker, packet: worker.check.remote(packet), packet)
    spent = time.perf_counter() - begun
    print(f"{checked} policies in {spent:.1f} s on {workers} workers, {checked / spent:.0f}/s; {wrong} with errors")


if __name__ == "__main__":
    main()
