//! Broad phase in batches of eight: drops the pairs that are apart for certain in `f32`, so that `f64`
//! decides the near ones only.

use super::collision_checker::{CollisionChecker, SegmentCentres, is_nearer, other};
use crate::planning::context::QueryContext;
use crate::planning::scene::{
    AllowedCollisions, Configuration, Contact, ContactTarget, MIN_CLEARANCE, Padding, above_floor,
};
use crate::simd::{Batch8, BatchCheck, BatchModel, BatchPair, NearPair, Obb, ObbSet};

/// Distances that count as near.
#[derive(Clone, Copy)]
struct NearRange {
    /// Distance for each configuration of the batch, in m.
    metres: [f32; 8],
    /// Set where pairs of the robot's own parts count.
    is_own: bool,
}

impl NearRange {
    const LEAST: Self = Self { metres: [MIN_CLEARANCE as f32; 8], is_own: true };
}

impl QueryContext<'_> {
    /// Batch model of the robot, whose free joints are those of the hand, its arm and the postures; `None`
    /// where the robot has no such model.
    pub(crate) fn batch_model(&self) -> Option<&BatchModel> {
        let make = || {
            // Pairs that never move against each other keep the distance that they have at the start.
            if self.start_contact().is_some() {
                return None;
            }
            let model = self.model;
            let hand = model.hand()?;
            let dofs = model.tree().dofs().iter().zip(0..);
            let named: Vec<usize> = dofs
                .filter(|(dof, _)| model.card().postures.values().any(|it| it.contains_key(&dof.name)))
                .map(|(_, at)| at)
                .collect();
            let chain = &hand.solver.chain().in_tree;
            let is_free = |at: usize| {
                chain.contains(&at) || named.contains(&at) || hand.open.iter().any(|(open, _)| *open == at)
            };
            let reduced = model.tree().reduced(&self.state.robot.joints, is_free)?;
            let free = (0..model.tree().dofs().len()).map(is_free).collect();
            Some((BatchModel::new(&reduced, &model.map_from_root([0.0; 3]), &self.body)?, free))
        };
        let (batch_model, _) = self.batch_model.get_or_init(make).as_ref()?;
        Some(batch_model)
    }

    /// Checks whether the batch model represents a configuration: joints that it holds still are as at the
    /// start.
    fn is_drawn(&self, configuration: &Configuration) -> bool {
        let Some(Some((_, free))) = self.batch_model.get() else { return false };
        let values = configuration.joints.iter().zip(&self.state.robot.joints).zip(free);
        values.into_iter().all(|((one, start), is_free)| *is_free || one == start)
    }
}

impl CollisionChecker<'_, '_> {
    fn obbs(&self) -> Option<&ObbSet> {
        let make = || {
            let obbs = self.obstacles.iter().map(|near| Obb::new(&near.solid, self.place()));
            obbs.collect()
        };
        self.prefilter.obbs.get_or_init(make).as_ref()
    }

    /// Near pairs in up to eight configurations; `None` where the prefilter does not apply.
    pub(crate) fn near_in(
        &self,
        configurations: &[&Configuration],
        allowed: AllowedCollisions,
    ) -> Option<Vec<NearPair>> {
        let batch_model = self.context.batch_model()?;
        self.near(batch_model, &self.batch(batch_model, configurations)?, allowed, None, NearRange::LEAST)
    }

    /// Near pairs on eight segments of an edge. With `pairs`, only of those, on the lanes of their bits.
    pub(crate) fn near_on(
        &self,
        way: [&Configuration; 2],
        legs: &SegmentCentres,
        allowed: AllowedCollisions,
        pairs: Option<&[(BatchPair, u8)]>,
    ) -> Option<Vec<NearPair>> {
        let batch_model = self.context.batch_model()?;
        if !way.iter().all(|configuration| self.context.is_drawn(configuration)) {
            return None;
        }
        let mut batch = batch_model.batch();
        let ends = way.map(|configuration| (self.seen(configuration.base), configuration.joints.as_slice()));
        let is_within = batch_model.set_on(&mut batch, ends, &legs.middles, legs.half);
        if is_within { self.near(batch_model, &batch, allowed, pairs, NearRange::LEAST) } else { None }
    }

    /// Obstacles and floor within some distances of up to eight configurations; `None` where the prefilter
    /// does not apply.
    pub(crate) fn within(
        &self,
        configurations: &[&Configuration],
        allowed: AllowedCollisions,
        metres: [f32; 8],
    ) -> Option<Vec<NearPair>> {
        let batch_model = self.context.batch_model()?;
        if !configurations.iter().all(|configuration| self.holds(configuration)) {
            return None;
        }
        self.near(
            batch_model,
            &self.batch(batch_model, configurations)?,
            allowed,
            None,
            NearRange { metres, is_own: false },
        )
    }

    /// Batch of up to eight configurations; the first fills the rest.
    fn batch(&self, batch_model: &BatchModel, configurations: &[&Configuration]) -> Option<Batch8> {
        let first = configurations.first()?;
        let mut batch = batch_model.batch();
        let set = |lane: usize| {
            let configuration = configurations.get(lane).unwrap_or(first);
            self.context.is_drawn(configuration)
                && batch_model.set(&mut batch, lane, self.seen(configuration.base), &configuration.joints)
        };
        (0..8).all(set).then_some(batch)
    }

