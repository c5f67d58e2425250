//! Ways of the whole robot: the base drives with the arm as it is, then the arm unfolds, then the base drives in.

use std::collections::BTreeMap;

use motet_robots::card::Drive;
use smol_str::{SmolStr, format_smolstr};

use crate::planning::base::base_map::BaseMap;
use crate::planning::checking::collision_checker::CollisionChecker;
use crate::planning::query::answer::{ContactShare, ITSELF, Infeasible, InfeasibleReason, MotionAnswer};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::{AllowedCollisions, Contact};
use crate::planning::search::context::QueryContext;
use crate::planning::search::goal_search::LAST;

/// How far before the goal the arm unfolds, in m: where there is room, most often, first.
const BACK: [f64; 4] = [0.2, 0.45, 0.0, 0.1];

/// Why no way leads along a line.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum PathError {
    /// The line itself is not free.
    Line,
    /// None of the ways that are tried leads to where it begins.
    Route,
}

/// What is met, and how often.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactTally {
    others: BTreeMap<SmolStr, usize>,
    /// Of the robot itself, by the two links.
    own: BTreeMap<[SmolStr; 2], usize>,
}

impl ContactTally {
    pub(crate) fn add(&mut self, contact: &Contact) {
        if contact.is_own {
            *self.own.entry([contact.link.clone(), contact.other.clone()]).or_default() += 1;
        } else {
            self.add_entity(contact.other.clone());
        }
    }

    pub(crate) fn add_entity(&mut self, name: SmolStr) {
        *self.others.entry(name).or_default() += 1;
    }

    /// What is met most often; of equals the first by name. The robot itself counts as one, and is told with the links that meet
    /// most often.
    pub(crate) fn most(&self) -> Option<SmolStr> {
        self.counted().map(|(name, _)| name)
    }

    /// That no pose is free of those whose touches these are: what most of them touch, and how many of how many.
    pub(crate) fn none_free(&self) -> InfeasibleReason {
        let (by, touching) = self.counted().unzip();
        let tried = self.others.values().chain(self.own.values()).sum();
        InfeasibleReason::NoFreePose { by, share: touching.map(|touching| ContactShare { touching, tried }) }
    }

