//! Whether states, and straight ways along which nothing turns, are free among the things in a neighbourhood. Made once for
//! a query. Ways along which something turns are in `way`.

use nalgebra::Vector3;

use crate::collision::Solid;
use crate::planning::checking::prefilter::{PrefilterCache, SegmentCentres, other};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::MIN_CLEARANCE;
use crate::planning::scene::contact::{AllowedCollisions, Contact, ContactTarget};
use crate::planning::search::context::QueryContext;
use crate::planning::search::path::ContactTally;
use crate::simd::NearPair;

/// A neighbourhood, and the robot in it.
pub(crate) struct CollisionChecker<'r, 'w> {
    pub(crate) context: &'r QueryContext<'w>,
    pub(crate) limbs: Vec<CheckedPart>,
    pub(crate) obstacles: Vec<NearObstacle>,
    /// The middle of the places where the base can be, and how far from it, in m.
    place: [f64; 2],
    far: f64,
    pub(crate) quick: PrefilterCache,
}

/// What counts of a part of the robot.
#[derive(Clone, Copy)]
pub(crate) struct CheckedPart {
    pub(crate) link: usize,
    pub(crate) reach: f64,
    /// What does not move on a base that does not drive touches what it is bolted to.
    pub(crate) counts: bool,
    pub(crate) is_carried: bool,
    in_hand: bool,
    is_held: bool,
}

/// A thing of the room.
pub(crate) struct NearObstacle {
    pub(crate) index: usize,
    pub(crate) entity: usize,
    pub(crate) solid: Solid,
    pub(crate) reach: f64,
}

