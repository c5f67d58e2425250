//! Ways of the base over the floor: a way round what stands there, and the first contact on the way. The base
//! counts as a disc.
//!
//! A way goes along straight legs from corner to corner of the obstacles, each inflated by the disc
//! (visibility graph: Lozano-Pérez and Wesley 1979). Only obstacles that lie on the way are in the graph.

use crate::body::{BasePose, UprightBody};
use crate::motion::BaseMotion;
use crate::world::{Rest, Role, SimWorld, Thing};
use motet_robots::scene::{Outline, PlacedOutline};
use motet_runtime::Time;
use smol_str::SmolStr;

/// Distance that a planned way keeps, beside the disc.
const SPARE_M: f64 = 0.01;
/// Distance of the corners of a way from what it passes, beside the disc and what it keeps.
const CORNER_M: f64 = 0.02;
/// Height in m below which furniture is in the way of the base, and below which a loose thing lies on the
/// floor.
const ABOVE_M: f64 = 1.0;
const FLOOR_M: f64 = 0.3;
/// Greatest number of obstacles that a way goes round.
const MOST: usize = 24;
/// Span in s between two checks for contact; the base drives some cm in it.
const SAMPLE_SECS: f64 = 0.05;
/// Decrease in m of the distance to something already touched that counts as contact again.
const DEEPER_M: f64 = 0.005;

/// Something in the way, with the distance that the axis of the base keeps from it.
struct Obstacle<'w> {
    id: &'w SmolStr,
    body: &'w UprightBody,
    keeps: f64,
}

impl Obstacle<'_> {
    fn blocks(&self, [a, b]: [[f64; 2]; 2]) -> bool {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let (length, middle) = (dx.hypot(dy), [f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])]);
        let body = self.body;
        let far = (body.x() - middle[0]).hypot(body.y() - middle[1]);
        if far > length / 2.0 + body.radius() + self.keeps {
            return false;
        }
        let axis = if length > 1e-9 { [dx / length, dy / length] } else { [1.0, 0.0] };
        let leg =
            PlacedOutline { outline: Outline::Rectangle { half: [length / 2.0, 0.0] }, centre: middle, axis };
        body.placed().gap(&leg) < self.keeps
    }

    /// Corners of a way round it.
    fn corners(&self) -> Vec<[f64; 2]> {
        let (body, keeps) = (self.body, self.keeps.max(0.0) + CORNER_M);
        let local: Vec<[f64; 2]> = match body.outline {
            Outline::Rectangle { half: [a, b] } => {
                let (a, b) = (a + keeps, b + keeps);
                vec![[a, b], [a, -b], [-a, -b], [-a, b]]
            }
            Outline::Disc { radius } => {
                let eighth = std::f64::consts::FRAC_PI_4;
                let away = (radius + keeps) / (eighth / 2.0).cos();
                let corner = |step: i32| {
                    let (sin, cos) = (f64::from(step) * eighth).sin_cos();
                    [away * cos, away * sin]
                };
                (0..8).map(corner).collect()
            }
        };
        let placed = |[x, y]: [f64; 2]| {
            let [dx, dy, _] = body.turned_out([x, y, 0.0]);
            [body.x() + dx, body.y() + dy]
        };
        local.into_iter().map(placed).collect()
    }
}

/// Contact of the base on its way.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Contact {
    pub(crate) at: Time,
    pub(crate) with: SmolStr,
}

impl SimWorld {
    /// Things in the way of the base: furniture, people, and what lies on the floor.
    pub(crate) fn floor_things(&self) -> impl Iterator<Item = (&SmolStr, &Thing)> {
        self.things.iter().filter(|(id, thing)| match thing.role {
            Role::Surface | Role::Container | Role::Person => thing.body.bottom() < ABOVE_M,
            Role::Object => thing.rest == Rest::Free && thing.body.bottom() < FLOOR_M && !self.is_lifted(id),
            Role::Place => false,
        })
    }

