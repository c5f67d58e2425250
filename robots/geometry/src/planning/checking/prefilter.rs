//! States and ways looked at eight at a time before they are looked at one by one: what is apart for certain in `f32` is left
//! out, so that only what is near is looked at in `f64`.

use std::cell::{OnceCell, RefCell};

use crate::planning::checking::collision_checker::{CollisionChecker, is_touching};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::MIN_CLEARANCE;
use crate::planning::scene::contact::{AllowedCollisions, Contact, ContactTarget};
use crate::planning::search::context::QueryContext;
use crate::simd::{Batch8, BatchCheck, BatchModel, BatchPair, NearPair, Obb, ObbSet, PairTarget, PosedBatch};

/// What the quick look needs of a neighbourhood, made when it is first asked for.
#[derive(Default)]
pub(crate) struct PrefilterCache {
    obbs: OnceCell<Option<ObbSet>>,
    /// Where the robot was placed last: nothing but room for the next time.
    posed: RefCell<PosedBatch>,
}

/// What counts as near.
#[derive(Clone, Copy)]
struct NearRange {
    /// In each of eight states, in m.
    metres: [f32; 8],
    /// Whether the parts of the robot count among each other.
    is_own: bool,
}

impl NearRange {
    const LEAST: Self = Self { metres: [MIN_CLEARANCE as f32; 8], is_own: true };
}

/// Eight legs of a way, all of a length, as shares of it.
#[derive(Clone, Copy)]
pub(crate) struct SegmentCentres {
    pub(crate) middles: [f64; 8],
    /// Half of the length of each.
    pub(crate) half: f64,
}

impl SegmentCentres {
    /// Those of a whole way, one after the other.
    pub(crate) const WHOLE: Self =
        Self { middles: [0.0625, 0.1875, 0.3125, 0.4375, 0.5625, 0.6875, 0.8125, 0.9375], half: 0.0625 };
}

impl QueryContext<'_> {
    /// The robot with the joints that a hand, its arm and the postures move; `None` where it is not simple enough.
    pub(crate) fn batch_model(&self) -> Option<&BatchModel> {
        let make = || {
            // Pairs that never move against each other are as apart as at the start.
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

    /// Whether all but the joints of the figure are as at the start, and the robot itself is free there.
    fn is_drawn(&self, configuration: &Configuration) -> bool {
        let Some(Some((_, free))) = self.batch_model.get() else { return false };
        let values = configuration.joints.iter().zip(&self.state.robot.joints).zip(free);
        values.into_iter().all(|((one, start), is_free)| *is_free || one == start)
    }
}

impl CollisionChecker<'_, '_> {
    fn obbs(&self) -> Option<&ObbSet> {
        let make = || {
            let obbs = self.obstacles.iter().map(|near| Obb::new(near.entity, &near.solid, self.place()));
            obbs.collect()
        };
        self.quick.obbs.get_or_init(make).as_ref()
    }

    /// The pairs that are near each other in some states, at most eight: `None` where it cannot be told this way.
    pub(crate) fn near_in(
        &self,
        configurations: &[&Configuration],
        allowed: AllowedCollisions,
    ) -> Option<Vec<NearPair>> {
        let batch_model = self.context.batch_model()?;
        self.near(batch_model, &self.batch(batch_model, configurations)?, allowed, None, NearRange::LEAST)
    }

    /// The pairs that are near each other on eight legs of a way; where some are given, of these only, each on those legs of which its
    /// bit is set in `lanes`.
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

    /// What stands around, or the floor, that may be within so many metres of the robot in each of some states, at most eight; `None`
    /// where it cannot be told this way.
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

    /// Some states, at most eight, the first again for what is left.
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

    /// A pose of the base from the origin of the neighbourhood.
    fn seen(&self, [x, y, yaw]: [f64; 3]) -> [f64; 3] {
        let [a, b] = self.place();
        [x - a, y - b, yaw]
    }

    /// The pairs that are near each other in eight states.
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
        let mut posed = self.quick.posed.borrow_mut();
        let counts = |part: usize, entity: Option<usize>| {
            self.limbs.get(part).is_some_and(|limb| match entity {
                Some(entity) => limb.counts && !limb.may_touch(entity, allowed),
                None => limb.counts && limb.is_carried,
            })
        };
        let look = BatchCheck {
            batch_model,
            batch,
            obbs,
            gaps: gap.metres,
            is_own: gap.is_own,
            // Where a clearance is looked for, all that is near counts.
            is_first: gap.is_own,
            pairs,
            posed: &mut posed,
            counts,
        };
        Some(look.near_pairs())
    }

    /// The first touch in the first of some states that touches anything, with [`MIN_CLEARANCE`] between everything.
    pub(crate) fn first_contact(
        &self,
        configurations: &[&Configuration],
        allowed: AllowedCollisions,
    ) -> Option<Contact> {
        configurations
            .chunks(8)
            .find_map(|configurations| self.contacts(configurations, allowed).into_iter().flatten().next())
    }

    /// The first touch in each of at most eight states.
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
            .map(|(configuration, lane)| self.contact_among(&near, lane, configuration))
            .collect()
    }

    /// Which of some pairs touches in a state, which is one of those looked at: what is certain first, which costs nothing more.
    pub(crate) fn contact_among(
        &self,
        near: &[NearPair],
        lane: usize,
        configuration: &Configuration,
    ) -> Option<Contact> {
        let sure = near.iter().find(|near| near.sure >> lane & 1 == 1).map(|near| self.told(near));
        sure.or_else(|| {
            let mut near = near.iter().filter(|near| near.still >> lane & 1 == 1);
            near.find_map(|near| self.contact_of(near, configuration))
        })
    }

    /// The touch of a pair that touches.
    pub(crate) fn told(&self, near: &NearPair) -> Contact {
        let other = match other(&near.pair) {
            ContactTarget::Obstacle(at) => {
                ContactTarget::Obstacle(self.obstacles.get(at).map_or(at, |obstacle| obstacle.index))
            }
            other @ (ContactTarget::Part(_) | ContactTarget::Floor) => other,
        };
        self.context.told(near.pair.part, other)
    }

    /// Whether a pair touches in a state.
    pub(crate) fn contact_of(&self, near: &NearPair, configuration: &Configuration) -> Option<Contact> {
        let solid = |part: usize| Some((self.part_at(part, configuration)?, self.limbs.get(part)?));
        let (one, limb) = solid(near.pair.part)?;
        let is_touched = match other(&near.pair) {
            ContactTarget::Obstacle(at) => {
                let obstacle = self.obstacles.get(at)?;
                is_touching(&one, limb.reach, &obstacle.solid, obstacle.reach)
            }
            ContactTarget::Part(at) => {
                let (other, beyond) = solid(at)?;
                is_touching(&one, limb.reach, &other, beyond.reach)
            }
            ContactTarget::Floor => {
                crate::planning::checking::collision_checker::above_floor(&one) <= MIN_CLEARANCE
            }
        };
        is_touched.then(|| self.told(near))
    }
}

/// What a part is near to.
pub(crate) fn other(pair: &BatchPair) -> ContactTarget {
    match pair.target {
        PairTarget::Obb(at) => ContactTarget::Obstacle(at),
        PairTarget::Part(at, _) => ContactTarget::Part(at),
        PairTarget::Floor => ContactTarget::Floor,
    }
}
