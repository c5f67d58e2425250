//! States and ways looked at eight at a time before they are looked at one by one: what is apart for certain in `f32` is left
//! out, so that only what is near is looked at in `f64`.

use std::cell::OnceCell;

use super::around::{Around, touches};
use super::room::{GAP, Room};
use super::state::State;
use super::touch::{Allowed, Other, Touch};
use crate::lanes::{Against, Eight, Figure, Look, Met, Pair, Slab};

/// What the quick look needs of a neighbourhood, made when it is first asked for.
#[derive(Default)]
pub(super) struct Quick(OnceCell<Option<Vec<Slab>>>);

/// A part and another solid that are near each other in one of eight states.
#[derive(Clone, Copy)]
pub(super) struct Near {
    pub(super) part: usize,
    pub(super) other: Other,
    pair: Pair,
    pub(super) lanes: u8,
    pub(super) still: u8,
    /// Of these the states in which it touches for certain.
    pub(super) sure: u8,
}

/// What counts as near.
#[derive(Clone, Copy)]
struct Gap {
    metres: f64,
    /// Whether the parts of the robot count among each other.
    is_own: bool,
}

impl Gap {
    const LEAST: Self = Self { metres: GAP, is_own: true };
}

/// Eight pieces of a way, one after the other: the middle of all, and half of the length of all, as shares of the way.
#[derive(Clone, Copy)]
pub(super) struct Pieces {
    pub(super) middle: f64,
    pub(super) half: f64,
}

impl Pieces {
    /// Those of a whole way.
    pub(super) const WHOLE: Self = Self { middle: 0.5, half: 0.5 };

    /// The middle of a piece, and half of its length.
    pub(super) fn piece(self, lane: usize) -> (f64, f64) {
        let half = self.half / 8.0;
        (self.middle - self.half + half * (2 * lane + 1) as f64, half)
    }
}

impl Room<'_> {
    /// The robot with the joints that a hand, its arm and the postures move; `None` where it is not simple enough.
    pub(super) fn figure(&self) -> Option<&Figure> {
        let make = || {
            // Pairs that never move against each other are as apart as at the start.
            if self.at_start().is_some() {
                return None;
            }
            let machine = self.machine;
            let hand = machine.hand()?;
            let variables = machine.tree().variables().iter().zip(0..);
            let named: Vec<usize> = variables
                .filter(|(variable, _)| {
                    machine.card().postures.values().any(|it| it.contains_key(&variable.name))
                })
                .map(|(_, at)| at)
                .collect();
            let chain = &hand.solver.chain().in_tree;
            let is_free = |at: usize| {
                chain.contains(&at) || named.contains(&at) || hand.open.iter().any(|(open, _)| *open == at)
            };
            let rig = machine.tree().rig(&self.world.robot.joints, is_free)?;
            let free = (0..machine.tree().variables().len()).map(is_free).collect();
            Some((Figure::new(&rig, &machine.map_from_root([0.0; 3]), &self.body)?, free))
        };
        let (figure, _) = self.figure.get_or_init(make).as_ref()?;
        Some(figure)
    }

    /// Whether all but the joints of the figure are as at the start, and the robot itself is free there.
    fn is_drawn(&self, state: &State) -> bool {
        let Some(Some((_, free))) = self.figure.get() else { return false };
        let values = state.joints.iter().zip(&self.world.robot.joints).zip(free);
        values.into_iter().all(|((one, start), is_free)| *is_free || one == start)
    }
}

impl Around<'_, '_> {
    fn slabs(&self) -> Option<&[Slab]> {
        let make = || {
            let slabs = self.things.iter().map(|near| Slab::new(near.entity, &near.solid, self.place()));
            slabs.collect()
        };
        self.quick.0.get_or_init(make).as_deref()
    }

    /// The pairs that are near each other in some states, at most eight: `None` where it cannot be told this way.
    pub(super) fn near_in(&self, states: &[&State], allowed: Allowed) -> Option<Vec<Near>> {
        let figure = self.room.figure()?;
        let first = states.first()?;
        let mut eight = figure.eight();
        for lane in 0..8 {
            let state = states.get(lane).unwrap_or(first);
            if !self.set(figure, &mut eight, lane, state) {
                return None;
            }
        }
        self.near(figure, &eight, allowed, None, Gap::LEAST)
    }

