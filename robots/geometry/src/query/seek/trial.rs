//! What is tried of a free state in which the hand is where it is wanted: simple ways to it, and for some a search. Where all of that
//! leads nowhere: finer poses of the hand, places of the base that are cut off for a disc, a proof that there is nothing, and more candidates.

use std::collections::VecDeque;
use std::ops::ControlFlow;

use nalgebra::Isometry3;

use super::{Alone, At, Candidate, Ended, Places, Search, Sought, Times, Way};
use crate::query::answer::{Answer, Infeasible, Reason, Unknown};
use crate::query::cells::Covered;
use crate::query::connect::Effort;
use crate::query::grasp::Hold;
use crate::query::grip::Grips;
use crate::query::screen::Screen;
use crate::query::state::State;
use crate::query::travel::{NoWay, Tally};

/// After so many free states without a simple way to any, a way is searched for to some of them, and after as many more again.
const SIMPLE: usize = 6;
/// To so many, shortly.
const SEARCHED: usize = 3;
/// States that are kept for a longer search in the end.
const LEFT: usize = 8;
/// So many states to which the hand does not come straight count as one to which it does: they take as long.
const CHEAP: usize = 8;
/// Many proofs are short: so many cells are looked at after the first candidates, and so many after all for the poses that were given.
const SHORT: usize = 128;
const LONGER: usize = 1024;
/// Free states that a proof meets to which ways are looked for, simple ones and by a short search.
const MET: usize = 8;
/// Finer poses of the hand are so near to each other, in m that any of its points goes from one to the next, about; where they are few, so
/// near.
const FINE: [f64; 2] = [0.05, 0.005];
/// Fewer are few; and about the most of them.
const POSES: [usize; 2] = [128, 1024];
/// So many times as many candidates are tried where the base is cut off, of which most are of no use.
const CUT_OFF: usize = 4;
/// So many times as many are tried in the end, where it is known that there is a free state, or nothing is.
const MORE: usize = 8;

/// States along which the hand comes straight to where it is wanted.
pub(super) struct Lined {
    at: At,
    line: Vec<State>,
    inwards: [f64; 2],
}

