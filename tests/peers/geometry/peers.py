"""Other ways to answer `reach`, on exported targets: `peers.py TARGETS [--most N] [--seconds S]`.

`sampled`: inverse kinematics by damped least squares from up to 20 states at random (pinocchio), then RRT-Connect (ompl) with coal's
collisions. `graph`: a reachability graph as R-LGP builds it: 200 positions of the hand uniform in the room, each with up to 6 restarts
of inverse kinematics, 16 nearest neighbours, and a lazy Dijkstra search; the hand's orientation is ignored.
"""

import argparse
import heapq
import json
import statistics
import time

import numpy as np
import ompl.base as ob
import ompl.geometric as og
import ompl.util as ou
import pinocchio as pin

from planner import Planner

NODES, RESTARTS, NEIGHBOURS = 200, 6, 16


def connect(planner, goal, seconds):
    space = ob.RealVectorStateSpace(len(goal))
    bounds = ob.RealVectorBounds(len(goal))
    for at, (low, high) in enumerate(zip(planner.lower, planner.upper)):
        bounds.setLow(at, float(low))
        bounds.setHigh(at, float(high))
    space.setBounds(bounds)
    setup = og.SimpleSetup(space)
    row = lambda state: np.array([state[at] for at in range(len(goal))])
    setup.setStateValidityChecker(lambda state: planner.is_free(row(state)))
    # As far apart as 2 cm of the longest way there is.
    setup.getSpaceInformation().setStateValidityCheckingResolution(0.02 / space.getMaximumExtent())
    start, end = space.allocState(), space.allocState()
    for at in range(len(goal)):
        start[at], end[at] = float(planner.start[at]), float(goal[at])
    setup.setStartAndGoalStates(start, end)
    setup.setPlanner(og.RRTConnect(setup.getSpaceInformation()))
    setup.solve(seconds)
    return setup.haveExactSolutionPath()


def sampled(planner, case, chance, seconds):
    grasps = list(planner.grasps(case))
    for _ in range(20 if grasps else 0):
        at, before = grasps[chance.integers(len(grasps))]
        state = planner.solve(at, planner.scatter(chance, at.translation))
        if state is None or not planner.is_free(state, exempt=True):
            continue
        first = planner.solve(before, state)
        if first is None or not planner.is_free(first) or not planner.is_way_free(first, state, exempt=True):
            continue
        if connect(planner, first, seconds):
            return True
    return False


class Graph:
    def __init__(self, planner, case, chance):
        self.planner = planner
        things = np.array([it["pose"][:3] for it in case["obstacles"]] + [[*planner.stand[:2], 0.0]])
        low, high = things.min(axis=0) - planner.reach, things.max(axis=0) + planner.reach
        low[2] = max(low[2], 0.0)
        self.tips, self.states = [], []
        for _ in range(NODES):
            tip = chance.uniform(low, high)
            found = self.state(tip, chance)
            if found is not None:
                self.tips.append(tip)
                self.states.append(found)
        self.start = self.join(planner.forward(planner.start).translation, planner.start)

    def state(self, tip, chance, exempt=False):
        for _ in range(RESTARTS):
            goal = pin.SE3(np.eye(3), tip)
            state = self.planner.solve(goal, self.planner.scatter(chance, tip), turns=False)
            if state is not None and self.planner.is_free(state, exempt):
                return state
        return None

    def join(self, tip, state):
        self.tips.append(np.array(tip))
        self.states.append(state)
        return len(self.states) - 1

    def near(self, at):
        far = np.linalg.norm(np.array(self.tips) - self.tips[at], axis=1)
        return [(far[to], int(to)) for to in np.argsort(far)[1 : NEIGHBOURS + 1]]

    def answers(self, case, chance):
        """Whether a way leads to a state with the hand at the object."""
        for at, _ in list(self.planner.grasps(case))[:1]:
            state = self.state(at.translation, chance, exempt=True)
            if state is not None:
                return self.leads(self.join(at.translation, state))
        return False

    def leads(self, goal):
        edges = {at: set() for at in range(len(self.states))}
        for at in edges:
            for far, to in self.near(at):
                edges[at].add((far, to))
                edges[to].add((far, at))
        # Lazily: an edge is checked when it is taken.
        done, heap, known = set(), [(0.0, self.start, self.start)], {}
        while heap:
            cost, at, before = heapq.heappop(heap)
            if at in done:
                continue
            key = (min(at, before), max(at, before))
            if at != before:
                if key not in known:
                    known[key] = self.planner.is_way_free(self.states[before], self.states[at], exempt=goal in key)
                if not known[key]:
                    continue
            done.add(at)
            if at == goal:
                return True
            for far, to in edges[at]:
                if to not in done:
                    heapq.heappush(heap, (cost + far, to, at))
        return False


def graphed(planner, case, chance, _):
    return Graph(planner, case, chance).answers(case, chance)


def report(name, cases, answers, micros):
    """Recall and times over the reachable targets; the median."""
    reachable = [(said, took) for case, said, took in zip(cases, answers, micros) if case["is_reachable"]]
    times = sorted(took for _, took in reachable)
    recall = 100 * sum(said for said, _ in reachable) / len(reachable)
    print(
        f"  {name:8} recall {recall:5.1f} %, median {statistics.median(times):.0f} µs, "
        f"99 % within {times[int(0.99 * (len(times) - 1))]:.0f} µs"
    )
    return statistics.median(times)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("targets")
    arguments.add_argument("--most", type=int, default=100, help="targets of each robot")
    arguments.add_argument("--seconds", type=float, default=2.0, help="for one search of a way")
    arguments.add_argument("--without", choices=["sampled", "graph"], help="leave one out")
    settings = arguments.parse_args()
    ou.setLogLevel(ou.LOG_NONE)
    robots = {}
    for line in open(settings.targets, encoding="utf-8"):
        case = json.loads(line)
        of = robots.setdefault(case["robot"], [])
        if len(of) < settings.most:
            of.append(case)
    for name, cases in robots.items():
        reachable = sum(case["is_reachable"] for case in cases)
        print(f"{name}: {len(cases)} targets, {reachable} reachable")
        if not reachable:
            continue
        own = report("motet", cases, [case["said"] == "feasible" for case in cases], [case["took_us"] for case in cases])
        for peer, answer in (("sampled", sampled), ("graph", graphed)):
            if peer == settings.without:
                continue
            answers, micros = [], []
            for number, case in enumerate(cases):
                planner, chance = Planner(case), np.random.default_rng(number)
                begin = time.process_time()
                answers.append(answer(planner, case, chance, settings.seconds))
                micros.append(1e6 * (time.process_time() - begin))
            print(f"{' ' * 10}{report(peer, cases, answers, micros) / own:.0f} times as long at the median")


main()
