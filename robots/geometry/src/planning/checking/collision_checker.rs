//! Collision checker for configurations and pure-translation edges against nearby obstacles. Built once a
//! query. Edges along which a part turns are in `edge_check`.

use std::cell::{OnceCell, RefCell};

use nalgebra::Vector3;

use crate::collision::Solid;
use crate::planning::context::QueryContext;
use crate::planning::query::ContactTally;
use crate::planning::scene::{
    AllowedCollisions, Configuration, Contact, ContactTarget, HandModel, MIN_CLEARANCE, Padding, RobotModel,
    above_floor, plane,
};
use crate::simd::{BatchPair, NearPair, ObbSet, PairTarget, PosedBatch};

/// Collision checker: the robot's parts and the obstacles that they can touch around a place of the base.
pub(crate) struct CollisionChecker<'r, 'w> {
    pub(crate) context: &'r QueryContext<'w>,
    pub(crate) limbs: Vec<CheckedPart>,
    pub(crate) obstacles: Vec<NearObstacle>,
    /// Centre of the base positions that the checker covers, and their greatest distance from it, in m.
    place: [f64; 2],
    far: f64,
    pub(crate) prefilter: PrefilterCache,
}

/// Flags of one part of the robot.
#[derive(Clone, Copy)]
pub(crate) struct CheckedPart {
    pub(crate) link: usize,
    pub(crate) reach: f64,
    /// Unset for a part that never moves: on a fixed base it touches what it is bolted to.
    pub(crate) counts: bool,
    pub(crate) is_carried: bool,
    in_hand: bool,
    is_held: bool,
}

/// Obstacle within reach.
pub(crate) struct NearObstacle {
    pub(crate) index: usize,
    pub(crate) entity: usize,
    pub(crate) solid: Solid,
    pub(crate) reach: f64,
    pub(crate) padding: Padding,
}

impl<'w> QueryContext<'w> {
    /// Checker for base positions within `far` m of a place.
    pub(crate) fn around(&self, place: [f64; 2], far: f64) -> CollisionChecker<'_, 'w> {
        let wide = far + self.model.extent() + self.held_reach() + Padding::new(self.clearance).most();
        let [x, y] = place;
        let obstacles = self.obstacles.near(place, wide).filter(|(_, obstacle)| {
            let (dx, dy, wide) =
                (obstacle.solid.centre.x - x, obstacle.solid.centre.y - y, wide + obstacle.reach);
            dx * dx + dy * dy <= wide * wide
        });
        let obstacles = obstacles.map(|(index, obstacle)| NearObstacle {
            index,
            entity: obstacle.entity,
            solid: obstacle.solid,
            reach: obstacle.reach,
            padding: obstacle.padding,
        });
        CollisionChecker {
            context: self,
            limbs: self.limbs(),
            obstacles: obstacles.collect(),
            place,
            far,
            prefilter: PrefilterCache::default(),
        }
    }

    /// Checker for an edge.
    pub(crate) fn along(&self, from: &Configuration, to: &Configuration) -> CollisionChecker<'_, 'w> {
        let ([x, y, _], [to_x, to_y, _]) = (from.base, to.base);
        let middle = [(x + to_x) / 2.0, (y + to_y) / 2.0];
        // Spare for rounding.
        self.around(middle, libm::hypot(to_x - x, to_y - y) / 2.0 + 1e-6)
    }

    /// Reach that the held object adds to the robot, in m.
    fn held_reach(&self) -> f64 {
        let part = self.held.and_then(|at| self.body.parts().get(at));
        part.map_or(0.0, |part| part.solid.centre.norm() + part.solid.reach())
    }

    fn limbs(&self) -> Vec<CheckedPart> {
        let hand = self.model.hand();
        let is = |list: fn(&HandModel) -> &Vec<bool>, link: usize| {
            hand.is_some_and(|hand| list(hand).get(link) == Some(&true))
        };
        let drives = self.model.drives();
        let limbs = self.body.parts().iter().zip(0..).map(|(part, at)| {
            let is_held = self.held == Some(at);
            let is_carried = is_held || is(|hand| &hand.carried, part.link);
            CheckedPart {
                link: part.link,
                reach: part.solid.reach(),
                counts: drives || is_carried,
                is_carried,
                in_hand: is_held || is(|hand| &hand.members, part.link),
                is_held,
            }
        });
        limbs.collect()
    }
}