impl Search<'_, '_, '_> {
    /// A way, or the answer where there is none.
    pub(super) fn all(&mut self, screen: Option<&Screen<'_, '_, '_>>) -> Result<Way, Answer> {
        match self.found(screen) {
            ControlFlow::Break(way) => Ok(way),
            ControlFlow::Continue(is_proven) => Err(self.none(is_proven)),
        }
    }

    /// A way; else whether there is none for certain.
    fn found(&mut self, screen: Option<&Screen<'_, '_, '_>>) -> ControlFlow<Way, bool> {
        if screen.is_some() {
            self.is_spent = self.goes(screen, Places::Open, Times::First)?;
        } else {
            self.is_spent = self.goes(screen, Places::Open, Times::Few)?;
            // Candidates that are solved one by one take as long as cells do.
            if self.proves(SHORT)? == Covered::Nowhere {
                return ControlFlow::Continue(true);
            }
            self.is_spent = self.is_spent || self.goes(screen, Places::Open, Times::Rest)?;
        }
        let Some(grips) = self.sought.grips.filter(|_| !self.is_spent) else {
            self.searches_long()?;
            return ControlFlow::Continue(false);
        };
        if self.proves(LONGER)? == Covered::Nowhere {
            return ControlFlow::Continue(true);
        }
        // What is tried beyond the poses that were given takes nothing away.
        self.refines(grips);
        self.goes(screen, Places::Open, Times::First)?;
        if self.is_cut_off {
            self.goes(None, Places::CutOff, Times::Again(CUT_OFF))?;
        }
        self.searches_long()?;
        if self.budget.cells > LONGER && self.proves(usize::MAX)? == Covered::Nowhere {
            return ControlFlow::Continue(true);
        }
        self.goes(screen, Places::Open, Times::More(MORE))?;
        if self.is_cut_off {
            self.goes(None, Places::CutOff, Times::More(MORE))?;
        }
        self.searches_long()?;
        ControlFlow::Continue(false)
    }

    /// Goes through candidates; whether more are left than may be tried.
    fn goes(
        &mut self,
        screen: Option<&Screen<'_, '_, '_>>,
        places: Places,
        times: Times,
    ) -> ControlFlow<Way, bool> {
        self.batch.clear();
        if times != Times::Rest {
            (self.tried, self.lined) = (0, 0);
        }
        let ended = match screen {
            Some(screen) => self.by_eights(screen, times),
            None => self.one_by_one(places, times),
        };
        match ended {
            ControlFlow::Break(Some(way)) => ControlFlow::Break(way),
            ControlFlow::Break(None) => ControlFlow::Continue(true),
            ControlFlow::Continue(()) => ControlFlow::Continue(false),
        }
    }

    /// Goes on to poses of the hand between those that were given: indices are of these then.
    fn refines(&mut self, grips: &Grips<'_>) {
        let sought = self.sought;
        let finer = finer(grips);
        let tips: Vec<Isometry3<f64>> = finer.iter().map(|hold| hold.map_from_tip).collect();
        self.palm = sought.around.room.palm(sought.hand, &tips, sought.allowed);
        self.tips = tips.into_iter().enumerate().map(|(at, tip)| (at, tip, Alone::Unknown)).collect();
        self.finer = Some(finer);
    }

    /// What so many cells at most tell of all ways to grip the thing, or a way to a free state that they meet. Where one was found before
    /// there is nothing to prove.
    fn proves(&mut self, cells: usize) -> ControlFlow<Way, Covered> {
        let sought = self.sought;
        let Some(grips) = sought.grips.filter(|_| self.met.is_none()) else {
            return ControlFlow::Continue(Covered::Open);
        };
        let cells = cells.min(self.budget.cells);
        let mut found = None;
        let before = std::mem::take(&mut self.tried);
        let covered = sought.around.covered(sought.hand, grips, sought.allowed, cells, |hold, state| {
            self.meets(hold, state, &mut found)
        });
        self.tried += before;
        match found {
            Some(way) => ControlFlow::Break(way),
            None => ControlFlow::Continue(covered),
        }
    }

    /// The answer where no way was found.
    fn none(&mut self, is_proven: bool) -> Answer {
        let none_free =
            |search: &Self| if search.poses.is_empty() { &search.hands } else { &search.poses }.none_free();
        if is_proven {
            return Answer::Infeasible(Infeasible::proven(none_free(self), None));
        }
        if self.is_spent {
            return Answer::Unknown(Unknown::Budget);
        }
        let state = self.met.take();
        let reason = match state.is_some() || self.is_cut_off {
            true => Reason::BlockedPath { by: self.ways.most() },
            false => none_free(self),
        };
        let state = state.map(Box::new);
        Answer::Infeasible(Infeasible { state, ..Infeasible::exhausted(reason) })
    }

    /// Tries what is left of the candidates that were to be tried together.
    pub(super) fn tries_batch(&mut self) -> Ended {
        let batch = std::mem::take(&mut self.batch);
        self.tries(batch)
    }

    /// Tries candidates one after the other; what ends the search.
    pub(super) fn tries(&mut self, batch: Vec<Candidate>) -> Ended {
        let sought = self.sought;
        let states: Vec<&State> = batch.iter().map(|candidate| &candidate.state).collect();
        let touches = sought.around.touches(&states, sought.allowed);
        for (candidate, touch) in batch.into_iter().zip(touches) {
            if let Some(touch) = touch {
                self.poses.add(&touch);
                continue;
            }
            if let Some(way) = self.simple(candidate) {
                return ControlFlow::Break(Some(way));
            }
            // Where nothing simple does for some, a search may.
            if self.tried.is_multiple_of(SIMPLE)
                && let Some(way) = self.searches()
            {
                return ControlFlow::Break(Some(way));
            }
            let paths = self.budget.paths;
            if self.lined >= paths || self.tried >= paths.saturating_mul(CHEAP) {
                return ControlFlow::Break(None);
            }
        }
        ControlFlow::Continue(())
    }

    /// A simple way to a free state.
    fn simple(&mut self, Candidate { at, tip, state }: Candidate) -> Option<Way> {
        self.tried += 1;
        let way = self.sought.way_to(&tip, &state, &mut self.ways);
        self.met.get_or_insert(state);
        match way {
            Ok(path) => return Some((at, path)),
            Err(None) => {}
            Err(Some(line)) => {
                self.lined += 1;
                if self.left.len() < SEARCHED {
                    let inwards = line.first()?.inwards(&tip.translation.vector);
                    self.left.push(Lined { at, line, inwards });
                }
            }
        }
        None
    }

    /// Tries a free state that a proof met.
    fn meets(&mut self, hold: &Hold, state: State, found: &mut Option<Way>) -> ControlFlow<()> {
        let candidate = Candidate { at: At::Hold(*hold), tip: hold.map_from_tip, state };
        self.is_cut_off |= !self.sought.around.room.is_near_drivable(candidate.state.base);
        *found = self.simple(candidate).or_else(|| self.searches());
        if found.is_none() && self.tried < MET { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }

    /// A way that a short search finds to one of some states that are left.
    fn searches(&mut self) -> Option<Way> {
        for lined in self.left.drain(..) {
            if let Some(path) = self.sought.around.lead(&lined.line, lined.inwards, Effort::Short) {
                return Some((lined.at, path));
            }
            if self.searched.len() < LEFT {
                self.searched.push(lined);
            }
        }
        None
    }

    /// The same with a long one, to all of them.
    fn searches_long(&mut self) -> ControlFlow<Way> {
        let around = self.sought.around;
        let mut left = self.searched.drain(..).chain(self.left.drain(..)).take(LEFT);
        let way = left.find_map(|Lined { at, line, inwards, .. }| {
            Some((at, around.lead(&line, inwards, Effort::Long)?))
        });
        way.map_or(ControlFlow::Continue(()), ControlFlow::Break)
    }
}

