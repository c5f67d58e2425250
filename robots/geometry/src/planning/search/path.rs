//! Paths of the whole robot: the base drives with the arm as it is, the arm unfolds, and the base drives in.
//! If no simple path leads to the beginning of an approach line, RRT-Connect searches from open space: out of
//! a drawer, or between obstacles closer than the base's disc is wide.

use std::f64::consts::TAU;

use motet_robots::card::Drive;

use super::rrt_connect::{PlannedJoints, RrtEffort};
use crate::planning::base::BaseMap;
use crate::planning::checking::CollisionChecker;
use crate::planning::context::QueryContext;
use crate::planning::query::ContactTally;
use crate::planning::scene::{AllowedCollisions, Configuration, Contact, plane};

/// Greatest distance between the base at the goal and at the start of the approach, in m.
pub(crate) const LAST: f64 = 0.65;
/// Distances before the goal at which the arm unfolds, in m, the most promising first.
const BACK: [f64; 4] = [0.2, 0.45, 0.0, 0.1];

/// Failure of a path along an approach line.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum PathError {
    /// The approach line itself is blocked.
    Line,
    /// No route leads to the start of the line.
    Route,
}

impl QueryContext<'_> {
    /// Path from the start to the beginning of a line and along it; see [`CollisionChecker::route_to`].
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

    /// Arm motion between two free configurations with the base still.
    pub(crate) fn unfold(
        &self,
        from: &Configuration,
        to: &Configuration,
        met: &mut ContactTally,
    ) -> Option<Vec<Configuration>> {
        let [x, y, _] = from.base;
        self.around([x, y], 0.01).unfold(from, to, AllowedCollisions::default(), met)
    }

    /// Checks whether the base can drive near to a place with the arm as at the start; approximate.
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

    /// Checks whether the start's component of the map holds a place; approximate.
    pub(crate) fn is_at_home(&self, place: [f64; 2]) -> bool {
        self.map().is_none_or(|map| map.is_among(place, self.homes(map)))
    }

    /// Checks whether the base can drive to a configuration with the arm as it is.
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

    /// Route of the base to a configuration with the arm as it is.
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

    /// Route of the base to the first configuration, which has the arm as at the start, and then along all
    /// of them.
    pub(crate) fn driven(&self, configurations: Vec<Configuration>) -> Option<Vec<Configuration>> {
        let folded = configurations.first()?;
        let mut path = self.drive(folded)?;
        let turns = path.last().map_or(0.0, |last| last.base[2] - folded.base[2]);
        path.extend(configurations.into_iter().skip(1).map(|configuration| configuration.turned(turns)));
        Some(path)
    }

    /// Fills the caches.
    pub(crate) fn prepare(&self) {
        self.start_contact();
        self.batch_model();
        if let Some(map) = self.map() {
            self.homes(map);
        }
    }

    /// Edges out of the start where it has no room to turn, the nearest first.
    pub(crate) fn escapes(&self, map: &BaseMap) -> &[(Configuration, [f64; 2])] {
        self.escapes.get_or_init(|| self.ways_out(map))
    }

    /// Components of the map that the base can reach from the start.
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
            // In the robot's frame, so that the result does not depend on the map's axes.
            let (sin, cos) = libm::sincos(yaw + std::f64::consts::TAU * f64::from(step) / 16.0);
            let out = start.at([x + cos * far, y + sin * far, yaw]);
            let place = plane(&out);
            (map.at(place) > 0.0 && checker.edge(start, &out, AllowedCollisions::default()).is_ok())
                .then_some((out, place))
        });
        out.take(4).collect()
    }
}

impl CollisionChecker<'_, '_> {
    /// Path from the start to the beginning of a line and along it; checks the line's configurations first.
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

