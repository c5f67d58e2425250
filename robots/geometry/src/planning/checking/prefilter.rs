//! States and ways looked at eight at a time before they are looked at one by one: what is apart for certain in `f32` is left
//! out, so that only what is near is looked at in `f64`.

use std::cell::{OnceCell, RefCell};

use crate::lanes::{Against, Eight, Figure, Look, Met, Pair, Posed, Slab, Slabs};
use crate::planning::checking::collision_checker::{CollisionChecker, is_touching};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::MIN_CLEARANCE;
use crate::planning::scene::contact::{AllowedCollisions, Contact, ContactTarget};
use crate::planning::search::context::QueryContext;

/// What the quick look needs of a neighbourhood, made when it is first asked for.
#[derive(Default)]
pub(crate) struct PrefilterCache {
    slabs: OnceCell<Option<Slabs>>,
    /// Where the robot was placed last: nothing but room for the next time.
    posed: RefCell<Posed>,
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
    pub(crate) fn figure(&self) -> Option<&Figure> {
        let make = || {
            // Pairs that never move against each other are as apart as at the start.
            if self.start_contact().is_some() {
                return None;
            }
            let model = self.model;
            let hand = model.hand()?;
            let variables = model.tree().variables().iter().zip(0..);
            let named: Vec<usize> = variables
                .filter(|(variable, _)| {
                    model.card().postures.values().any(|it| it.contains_key(&variable.name))
                })
                .map(|(_, at)| at)
                .collect();
            let chain = &hand.solver.chain().in_tree;
            let is_free = |at: usize| {
                chain.contains(&at) || named.contains(&at) || hand.open.iter().any(|(open, _)| *open == at)
            };
            let rig = model.tree().rig(&self.state.robot.joints, is_free)?;
            let free = (0..model.tree().variables().len()).map(is_free).collect();
            Some((Figure::new(&rig, &model.map_from_root([0.0; 3]), &self.body)?, free))
        };
        let (figure, _) = self.figure.get_or_init(make).as_ref()?;
        Some(figure)
    }

    /// Whether all but the joints of the figure are as at the start, and the robot itself is free there.
    fn is_drawn(&self, configuration: &Configuration) -> bool {
        let Some(Some((_, free))) = self.figure.get() else { return false };
        let values = configuration.joints.iter().zip(&self.state.robot.joints).zip(free);
        values.into_iter().all(|((one, start), is_free)| *is_free || one == start)
    }
}

impl CollisionChecker<'_, '_> {
    fn slabs(&self) -> Option<&Slabs> {
        let make = || {
            let slabs = self.obstacles.iter().map(|near| Slab::new(near.entity, &near.solid, self.place()));
            slabs.collect()
        };
        self.quick.slabs.get_or_init(make).as_ref()
    }

    /// The pairs that are near each other in some states, at most eight: `None` where it cannot be told this way.
    pub(crate) fn near_in(
        &self,
        configurations: &[&Configuration],
        allowed: AllowedCollisions,
    ) -> Option<Vec<Met>> {
        let figure = self.context.figure()?;
        self.near(figure, &self.eight(figure, configurations)?, allowed, None, NearRange::LEAST)
    }

    /// The pairs that are near each other on eight legs of a way; where some are given, of these only, each on those legs of which its
    /// bit is set in `lanes`.
    pub(crate) fn near_on(
        &self,
        way: [&Configuration; 2],
        legs: &SegmentCentres,
        allowed: AllowedCollisions,
        pairs: Option<&[(Pair, u8)]>,
    ) -> Option<Vec<Met>> {
        let figure = self.context.figure()?;
        if !way.iter().all(|configuration| self.context.is_drawn(configuration)) {
            return None;
        }
        let mut eight = figure.eight();
        let ends = way.map(|configuration| (self.seen(configuration.base), configuration.joints.as_slice()));
        let is_within = figure.set_on(&mut eight, ends, &legs.middles, legs.half);
        if is_within { self.near(figure, &eight, allowed, pairs, NearRange::LEAST) } else { None }
    }

    /// What stands around, or the floor, that may be within so many metres of the robot in each of some states, at most eight; `None`
    /// where it cannot be told this way.
    pub(crate) fn within(
        &self,
        configurations: &[&Configuration],
        allowed: AllowedCollisions,
        metres: [f32; 8],
    ) -> Option<Vec<Met>> {
        let figure = self.context.figure()?;
        if !configurations.iter().all(|configuration| self.holds(configuration)) {
            return None;
        }
        self.near(
            figure,
            &self.eight(figure, configurations)?,
            allowed,
            None,
            NearRange { metres, is_own: false },
        )
    }

    /// Some states, at most eight, the first again for what is left.
    fn eight(&self, figure: &Figure, configurations: &[&Configuration]) -> Option<Eight> {
        let first = configurations.first()?;
        let mut eight = figure.eight();
        let set = |lane: usize| {
            let configuration = configurations.get(lane).unwrap_or(first);
            self.context.is_drawn(configuration)
                && figure.set(&mut eight, lane, self.seen(configuration.base), &configuration.joints)
        };
        (0..8).all(set).then_some(eight)
    }

    /// A pose of the base from the origin of the neighbourhood.
    fn seen(&self, [x, y, yaw]: [f64; 3]) -> [f64; 3] {
        let [a, b] = self.place();
        [x - a, y - b, yaw]
    }

    /// The pairs that are near each other in eight states.
    pub(crate) fn near_to(
        &self,
        figure: &Figure,
        eight: &Eight,
        allowed: AllowedCollisions,
    ) -> Option<Vec<Met>> {
        self.near(figure, eight, allowed, None, NearRange::LEAST)
    }

    fn near(
        &self,
        figure: &Figure,
        eight: &Eight,
        allowed: AllowedCollisions,
        pairs: Option<&[(Pair, u8)]>,
        gap: NearRange,
    ) -> Option<Vec<Met>> {
        let slabs = self.slabs()?;
        let mut posed = self.quick.posed.borrow_mut();
        let counts = |part: usize, entity: Option<usize>| {
            self.limbs.get(part).is_some_and(|limb| match entity {
                Some(entity) => limb.counts && !limb.may_touch(entity, allowed),
                None => limb.counts && limb.is_carried,
            })
        };
        let look = Look {
            figure,
            eight,
            slabs,
            gaps: gap.metres,
            is_own: gap.is_own,
            // Where a clearance is looked for, all that is near counts.
            is_first: gap.is_own,
            pairs,
            posed: &mut posed,
            counts,
        };
        Some(look.met())
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
        near: &[Met],
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
    pub(crate) fn told(&self, near: &Met) -> Contact {
        let other = match other(&near.pair) {
            ContactTarget::Obstacle(at) => {
                ContactTarget::Obstacle(self.obstacles.get(at).map_or(at, |obstacle| obstacle.index))
            }
            other @ (ContactTarget::Part(_) | ContactTarget::Floor) => other,
        };
        self.context.told(near.pair.part, other)
    }

    /// Whether a pair touches in a state.
    pub(crate) fn contact_of(&self, near: &Met, configuration: &Configuration) -> Option<Contact> {
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
pub(crate) fn other(pair: &Pair) -> ContactTarget {
    match pair.against {
        Against::Slab(at) => ContactTarget::Obstacle(at),
        Against::Part(at, _) => ContactTarget::Part(at),
        Against::Floor => ContactTarget::Floor,
    }
}
