//! The search for a way of the hand to one of some poses: the poses in the order in which they are given, for each one
//! candidate for the base and the arm after the other.

use std::ops::ControlFlow;

use nalgebra::{Isometry3, Vector3};

use super::answer::{Answer, Budget, Infeasible, Reason, Unknown};
use super::around::Around;
use super::cells::Covered;
use super::grasp::Hold;
use super::grip::Grips;
use super::machine::Hand;
use super::palm::Palm;
use super::room::Room;
use super::screen::{Draft, Group, Screen, Seen};
use super::solver::Solver;
use super::state::State;
use super::touch::Allowed;
use super::travel::{Tally, Unfolding};
use crate::inverse::manifold::LANES;

/// So many poses have the candidates of a budget each; more share them. Where the base is not placed by the arm's own solver,
/// most candidates have no solution at all.
const SHARED: [usize; 2] = [8, 32];
/// How far the base comes from where it stands in the end while the hand reaches, in m.
pub(super) const LAST: f64 = 0.65;
/// After so many states without a simple way to any, a way is searched for to some of them.
const SIMPLE: usize = 6;
/// States to which a way is searched for at a time.
const SEARCHED: usize = 3;
/// After so many rounds without a free state it is asked whether a short proof tells that there is none, where a round takes long, and by how
/// many cells.
const LOOKED: usize = 8;
const SHORT: usize = 128;
/// Free states that a proof meets to which a simple way is looked for.
const MET: usize = 8;
/// States that are looked at at a time for what they touch.
const BATCH: usize = 8;

/// Where the hand is wanted.
pub(super) struct Sought<'a, 'r, 'w> {
    pub(super) hand: &'a Hand,
    /// Poses of its tip in the map, the likeliest first.
    pub(super) tips: Vec<Isometry3<f64>>,
    /// All ways in which the hand may hold something, of which the poses are some, where these are all that are considered: so it is
    /// proven that there is no way where the hand alone is free in none.
    pub(super) grips: Option<&'a Grips<'a>>,
    /// What may touch there and on the last line to it.
    pub(super) allowed: Allowed,
    pub(super) palm: Palm<'r, 'w>,
    pub(super) around: &'a Around<'r, 'w>,
    /// From a pose of the tip back to where the last straight line to it begins, in m in the map: the best first.
    pub(super) backs: &'a dyn Fn(&Isometry3<f64>) -> Vec<Vector3<f64>>,
}

/// Where the hand is in the end.
#[derive(Clone, Copy, Debug)]
pub(super) enum At {
    /// At a pose that was given, by its index.
    Tip(usize),
    /// Where a proof found room for it.
    Hold(Hold),
}

/// A state with the tip at a pose.
struct Candidate {
    at: At,
    tip: Isometry3<f64>,
    state: State,
}

/// Where the hand is, with the way to it; or the answer where there is none.
type Found = Result<(At, Vec<State>), Answer>;

/// What is known of the hand alone in a pose.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Alone {
    Unknown,
    Free,
    Blocked,
}

/// What was tried of a budget, and what was met.
struct Search<'a, 'r, 'w> {
    sought: &'a Sought<'a, 'r, 'w>,
    budget: Budget,
    /// The poses by their index; after the first round those in which the hand alone is free.
    tips: Vec<(usize, Isometry3<f64>, Alone)>,
    tried: usize,
    hands: Tally,
    poses: Tally,
    ways: Tally,
    /// Whether a candidate was passed over because no way leads near to where its base is.
    is_cut_off: bool,
    /// States to look at.
    batch: Vec<Candidate>,
    /// Free states to which no simple way leads.
    left: Vec<Candidate>,
    /// A free state.
    met: Option<State>,
}

impl<'a, 'r, 'w> Search<'a, 'r, 'w> {
    fn new(sought: &'a Sought<'a, 'r, 'w>, budget: Budget) -> Self {
        Self {
            sought,
            budget,
            tips: sought.tips.iter().enumerate().map(|(at, tip)| (at, *tip, Alone::Unknown)).collect(),
            tried: 0,
            hands: Tally::default(),
            poses: Tally::default(),
            ways: Tally::default(),
            is_cut_off: false,
            batch: Vec::with_capacity(BATCH),
            left: vec![],
            met: None,
        }
    }

