//! States and ways looked at eight at a time before they are looked at one by one: what is apart for certain in `f32` is left
//! out, so that only what is near is looked at in `f64`.

use std::cell::{OnceCell, RefCell};

use super::around::{Around, touches};
use super::room::{GAP, Room};
use super::state::State;
use super::touch::{Allowed, Other, Touch};
use crate::simd::{Batch8, BatchCheck, BatchModel, NearPair, Obb, ObbSet, PairTarget, PosedBatch, SolidPair};

/// What the quick look needs of a neighbourhood, made when it is first asked for.
#[derive(Default)]
pub(super) struct Quick {
    obbs: OnceCell<Option<ObbSet>>,
    /// Where the robot was placed last: nothing but room for the next time.
    posed: RefCell<PosedBatch>,
}

/// What counts as near.
#[derive(Clone, Copy)]
struct Gap {
    /// In each of eight states, in m.
    metres: [f32; 8],
    /// Whether the parts of the robot count among each other.
    is_own: bool,
}

impl Gap {
    const LEAST: Self = Self { metres: [GAP as f32; 8], is_own: true };
}

/// Eight legs of a way, all of a length, as shares of it.
#[derive(Clone, Copy)]
pub(super) struct Legs {
    pub(super) middles: [f64; 8],
    /// Half of the length of each.
    pub(super) half: f64,
}

impl Legs {
    /// Those of a whole way, one after the other.
    pub(super) const WHOLE: Self =
        Self { middles: [0.0625, 0.1875, 0.3125, 0.4375, 0.5625, 0.6875, 0.8125, 0.9375], half: 0.0625 };
}

impl Room<'_> {
    /// The robot with the joints that a hand, its arm and the postures move; `None` where it is not simple enough.
    pub(super) fn batch_model(&self) -> Option<&BatchModel> {
        let make = || {
            // Pairs that never move against each other are as apart as at the start.
            if self.at_start().is_some() {
                return None;
            }
            let machine = self.machine;
            let hand = machine.hand()?;
            let dofs = machine.tree().dofs().iter().zip(0..);
            let named: Vec<usize> = dofs
                .filter(|(dof, _)| machine.card().postures.values().any(|it| it.contains_key(&dof.name)))
                .map(|(_, at)| at)
                .collect();
            let chain = &hand.solver.chain().in_tree;
            let is_free = |at: usize| {
                chain.contains(&at) || named.contains(&at) || hand.open.iter().any(|(open, _)| *open == at)
            };
            let reduced = machine.tree().reduced(&self.world.robot.joints, is_free)?;
            let free = (0..machine.tree().dofs().len()).map(is_free).collect();
            Some((BatchModel::new(&reduced, &machine.map_from_root([0.0; 3]), &self.body)?, free))
        };
        let (batch_model, _) = self.batch_model.get_or_init(make).as_ref()?;
        Some(batch_model)
    }

    /// Whether all but the joints of the figure are as at the start, and the robot itself is free there.
    fn is_drawn(&self, state: &State) -> bool {
        let Some(Some((_, free))) = self.batch_model.get() else { return false };
        let values = state.joints.iter().zip(&self.world.robot.joints).zip(free);
        values.into_iter().all(|((one, start), is_free)| *is_free || one == start)
    }
}

impl Around<'_, '_> {
    fn obbs(&self) -> Option<&ObbSet> {
        let make = || {
            let obbs = self.things.iter().map(|near| Obb::new(near.entity, &near.solid, self.place()));
            obbs.collect()
        };
        self.quick.obbs.get_or_init(make).as_ref()
    }

    /// The pairs that are near each other in some states, at most eight: `None` where it cannot be told this way.
    pub(super) fn near_in(&self, states: &[&State], allowed: Allowed) -> Option<Vec<NearPair>> {
        let batch_model = self.room.batch_model()?;
        self.near(batch_model, &self.batch(batch_model, states)?, allowed, None, Gap::LEAST)
    }

    /// The pairs that are near each other on eight legs of a way; where some are given, of these only, each on those legs of which its
    /// bit is set in `lanes`.
    pub(super) fn near_on(
        &self,
        way: [&State; 2],
        legs: &Legs,
        allowed: Allowed,
        pairs: Option<&[(SolidPair, u8)]>,
    ) -> Option<Vec<NearPair>> {
        let batch_model = self.room.batch_model()?;
        if !way.iter().all(|state| self.room.is_drawn(state)) {
            return None;
        }
        let mut batch = batch_model.batch();
        let ends = way.map(|state| (self.seen(state.base), state.joints.as_slice()));
        let is_within = batch_model.set_on(&mut batch, ends, &legs.middles, legs.half);
        if is_within { self.near(batch_model, &batch, allowed, pairs, Gap::LEAST) } else { None }
    }