    /// The pairs that are near each other on eight pieces of a way; of these only, where some are given.
    pub(super) fn near_on(
        &self,
        [from, to]: [&State; 2],
        pieces: Pieces,
        allowed: Allowed,
        pairs: Option<&[Near]>,
    ) -> Option<Vec<Near>> {
        let figure = self.room.figure()?;
        let mut eight = figure.eight();
        let mut state = from.clone();
        let mut half = 0.0;
        for lane in 0..8 {
            let (middle, own) = pieces.piece(lane);
            half = own;
            state.set_towards(from, to, middle);
            if !self.set(figure, &mut eight, lane, &state) {
                return None;
            }
        }
        let change = |one: f64, other: f64| (other - one) * half;
        let [x, y, yaw] = from.base;
        let [to_x, to_y, to_yaw] = to.base;
        let base = [change(x, to_x), change(y, to_y), change(yaw, to_yaw)];
        figure.spread(&mut eight, base, |at| {
            from.joints.get(at).zip(to.joints.get(at)).map_or(0.0, |(one, other)| change(*one, *other))
        });
        self.near(figure, &eight, allowed, pairs, Gap::LEAST)
    }

    /// Whether anything that stands around, or the floor, may be within `metres` of the robot in each of some states of at most eight.
    pub(super) fn within(&self, states: &[State], allowed: Allowed, metres: f64) -> Vec<bool> {
        let near = || {
            let figure = self.room.figure()?;
            let first = states.first()?;
            let mut eight = figure.eight();
            for lane in 0..8 {
                let state = states.get(lane).unwrap_or(first);
                if !self.holds(state) || !self.set(figure, &mut eight, lane, state) {
                    return None;
                }
            }
            let gap = Gap { metres, is_own: false };
            let near = self.near(figure, &eight, allowed, None, gap)?;
            Some(near.iter().fold(0, |lanes, near| lanes | near.still))
        };
        let lanes = near().unwrap_or(u8::MAX);
        (0..states.len()).map(|lane| lanes >> lane & 1 == 1).collect()
    }

    fn set(&self, figure: &Figure, eight: &mut Eight, lane: usize, state: &State) -> bool {
        let ([x, y, yaw], [a, b]) = (state.base, self.place());
        self.room.is_drawn(state) && figure.set(eight, lane, [x - a, y - b, yaw], &state.joints)
    }

    /// The pairs that are near each other in eight states.
    pub(super) fn near_to(&self, figure: &Figure, eight: &Eight, allowed: Allowed) -> Option<Vec<Near>> {
        self.near(figure, eight, allowed, None, Gap::LEAST)
    }

    fn near(
        &self,
        figure: &Figure,
        eight: &Eight,
        allowed: Allowed,
        pairs: Option<&[Near]>,
        gap: Gap,
    ) -> Option<Vec<Near>> {
        let slabs = self.slabs()?;
        let pairs: Option<Vec<Pair>> = pairs.map(|pairs| pairs.iter().map(|near| near.pair).collect());
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
            gap: gap.metres as f32,
            is_own: gap.is_own,
            is_first: true,
            pairs: pairs.as_deref(),
            counts,
        };
        Some(look.met().into_iter().map(Near::new).collect())
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
    pub(super) fn touch_among(&self, near: &[Near], lane: usize, state: &State) -> Option<Touch> {
        let sure = near.iter().find(|near| near.sure >> lane & 1 == 1).map(|near| self.told(near));
        sure.or_else(|| {
            let mut near = near.iter().filter(|near| near.still >> lane & 1 == 1);
            near.find_map(|near| self.touch_of(near, state))
        })
    }

    /// The touch of a pair that touches.
    pub(super) fn told(&self, near: &Near) -> Touch {
        let other = match near.other {
            Other::Thing(at) => Other::Thing(self.things.get(at).map_or(at, |thing| thing.index)),
            Other::Part(_) | Other::Floor => near.other,
        };
        self.room.told(near.part, other)
    }

    /// Whether a pair touches in a state.
    pub(super) fn touch_of(&self, near: &Near, state: &State) -> Option<Touch> {
        let machine = self.room.machine;
        let solid = |part: usize| {
            let own = self.room.body.parts().get(part)?;
            let pose =
                machine.map_from_root(state.base) * machine.tree().root_from_link(&state.joints, own.link);
            Some((own.solid.moved(&pose), self.limbs.get(part)?))
        };
        let (one, limb) = solid(near.part)?;
        let is_touched = match near.other {
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

impl Near {
    fn new(Met { pair, lanes, still, sure }: Met) -> Self {
        let other = match pair.against {
            Against::Slab(at) => Other::Thing(at),
            Against::Part(at, _) => Other::Part(at),
            Against::Floor => Other::Floor,
        };
        Self { part: pair.part, other, pair, lanes, still, sure }
    }
}
