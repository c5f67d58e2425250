//! Ways of the whole robot: the base drives with the arm as it is, then the arm unfolds, then the base drives in.

use std::collections::BTreeMap;

use motet_robots::card::Drive;
use smol_str::{SmolStr, format_smolstr};

use super::answer::{Answer, ITSELF, Infeasible, Reason, Share};
use super::around::Around;
use super::map::Map;
use super::room::Room;
use super::seek::LAST;
use super::state::State;
use super::touch::{Allowed, Touch};

/// How far before the goal the arm unfolds, in m: where there is room, most often, first.
const BACK: [f64; 4] = [0.2, 0.45, 0.0, 0.1];

/// Why no way leads along a line.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum NoWay {
    /// The line itself is not free.
    Line,
    /// None of the ways that are tried leads to where it begins.
    Route,
}

/// What is met, and how often.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    others: BTreeMap<SmolStr, usize>,
    /// Of the robot itself, by the two links.
    own: BTreeMap<[SmolStr; 2], usize>,
}

impl Tally {
    pub(super) fn add(&mut self, touch: &Touch) {
        if touch.is_own {
            *self.own.entry([touch.link.clone(), touch.other.clone()]).or_default() += 1;
        } else {
            self.add_entity(touch.other.clone());
        }
    }

    pub(super) fn add_entity(&mut self, name: SmolStr) {
        *self.others.entry(name).or_default() += 1;
    }

    /// What is met most often; of equals the first by name. The robot itself counts as one, and is told with the links that meet
    /// most often.
    pub(super) fn most(&self) -> Option<SmolStr> {
        self.counted().map(|(name, _)| name)
    }

    /// That no pose is free of those whose touches these are: what most of them touch, and how many of how many.
    pub(super) fn none_free(&self) -> Reason {
        let (by, touching) = self.counted().unzip();
        let tried = self.others.values().chain(self.own.values()).sum();
        Reason::NoFreePose { by, share: touching.map(|touching| Share { touching, tried }) }
    }

    fn counted(&self) -> Option<(SmolStr, usize)> {
        let own: usize = self.own.values().sum();
        match first_most(&self.others) {
            Some((name, count)) if count >= own => Some((name.clone(), count)),
            _ => first_most(&self.own)
                .map(|([one, other], _)| (format_smolstr!("{ITSELF} (`{one}` and `{other}`)"), own)),
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.others.is_empty() && self.own.is_empty()
    }
}

/// The key that is counted most often, the first of equals.
fn first_most<K>(counts: &BTreeMap<K, usize>) -> Option<(&K, usize)> {
    counts.iter().fold(None, |most, (name, count)| match most {
        Some((_, known)) if known >= *count => most,
        Some(_) | None => Some((name, *count)),
    })
}

/// The answer of a search that ends without a way: what is in the way where a state was found, else what leaves none free.
pub(super) fn exhausted(found: bool, poses: &Tally, ways: &Tally) -> Answer {
    let reason = if found { Reason::BlockedPath { by: ways.most() } } else { poses.none_free() };
    Answer::Infeasible(Infeasible::exhausted(reason))
}

impl Room<'_> {
    /// A way from where the robot is to the beginning of a line, as [`Around::route_to`] finds one, and then along the line.
    pub(super) fn route_along(
        &self,
        line: &[State],
        inwards: [f64; 2],
        allowed: Allowed,
        met: &mut Tally,
    ) -> Option<Vec<State>> {
        let around = self.around(plane(line.last()?), LAST);
        around.route_along(line, inwards, allowed, met)
    }

    /// The arm from one configuration to another with the base still; both are free.
    pub(super) fn unfold(&self, from: &State, to: &State, met: &mut Tally) -> Option<Vec<State>> {
        let [x, y, _] = from.base;
        self.around([x, y], 0.01).unfold(from, to, met)
    }

    /// Whether the base, with the arm as it is at the start, can drive to any place within a step of one. Not exact.
    pub(super) fn is_near_drivable(&self, [x, y, _]: [f64; 3]) -> bool {
        let Some(map) = self.map() else { return true };
        let homes = self.homes(map);
        let widest = BACK.into_iter().fold(0.0, f64::max) + 0.1;
        let off = std::f64::consts::FRAC_1_SQRT_2;
        let around = [
            (1.0, 0.0),
            (0.0, 1.0),
            (-1.0, 0.0),
            (0.0, -1.0),
            (off, off),
            (-off, off),
            (off, -off),
            (-off, -off),
        ];
        map.is_among([x, y], homes)
            || [0.5 * widest, widest].into_iter().any(|far| {
                around.into_iter().any(|(cos, sin)| map.is_among([x + cos * far, y + sin * far], homes))
            })
    }