    /// What stands around, or the floor, that may be within so many metres of the robot in each of some states, at most eight; `None`
    /// where it cannot be told this way.
    pub(super) fn within(
        &self,
        states: &[&State],
        allowed: Allowed,
        metres: [f32; 8],
    ) -> Option<Vec<NearPair>> {
        let batch_model = self.room.batch_model()?;
        if !states.iter().all(|state| self.holds(state)) {
            return None;
        }
        self.near(
            batch_model,
            &self.batch(batch_model, states)?,
            allowed,
            None,
            Gap { metres, is_own: false },
        )
    }

    /// Some states, at most eight, the first again for what is left.
    fn batch(&self, batch_model: &BatchModel, states: &[&State]) -> Option<Batch8> {
        let first = states.first()?;
        let mut batch = batch_model.batch();
        let set = |lane: usize| {
            let state = states.get(lane).unwrap_or(first);
            self.room.is_drawn(state)
                && batch_model.set(&mut batch, lane, self.seen(state.base), &state.joints)
        };
        (0..8).all(set).then_some(batch)
    }

    /// A pose of the base from the origin of the neighbourhood.
    fn seen(&self, [x, y, yaw]: [f64; 3]) -> [f64; 3] {
        let [a, b] = self.place();
        [x - a, y - b, yaw]
    }

    /// The pairs that are near each other in eight states.
    pub(super) fn near_to(
        &self,
        batch_model: &BatchModel,
        batch: &Batch8,
        allowed: Allowed,
    ) -> Option<Vec<NearPair>> {
        self.near(batch_model, batch, allowed, None, Gap::LEAST)
    }

    fn near(
        &self,
        batch_model: &BatchModel,
        batch: &Batch8,
        allowed: Allowed,
        pairs: Option<&[(SolidPair, u8)]>,
        gap: Gap,
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

    /// The first touch in the first of some states that touches anything, with [`GAP`] between everything.
    pub(super) fn first_touch(&self, states: &[&State], allowed: Allowed) -> Option<Touch> {
        states.chunks(8).find_map(|states| self.touches(states, allowed).into_iter().flatten().next())
    }

    /// The first touch in each of at most eight states.
    pub(super) fn touches(&self, states: &[&State], allowed: Allowed) -> Vec<Option<Touch>> {
        let is_here = states.iter().all(|state| self.holds(state));
        let Some(near) = is_here.then(|| self.near_in(states, allowed)).flatten() else {
            return states.iter().map(|state| self.touch_exactly(state, allowed)).collect();
        };
        states.iter().zip(0..).map(|(state, lane)| self.touch_among(&near, lane, state)).collect()
    }

    /// Which of some pairs touches in a state, which is one of those looked at: what is certain first, which costs nothing more.
    pub(super) fn touch_among(&self, near: &[NearPair], lane: usize, state: &State) -> Option<Touch> {
        let sure = near.iter().find(|near| near.sure >> lane & 1 == 1).map(|near| self.told(near));
        sure.or_else(|| {
            let mut near = near.iter().filter(|near| near.still >> lane & 1 == 1);
            near.find_map(|near| self.touch_of(near, state))
        })
    }

    /// The touch of a pair that touches.
    pub(super) fn told(&self, near: &NearPair) -> Touch {
        let other = match other(&near.pair) {
            Other::Thing(at) => Other::Thing(self.things.get(at).map_or(at, |thing| thing.index)),
            other @ (Other::Part(_) | Other::Floor) => other,
        };
        self.room.told(near.pair.part, other)
    }

    /// Whether a pair touches in a state.
    pub(super) fn touch_of(&self, near: &NearPair, state: &State) -> Option<Touch> {
        let solid = |part: usize| Some((self.part_at(part, state)?, self.limbs.get(part)?));
        let (one, limb) = solid(near.pair.part)?;
        let is_touched = match other(&near.pair) {
            Other::Thing(at) => {
                let thing = self.things.get(at)?;
                touches(&one, limb.reach, &thing.solid, thing.reach)
            }
            Other::Part(at) => {
                let (other, beyond) = solid(at)?;
                touches(&one, limb.reach, &other, beyond.reach)
            }
            Other::Floor => super::around::above_floor(&one) <= GAP,
        };
        is_touched.then(|| self.told(near))
    }
}

/// What a part is near to.
pub(super) fn other(pair: &SolidPair) -> Other {
    match pair.target {
        PairTarget::Obb(at) => Other::Thing(at),
        PairTarget::Part(at, _) => Other::Part(at),
        PairTarget::Floor => Other::Floor,
    }
}