    /// Stances of a way from here to a stance, or the thing that leaves no way.
    pub(crate) fn route(&self, to: BasePose) -> Result<Vec<BasePose>, SmolStr> {
        let (from, radius) = (self.base, self.base_extent());
        let obstacle = |(id, thing): (&'_ SmolStr, &'_ Thing)| {
            let here = thing.body.gap(from.x, from.y) - DEEPER_M;
            let there = thing.body.gap(to.x, to.y);
            (id.clone(), thing.body, here, there)
        };
        let things: Vec<_> = self.floor_things().map(obstacle).collect();
        let is_taken =
            |(_, _, here, there): &&(SmolStr, UprightBody, f64, f64)| *there < (radius - SPARE_M).min(*here);
        if let Some((id, ..)) = things.iter().find(is_taken) {
            return Err(id.clone());
        }
        let kept = |here: f64, there: f64| (radius + SPARE_M).min(here).min(there - 1e-6);
        let obstacles: Vec<Obstacle<'_>> = things
            .iter()
            .map(|(id, body, here, there)| Obstacle { id, body, keeps: kept(*here, *there) })
            .collect();
        let ends = [[from.x, from.y], [to.x, to.y]];
        let points = way(ends, &obstacles)?;
        Ok(points.into_iter().skip(1).map(|[x, y]| BasePose { x, y, heading: to.heading }).collect())
    }

    /// The first contact of a motion of the base from now on, with what is `solid` for it.
    pub(crate) fn contact(&self, motion: &BaseMotion, solid: impl Fn(&SmolStr) -> bool) -> Option<Contact> {
        let (start, radius) = (self.now, self.base_extent() - SPARE_M);
        let from = motion.at(start);
        let things: Vec<(&SmolStr, &Thing, f64)> = self
            .floor_things()
            .filter(|(id, _)| solid(id))
            .map(|(id, thing)| (id, thing, radius.min(thing.body.gap(from.x, from.y) - DEEPER_M)))
            .filter(|(_, _, limit)| *limit > 0.0)
            .collect();
        let span = motion.end().since(start).secs();
        let count = (span / SAMPLE_SECS).ceil().clamp(0.0, 1e5) as u32;
        let mut before = start;
        for step in 1..=count {
            let now = start.after(Time::from_secs(span * f64::from(step) / f64::from(count)));
            let at = motion.at(now);
            let touches = |(_, thing, limit): &&(&SmolStr, &Thing, f64)| {
                let mut body = thing.body;
                if let Some(walk) = &thing.walk {
                    let [x, y] = walk.at(now);
                    (body.xyz[0], body.xyz[1]) = (x, y);
                }
                body.gap(at.x, at.y) < *limit
            };
            if let Some((id, ..)) = things.iter().find(touches) {
                return Some(Contact { at: before, with: (*id).clone() });
            }
            before = now;
        }
        None
    }
}