    /// Whether the hand alone is free in a pose. Where that is not known it is found out for the next ones as well.
    fn is_free(&mut self, at: usize) -> bool {
        if self.tips.get(at).is_some_and(|(_, _, known)| *known == Alone::Unknown) {
            let next = self.tips.iter_mut().skip(at).filter(|(_, _, known)| *known == Alone::Unknown);
            let mut next: Vec<_> = next.take(BATCH).collect();
            let poses: Vec<Isometry3<f64>> = next.iter().map(|(_, tip, _)| *tip).collect();
            for ((_, _, known), touch) in next.iter_mut().zip(self.sought.palm.touches(&poses)) {
                *known = if touch.is_some() { Alone::Blocked } else { Alone::Free };
                touch.iter().for_each(|touch| self.hands.add(touch));
            }
        }
        self.tips.get(at).is_some_and(|(_, _, known)| *known == Alone::Free)
    }

    /// Leaves out the poses in which the hand alone is not free: so many rounds are left for the others.
    fn rounds(&mut self) -> usize {
        self.tips.retain(|(_, _, known)| *known == Alone::Free);
        let [few, many] = SHARED;
        let shared = if self.places_base() { few } else { many };
        let all = self.budget.candidates.saturating_mul(shared);
        self.budget.candidates.min(all.div_ceil(self.tips.len().max(1)))
    }

    fn places_base(&self) -> bool {
        matches!(self.sought.hand.solver, Solver::Lift(_))
    }

    /// Goes through all candidates, those of a round for all poses before the next; what ends the search.
    fn one_by_one(&mut self) -> ControlFlow<Found> {
        let (sought, room) = (self.sought, self.sought.around.room);
        let places_base = self.places_base();
        let (mut round, mut rounds) = (0, 1);
        while round < rounds {
            for index in 0..self.tips.len() {
                if !self.is_free(index) {
                    continue;
                }
                let Some((at, tip, _)) = self.tips.get(index).copied() else { continue };
                if !places_base && !room.is_near_drivable(room.base_at(sought.hand, &tip, round)) {
                    self.is_cut_off = true;
                    continue;
                }
                for state in room.candidates(sought.hand, &tip, round) {
                    if places_base && !room.is_near_drivable(state.base) {
                        self.is_cut_off = true;
                        continue;
                    }
                    self.batch.push(Candidate { at: At::Tip(at), tip, state });
                    if self.batch.len() == BATCH {
                        self.tries_batch()?;
                    }
                }
            }
            if round == 0 {
                rounds = self.rounds();
            }
            if round == LOOKED {
                self.tries_batch()?;
                self.covered(SHORT.min(self.budget.cells))?;
            }
            round += 1;
        }
        self.tries_batch()
    }

    /// The same candidates, eight at a time.
    fn by_eights(&mut self, screen: &Screen<'_, '_, '_>) -> ControlFlow<Found> {
        let mut drafts: Vec<Draft> = Vec::new();
        let mut groups: Vec<Group> = Vec::new();
        let mut tips: Vec<(usize, Isometry3<f64>)> = Vec::new();
        for index in 0..self.tips.len() {
            if self.is_free(index) {
                tips.extend(self.tips.get(index).map(|(at, tip, _)| (*at, *tip)));
            }
            if tips.len() == LANES || (index + 1 == self.tips.len() && !tips.is_empty()) {
                let group = screen.group(std::mem::take(&mut tips));
                screen.drafts(&group, 0, &mut drafts);
                self.screened(screen, &mut drafts, LANES)?;
                groups.push(group);
            }
        }
        for round in 1..self.rounds() {
            for group in &groups {
                screen.drafts(group, round, &mut drafts);
                self.screened(screen, &mut drafts, LANES)?;
            }
        }
        self.screened(screen, &mut drafts, 1)?;
        self.tries_batch()
    }

