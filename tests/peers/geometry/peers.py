"""Other ways to answer `reach`, on exported targets: `peers.py TARGETS [--robot NAME] [--most N] [--seconds S] [--all] [--without PEER]`.

`sampled`: for up to 10 grasps inverse kinematics by damped least squares from up to 20 states at random (pinocchio), then RRT-Connect
(ompl) with coal's collisions. `graph`: a reachability graph as R-LGP builds it: 200 positions of the hand uniform in the room, each with up to 6 restarts
of inverse kinematics, 16 nearest neighbours, and a lazy Dijkstra search; the hand's orientation is ignored.
"""

import argparse
import heapq
import json
import math
import statistics
import time

import numpy as np
import ompl.base as ob
import ompl.geometric as og
import ompl.util as ou
import pinocchio as pin

from planner import Planner

GRASPS, STARTS = 10, 20
NODES, RESTARTS, NEIGHBOURS = 200, 6, 16
# A tree grows by at most so much of m and rad together.
RANGE = 1.0


def space_of(planner):
    """Where a robot moves: the plane and all directions, where it drives, and its joints. A state of it as a row of numbers, and back."""
    joints = ob.RealVectorStateSpace(len(planner.joints(planner.start)))
    joints.setBounds(box(planner.joints(planner.lower), planner.joints(planner.upper)))
    if not planner.drives:
        count = range(len(planner.joints(planner.start)))

        def write(state, values):
            for at in count:
                state[at] = float(values[at])

        return joints, lambda state: np.array([state[at] for at in count]), write
    plane, space = ob.SE2StateSpace(), ob.CompoundStateSpace()
    plane.setBounds(box(*planner.room))
    space.addSubspace(plane, 1.0)
    space.addSubspace(joints, 1.0)
    count = range(len(planner.joints(planner.start)))

    def read(state):
        base, arm = state[0], state[1]
        return np.array([base.getX(), base.getY(), base.getYaw(), *(arm[at] for at in count)])

    def write_both(state, values):
        base, arm = state[0], state[1]
        base.setXY(float(values[0]), float(values[1]))
        base.setYaw(math.remainder(float(values[2]), math.tau))
        for at in count:
            arm[at] = float(values[3 + at])

    return space, read, write_both


def box(lower, upper):
    bounds = ob.RealVectorBounds(len(lower))
    for at, (low, high) in enumerate(zip(lower, upper)):
        bounds.setLow(at, float(low))
        bounds.setHigh(at, float(high))
    return bounds


def connect(planner, goal, seconds):
    space, read, write = space_of(planner)
    setup = og.SimpleSetup(space)
    setup.setStateValidityChecker(lambda state: planner.is_free(read(state)))
    # As far apart as 2 cm of the longest way there is.
    setup.getSpaceInformation().setStateValidityCheckingResolution(0.02 / space.getMaximumExtent())
    start, end = space.allocState(), space.allocState()
    write(start, planner.start)
    write(end, goal)
    setup.setStartAndGoalStates(start, end)
    search = og.RRTConnect(setup.getSpaceInformation())
    search.setRange(RANGE)
    setup.setPlanner(search)
    setup.solve(seconds)
    return setup.haveExactSolutionPath()


def sampled(planner, case, chance, seconds):
    """Grasps in an order at random: for each a free state, from up to so many at random, and a way to it."""
    grasps = list(planner.grasps(case))
    for at, before in (grasps[it] for it in chance.permutation(len(grasps))[:GRASPS]):
        for _ in range(STARTS):
            state = planner.solve(at, planner.scatter(chance, at.translation))
            if state is None or not planner.is_free(state, exempt=True):
                continue
            first = planner.solve(before, state)
            if first is None or not planner.is_free(first) or not planner.is_way_free(first, state, exempt=True):
                continue
            if connect(planner, first, seconds):
                return True
            break
    return False


class Graph:
    """Of a room: where the hand can be, and what was found of the ways between."""

    def __init__(self, planner, chance):
        low, high = planner.tips()
        self.tips, self.states, self.known = [], [], {}
        for _ in range(NODES):
            tip = chance.uniform(low, high)
            found = state_at(planner, tip, chance)
            if found is not None:
                self.tips.append(tip)
                self.states.append(found)
        self.tips.append(planner.forward(planner.start).translation.copy())
        self.states.append(planner.start)
        self.start = len(self.states) - 1

    def answers(self, planner, case, chance):
        """Whether a way leads to a state with the hand at the object."""
        for at, _ in list(planner.grasps(case))[:1]:
            state = state_at(planner, at.translation, chance, exempt=True)
            if state is not None:
                return self.leads(planner, at.translation, state)
        return False

    def leads(self, planner, tip, state):
        tips, states = np.array([*self.tips, tip]), [*self.states, state]
        goal = len(self.states)
        edges = {at: set() for at in range(len(states))}
        for at in edges:
            far = np.linalg.norm(tips - tips[at], axis=1)
            for to in map(int, np.argsort(far)[1 : NEIGHBOURS + 1]):
                edges[at].add((far[to], to))
                edges[to].add((far[to], at))
        # Lazily: an edge is checked when it is taken; of those that do not end at the goal it is known for the next.
        done, heap, own = set(), [(0.0, self.start, self.start)], {}
        while heap:
            cost, at, before = heapq.heappop(heap)
            if at in done:
                continue
            key = (min(at, before), max(at, before))
            if at != before:
                known = own if goal in key else self.known
                if key not in known:
                    known[key] = planner.is_way_free(states[before], nearest(planner, states[at], states[before]), exempt=goal in key)
                if not known[key]:
                    continue
            done.add(at)
            if at == goal:
                return True
            for far, to in edges[at]:
                if to not in done:
                    heapq.heappush(heap, (cost + far, to, at))
        return False