impl QueryContext<'_> {
    /// Contact at the start.
    pub(crate) fn start_contact(&self) -> Option<&Contact> {
        let robot = &self.state.robot;
        // This check alone includes parts that never move against each other.
        let find = || self.along(robot, robot).contact_exactly(robot, AllowedCollisions::default());
        self.start_contact.get_or_init(find).as_ref()
    }

    /// First contact in a configuration, with the padding of each obstacle. O(parts × obstacles near).
    ///
    /// ```
    /// use motet_geometry::planning::{AllowedCollisions, QueryContext, RobotModel, SceneState};
    /// use motet_robots::builtin::{self, RobotWithBody};
    ///
    /// let RobotWithBody { robot, urdf } = builtin::robot("hsr").unwrap();
    /// let scene = builtin::scene("kitchen").unwrap();
    /// let model = RobotModel::new(&robot, &urdf);
    /// let state = SceneState::new(&model, &scene);
    /// let context = QueryContext::new(&model, &scene, &state);
    ///
    /// let none = AllowedCollisions::default();
    /// assert_eq!(context.contact(&state.robot, none), None);
    /// let in_the_table = state.robot.at([2.2, 0.5, 0.0]);
    /// assert_eq!(context.contact(&in_the_table, none).unwrap().other, "kitchen_table");
    /// ```
    #[must_use]
    pub fn contact(&self, configuration: &Configuration, allowed: AllowedCollisions) -> Option<Contact> {
        self.along(configuration, configuration).contact(configuration, allowed)
    }

    /// First contact in each configuration, checked in batches of eight: faster the nearer they are to each
    /// other.
    #[must_use]
    pub fn contacts(
        &self,
        configurations: &[Configuration],
        allowed: AllowedCollisions,
    ) -> Vec<Option<Contact>> {
        let checker = self.all_around(configurations, MIN_CLEARANCE);
        let eights = configurations
            .chunks(8)
            .map(|configurations| configurations.iter().collect::<Vec<&Configuration>>());
        eights.flat_map(|configurations| checker.contacts(&configurations, allowed)).collect()
    }

    /// Clearance to obstacles and floor, in m, at most 1.
    #[must_use]
    pub fn clearance(&self, configuration: &Configuration, allowed: AllowedCollisions) -> f64 {
        self.around(plane(configuration), 1.0).clearance(configuration, allowed, 1.0)
    }

    /// Checks whether a whole edge is free, not only samples of it.
    ///
    /// # Errors
    ///
    /// The contact, or a pair that comes too near to be certified.
    pub fn edge(
        &self,
        from: &Configuration,
        to: &Configuration,
        allowed: AllowedCollisions,
    ) -> Result<(), Contact> {
        self.along(from, to).edge(from, to, allowed)
    }
}

impl RobotModel {
    /// All pairs of links of the robot that touch each other in a configuration and may not, by their indices
    /// in the tree, the lower first, sorted, each once. O(parts²).
    ///
    /// ```
    /// use motet_geometry::planning::{Configuration, RobotModel};
    /// use motet_robots::builtin::{self, RobotWithBody};
    ///
    /// let RobotWithBody { robot, urdf } = builtin::robot("hsr").unwrap();
    /// let model = RobotModel::new(&robot, &urdf);
    /// let rest = Configuration { base: [0.0; 3], joints: model.rest().to_vec() };
    /// assert!(model.own_contacts(&rest).is_empty());
    /// ```
    #[must_use]
    pub fn own_contacts(&self, configuration: &Configuration) -> Vec<[usize; 2]> {
        let (body, parts) = (self.body(), self.body().parts());
        let placed = body.placed(&self.map_from_links(configuration));
        let met = body.pairs().iter().filter_map(|[one, other]| {
            let (a, b) = (parts.get(*one)?, parts.get(*other)?);
            let is_met = is_nearer(
                placed.get(*one)?,
                a.solid.reach(),
                placed.get(*other)?,
                b.solid.reach(),
                MIN_CLEARANCE,
            );
            is_met.then_some([a.link.min(b.link), a.link.max(b.link)])
        });
        let mut met: Vec<[usize; 2]> = met.collect();
        met.sort_unstable();
        met.dedup();
        met
    }
}