impl<'w> QueryContext<'w> {
    /// What the robot can touch with its base no farther than `far` from a place, in m.
    pub(crate) fn around(&self, place: [f64; 2], far: f64) -> CollisionChecker<'_, 'w> {
        let wide = far + self.model.extent() + self.held_reach() + MIN_CLEARANCE;
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
        });
        CollisionChecker {
            context: self,
            limbs: self.limbs(),
            obstacles: obstacles.collect(),
            place,
            far,
            quick: PrefilterCache::default(),
        }
    }

    /// What the robot can touch on its way between two places of its base.
    pub(crate) fn along(&self, from: &Configuration, to: &Configuration) -> CollisionChecker<'_, 'w> {
        let ([x, y, _], [to_x, to_y, _]) = (from.base, to.base);
        let middle = [(x + to_x) / 2.0, (y + to_y) / 2.0];
        // With some to spare for rounding.
        self.around(middle, libm::hypot(to_x - x, to_y - y) / 2.0 + 1e-6)
    }

    /// How far what is held adds to the robot.
    fn held_reach(&self) -> f64 {
        let part = self.held.and_then(|at| self.body.parts().get(at));
        part.map_or(0.0, |part| part.solid.centre.norm() + part.solid.reach())
    }

    fn limbs(&self) -> Vec<CheckedPart> {
        let hand = self.model.hand();
        let is = |list: fn(&crate::planning::scene::robot_model::HandModel) -> &Vec<bool>, link: usize| {
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

impl CollisionChecker<'_, '_> {
    /// The first touch in a state, with [`MIN_CLEARANCE`] between everything.
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

    /// The same, pair by pair.
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

    /// The origin of the neighbourhood.
    pub(crate) fn place(&self) -> [f64; 2] {
        self.place
    }

    fn contact_here(&self, configuration: &Configuration, allowed: AllowedCollisions) -> Option<Contact> {
        let poses = self.context.model.map_from_links(configuration);
        let placed = self.context.body.placed(&poses);
        let found = self.first(&placed, allowed);
        found.map(|(part, other)| self.context.told(part, other))
    }

    /// Whether the base is where this neighbourhood is enough.
    pub(crate) fn holds(&self, configuration: &Configuration) -> bool {
        let [x, y, _] = configuration.base;
        let [a, b] = self.place;
        self.holds_off([x - a, y - b])
    }

    /// The same for a base so far from the origin of the neighbourhood.
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
                    && is_touching(solid, limb.reach, &near.solid, near.reach)
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
            is_touching(placed.get(*one)?, a.reach, placed.get(*other)?, b.reach)
                .then_some((*one, ContactTarget::Part(*other)))
        })
    }

    /// The least distance between the robot and what stands around, the floor included, where it is less than `least`; with the
    /// base anywhere.
    pub(crate) fn clearance_at(
        &self,
        configuration: &Configuration,
        allowed: AllowedCollisions,
        least: f64,
    ) -> f64 {
        let [x, y, _] = configuration.base;
        // A neighbourhood is as large as the robot and says nothing of what is beyond.
        let (dx, dy) = (x - self.place[0], y - self.place[1]);
        if (dx * dx + dy * dy).sqrt() + least <= self.far {
            self.clearance(configuration, allowed, least)
        } else {
            self.context.around([x, y], least).clearance(configuration, allowed, least)
        }
    }

    /// The least distance between the robot and what stands around, the floor included, where it is less than `least`.
    pub(crate) fn clearance(
        &self,
        configuration: &Configuration,
        allowed: AllowedCollisions,
        mut least: f64,
    ) -> f64 {
        let placed = self.context.body.placed(&self.context.model.map_from_links(configuration));
        for (limb, solid) in self.limbs.iter().zip(&placed).filter(|(limb, _)| limb.counts) {
            for near in &self.obstacles {
                if !limb.may_touch(near.entity, allowed) {
                    least = solid.distance_to(limb.reach, &near.solid, near.reach, least).min(least);
                }
            }
            if limb.is_carried {
                least = above_floor(solid).min(least);
            }
        }
        least
    }

    /// The least distance of some pairs of parts and what stands around in a state, where it is less than `least`.
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

    /// A part of the robot in a state.
    pub(crate) fn part_at(&self, part: usize, configuration: &Configuration) -> Option<Solid> {
        let (model, own) = (self.context.model, self.context.body.parts().get(part)?);
        let pose = model.map_from_root(configuration.base)
            * model.tree().root_from_link(&configuration.joints, own.link);
        Some(own.solid.moved(&pose))
    }

    /// Whether the straight way between two states is free throughout.
    ///
    /// # Errors
    ///
    /// What touches on the way, or comes so near that nothing certain can be said.
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

    /// Whether a way is free. What touches is noted.
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
    /// Whether a straight way is free where nothing turns on it, so that what each part sweeps over is convex and one distance tells all.
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
            return Err(self.told(near));
        }
        let context = self.context;
        let placed = |configuration| context.body.placed(&context.model.map_from_links(configuration));
        let (placed, last) = (placed(from), placed(to));
        let solids: Vec<(Solid, Vector3<f64>)> =
            placed.iter().zip(&last).map(|(one, other)| (*one, other.centre - one.centre)).collect();
        let look = |part: usize, other: ContactTarget| match self.touches_swept(&solids, part, other) {
            Some(other) => Err(context.told(part, other)),
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

    /// What a part touches while it moves straight, if it does: a thing as the room knows it.
    fn touches_swept(
        &self,
        solids: &[(Solid, Vector3<f64>)],
        part: usize,
        other: ContactTarget,
    ) -> Option<ContactTarget> {
        let ((solid, shift), limb) = solids.get(part).zip(self.limbs.get(part))?;
        match other {
            ContactTarget::Obstacle(at) => {
                let near = self.obstacles.get(at)?;
                let metres =
                    solid.swept_distance_to(shift, limb.reach, &near.solid, near.reach, MIN_CLEARANCE);
                (metres <= MIN_CLEARANCE).then_some(ContactTarget::Obstacle(near.index))
            }
            ContactTarget::Floor => (above_floor(solid) + shift.z.min(0.0) <= MIN_CLEARANCE).then_some(other),
            ContactTarget::Part(at) => {
                let ((beyond, moved), far) = solids.get(at).zip(self.limbs.get(at))?;
                // What goes along stays as far away as it is.
                let shift = shift - moved;
                let is_touched = shift.norm_squared() > 0.0
                    && solid.swept_distance_to(&shift, limb.reach, beyond, far.reach, MIN_CLEARANCE)
                        <= MIN_CLEARANCE;
                is_touched.then_some(other)
            }
        }
    }
}

impl QueryContext<'_> {
    /// Whether no part of the robot turns on the straight way between two states.
    pub(crate) fn is_straight(&self, from: &Configuration, to: &Configuration) -> bool {
        let ([_, _, yaw], [_, _, to_yaw]) = (from.base, to.base);
        let values = from.joints.iter().zip(&to.joints).zip(self.model.turning());
        yaw == to_yaw && values.into_iter().all(|((one, other), turns)| one == other || !turns)
    }
}

impl CheckedPart {
    pub(crate) fn may_touch(&self, entity: usize, allowed: AllowedCollisions) -> bool {
        (self.in_hand && allowed.hand == Some(entity)) || (self.is_held && allowed.held == Some(entity))
    }
}

/// Whether two solids are no farther from each other than [`MIN_CLEARANCE`].
pub(crate) fn is_touching(one: &Solid, reach: f64, other: &Solid, other_reach: f64) -> bool {
    one.apart(reach, other, other_reach, [MIN_CLEARANCE, MIN_CLEARANCE], &mut Vector3::zeros())
        <= MIN_CLEARANCE
}

pub(crate) fn above_floor(solid: &Solid) -> f64 {
    solid.centre.z - solid.extent(&Vector3::z())
}