def state_at(planner, tip, chance, exempt=False):
    for _ in range(RESTARTS):
        state = planner.solve(pin.SE3(np.eye(3), tip), planner.scatter(chance, tip), turns=False)
        if state is not None and planner.is_free(state, exempt):
            return state
    return None


def nearest(planner, state, before):
    """The same state with the yaw that is nearest to another's."""
    if not planner.drives:
        return state
    turned = state.copy()
    turned[2] = before[2] + math.remainder(state[2] - before[2], math.tau)
    return turned


class Asked:
    """Targets that a peer was asked for: whether it found a way, and seconds of the processor."""

    def __init__(self, name):
        self.name, self.found, self.seconds, self.inside, self.built = name, [], [], 0.0, []

    def row(self, own):
        times, total = sorted(self.seconds), sum(self.seconds)
        median = statistics.median(times)
        line = (
            f"  {self.name:8} recall {sum(self.found)} of {len(times)}, {100 * sum(self.found) / len(times):.1f} %; "
            f"median {1e3 * median:.2f} ms, 99 % within {1e3 * times[math.ceil(0.99 * len(times)) - 1]:.2f} ms"
        )
        found = [took for took, is_found in zip(self.seconds, self.found) if is_found]
        if len(found) < len(times):
            line += f", of what it found {1e3 * statistics.median(found or [math.nan]):.2f} ms"
        if self.inside:
            line += f"; {100 * self.inside / (total + sum(self.built)):.0f} % of it in compiled collision checks"
        if self.built:
            line += f"; a room's graph in {1e3 * statistics.median(self.built):.0f} ms before"
        return line + (f"; {median / own:.0f} times as long as motet" if own else ""), median


def clocked(run):
    begin = time.process_time()
    return run(), time.process_time() - begin


def ask(peers, case, number, seconds, graphs):
    """Each peer, for one target."""
    for peer in peers:
        planner, chance = Planner(case), np.random.default_rng(number)
        if peer.name == "graph":
            room = case["name"].rsplit(" ", 1)[0]
            if room not in graphs:
                graphs.clear()
                graphs[room], took = clocked(lambda: Graph(planner, chance))
                peer.built.append(took)
            run = lambda: graphs[room].answers(planner, case, chance)
        else:
            run = lambda: sampled(planner, case, chance, seconds)
        found, took = clocked(run)
        peer.found.append(found)
        peer.seconds.append(took)
        peer.inside += planner.inside


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("targets")
    arguments.add_argument("--robot", help="this one only")
    arguments.add_argument("--most", type=int, default=100, help="targets of each robot")
    arguments.add_argument("--seconds", type=float, default=2.0, help="for one search of a way")
    arguments.add_argument("--all", action="store_true", help="ask for what is not known to be reachable too")
    arguments.add_argument("--without", choices=["sampled", "graph"], help="leave one out")
    settings = arguments.parse_args()
    ou.setLogLevel(ou.LOG_NONE)
    robots = {}
    for line in open(settings.targets, encoding="utf-8"):
        case = json.loads(line)
        of = robots.setdefault(case["robot"], [])
        if settings.robot in (None, case["robot"]) and len(of) < settings.most:
            of.append(case)
    for name, cases in robots.items():
        reachable = [case for case in cases if case["is_reachable"]]
        if not reachable:
            continue
        print(f"{name}: {len(cases)} targets, {len(reachable)} reachable", flush=True)
        Planner(cases[0]).check(np.random.default_rng(0))
        own = Asked("motet")
        own.found = [case["said"] == "feasible" for case in reachable]
        own.seconds = [1e-6 * case["took_us"] for case in reachable]
        row, median = own.row(None)
        print(row, flush=True)
        peers, graphs = [Asked(it) for it in ("sampled", "graph") if it != settings.without], {}
        for number, case in enumerate(reachable):
            ask(peers, case, number, settings.seconds, graphs)
        for peer in peers:
            print(peer.row(median)[0], flush=True)
        if not settings.all:
            continue
        rest, others = [case for case in cases if not case["is_reachable"]], [Asked(it.name) for it in peers]
        for number, case in enumerate(rest):
            ask(others, case, number, settings.seconds, graphs)
        for peer in others:
            times = [1e3 * it for it in peer.seconds]
            print(f"  {peer.name:8} of {len(rest)} others found {sum(peer.found)}, median {statistics.median(times or [0]):.0f} ms", flush=True)


main()