impl CollisionChecker<'_, '_> {
    /// First contact in a configuration, with the padding of each obstacle.
    pub(crate) fn contact(
        &self,
        configuration: &Configuration,
        allowed: AllowedCollisions,
    ) -> Option<Contact> {
        if self.holds(configuration) {
            self.first_contact(&[configuration], allowed)
        } else {
            self.context.along(configuration, configuration).first_contact(&[configuration], allowed)
        }
    }

    /// First contact in a configuration, pair by pair in `f64`.
    pub(crate) fn contact_exactly(
        &self,
        configuration: &Configuration,
        allowed: AllowedCollisions,
    ) -> Option<Contact> {
        if self.holds(configuration) {
            self.contact_here(configuration, allowed)
        } else {
            self.context.along(configuration, configuration).contact_here(configuration, allowed)
        }
    }

    /// Origin of the neighbourhood.
    pub(crate) fn place(&self) -> [f64; 2] {
        self.place
    }

    fn contact_here(&self, configuration: &Configuration, allowed: AllowedCollisions) -> Option<Contact> {
        let poses = self.context.model.map_from_links(configuration);
        let placed = self.context.body.placed(&poses);
        let found = self.first(&placed, allowed);
        found.map(|(part, other)| self.context.named_contact(part, other))
    }

    /// Checks whether the checker covers the base of a configuration.
    pub(crate) fn holds(&self, configuration: &Configuration) -> bool {
        let [x, y, _] = configuration.base;
        let [a, b] = self.place;
        self.holds_off([x - a, y - b])
    }

    /// Checks whether the checker covers a base at an offset from its origin.
    pub(crate) fn holds_off(&self, [x, y]: [f64; 2]) -> bool {
        x * x + y * y <= self.far * self.far
    }

    fn first(&self, placed: &[Solid], allowed: AllowedCollisions) -> Option<(usize, ContactTarget)> {
        for ((limb, solid), part) in self.limbs.iter().zip(placed).zip(0..) {
            if !limb.counts {
                continue;
            }
            for near in &self.obstacles {
                if !limb.may_touch(near.entity, allowed)
                    && is_nearer(
                        solid,
                        limb.reach,
                        &near.solid,
                        near.reach,
                        limb.padding(near.entity, near.padding, allowed),
                    )
                {
                    return Some((part, ContactTarget::Obstacle(near.index)));
                }
            }
            if limb.is_carried && above_floor(solid) <= MIN_CLEARANCE {
                return Some((part, ContactTarget::Floor));
            }
        }
        self.context.body.pairs().iter().find_map(|[one, other]| {
            let (a, b) = (self.limbs.get(*one)?, self.limbs.get(*other)?);
            is_nearer(placed.get(*one)?, a.reach, placed.get(*other)?, b.reach, MIN_CLEARANCE)
                .then_some((*one, ContactTarget::Part(*other)))
        })
    }

    /// Clearance to obstacles and floor where it is less than `least`, with the base anywhere.
    pub(crate) fn clearance_at(
        &self,
        configuration: &Configuration,
        allowed: AllowedCollisions,
        least: f64,
    ) -> f64 {
        let [x, y, _] = configuration.base;
        // The neighbourhood is only as large as the robot's reach.
        let (dx, dy) = (x - self.place[0], y - self.place[1]);
        if (dx * dx + dy * dy).sqrt() + least <= self.far {
            self.clearance(configuration, allowed, least)
        } else {
            self.context.around([x, y], least).clearance(configuration, allowed, least)
        }
    }

    /// Clearance to obstacles and floor where it is less than `least`.
    pub(crate) fn clearance(
        &self,
        configuration: &Configuration,
        allowed: AllowedCollisions,
        mut least: f64,
    ) -> f64 {
        let placed = self.context.body.placed(&self.context.model.map_from_links(configuration));
        for (limb, solid) in self.limbs.iter().zip(&placed).filter(|(limb, _)| limb.counts) {
            for near in &self.obstacles {
                if limb.is_kept_from(near.entity, allowed) {
                    least = solid.distance_to(limb.reach, &near.solid, near.reach, least).min(least);
                }
            }
            if limb.is_carried {
                least = above_floor(solid).min(least);
            }
        }
        least
    }