/// Points of a way round obstacles from one point to another; else the first obstacle on the straight line.
fn way(ends: [[f64; 2]; 2], obstacles: &[Obstacle<'_>]) -> Result<Vec<[f64; 2]>, SmolStr> {
    let on = |leg: [[f64; 2]; 2]| obstacles.iter().enumerate().filter(move |(_, other)| other.blocks(leg));
    let mut involved: Vec<usize> = on(ends).map(|(index, _)| index).collect();
    let [from, _] = ends;
    let away = |at: &Obstacle<'_>| at.body.gap(from[0], from[1]);
    let first =
        obstacles.iter().filter(|other| other.blocks(ends)).min_by(|a, b| away(a).total_cmp(&away(b)));
    let Some(first) = first else { return Ok(ends.to_vec()) };
    while involved.len() <= MOST {
        let taken: Vec<&Obstacle<'_>> = involved.iter().filter_map(|index| obstacles.get(*index)).collect();
        let corners = taken.iter().flat_map(|other| other.corners());
        let is_free = |point: &[f64; 2]| obstacles.iter().all(|other| !other.blocks([*point, *point]));
        let nodes: Vec<[f64; 2]> = ends.into_iter().chain(corners.filter(is_free)).collect();
        let Some(points) = shortest(&nodes, |leg| taken.iter().all(|other| !other.blocks(leg))) else {
            break;
        };
        let more: Vec<usize> = points
            .windows(2)
            .filter_map(|pair| pair.first_chunk::<2>())
            .flat_map(|leg| on(*leg).map(|(index, _)| index))
            .filter(|index| !involved.contains(index))
            .collect();
        if more.is_empty() {
            return Ok(points);
        }
        involved.extend(more);
        involved.sort_unstable();
        involved.dedup();
    }
    Err(first.id.clone())
}

/// The shortest way from the first of some nodes to the second along legs that are free: Dijkstra 1959.
/// O(nodes²) legs.
fn shortest(nodes: &[[f64; 2]], is_free: impl Fn([[f64; 2]; 2]) -> bool) -> Option<Vec<[f64; 2]>> {
    let mut reached: Vec<(f64, Option<usize>)> = vec![(f64::INFINITY, None); nodes.len()];
    let mut open: Vec<usize> = (0..nodes.len()).collect();
    reached.first_mut()?.0 = 0.0;
    loop {
        let length = |index: &usize| reached.get(*index).map_or(f64::INFINITY, |(length, _)| *length);
        let place = (0..open.len()).min_by(|a, b| {
            let [a, b] = [a, b].map(|at| open.get(*at).map_or(f64::INFINITY, length));
            a.total_cmp(&b)
        })?;
        let here = open.swap_remove(place);
        let (so_far, from) = (length(&here), *nodes.get(here)?);
        if so_far == f64::INFINITY {
            return None;
        }
        if here == 1 {
            break;
        }
        for next in &open {
            let (Some(to), Some(best)) = (nodes.get(*next), reached.get_mut(*next)) else { continue };
            let length = so_far + (to[0] - from[0]).hypot(to[1] - from[1]);
            if length < best.0 && is_free([from, *to]) {
                *best = (length, Some(here));
            }
        }
    }
    let mut points = Vec::new();
    let mut at = Some(1);
    while let Some(index) = at {
        points.push(*nodes.get(index)?);
        at = reached.get(index)?.1;
    }
    points.reverse();
    Some(points)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

    use super::*;
    use motet_robots::scene::{EntityShape, Placement};

    fn boxes(at: &[([f64; 2], [f64; 2])]) -> Vec<(SmolStr, UprightBody)> {
        let body = |(index, ([x, y], [a, b])): (usize, &([f64; 2], [f64; 2]))| {
            let pose = Placement { xyz: [*x, *y, 0.5], rpy: [0.0; 3] };
            let shape = EntityShape::Box([*a, *b, 1.0]);
            (SmolStr::from(format!("wall_{index}")), UprightBody::new(pose, Some(&shape), false))
        };
        at.iter().enumerate().map(body).collect()
    }

    fn between(to: [f64; 2], walls: &[(SmolStr, UprightBody)]) -> Result<Vec<[f64; 2]>, SmolStr> {
        let obstacles: Vec<_> = walls.iter().map(|(id, body)| Obstacle { id, body, keeps: 0.25 }).collect();
        way([[0.0, 0.0], to], &obstacles)
    }

    #[test]
    fn route_goes_straight_where_it_can_and_round_what_stands_there() {
        assert_eq!(between([4.0, 0.0], &[]), Ok(vec![[0.0, 0.0], [4.0, 0.0]]));
        let walls = boxes(&[([2.0, 0.5], [0.2, 3.0]), ([2.0, -3.0], [0.2, 3.0])]);
        let points = between([4.0, 0.0], &walls).unwrap();
        assert!(points.len() > 2, "{points:?}");
        let obstacles: Vec<_> = walls.iter().map(|(id, body)| Obstacle { id, body, keeps: 0.25 }).collect();
        for pair in points.windows(2) {
            let leg = *pair.first_chunk::<2>().unwrap();
            assert!(obstacles.iter().all(|other| !other.blocks(leg)), "{leg:?}");
        }
        let length: f64 =
            points.windows(2).map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1])).sum();
        // The gap between the walls is too narrow: the path leads round the end of the first,
        // 2 m to the side.
        assert!((6.0..6.5).contains(&length), "{length}");
    }

    #[test]
    fn route_out_of_a_ring_of_walls_names_the_wall() {
        let ring = boxes(&[
            ([1.0, 0.0], [0.1, 2.1]),
            ([-1.0, 0.0], [0.1, 2.1]),
            ([0.0, 1.0], [2.1, 0.1]),
            ([0.0, -1.0], [2.1, 0.1]),
        ]);
        assert_eq!(between([4.0, 0.0], &ring), Err("wall_0".into()));
        assert!(between([0.5, 0.5], &ring).is_ok());
    }
}
