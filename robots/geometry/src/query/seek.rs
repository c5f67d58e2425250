//! The search for a way of the hand to one of some poses: the poses in the order in which they are given, for each one
//! candidate for the base and the arm after the other. Which ways are looked for to a candidate, and what is tried where there is none, is
//! in `trial`.

use std::ops::{ControlFlow, Range};

use nalgebra::{Isometry3, Vector3};

use super::answer::{Answer, Budget};
use super::around::Around;
use super::grasp::Hold;
use super::grip::Grips;
use super::machine::Hand;
use super::palm::Palm;
use super::room::Room;
use super::screen::{Draft, Group, Screen, Seen};
use super::solver::Solver;
use super::state::State;
use super::touch::Allowed;
use super::travel::Tally;
use crate::inverse::batch::LANES;

mod trial;

use trial::Lined;

/// So many poses have the candidates of a budget each; more share them. Where the base is not placed by the arm's own solver,
/// most candidates have no solution at all, and the poses that were given have more.
const SHARED: [usize; 2] = [8, 32];
/// Rounds after which a short proof is tried, where a round takes long.
const FEW: usize = 9;
/// How far the base comes from where it stands in the end while the hand reaches, in m.
pub(super) const LAST: f64 = 0.65;
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
    pub(super) around: &'a Around<'r, 'w>,
    /// From a pose of the tip back to where the last straight line to it begins, in m in the map: the best first.
    pub(super) backs: &'a dyn Fn(&Isometry3<f64>) -> Vec<Vector3<f64>>,
}

/// Where the hand is in the end.
#[derive(Clone, Copy, Debug)]
pub(super) enum At {
    /// At a pose that was given, by its index.
    Tip(usize),
    /// At another, between those or where a proof found room for it.
    Hold(Hold),
}

/// A state with the tip at a pose.
struct Candidate {
    at: At,
    tip: Isometry3<f64>,
    state: State,
}

/// Where the hand is, with the way to it.
type Way = (At, Vec<State>);

/// What ends a search through candidates: a way, or that as many were tried as may be.
type Ended = ControlFlow<Option<Way>>;

/// Which rounds of candidates are gone through.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Times {
    /// All; in the first it is found out in which poses the hand alone is free.
    First,
    /// The first few of them, likewise.
    Few,
    /// The others.
    Rest,
    /// All once more, with a budget so many times as large.
    Again(usize),
    /// Those that come after them with a budget so many times as large.
    More(usize),
}

impl Times {
    /// Whether it is found out in the first round in which poses the hand alone is free.
    fn begins(self) -> bool {
        matches!(self, Self::First | Self::Few)
    }
}

/// Which places of the base are looked at.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Places {
    /// To which a way leads, about, with the arm as it was and the base taken for a disc.
    Open,
    /// The others.
    CutOff,
}

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
    /// The poses by their index; after the first round without those in which the hand alone is not free.
    tips: Vec<(usize, Isometry3<f64>, Alone)>,
    /// What they are, where they are none of those that were given.
    finer: Option<Vec<Hold>>,
    palm: Palm<'r, 'w>,
    /// Free states that were tried since the last time that as many began to be tried as may be.
    tried: usize,
    /// Of these so many to which the hand comes straight.
    lined: usize,
    /// Whether as many were tried as may be.
    is_spent: bool,
    hands: Tally,
    poses: Tally,
    ways: Tally,
    /// Whether a candidate was passed over because no way leads near to where its base is.
    is_cut_off: bool,
    /// States to look at.
    batch: Vec<Candidate>,
    /// Free states to which the hand comes straight, and no simple way leads.
    left: Vec<Lined>,
    /// Some of those to which a short search led nowhere.
    searched: Vec<Lined>,
    /// A free state.
    met: Option<State>,
}

impl<'a, 'r, 'w> Search<'a, 'r, 'w> {
    fn new(sought: &'a Sought<'a, 'r, 'w>, budget: Budget) -> Self {
        Self {
            sought,
            budget,
            tips: sought.tips.iter().enumerate().map(|(at, tip)| (at, *tip, Alone::Unknown)).collect(),
            finer: None,
            palm: sought.around.room.palm(sought.hand, &sought.tips, sought.allowed),
            tried: 0,
            lined: 0,
            is_spent: false,
            hands: Tally::default(),
            poses: Tally::default(),
            ways: Tally::default(),
            is_cut_off: false,
            batch: Vec::with_capacity(BATCH),
            left: vec![],
            searched: vec![],
            met: None,
        }
    }