    /// Looks at drafts while there are at least so many: the free ones are tried at once, those that come near something when
    /// there are enough of them.
    fn screened(
        &mut self,
        screen: &Screen<'_, '_, '_>,
        drafts: &mut Vec<Draft>,
        least: usize,
    ) -> ControlFlow<Found> {
        while drafts.len() >= least {
            let rest = drafts.split_off(drafts.len().min(LANES));
            let seen = screen.seen(drafts);
            for (draft, _) in drafts.iter().zip(&seen).filter(|(_, seen)| matches!(seen, Seen::Free)) {
                if let Some(candidate) = self.solved(screen, draft, true) {
                    self.tries(vec![candidate])?;
                }
            }
            for (draft, seen) in drafts.iter().zip(&seen) {
                match seen {
                    Seen::Free => {}
                    Seen::Touches(touch) => self.poses.add(touch),
                    Seen::Open => {
                        let candidate = self.solved(screen, draft, false);
                        self.batch.extend(candidate);
                    }
                }
                if self.batch.len() == BATCH {
                    self.tries_batch()?;
                }
            }
            *drafts = rest;
        }
        ControlFlow::Continue(())
    }

    /// A draft to what `f64` can tell, where a way may lead to it.
    fn solved(&mut self, screen: &Screen<'_, '_, '_>, draft: &Draft, is_free: bool) -> Option<Candidate> {
        let state = screen.state(draft)?;
        if self.sought.around.room.is_near_drivable(state.base) {
            return Some(Candidate { at: At::Tip(draft.at), tip: draft.tip, state });
        }
        self.is_cut_off = true;
        if is_free {
            self.met.get_or_insert(state);
        }
        None
    }

    /// Tries what is left of the candidates that were to be tried together.
    fn tries_batch(&mut self) -> ControlFlow<Found> {
        let batch = std::mem::take(&mut self.batch);
        self.tries(batch)
    }

    /// Tries candidates one after the other; what ends the search.
    fn tries(&mut self, batch: Vec<Candidate>) -> ControlFlow<Found> {
        let states: Vec<&State> = batch.iter().map(|candidate| &candidate.state).collect();
        let touches = self.sought.around.touches(&states, self.sought.allowed);
        for (candidate, touch) in batch.into_iter().zip(touches) {
            if let Some(touch) = touch {
                self.poses.add(&touch);
                continue;
            }
            self.tried += 1;
            self.met.get_or_insert_with(|| candidate.state.clone());
            let Candidate { at, tip, state } = &candidate;
            if let Some(path) = self.sought.way_to(tip, state, Unfolding::Simple, &mut self.ways) {
                return ControlFlow::Break(Ok((*at, path)));
            }
            if self.left.len() < SEARCHED {
                self.left.push(candidate);
            }
            // Where nothing simple does for some, a search may.
            if self.tried == SIMPLE
                && let Some(found) = self.searched()
            {
                return ControlFlow::Break(Ok(found));
            }
            if self.tried >= self.budget.paths {
                return ControlFlow::Break(self.searched().ok_or(Answer::Unknown(Unknown::Budget)));
            }
        }
        ControlFlow::Continue(())
    }

    /// Proves with so many cells that no state is free, or tries those that are met on the way; nothing where one is known already.
    fn covered(&mut self, cells: usize) -> ControlFlow<Found> {
        let (sought, None) = (self.sought, &self.met) else { return ControlFlow::Continue(()) };
        let Some(grips) = sought.grips else { return ControlFlow::Continue(()) };
        let mut found = None;
        let covered = sought.around.covered(sought.hand, grips, sought.allowed, cells, |hold, state| {
            self.meets(hold, state, &mut found)
        });
        if covered == Covered::Nowhere {
            let by = self.poses.most().or(self.hands.most());
            let none = Infeasible::proven(Reason::NoFreePose { by }, None);
            return ControlFlow::Break(Err(Answer::Infeasible(none)));
        }
        found.map_or(ControlFlow::Continue(()), |found| ControlFlow::Break(Ok(found)))
    }

