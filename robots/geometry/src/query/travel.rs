//! Ways of the whole robot: the base drives with the arm as it is, then the arm unfolds, then the base drives in.

use std::collections::BTreeMap;

use motet_robots::card::Drive;
use smol_str::SmolStr;

use super::answer::{Answer, Infeasible, Reason};
use super::room::Room;
use super::state::State;
use super::touch::{Allowed, Touch};

/// How far before the goal the arm unfolds, in m.
const BACK: [f64; 4] = [0.0, 0.15, 0.3, 0.5];

/// What is met, and how often.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally(BTreeMap<SmolStr, usize>);

impl Tally {
    pub(super) fn add(&mut self, touch: &Touch) {
        let name = if touch.is_own { SmolStr::new_static("the robot itself") } else { touch.other.clone() };
        *self.0.entry(name).or_default() += 1;
    }

    pub(super) fn add_entity(&mut self, name: SmolStr) {
        *self.0.entry(name).or_default() += 1;
    }

    /// What is met most often; of equals the first by name.
    pub(super) fn most(&self) -> Option<SmolStr> {
        let mut most: Option<(&SmolStr, usize)> = None;
        for (name, count) in &self.0 {
            if most.is_none_or(|(_, known)| *count > known) {
                most = Some((name, *count));
            }
        }
        most.map(|(name, _)| name.clone())
    }
}

/// The answer of a search that ends without a way: what is in the way where a state was found, else what leaves none free.
pub(super) fn exhausted(found: bool, poses: &Tally, ways: &Tally) -> Answer {
    let reason =
        if found { Reason::BlockedPath { by: ways.most() } } else { Reason::NoFreePose { by: poses.most() } };
    Answer::Infeasible(Infeasible { reason, change: None, certified: false })
}