    /// Base pose relative to the origin of the neighbourhood.
    fn seen(&self, [x, y, yaw]: [f64; 3]) -> [f64; 3] {
        let [a, b] = self.place();
        [x - a, y - b, yaw]
    }

    /// Near pairs in a batch.
    pub(crate) fn near_to(
        &self,
        batch_model: &BatchModel,
        batch: &Batch8,
        allowed: AllowedCollisions,
    ) -> Option<Vec<NearPair>> {
        self.near(batch_model, batch, allowed, None, NearRange::LEAST)
    }

    fn near(
        &self,
        batch_model: &BatchModel,
        batch: &Batch8,
        allowed: AllowedCollisions,
        pairs: Option<&[(BatchPair, u8)]>,
        gap: NearRange,
    ) -> Option<Vec<NearPair>> {
        let obbs = self.obbs()?;
        let mut posed = self.prefilter.posed.borrow_mut();
        // A clearance is measured, not required.
        let is_measured = !gap.is_own;
        let beyond = |part: usize, obstacle: Option<usize>| {
            let limb = self.limbs.get(part).filter(|limb| limb.counts)?;
            let Some(near) = obstacle else { return limb.is_carried.then_some(0.0) };
            let near = self.obstacles.get(near)?;
            if is_measured {
                return limb.is_kept_from(near.entity, allowed).then_some(0.0);
            }
            let pad = || limb.padding(near.entity, near.padding, allowed) - MIN_CLEARANCE;
            (!limb.may_touch(near.entity, allowed)).then(|| pad() as f32)
        };
        let most = Padding::new(self.context.clearance).most() - MIN_CLEARANCE;
        let look = BatchCheck {
            batch_model,
            batch,
            obbs,
            gaps: gap.metres,
            is_own: gap.is_own,
            // A clearance needs all near pairs, not only the first.
            is_first: gap.is_own,
            pairs,
            posed: &mut posed,
            most_beyond: if is_measured { 0.0 } else { most as f32 },
            beyond,
        };
        Some(look.near_pairs())
    }

    /// First contact in the first configuration that has one.
    pub(crate) fn first_contact(
        &self,
        configurations: &[&Configuration],
        allowed: AllowedCollisions,
    ) -> Option<Contact> {
        configurations
            .chunks(8)
            .find_map(|configurations| self.contacts(configurations, allowed).into_iter().flatten().next())
    }

    /// First contact in each of up to eight configurations.
    pub(crate) fn contacts(
        &self,
        configurations: &[&Configuration],
        allowed: AllowedCollisions,
    ) -> Vec<Option<Contact>> {
        let is_here = configurations.iter().all(|configuration| self.holds(configuration));
        let Some(near) = is_here.then(|| self.near_in(configurations, allowed)).flatten() else {
            return configurations
                .iter()
                .map(|configuration| self.contact_exactly(configuration, allowed))
                .collect();
        };
        configurations
            .iter()
            .zip(0..)
            .map(|(configuration, lane)| self.contact_among(&near, lane, configuration, allowed))
            .collect()
    }

    /// First contact among near pairs in one configuration: certain contacts first, which need no check in
    /// `f64`.
    pub(crate) fn contact_among(
        &self,
        near: &[NearPair],
        lane: usize,
        configuration: &Configuration,
        allowed: AllowedCollisions,
    ) -> Option<Contact> {
        let sure = near.iter().find(|near| near.sure >> lane & 1 == 1).map(|near| self.named_contact(near));
        sure.or_else(|| {
            let mut near = near.iter().filter(|near| near.still >> lane & 1 == 1);
            near.find_map(|near| self.contact_of(near, configuration, allowed))
        })
    }

    /// Contact of a near pair.
    pub(crate) fn named_contact(&self, near: &NearPair) -> Contact {
        let other = match other(&near.pair) {
            ContactTarget::Obstacle(at) => {
                ContactTarget::Obstacle(self.obstacles.get(at).map_or(at, |obstacle| obstacle.index))
            }
            other @ (ContactTarget::Part(_) | ContactTarget::Floor) => other,
        };
        self.context.named_contact(near.pair.part, other)
    }

    /// Checks a near pair in `f64`.
    fn contact_of(
        &self,
        near: &NearPair,
        configuration: &Configuration,
        allowed: AllowedCollisions,
    ) -> Option<Contact> {
        let solid = |part: usize| Some((self.part_at(part, configuration)?, self.limbs.get(part)?));
        let (one, limb) = solid(near.pair.part)?;
        let is_touched = match other(&near.pair) {
            ContactTarget::Obstacle(at) => {
                let obstacle = self.obstacles.get(at)?;
                let pad = limb.padding(obstacle.entity, obstacle.padding, allowed);
                is_nearer(&one, limb.reach, &obstacle.solid, obstacle.reach, pad)
            }
            ContactTarget::Part(at) => {
                let (other, beyond) = solid(at)?;
                is_nearer(&one, limb.reach, &other, beyond.reach, MIN_CLEARANCE)
            }
            ContactTarget::Floor => above_floor(&one) <= MIN_CLEARANCE,
        };
        is_touched.then(|| self.named_contact(near))
    }
}