/// Poses in the middle of patches that are cut until they are small.
fn finer(grips: &Grips<'_>) -> Vec<Hold> {
    let ([near, nearer], [few, most]) = (FINE, POSES);
    let mut open = VecDeque::from(grips.patches());
    let mut found = Vec::new();
    while let Some(patch) = open.pop_front() {
        let (size, across) = grips.widest(&patch);
        let count = open.len() + found.len();
        if (size > near && count < most) || (size > nearer && count < few) {
            open.extend(patch.halves(across));
        } else {
            found.extend(grips.hold(&patch));
        }
    }
    found
}

impl Sought<'_, '_, '_> {
    /// A way from where the robot is to a free state with the tip at a pose.
    ///
    /// # Errors
    ///
    /// A line along which the hand comes straight to it, where there is one to which no way was found.
    fn way_to(
        &self,
        tip: &Isometry3<f64>,
        state: &State,
        met: &mut Tally,
    ) -> Result<Vec<State>, Option<Vec<State>>> {
        let mut left = None;
        for back in (self.backs)(tip) {
            let Some(line) = self.around.room.line(self.hand, state, tip, &back) else { continue };
            match self.along(tip, &line, met) {
                Ok(path) => return Ok(path),
                Err(NoWay::Line) => {}
                Err(NoWay::Route) => left = left.or(Some(line)),
            }
        }
        Err(left)
    }

    /// A way from where the robot is along a line.
    fn along(&self, tip: &Isometry3<f64>, line: &[State], met: &mut Tally) -> Result<Vec<State>, NoWay> {
        let inner: Vec<&State> = line.iter().take(line.len().saturating_sub(1)).skip(1).collect();
        if let Some(touch) = self.around.first_touch(&inner, self.allowed) {
            met.add(&touch);
            return Err(NoWay::Line);
        }
        let inwards = line.first().map_or([1.0, 0.0], |first| first.inwards(&tip.translation.vector));
        self.around.route_to(line, inwards, self.allowed, met)
    }
}

#[cfg(test)]
mod tests;