    fn counted(&self) -> Option<(SmolStr, usize)> {
        let own: usize = self.own.values().sum();
        match first_most(&self.others) {
            Some((name, count)) if count >= own => Some((name.clone(), count)),
            _ => first_most(&self.own)
                .map(|([one, other], _)| (format_smolstr!("{ITSELF} (`{one}` and `{other}`)"), own)),
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
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
pub(crate) fn exhausted(found: bool, poses: &ContactTally, ways: &ContactTally) -> MotionAnswer {
    let reason = if found { InfeasibleReason::BlockedPath { by: ways.most() } } else { poses.none_free() };
    MotionAnswer::Infeasible(Infeasible::exhausted(reason))
}

impl QueryContext<'_> {
    /// A way from where the robot is to the beginning of a line, as [`CollisionChecker::route_to`] finds one, and then along the line.
    pub(crate) fn route_along(
        &self,
        line: &[Configuration],
        inwards: [f64; 2],
        allowed: AllowedCollisions,
        met: &mut ContactTally,
    ) -> Option<Vec<Configuration>> {
        let checker = self.around(plane(line.last()?), LAST);
        checker.route_along(line, inwards, allowed, met)
    }

    /// The arm from one configuration to another with the base still; both are free.
    pub(crate) fn unfold(
        &self,
        from: &Configuration,
        to: &Configuration,
        met: &mut ContactTally,
    ) -> Option<Vec<Configuration>> {
        let [x, y, _] = from.base;
        self.around([x, y], 0.01).unfold(from, to, met)
    }

    /// Whether the base, with the arm as it is at the start, can drive to any place within a step of one. Not exact.
    pub(crate) fn is_near_drivable(&self, [x, y, _]: [f64; 3]) -> bool {
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
    pub(crate) fn is_at_home(&self, place: [f64; 2]) -> bool {
        self.map().is_none_or(|map| map.is_among(place, self.homes(map)))
    }

    /// Whether the base can drive to a state with the arm as it is.
    pub(crate) fn is_drivable(&self, to: &Configuration) -> bool {
        let (start, goal) = (plane(&self.state.robot), plane(to));
        match self.map() {
            Some(map) => {
                map.is_connected(start, goal)
                    || self.escapes(map).iter().any(|(_, from)| map.is_connected(*from, goal))
            }
            None => start == goal,
        }
    }

    /// The way of the base to a state with the arm as it is.
    pub(crate) fn drive(&self, to: &Configuration) -> Option<Vec<Configuration>> {
        let start = &self.state.robot;
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
            if self.model.card().base.drive == Drive::Differential {
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
    pub(crate) fn driven(&self, configurations: Vec<Configuration>) -> Option<Vec<Configuration>> {
        let folded = configurations.first()?;
        let mut path = self.drive(folded)?;
        let turns = path.last().map_or(0.0, |last| last.base[2] - folded.base[2]);
        path.extend(configurations.into_iter().skip(1).map(|configuration| configuration.turned(turns)));
        Some(path)
    }

    /// Makes what is otherwise made when it is first asked for.
    pub(crate) fn prepare(&self) {
        self.start_contact();
        self.batch_model();
        if let Some(map) = self.map() {
            self.homes(map);
        }
    }

    /// Straight ways out of where the robot is, where it has no room to turn: some, nearest first.
    pub(crate) fn escapes(&self, map: &BaseMap) -> &[(Configuration, [f64; 2])] {
        self.escapes.get_or_init(|| self.ways_out(map))
    }

    /// Components of the map to which ways lead from where the robot is.
    fn homes(&self, map: &BaseMap) -> &[u32] {
        self.homes.get_or_init(|| {
            let places = [plane(&self.state.robot)].into_iter();
            let places = places.chain(self.escapes(map).iter().map(|(_, place)| *place));
            let mut homes: Vec<u32> = places.filter_map(|place| map.component(place)).collect();
            homes.sort_unstable();
            homes.dedup();
            homes
        })
    }

    fn ways_out(&self, map: &BaseMap) -> Vec<(Configuration, [f64; 2])> {
        let start = &self.state.robot;
        if self.start_contact().is_some() || map.at(plane(start)) > 0.0 {
            return vec![];
        }
        let checker = self.around(plane(start), 1.0);
        let ways =
            [0.1, 0.2, 0.3, 0.45, 0.6, 0.8].into_iter().flat_map(|far| (0..16).map(move |step| (far, step)));
        let [x, y, yaw] = start.base;
        let out = ways.filter_map(|(far, step)| {
            // In the robot's frame, so that a room that is turned with it has the same.
            let (sin, cos) = libm::sincos(yaw + std::f64::consts::TAU * f64::from(step) / 16.0);
            let out = start.at([x + cos * far, y + sin * far, yaw]);
            let place = plane(&out);
            (map.at(place) > 0.0 && checker.edge(start, &out, AllowedCollisions::default()).is_ok())
                .then_some((out, place))
        });
        out.take(4).collect()
    }

    /// The variable that lifts the arm and its highest value, where the arm has one.
    fn lift(&self) -> Option<(usize, f64)> {
        let crate::planning::scene::ik_solver::IkSolver::Lift(arm) = &self.model.hand()?.solver else {
            return None;
        };
        let chain = arm.chain();
        let (lower, upper) = chain.dofs.first()?.limits?;
        Some((*chain.in_tree.first()?, if arm.up > 0.0 { upper } else { lower }))
    }
}

impl CollisionChecker<'_, '_> {
    /// A way from where the robot is to the beginning of a line, as [`CollisionChecker::route_to`] finds one, and then along the line.
    pub(crate) fn route_along(
        &self,
        line: &[Configuration],
        inwards: [f64; 2],
        allowed: AllowedCollisions,
        met: &mut ContactTally,
    ) -> Option<Vec<Configuration>> {
        if let Some(contact) = self.first_contact(&line.iter().collect::<Vec<_>>(), allowed) {
            met.add(&contact);
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
    pub(crate) fn route_to(
        &self,
        line: &[Configuration],
        inwards: [f64; 2],
        allowed: AllowedCollisions,
        met: &mut ContactTally,
    ) -> Result<Vec<Configuration>, PathError> {
        let (first, rest) = line.split_first().ok_or(PathError::Line)?;
        let backs = if self.context.model.drives() { &BACK[..] } else { &[0.0] };
        let outside = |back: &f64| {
            let [x, y, yaw] = first.base;
            first.at([x - inwards[0] * back, y - inwards[1] * back, yaw])
        };
        // Before the line nothing may touch.
        let outsides: Vec<Configuration> = std::iter::once(&0.0).chain(backs).map(outside).collect();
        let contacts = self.contacts(&outsides.iter().collect::<Vec<_>>(), AllowedCollisions::default());
        let mut contacts = contacts.into_iter();
        let way = |pair: &[Configuration]| match pair {
            [one, other] => self.between(one, other, allowed).err(),
            _ => None,
        };
        if let Some(contact) = contacts.next().flatten().or_else(|| line.windows(2).rev().find_map(way)) {
            met.add(&contact);
            return Err(PathError::Line);
        }
        let outsides = outsides.into_iter().skip(1).zip(contacts).zip(backs);
        for ((outside, contact), back) in outsides {
            let Some(mut path) = self.route(&outside, contact, first, met) else { continue };
            let shifted = (*back > 0.0).then_some(first).into_iter().chain(rest);
            // The way may end some full turns from where it was asked to.
            let turns = path.last().map_or(0.0, |last| last.base[2] - first.base[2]);
            path.extend(shifted.map(|configuration| configuration.turned(turns)));
            return Ok(path);
        }
        Err(PathError::Route)
    }

    /// A way from where the robot is to a state, both included, from which a straight way without a turn leads to another one that is
    /// free. `touch` is what the state touches.
    fn route(
        &self,
        outside: &Configuration,
        contact: Option<Contact>,
        to: &Configuration,
        met: &mut ContactTally,
    ) -> Option<Vec<Configuration>> {
        let context = self.context;
        let folded = Configuration { base: outside.base, joints: context.state.robot.joints.clone() };
        let is_drivable = context.is_drivable(&folded);
        let free = contact.map_or(Ok(()), Err);
        if let Err(contact) = free.and_then(|()| match outside.base == to.base {
            true => Ok(()),
            false => self.between(outside, to, AllowedCollisions::default()),
        }) {
            met.add(&contact);
            return None;
        }
        if !is_drivable {
            return None;
        }
        context.driven(self.unfold(&folded, outside, met)?)
    }

    /// The arm from one configuration to another with the base still: straight, by way of a raised lift, or by way of a
    /// posture. Both are free.
    pub(crate) fn unfold(
        &self,
        from: &Configuration,
        to: &Configuration,
        met: &mut ContactTally,
    ) -> Option<Vec<Configuration>> {
        let none = AllowedCollisions::default();
        let mut is_free = |way: &[&Configuration]| {
            let inner = way.get(1..way.len().saturating_sub(1)).unwrap_or_default();
            let contact = self.first_contact(inner, none).or_else(|| {
                way.windows(2).find_map(|pair| match pair {
                    [one, other] => self.between(one, other, none).err(),
                    _ => None,
                })
            });
            contact.map(|contact| met.add(&contact)).is_none()
        };
        if is_free(&[from, to]) {
            return Some(vec![from.clone(), to.clone()]);
        }
        if let Some((at, top)) = self.context.lift() {
            let raised = |configuration: &Configuration| {
                let mut configuration = configuration.clone();
                if let Some(slot) = configuration.joints.get_mut(at) {
                    *slot = top;
                }
                configuration
            };
            let (first, last) = (raised(from), raised(to));
            if is_free(&[from, &first, to]) {
                return Some(vec![from.clone(), first, to.clone()]);
            }
            if is_free(&[from, &first, &last, to]) {
                return Some(vec![from.clone(), first, last, to.clone()]);
            }
        }
        let card = self.context.model.card();
        let postures = card.postures.keys().filter_map(|name| self.context.model.posture(name, &from.joints));
        postures
            .map(|joints| Configuration { base: from.base, joints })
            .find_map(|by| is_free(&[from, &by, to]).then(|| vec![from.clone(), by, to.clone()]))
    }
}

pub(crate) fn plane(configuration: &Configuration) -> [f64; 2] {
    let [x, y, _] = configuration.base;
    [x, y]
}