    /// Nearest obstacle, by its index in the scene, of some groups of parts, with the distance in m. `counts`
    /// chooses by the mark of the arm's parts.
    pub(crate) fn nearest(
        &self,
        configuration: &Configuration,
        allowed: AllowedCollisions,
        counts: impl Fn(bool) -> bool,
    ) -> Option<(f64, usize)> {
        let placed = self.context.robot_at(configuration);
        let limbs = self.limbs.iter().zip(&placed).filter(|(limb, _)| limb.counts && counts(limb.is_carried));
        let mut least: Option<(f64, usize)> = None;
        for (limb, solid) in limbs {
            for near in self.obstacles.iter().filter(|near| limb.is_kept_from(near.entity, allowed)) {
                let enough = least.map_or(f64::INFINITY, |(known, _)| known);
                let metres = solid.distance_to(limb.reach, &near.solid, near.reach, enough);
                if metres < enough {
                    least = Some((metres, near.index));
                }
            }
        }
        least
    }

    /// Least distance of some pairs in a configuration, where it is less than `least`.
    pub(crate) fn clearance_among<'n>(
        &self,
        configuration: &Configuration,
        near: impl Iterator<Item = &'n NearPair>,
        mut least: f64,
    ) -> f64 {
        let mut placed: Option<(usize, Solid)> = None;
        for NearPair { pair, .. } in near {
            let solid = match placed {
                Some((part, solid)) if part == pair.part => solid,
                Some(_) | None => {
                    let Some(solid) = self.part_at(pair.part, configuration) else { continue };
                    placed = Some((pair.part, solid));
                    solid
                }
            };
            let metres = match other(pair) {
                ContactTarget::Obstacle(at) => {
                    let Some((near, limb)) = self.obstacles.get(at).zip(self.limbs.get(pair.part)) else {
                        continue;
                    };
                    solid.distance_to(limb.reach, &near.solid, near.reach, least)
                }
                ContactTarget::Floor => above_floor(&solid),
                ContactTarget::Part(_) => continue,
            };
            least = metres.min(least);
        }
        least
    }

    /// Solid of a part in a configuration.
    pub(crate) fn part_at(&self, part: usize, configuration: &Configuration) -> Option<Solid> {
        let (model, own) = (self.context.model, self.context.body.parts().get(part)?);
        let pose = model.map_from_root(configuration.base)
            * model.tree().root_from_link(&configuration.joints, own.link);
        Some(own.solid.moved(&pose))
    }

    /// Checks whether a whole edge is free.
    ///
    /// # Errors
    ///
    /// The contact, or a pair that comes too near to be certified.
    pub(crate) fn edge(
        &self,
        from: &Configuration,
        to: &Configuration,
        allowed: AllowedCollisions,
    ) -> Result<(), Contact> {
        match self.contact(from, allowed).or_else(|| self.contact(to, allowed)) {
            Some(contact) => Err(contact),
            None => self.between(from, to, allowed),
        }
    }

    /// Checks whether a path is free, and counts its contact.
    pub(crate) fn is_free(
        &self,
        way: &[Configuration],
        allowed: AllowedCollisions,
        met: &mut ContactTally,
    ) -> bool {
        let configurations: Vec<&Configuration> = way.iter().collect();
        let contact = self.first_contact(&configurations, allowed).or_else(|| {
            way.windows(2).rev().find_map(|pair| match pair {
                [one, other] => self.between(one, other, allowed).err(),
                _ => None,
            })
        });
        contact.map(|contact| met.add(&contact)).is_none()
    }
}

impl CollisionChecker<'_, '_> {
    /// Checks an edge along which nothing turns: the sweep of each part is convex, so that one distance
    /// decides.
    pub(crate) fn swept(
        &self,
        from: &Configuration,
        to: &Configuration,
        allowed: AllowedCollisions,
    ) -> Result<(), Contact> {
        let near = self.near_on([from, to], &SegmentCentres::WHOLE, allowed, None);
        if near.as_ref().is_some_and(Vec::is_empty) {
            return Ok(());
        }
        if let Some(near) = near.iter().flatten().find(|near| near.sure != 0) {
            return Err(self.named_contact(near));
        }
        let context = self.context;
        let placed = |configuration| context.body.placed(&context.model.map_from_links(configuration));
        let (placed, last) = (placed(from), placed(to));
        let solids: Vec<(Solid, Vector3<f64>)> =
            placed.iter().zip(&last).map(|(one, other)| (*one, other.centre - one.centre)).collect();
        let look = |part: usize, other: ContactTarget| match self.touches_swept(&solids, part, other, allowed)
        {
            Some(other) => Err(context.named_contact(part, other)),
            None => Ok(()),
        };
        if let Some(near) = near {
            return near.into_iter().try_for_each(|near| look(near.pair.part, other(&near.pair)));
        }
        for (limb, part) in self.limbs.iter().zip(0..).filter(|(limb, _)| limb.counts) {
            for (near, at) in self.obstacles.iter().zip(0..) {
                if !limb.may_touch(near.entity, allowed) {
                    look(part, ContactTarget::Obstacle(at))?;
                }
            }
            if limb.is_carried {
                look(part, ContactTarget::Floor)?;
            }
        }
        context.body.pairs().iter().try_for_each(|[one, other]| look(*one, ContactTarget::Part(*other)))
    }