impl Room<'_> {
    /// Whether every edge of a way is free. What touches first is noted.
    pub(super) fn is_free(&self, way: &[State], allowed: Allowed, met: &mut Tally) -> bool {
        way.windows(2).all(|pair| match pair {
            [one, other] => self.edge(one, other, allowed).map_err(|touch| met.add(&touch)).is_ok(),
            _ => true,
        })
    }

    /// A way from where the robot is to the beginning of a line, as [`Room::route`] finds one, and then along the line.
    pub(super) fn route_along(
        &self,
        line: &[State],
        inwards: [f64; 2],
        allowed: Allowed,
        met: &mut Tally,
    ) -> Option<Vec<State>> {
        if !self.is_free(line, allowed, met) {
            return None;
        }
        let (first, rest) = line.split_first()?;
        let mut path = self.route(first, inwards, met)?;
        let turns = path.last()?.base[2] - first.base[2];
        path.extend(rest.iter().map(|state| state.turned(turns)));
        Some(path)
    }

    /// A way from where the robot is to a state, both included. `inwards` is the direction in the plane in which the robot comes
    /// to it; of length 1.
    pub(super) fn route(&self, to: &State, inwards: [f64; 2], met: &mut Tally) -> Option<Vec<State>> {
        let start = &self.world.robot;
        let none = Allowed::default();
        let backs = if self.machine.drives() { &BACK[..] } else { &[0.0] };
        for back in backs {
            let [x, y, yaw] = to.base;
            let outside = to.at([x - inwards[0] * back, y - inwards[1] * back, yaw]);
            let drive_in = if *back > 0.0 { self.edge(&outside, to, none) } else { Ok(()) };
            if let Err(touch) = drive_in {
                met.add(&touch);
                // What stands there stands there for a longer way too.
                break;
            }
            let folded = State { base: outside.base, joints: start.joints.clone() };
            if !self.is_drivable(&folded) {
                continue;
            }
            let Some(unfolded) = self.unfold(&folded, &outside, met) else { continue };
            let Some(mut path) = self.drive(&folded) else { continue };
            let last = path.last().map_or([0.0; 3], |state| state.base);
            let shifted = unfolded.into_iter().skip(1).chain((*back > 0.0).then(|| to.clone()));
            // The way may end some full turns from where it was asked to.
            let turns = last[2] - folded.base[2];
            path.extend(shifted.map(|state| state.turned(turns)));
            return Some(path);
        }
        None
    }

    /// Whether the base, with the arm as it is at the start, can drive to any place within a step of a state's.
    pub(super) fn is_near_drivable(&self, to: &State) -> bool {
        let Some(map) = self.map() else { return true };
        let (start, [x, y]) = (plane(&self.world.robot), plane(to));
        let starts: Vec<[f64; 2]> = [start].into_iter().chain(self.escapes().map(|(_, from)| from)).collect();
        let widest = BACK.into_iter().fold(0.0, f64::max) + 0.1;
        let rings =
            [0.0, 0.5, 1.0].into_iter().flat_map(|share| (0..8).map(move |step| (share * widest, step)));
        rings.into_iter().any(|(far, step)| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(step) / 8.0);
            let place = [x + cos * far, y + sin * far];
            starts.iter().any(|from| map.is_connected(*from, place))
        })
    }

    /// Whether the base can drive to a state with the arm as it is.
    pub(super) fn is_drivable(&self, to: &State) -> bool {
        let (start, goal) = (plane(&self.world.robot), plane(to));
        match self.map() {
            Some(map) => {
                map.is_connected(start, goal) || self.escapes().any(|(_, from)| map.is_connected(from, goal))
            }
            None => start == goal,
        }
    }

    /// The way of the base to a state with the arm as it is.
    pub(super) fn drive(&self, to: &State) -> Option<Vec<State>> {
        let start = &self.world.robot;
        let Some(map) = self.map() else { return Some(vec![start.clone()]) };
        let mut path = vec![start.clone()];
        let corners = match map.way(plane(start), plane(to)) {
            Some(corners) => corners,
            None => {
                let (out, from) = self.escapes().find(|(_, from)| map.is_connected(*from, plane(to)))?;
                path.push(out);
                map.way(from, plane(to))?
            }
        };
        let mut yaw = start.base[2];
        let goal_yaw = to.clone().after(start).base[2];
        let length = |from: [f64; 2], to: [f64; 2]| libm::hypot(to[0] - from[0], to[1] - from[1]);
        let whole: f64 = corners
            .windows(2)
            .map(|pair| match pair {
                [a, b] => length(*a, *b),
                _ => 0.0,
            })
            .sum();
        let mut gone = 0.0;
        for pair in corners.windows(2) {
            let [from, next] = pair else { continue };
            let far = length(*from, *next);
            if far == 0.0 {
                continue;
            }
            gone += far;
            if self.machine.card().base.drive == Drive::Differential {
                let heading = libm::atan2(next[1] - from[1], next[0] - from[0]);
                yaw += crate::trigonometry::wrapped(heading - yaw);
                path.push(start.at([from[0], from[1], yaw]));
            } else {
                yaw = start.base[2] + (goal_yaw - start.base[2]) * (gone / whole);
            }
            path.push(start.at([next[0], next[1], yaw]));
        }
        let last = path.last().unwrap_or(start);
        let end = start.at(to.base).after(last);
        if end.base != last.base {
            path.push(end);
        }
        Some(path)
    }

    /// Straight ways out of a place where there is no room to turn, nearest first.
    fn escapes(&self) -> impl Iterator<Item = (State, [f64; 2])> + '_ {
        let start = &self.world.robot;
        let map = self.map().filter(|map| map.at(plane(start)) <= 0.0);
        let ways =
            [0.1, 0.2, 0.3, 0.45, 0.6, 0.8].into_iter().flat_map(|far| (0..16).map(move |step| (far, step)));
        map.into_iter().flat_map(move |map| {
            ways.clone().filter_map(move |(far, step)| {
                let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(step) / 16.0);
                let [x, y, yaw] = start.base;
                let out = start.at([x + cos * far, y + sin * far, yaw]);
                let place = plane(&out);
                (map.at(place) > 0.0 && self.edge(start, &out, Allowed::default()).is_ok())
                    .then_some((out, place))
            })
        })
    }

    /// The arm from one configuration to another with the base still: straight, by way of a raised lift, or by way of a posture.
    pub(super) fn unfold(&self, from: &State, to: &State, met: &mut Tally) -> Option<Vec<State>> {
        let mut ways: Vec<Vec<State>> = vec![vec![from.clone(), to.clone()]];
        if let Some((at, top)) = self.lift() {
            let raised = |state: &State| {
                let mut state = state.clone();
                if let Some(slot) = state.joints.get_mut(at) {
                    *slot = top;
                }
                state
            };
            ways.push(vec![from.clone(), raised(from), to.clone()]);
            ways.push(vec![from.clone(), raised(from), raised(to), to.clone()]);
        }
        for name in self.machine.card().postures.keys() {
            if let Some(joints) = self.machine.posture(name, &from.joints) {
                ways.push(vec![from.clone(), State { base: from.base, joints }, to.clone()]);
            }
        }
        ways.into_iter().find(|way| self.is_free(way, Allowed::default(), met))
    }

    /// The variable that lifts the arm and its highest value, where the arm has one.
    fn lift(&self) -> Option<(usize, f64)> {
        let super::machine::Solver::Lift(arm) = &self.machine.hand()?.solver else { return None };
        let chain = arm.chain();
        let (lower, upper) = chain.variables.first()?.limits?;
        Some((*chain.in_tree.first()?, if arm.up > 0.0 { upper } else { lower }))
    }
}

pub(super) fn plane(state: &State) -> [f64; 2] {
    let [x, y, _] = state.base;
    [x, y]
}