    /// Path from the start along a line of free configurations. `inwards` is the unit direction in the
    /// plane in which the robot approaches.
    ///
    /// # Errors
    ///
    /// The blocked part.
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
        // Before the line no contact is permitted, but the hand may come near.
        let before = allowed.before();
        let outsides: Vec<Configuration> = std::iter::once(&0.0).chain(backs).map(outside).collect();
        let contacts = self.contacts(&outsides.iter().collect::<Vec<_>>(), before);
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
            let Some(mut path) = self.route((&outside, contact), first, before, met) else { continue };
            let shifted = (*back > 0.0).then_some(first).into_iter().chain(rest);
            // The route may end some full turns away.
            let turns = path.last().map_or(0.0, |last| last.base[2] - first.base[2]);
            path.extend(shifted.map(|configuration| configuration.turned(turns)));
            return Ok(path);
        }
        Err(PathError::Route)
    }

    /// Route from the start to a configuration, both included, from which a pure translation leads to the
    /// goal. The first comes with its contact.
    fn route(
        &self,
        (outside, contact): (&Configuration, Option<Contact>),
        to: &Configuration,
        allowed: AllowedCollisions,
        met: &mut ContactTally,
    ) -> Option<Vec<Configuration>> {
        let context = self.context;
        let folded = Configuration { base: outside.base, joints: context.state.robot.joints.clone() };
        let is_drivable = context.is_drivable(&folded);
        let free = contact.map_or(Ok(()), Err);
        if let Err(contact) = free.and_then(|()| match outside.base == to.base {
            true => Ok(()),
            false => self.between(outside, to, allowed),
        }) {
            met.add(&contact);
            return None;
        }
        if !is_drivable {
            return None;
        }
        context.driven(self.unfold(&folded, outside, allowed, met)?)
    }

    /// Arm motion between two free configurations with the base still: straight, over a raised lift, or
    /// over a posture.
    pub(crate) fn unfold(
        &self,
        from: &Configuration,
        to: &Configuration,
        allowed: AllowedCollisions,
        met: &mut ContactTally,
    ) -> Option<Vec<Configuration>> {
        let mut is_free = |way: &[&Configuration]| {
            let inner = way.get(1..way.len().saturating_sub(1)).unwrap_or_default();
            let contact = self.first_contact(inner, allowed).or_else(|| {
                way.windows(2).find_map(|pair| match pair {
                    [one, other] => self.between(one, other, allowed).err(),
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

/// Distances in m from the line at which the base stands with the arm folded.
const OUT: [f64; 11] = [0.3, 0.45, 0.6, 0.2, 0.1, 0.0, 0.8, 1.0, 1.3, 1.6, 2.0];
/// Directions of these places around the line.
const DIRECTIONS: usize = 16;

impl CollisionChecker<'_, '_> {
    /// Path from the start to the beginning of a free line and along it; the robot usually comes along
    /// `inwards`.
    pub(crate) fn retreat(
        &self,
        line: &[Configuration],
        inwards: [f64; 2],
        effort: RrtEffort,
    ) -> Option<Vec<Configuration>> {
        let context = self.context;
        let first = line.first()?;
        let (from, moving) = if context.slides() {
            (self.landing(first, inwards)?, PlannedJoints::All)
        } else {
            let folded = Configuration { base: first.base, joints: context.state.robot.joints.clone() };
            if self.contact(&folded, AllowedCollisions::default()).is_some() || !context.is_drivable(&folded)
            {
                return None;
            }
            (folded, PlannedJoints::Arm)
        };
        let mut configurations = self.connect(&from, first, moving, effort)?;
        configurations.extend(line.iter().skip(1).cloned());
        context.driven(configurations)
    }

    /// Place near a configuration to which the base drives with the arm as at the start.
    fn landing(&self, near: &Configuration, [x, y]: [f64; 2]) -> Option<Configuration> {
        let context = self.context;
        let [near_x, near_y, yaw] = near.base;
        let outwards = libm::atan2(-y, -x);
        let folded = |far: f64, step: usize| {
            let turn = step.div_ceil(2) as f64 * if step.is_multiple_of(2) { 1.0 } else { -1.0 };
            let (sin, cos) = libm::sincos(outwards + turn * TAU / DIRECTIONS as f64);
            Configuration {
                base: [near_x + cos * far, near_y + sin * far, yaw],
                joints: context.state.robot.joints.clone(),
            }
        };
        let mut places = OUT.into_iter().flat_map(|far| (0..DIRECTIONS).map(move |step| (far, step)));
        places.find_map(|(far, step)| {
            let place = folded(far, step);
            (context.is_at_home(plane(&place)) && context.is_drivable(&place)).then_some(place)
        })
    }
}