    /// Contact of one part while it moves straight, with the scene's index of an obstacle.
    fn touches_swept(
        &self,
        solids: &[(Solid, Vector3<f64>)],
        part: usize,
        other: ContactTarget,
        allowed: AllowedCollisions,
    ) -> Option<ContactTarget> {
        let ((solid, shift), limb) = solids.get(part).zip(self.limbs.get(part))?;
        match other {
            ContactTarget::Obstacle(at) => {
                let near = self.obstacles.get(at)?;
                let pad = limb.padding(near.entity, near.padding, allowed);
                let metres = solid.swept_distance_to(shift, limb.reach, &near.solid, near.reach, pad);
                (metres <= pad).then_some(ContactTarget::Obstacle(near.index))
            }
            ContactTarget::Floor => (above_floor(solid) + shift.z.min(0.0) <= MIN_CLEARANCE).then_some(other),
            ContactTarget::Part(at) => {
                let ((beyond, moved), far) = solids.get(at).zip(self.limbs.get(at))?;
                // Parts that move alike keep their distance.
                let shift = shift - moved;
                let is_touched = shift.norm_squared() > 0.0
                    && solid.swept_distance_to(&shift, limb.reach, beyond, far.reach, MIN_CLEARANCE)
                        <= MIN_CLEARANCE;
                is_touched.then_some(other)
            }
        }
    }
}

impl CheckedPart {
    pub(crate) fn may_touch(&self, entity: usize, allowed: AllowedCollisions) -> bool {
        self.in_hand && allowed.touches(entity, self.is_held)
    }

    /// Distance in m that the part keeps from an obstacle of an entity that it may not touch.
    pub(crate) fn padding(&self, entity: usize, padding: Padding, allowed: AllowedCollisions) -> f64 {
        if self.in_hand && allowed.is_near(entity) { MIN_CLEARANCE } else { padding.of(self.is_carried) }
    }

    /// Checks whether the clearance of the part from an entity counts.
    pub(crate) fn is_kept_from(&self, entity: usize, allowed: AllowedCollisions) -> bool {
        !(self.may_touch(entity, allowed) || self.in_hand && allowed.is_near(entity))
    }
}

/// Checks whether two solids are within `metres` of each other.
pub(crate) fn is_nearer(one: &Solid, reach: f64, other: &Solid, other_reach: f64, metres: f64) -> bool {
    one.apart(reach, other, other_reach, [metres, metres], &mut Vector3::zeros()) <= metres
}

/// Prefilter data of a neighbourhood, filled at first use.
#[derive(Default)]
pub(crate) struct PrefilterCache {
    pub(crate) obbs: OnceCell<Option<ObbSet>>,
    /// Buffer for the placed robot, reused by the next check.
    pub(crate) posed: RefCell<PosedBatch>,
}

/// Centres of eight segments of one length, as shares of the edge.
#[derive(Clone, Copy)]
pub(crate) struct SegmentCentres {
    pub(crate) middles: [f64; 8],
    /// Half of a segment's length.
    pub(crate) half: f64,
}

impl SegmentCentres {
    /// Eight segments of the whole edge.
    pub(crate) const WHOLE: Self =
        Self { middles: [0.0625, 0.1875, 0.3125, 0.4375, 0.5625, 0.6875, 0.8125, 0.9375], half: 0.0625 };
}

/// Other body of a batch pair.
pub(crate) fn other(pair: &BatchPair) -> ContactTarget {
    match pair.target {
        PairTarget::Obb(at) => ContactTarget::Obstacle(at),
        PairTarget::Part(at, _) => ContactTarget::Part(at),
        PairTarget::Floor => ContactTarget::Floor,
    }
}