    /// Tries a free state that a proof met.
    fn meets(&mut self, hold: &Hold, state: State, found: &mut Option<(At, Vec<State>)>) -> ControlFlow<()> {
        self.met.get_or_insert_with(|| state.clone());
        self.tried += 1;
        if self.sought.around.room.is_near_drivable(state.base) {
            let candidate = Candidate { at: At::Hold(*hold), tip: hold.map_from_tip, state };
            let way = self.sought.way_to(&candidate.tip, &candidate.state, Unfolding::Simple, &mut self.ways);
            if let Some(path) = way {
                *found = Some((candidate.at, path));
                return ControlFlow::Break(());
            }
            if self.left.len() < SEARCHED {
                self.left.push(candidate);
            }
        } else {
            self.is_cut_off = true;
        }
        // All that were tried before touch something.
        if self.tried < MET { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }

    /// A way that a search finds to one of the states that are left.
    fn searched(&mut self) -> Option<(At, Vec<State>)> {
        self.left.drain(..).find_map(|Candidate { at, tip, state }| {
            Some((at, self.sought.way_to(&tip, &state, Unfolding::Searched, &mut self.ways)?))
        })
    }
}

impl Room<'_> {
    /// A way from where the robot is to one of the poses: which, and the states.
    ///
    /// # Errors
    ///
    /// The answer where none was found.
    pub(super) fn seek(&self, sought: &Sought<'_, '_, '_>, budget: Budget) -> Found {
        let mut search = Search::new(sought, budget);
        let screen = match &sought.hand.solver {
            Solver::Lift(arm) => Screen::new(sought.around, sought.hand, arm, sought.allowed),
            Solver::Parallel(_) | Solver::Seven(_) | Solver::Steps(_) => None,
        };
        let ended = match &screen {
            Some(screen) => search.by_eights(screen),
            None => search.one_by_one(),
        };
        if let ControlFlow::Break(found) = ended {
            return found;
        }
        if let Some(found) = search.searched() {
            return Ok(found);
        }
        if let ControlFlow::Break(found) = search.covered(budget.cells) {
            return found;
        }
        if let Some(found) = search.searched() {
            return Ok(found);
        }
        let state = search.met.take();
        let is_met = state.is_some() || search.is_cut_off;
        let reason = match is_met {
            true => Reason::BlockedPath { by: search.ways.most() },
            false => Reason::NoFreePose { by: search.poses.most().or(search.hands.most()) },
        };
        let state = state.map(Box::new);
        Err(Answer::Infeasible(Infeasible { state, ..Infeasible::exhausted(reason) }))
    }

    /// How far the base can be from the tip of a hand, in m.
    pub(super) fn farthest(&self, hand: &Hand) -> f64 {
        match &hand.solver {
            Solver::Lift(arm) => arm.reach(),
            Solver::Parallel(_) | Solver::Seven(_) | Solver::Steps(_) => {
                hand.card.reach_m + self.machine.card().base.radius_m
            }
        }
    }
}

impl Sought<'_, '_, '_> {
    /// A way from where the robot is to a free state with the tip at a pose.
    fn way_to(
        &self,
        tip: &Isometry3<f64>,
        state: &State,
        unfolding: Unfolding,
        met: &mut Tally,
    ) -> Option<Vec<State>> {
        (self.backs)(tip).into_iter().find_map(|back| {
            let line = self.around.room.line(self.hand, state, tip, &back)?;
            let inwards = line.first()?.inwards(&tip.translation.vector);
            let inner: Vec<&State> = line.get(1..line.len() - 1)?.iter().collect();
            if let Some(touch) = self.around.first_touch(&inner, self.allowed) {
                met.add(&touch);
                return None;
            }
            self.around.route_to(&line, inwards, self.allowed, unfolding, met)
        })
    }
}
