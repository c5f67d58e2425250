//! The search for a way of the hand to one of some poses: the poses in the order in which they are given, for each one
//! candidate for the base and the arm after the other.

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
        let (mut tried, mut is_cut_off) = (0, false);
        let mut left: Vec<(usize, Isometry3<f64>, State)> = Vec::new();
        let searched = |left: &mut Vec<(usize, Isometry3<f64>, State)>, ways: &mut Tally| {
            left.drain(..).find_map(|(at, tip, state)| {
                Some((at, sought.way_to(&tip, &state, Unfolding::Searched, ways)?))
            })
        };
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
                    if let Some(touch) = sought.around.touch(&state, sought.allowed) {
                        poses.add(&touch);
                        continue;
                    }
                    tried += 1;
                    if let Some(path) = sought.way_to(tip, &state, Unfolding::Simple, &mut ways) {
                        return Ok((*at, path));
                    }
                    if left.len() < SEARCHED {
                        left.push((*at, *tip, state));
                    }
                    // Where nothing simple does for some, a search may.
                    if tried == SIMPLE
                        && let Some(found) = searched(&mut left, &mut ways)
                    {
                        return Ok(found);
                    }
                    if tried >= budget.paths {
                        return searched(&mut left, &mut ways).ok_or(Answer::Unknown(Unknown::Budget));
                    }
                }
            }
            if round == 0 {
                tips.retain(|(_, _, known)| *known == Alone::Free);
                rounds = rounds.min(budget.candidates.saturating_mul(shared).div_ceil(tips.len().max(1)));
            }
            round += 1;
        }
        if let Some(found) = searched(&mut left, &mut ways) {
            return Ok(found);
        }
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
    /// A way from where the robot is to a state with the tip at a pose.
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
            self.around.route_along(&line, inwards, self.allowed, unfolding, met)
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