    /// Whether the hand alone is free in a pose. Where that is not known it is found out for the next ones as well.
    fn is_free(&mut self, at: usize) -> bool {
        if self.tips.get(at).is_some_and(|(_, _, known)| *known == Alone::Unknown) {
            let next = self.tips.iter_mut().skip(at).filter(|(_, _, known)| *known == Alone::Unknown);
            let mut next: Vec<_> = next.take(BATCH).collect();
            let poses: Vec<Isometry3<f64>> = next.iter().map(|(_, tip, _)| *tip).collect();
            for ((_, _, known), touch) in next.iter_mut().zip(self.palm.touches(&poses)) {
                *known = if touch.is_some() { Alone::Blocked } else { Alone::Free };
                touch.iter().for_each(|touch| self.hands.add(touch));
            }
        }
        self.tips.get(at).is_some_and(|(_, _, known)| *known == Alone::Free)
    }

    /// Leaves out the poses in which the hand alone is known not to be free: so many rounds are left for the others, with a budget so many times as
    /// large.
    fn rounds(&mut self, times: usize) -> usize {
        self.tips.retain(|(_, _, known)| *known != Alone::Blocked);
        let [few, many] = SHARED;
        let shared = if self.places_base() || self.finer.is_some() { few } else { many };
        let candidates = self.budget.candidates.saturating_mul(times);
        candidates.min(candidates.saturating_mul(shared).div_ceil(self.tips.len().max(1)))
    }

    fn rounds_of(&mut self, times: Times) -> Range<usize> {
        match times {
            Times::First => 0..self.rounds(1),
            Times::Few => 0..self.rounds(1).min(FEW),
            Times::Rest => FEW..self.rounds(1),
            Times::Again(times) => 0..self.rounds(times),
            Times::More(times) => self.rounds(1)..self.rounds(times),
        }
    }

    fn at(&self, index: usize) -> At {
        let finer = self.finer.as_ref().and_then(|holds| holds.get(index));
        finer.map_or(At::Tip(index), |hold| At::Hold(*hold))
    }

    fn places_base(&self) -> bool {
        matches!(self.sought.hand.solver, Solver::Lift(_))
    }

    /// Goes through all candidates, those of a round for all poses before the next; what ends the search.
    fn one_by_one(&mut self, places: Places, times: Times) -> Ended {
        let (sought, room) = (self.sought, self.sought.around.room);
        let places_base = self.places_base();
        let is_passed = |base| room.is_near_drivable(base) != (places == Places::Open);
        let mut rounds = if times.begins() { 0..1 } else { self.rounds_of(times) };
        while let Some(round) = rounds.next() {
            for index in 0..self.tips.len() {
                if !self.is_free(index) {
                    continue;
                }
                let Some((at, tip, _)) = self.tips.get(index).copied() else { continue };
                if !places_base && is_passed(room.base_at(sought.hand, &tip, round)) {
                    self.is_cut_off |= places == Places::Open;
                    continue;
                }
                for state in room.candidates(sought.hand, &tip, round) {
                    if places_base && is_passed(state.base) {
                        self.is_cut_off |= places == Places::Open;
                        continue;
                    }
                    self.batch.push(Candidate { at: self.at(at), tip, state });
                    if self.batch.len() == BATCH {
                        self.tries_batch()?;
                    }
                }
            }
            if round == 0 && times.begins() {
                rounds = 1..self.rounds_of(times).end;
            }
        }
        self.tries_batch()
    }

    /// The same candidates, eight at a time.
    fn by_eights(&mut self, screen: &Screen<'_, '_, '_>, times: Times) -> Ended {
        let mut drafts: Vec<Draft> = Vec::new();
        let mut groups: Vec<Group> = Vec::new();
        let mut tips: Vec<(usize, Isometry3<f64>)> = Vec::new();
        for index in 0..self.tips.len() {
            if self.is_free(index) {
                tips.extend(self.tips.get(index).map(|(at, tip, _)| (*at, *tip)));
            }
            if tips.len() == LANES || (index + 1 == self.tips.len() && !tips.is_empty()) {
                let group = screen.group(std::mem::take(&mut tips));
                if times.begins() {
                    screen.drafts(&group, 0, &mut drafts);
                    self.screened(screen, &mut drafts, LANES)?;
                }
                groups.push(group);
            }
        }
        for round in self.rounds_of(times).skip(usize::from(times.begins())) {
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
    fn screened(&mut self, screen: &Screen<'_, '_, '_>, drafts: &mut Vec<Draft>, least: usize) -> Ended {
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
            return Some(Candidate { at: self.at(draft.at), tip: draft.tip, state });
        }
        self.is_cut_off = true;
        if is_free {
            self.met.get_or_insert(state);
        }
        None
    }
}

impl Room<'_> {
    /// A way from where the robot is to one of the poses: which, and the states.
    ///
    /// # Errors
    ///
    /// The answer where none was found.
    pub(super) fn seek(&self, sought: &Sought<'_, '_, '_>, budget: Budget) -> Result<Way, Answer> {
        let screen = match &sought.hand.solver {
            Solver::Lift(arm) => Screen::new(sought.around, sought.hand, arm, sought.allowed),
            Solver::Parallel(_) | Solver::Seven(_) | Solver::Steps(_) => None,
        };
        Search::new(sought, budget).all(screen.as_ref())
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
