//! The search for a way of the hand to one of some poses: the poses in the order in which they are given, for each one
//! candidate for the base and the arm after the other.

use std::ops::ControlFlow;

use nalgebra::{Isometry3, Vector3};

use super::answer::{Answer, Budget, Infeasible, Reason, Unknown};
use super::around::Around;
use super::machine::{Hand, Solver};
use super::palm::Palm;
use super::room::Room;
use super::state::State;
use super::touch::Allowed;
use super::travel::{Tally, Unfolding, exhausted};

/// So many poses have the candidates of a budget each; more share them. Where the base is not placed by the arm's own solver,
/// most candidates have no solution at all.
const SHARED: [usize; 2] = [8, 32];
/// How far the base comes from where it stands in the end while the hand reaches, in m.
pub(super) const LAST: f64 = 0.65;
/// After so many states without a simple way to any, a way is searched for to some of them.
const SIMPLE: usize = 6;
/// States to which a way is searched for at a time.
const SEARCHED: usize = 3;
/// States that are looked at at a time for what they touch.
const BATCH: usize = 8;

/// Where the hand is wanted.
pub(super) struct Sought<'a, 'r, 'w> {
    pub(super) hand: &'a Hand,
    /// Poses of its tip in the map, the likeliest first.
    pub(super) tips: Vec<Isometry3<f64>>,
    /// Whether there are no others, so that it is proven that there is no way where the hand alone is free in none.
    pub(super) is_all: bool,
    /// What may touch there and on the last line to it.
    pub(super) allowed: Allowed,
    pub(super) palm: Palm<'r, 'w>,
    pub(super) around: &'a Around<'r, 'w>,
    /// From a pose of the tip back to where the last straight line to it begins, in m in the map: the best first.
    pub(super) backs: &'a dyn Fn(&Isometry3<f64>) -> Vec<Vector3<f64>>,
}

/// A state with the tip at a pose.
struct Candidate {
    /// Index of the pose.
    at: usize,
    tip: Isometry3<f64>,
    state: State,
}

/// What was tried of a budget, and what was met.
struct Search<'a, 'r, 'w> {
    sought: &'a Sought<'a, 'r, 'w>,
    budget: Budget,
    tried: usize,
    poses: &'a mut Tally,
    ways: &'a mut Tally,
    /// Free states to which no simple way leads.
    left: Vec<Candidate>,
}

/// A pose by its index, with the way to it; or the answer where there is none.
type Found = Result<(usize, Vec<State>), Answer>;

impl Search<'_, '_, '_> {
    /// Tries candidates one after the other; what ends the search.
    fn tries(&mut self, batch: &mut Vec<Candidate>) -> ControlFlow<Found> {
        let states: Vec<&State> = batch.iter().map(|candidate| &candidate.state).collect();
        let touches = self.sought.around.touches(&states, self.sought.allowed);
        for (candidate, touch) in batch.drain(..).zip(touches) {
            if let Some(touch) = touch {
                self.poses.add(&touch);
                continue;
            }
            self.tried += 1;
            let Candidate { at, tip, state } = &candidate;
            if let Some(path) = self.sought.way_to(tip, state, Unfolding::Simple, self.ways) {
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

    /// A way that a search finds to one of the states that are left.
    fn searched(&mut self) -> Option<(usize, Vec<State>)> {
        self.left.drain(..).find_map(|Candidate { at, tip, state }| {
            Some((at, self.sought.way_to(&tip, &state, Unfolding::Searched, self.ways)?))
        })
    }
}

/// What is known of the hand alone in a pose.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Alone {
    Unknown,
    Free,
    Blocked,
}

impl Room<'_> {
    /// A way from where the robot is to one of the poses: which, and the states.
    ///
    /// # Errors
    ///
    /// The answer where none was found.
    pub(super) fn seek(
        &self,
        sought: &Sought<'_, '_, '_>,
        budget: Budget,
    ) -> Result<(usize, Vec<State>), Answer> {
        let mut tips: Vec<(usize, Isometry3<f64>, Alone)> =
            sought.tips.iter().enumerate().map(|(at, tip)| (at, *tip, Alone::Unknown)).collect();
        let (mut hands, mut poses, mut ways) = (Tally::default(), Tally::default(), Tally::default());
        let mut is_cut_off = false;
        let mut search =
            Search { sought, budget, tried: 0, poses: &mut poses, ways: &mut ways, left: vec![] };
        let mut batch: Vec<Candidate> = Vec::with_capacity(BATCH);
        let places_base = matches!(sought.hand.solver, Solver::Lift(_));
        let [few, many] = SHARED;
        let shared = if places_base { few } else { many };
        let mut rounds = budget.candidates;
        let mut round = 0;
        while round < rounds {
            for (at, tip, known) in &mut tips {
                if !known.is_free(&sought.palm, tip, &mut hands) {
                    continue;
                }
                if !places_base && !self.is_near_drivable(self.base_at(sought.hand, tip, round)) {
                    is_cut_off = true;
                    continue;
                }
                for state in self.candidates(sought.hand, tip, round) {
                    if places_base && !self.is_near_drivable(state.base) {
                        is_cut_off = true;
                        continue;
                    }
                    batch.push(Candidate { at: *at, tip: *tip, state });
                    if batch.len() == BATCH
                        && let ControlFlow::Break(found) = search.tries(&mut batch)
                    {
                        return found;
                    }
                }
            }
            if round == 0 {
                tips.retain(|(_, _, known)| *known == Alone::Free);
                rounds = rounds.min(budget.candidates.saturating_mul(shared).div_ceil(tips.len().max(1)));
            }
            round += 1;
        }
        if let ControlFlow::Break(found) = search.tries(&mut batch) {
            return found;
        }
        if let Some(found) = search.searched() {
            return Ok(found);
        }
        let tried = search.tried;
        if tips.is_empty() {
            let reason = Reason::NoFreePose { by: hands.most() };
            let certified = sought.is_all && !sought.tips.is_empty();
            return Err(Answer::Infeasible(Infeasible { reason, change: None, certified }));
        }
        Err(exhausted(tried > 0 || is_cut_off, &poses, &ways))
    }

    /// How far the base can be from the tip of a hand, in m.
    pub(super) fn farthest(&self, hand: &Hand) -> f64 {
        match &hand.solver {
            Solver::Lift(arm) => arm.reach(),
            Solver::Parallel(_) | Solver::Steps(_) => hand.card.reach_m + self.machine.card().base.radius_m,
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

impl Alone {
    fn is_free(&mut self, palm: &Palm<'_, '_>, tip: &Isometry3<f64>, met: &mut Tally) -> bool {
        if *self == Self::Unknown {
            let touch = palm.touch(tip);
            *self = if touch.is_some() { Self::Blocked } else { Self::Free };
            touch.iter().for_each(|touch| met.add(touch));
        }
        *self == Self::Free
    }
}