    /// Whether ways lead to a place, about.
    pub(super) fn is_at_home(&self, place: [f64; 2]) -> bool {
        self.map().is_none_or(|map| map.is_among(place, self.homes(map)))
    }

    /// Whether the base can drive to a state with the arm as it is.
    pub(super) fn is_drivable(&self, to: &State) -> bool {
        let (start, goal) = (plane(&self.world.robot), plane(to));
        match self.map() {
            Some(map) => {
                map.is_connected(start, goal)
                    || self.escapes(map).iter().any(|(_, from)| map.is_connected(*from, goal))
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
                let (out, from) =
                    self.escapes(map).iter().find(|(_, from)| map.is_connected(*from, plane(to)))?;
                path.push(out.clone());
                map.way(*from, plane(to))?
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

    /// The way of the base to the first of some states, which the arm is folded in, and then along them.
    pub(super) fn driven(&self, states: Vec<State>) -> Option<Vec<State>> {
        let folded = states.first()?;
        let mut path = self.drive(folded)?;
        let turns = path.last().map_or(0.0, |last| last.base[2] - folded.base[2]);
        path.extend(states.into_iter().skip(1).map(|state| state.turned(turns)));
        Some(path)
    }

    /// Makes what is otherwise made when it is first asked for.
    pub(super) fn prepare(&self) {
        self.at_start();
        self.batch_model();
        if let Some(map) = self.map() {
            self.homes(map);
        }
    }

    /// Straight ways out of where the robot is, where it has no room to turn: some, nearest first.
    pub(super) fn escapes(&self, map: &Map) -> &[(State, [f64; 2])] {
        self.escapes.get_or_init(|| self.ways_out(map))
    }

    /// Components of the map to which ways lead from where the robot is.
    fn homes(&self, map: &Map) -> &[u32] {
        self.homes.get_or_init(|| {
            let places = [plane(&self.world.robot)].into_iter();
            let places = places.chain(self.escapes(map).iter().map(|(_, place)| *place));
            let mut homes: Vec<u32> = places.filter_map(|place| map.component(place)).collect();
            homes.sort_unstable();
            homes.dedup();
            homes
        })
    }

    fn ways_out(&self, map: &Map) -> Vec<(State, [f64; 2])> {
        let start = &self.world.robot;
        if self.at_start().is_some() || map.at(plane(start)) > 0.0 {
            return vec![];
        }
        let around = self.around(plane(start), 1.0);
        let ways =
            [0.1, 0.2, 0.3, 0.45, 0.6, 0.8].into_iter().flat_map(|far| (0..16).map(move |step| (far, step)));
        let [x, y, yaw] = start.base;
        let out = ways.filter_map(|(far, step)| {
            // In the robot's frame, so that a room that is turned with it has the same.
            let (sin, cos) = libm::sincos(yaw + std::f64::consts::TAU * f64::from(step) / 16.0);
            let out = start.at([x + cos * far, y + sin * far, yaw]);
            let place = plane(&out);
            (map.at(place) > 0.0 && around.edge(start, &out, Allowed::default()).is_ok())
                .then_some((out, place))
        });
        out.take(4).collect()
    }

    /// The variable that lifts the arm and its highest value, where the arm has one.
    fn lift(&self) -> Option<(usize, f64)> {
        let super::solver::Solver::Lift(arm) = &self.machine.hand()?.solver else { return None };
        let chain = arm.chain();
        let (lower, upper) = chain.dofs.first()?.limits?;
        Some((*chain.in_tree.first()?, if arm.up > 0.0 { upper } else { lower }))
    }
}

impl Around<'_, '_> {
    /// A way from where the robot is to the beginning of a line, as [`Around::route_to`] finds one, and then along the line.
    pub(super) fn route_along(
        &self,
        line: &[State],
        inwards: [f64; 2],
        allowed: Allowed,
        met: &mut Tally,
    ) -> Option<Vec<State>> {
        if let Some(touch) = self.first_touch(&line.iter().collect::<Vec<_>>(), allowed) {
            met.add(&touch);
            return None;
        }
        self.route_to(line, inwards, allowed, met).ok()
    }

    /// The same with a line of states that touch nothing but what is allowed. `inwards` is the direction in the plane in which the robot
    /// comes to the first; of length 1.
    ///
    /// # Errors
    ///
    /// What is in the way.
    pub(super) fn route_to(
        &self,
        line: &[State],
        inwards: [f64; 2],
        allowed: Allowed,
        met: &mut Tally,
    ) -> Result<Vec<State>, NoWay> {
        let (first, rest) = line.split_first().ok_or(NoWay::Line)?;
        let backs = if self.room.machine.drives() { &BACK[..] } else { &[0.0] };
        let outside = |back: &f64| {
            let [x, y, yaw] = first.base;
            first.at([x - inwards[0] * back, y - inwards[1] * back, yaw])
        };
        // Before the line nothing may touch.
        let outsides: Vec<State> = std::iter::once(&0.0).chain(backs).map(outside).collect();
        let touches = self.touches(&outsides.iter().collect::<Vec<_>>(), Allowed::default());
        let mut touches = touches.into_iter();
        let way = |pair: &[State]| match pair {
            [one, other] => self.between(one, other, allowed).err(),
            _ => None,
        };
        if let Some(touch) = touches.next().flatten().or_else(|| line.windows(2).rev().find_map(way)) {
            met.add(&touch);
            return Err(NoWay::Line);
        }
        let outsides = outsides.into_iter().skip(1).zip(touches).zip(backs);
        for ((outside, touch), back) in outsides {
            let Some(mut path) = self.route(&outside, touch, first, met) else { continue };
            let shifted = (*back > 0.0).then_some(first).into_iter().chain(rest);
            // The way may end some full turns from where it was asked to.
            let turns = path.last().map_or(0.0, |last| last.base[2] - first.base[2]);
            path.extend(shifted.map(|state| state.turned(turns)));
            return Ok(path);
        }
        Err(NoWay::Route)
    }

    /// A way from where the robot is to a state, both included, from which a straight way without a turn leads to another one that is
    /// free. `touch` is what the state touches.
    fn route(
        &self,
        outside: &State,
        touch: Option<Touch>,
        to: &State,
        met: &mut Tally,
    ) -> Option<Vec<State>> {
        let room = self.room;
        let folded = State { base: outside.base, joints: room.world.robot.joints.clone() };
        let is_drivable = room.is_drivable(&folded);
        let free = touch.map_or(Ok(()), Err);
        if let Err(touch) = free.and_then(|()| match outside.base == to.base {
            true => Ok(()),
            false => self.between(outside, to, Allowed::default()),
        }) {
            met.add(&touch);
            return None;
        }
        if !is_drivable {
            return None;
        }
        room.driven(self.unfold(&folded, outside, met)?)
    }

    /// The arm from one configuration to another with the base still: straight, by way of a raised lift, or by way of a
    /// posture. Both are free.
    pub(super) fn unfold(&self, from: &State, to: &State, met: &mut Tally) -> Option<Vec<State>> {
        let none = Allowed::default();
        let mut is_free = |way: &[&State]| {
            let inner = way.get(1..way.len().saturating_sub(1)).unwrap_or_default();
            let touch = self.first_touch(inner, none).or_else(|| {
                way.windows(2).find_map(|pair| match pair {
                    [one, other] => self.between(one, other, none).err(),
                    _ => None,
                })
            });
            touch.map(|touch| met.add(&touch)).is_none()
        };
        if is_free(&[from, to]) {
            return Some(vec![from.clone(), to.clone()]);
        }
        if let Some((at, top)) = self.room.lift() {
            let raised = |state: &State| {
                let mut state = state.clone();
                if let Some(slot) = state.joints.get_mut(at) {
                    *slot = top;
                }
                state
            };
            let (first, last) = (raised(from), raised(to));
            if is_free(&[from, &first, to]) {
                return Some(vec![from.clone(), first, to.clone()]);
            }
            if is_free(&[from, &first, &last, to]) {
                return Some(vec![from.clone(), first, last, to.clone()]);
            }
        }
        let card = self.room.machine.card();
        let postures = card.postures.keys().filter_map(|name| self.room.machine.posture(name, &from.joints));
        postures
            .map(|joints| State { base: from.base, joints })
            .find_map(|by| is_free(&[from, &by, to]).then(|| vec![from.clone(), by, to.clone()]))
    }
}

pub(super) fn plane(state: &State) -> [f64; 2] {
    let [x, y, _] = state.base;
    [x, y]
}
