//! Facts: how they are looked up and changed, one by one and by patterns.
//!
//! A pattern write covers all facts that fit it, also those that nobody has asked for yet; a later write
//! wins. A cell that has `any` itself says whether some entity fits.

use super::cells::{Beliefs, CellId, PatternWrite, PerceivedFact};
use crate::query::{Answer, Pattern, Query, Truth};
use crate::time::Time;
use smol_str::SmolStr;

/// A change of what is believed, worked out before any change is made.
#[derive(Clone, Debug)]
pub(crate) struct BeliefChange {
    pub(crate) fluent: SmolStr,
    /// `any` means every entity.
    pub(crate) args: Vec<Pattern>,
    pub(crate) value: Truth,
    /// True if it surely happens; else it may have happened.
    pub(crate) sure: bool,
    /// True if a pattern is meant only of facts that have no cell: of what nobody has asked for yet.
    pub(crate) rest: bool,
}

impl PerceivedFact {
    /// True if a write is about this fact, or about all that it is about.
    fn is_covered(&self, change: &BeliefChange) -> bool {
        let Query::Fact { fluent, args } = &self.fact else { return false };
        *fluent == change.fluent && covers(&change.args, args)
    }
}

/// Relation of the beliefs to a claimed fact.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum FactStanding {
    /// It is believed.
    So,
    /// Something else is believed, or it is no longer known.
    Otherwise(Truth),
    /// Nothing was ever said of it.
    Unheard,
}

impl Beliefs {
    /// Truth value of a fact, with `any` of its existential closure, and the numbers of the observation
    /// behind it, 0 for an effect, and of its last change.
    pub(crate) fn fact(&self, fluent: &str, args: &[Pattern]) -> (Truth, (u64, u64)) {
        let own = self.find_fact(fluent, args).and_then(|id| self.cell(id));
        let (answer, numbers) = match own {
            Some(cell) => (truth_of(&cell.answer), (cell.seen, cell.changed)),
            None => {
                let (answer, numbers) = self.wide_answer(fluent, args);
                (truth_of(&answer), numbers)
            }
        };
        if args.contains(&Pattern::Any)
            && answer != Truth::True
            && let Some(numbers) = self.witness(fluent, args)
        {
            return (Truth::True, numbers);
        }
        (answer, numbers)
    }

    /// True if it is not known which one fact makes a pattern true: several may.
    pub(crate) fn is_vague(&self, fluent: &str, args: &[Pattern]) -> bool {
        let Some(facts) = self.fluents.get(fluent).filter(|_| args.contains(&Pattern::Any)) else {
            return false;
        };
        let single = |id: CellId| match (&*self.cell(id)?.query, truth_of(&self.cell(id)?.answer)) {
            (Query::Fact { args, .. }, truth) if !args.contains(&Pattern::Any) => Some(truth),
            _ => None,
        };
        let mut maybe = self.covered(fluent, args).filter_map(single).filter(|truth| *truth != Truth::False);
        let is_one = maybe.next() == Some(Truth::True) && maybe.next().is_none();
        let rest = facts.wides.iter().rev().find(|wide| covers(&wide.args, args));
        !(is_one && rest.is_some_and(|rest| rest.answer == Answer::Truth(false)))
    }

    /// True if what is believed of a fact was perhaps observed before the last effect on it.
    pub(crate) fn is_tainted(&self, fluent: &str, args: &[Pattern]) -> bool {
        let cell = self.find_fact(fluent, args).and_then(|id| self.cell(id));
        cell.is_some_and(|cell| cell.tainted)
    }

    /// Writes a fact that a host or a compiler states.
    pub(crate) fn tell(&mut self, fluent: &SmolStr, args: Vec<Pattern>, value: Truth) {
        let change = BeliefChange { fluent: fluent.clone(), args, value, sure: true, rest: false };
        self.apply(&change, Time::ZERO);
    }

    /// Writes what a compiler states of facts of which nothing was said.
    pub(crate) fn tell_rest(&mut self, fluent: &SmolStr, args: Vec<Pattern>, value: Truth) {
        let unsaid = |id: &CellId| self.cell(*id).is_some_and(|cell| !cell.written);
        let cells: Vec<CellId> = self.covered(fluent, &args).filter(unsaid).collect();
        cells.into_iter().for_each(|id| self.write_cell(id, value, Time::ZERO));
        let change = BeliefChange { fluent: fluent.clone(), args, value, sure: true, rest: true };
        self.apply(&change, Time::ZERO);
    }

    /// Relation of the beliefs to a fact from which a policy was proved; `any` stands for every entity for
    /// which none of `others` says something else.
    pub(crate) fn standing(
        &self,
        fluent: &str,
        args: &[Pattern],
        value: bool,
        others: &[&[Pattern]],
    ) -> FactStanding {
        let Some(facts) = self.fluents.get(fluent) else { return FactStanding::Unheard };
        let is_written = |id: &CellId| self.cell(*id).is_some_and(|cell| cell.written);
        let is_meant = |id: &CellId| {
            self.cell(*id).is_some_and(|cell| match &*cell.query {
                Query::Fact { args, .. } => !others.contains(&args.as_slice()),
                _ => true,
            })
        };
        let is_heard = facts.wides.iter().any(|wide| overlaps(&wide.args, args));
        let (believed, is_heard) = if args.contains(&Pattern::Any) {
            let mut told = self.covered(fluent, args).filter(is_written).filter(is_meant).peekable();
            let is_heard = is_heard || told.peek().is_some();
            let each = told.map(|id| self.cell(id).map_or(Truth::Unknown, |cell| truth_of(&cell.answer)));
            // Of those that no pattern was about, nothing was said.
            let answers = |is_meant: fn(&[Pattern], &[Pattern]) -> bool| {
                let wides = facts.wides.iter().rev().filter(move |wide| is_meant(&wide.args, args));
                wides.map(|wide| truth_of(&wide.answer))
            };
            let rest = answers(covers).next();
            let rest = rest.unwrap_or_else(|| answers(overlaps).fold(Truth::from(value), Truth::joined));
            (each.fold(rest, Truth::joined), is_heard)
        } else {
            let is_written = self.find_fact(fluent, args).as_ref().is_some_and(is_written);
            (self.fact(fluent, args).0, is_heard || is_written)
        };
        match believed {
            _ if !is_heard => FactStanding::Unheard,
            believed if believed == Truth::from(value) => FactStanding::So,
            believed => FactStanding::Otherwise(believed),
        }
    }

    /// Makes a change. All who depend on what becomes different are noted.
    pub(crate) fn apply(&mut self, change: &BeliefChange, now: Time) {
        if !self.lasting.is_empty() && change.sure && !change.rest {
            self.lasting.retain(|lasting| !lasting.is_covered(change));
        }
        if change.args.contains(&Pattern::Any) {
            self.write_wide(change, now);
        } else {
            self.write_one(change, now);
        }
    }

    /// Takes an observation of a cell. Returns true if it answers a question that is older than the last
    /// effect on the cell: unless somebody watches the cell, nothing is learned from it.
    pub(crate) fn observe(&mut self, id: CellId, answer: Answer, now: Time) -> bool {
        let Some(cell) = self.cell_mut(id) else { return false };
        let is_late = cell.late > 0;
        cell.due = cell.due.saturating_sub(1);
        cell.late = cell.late.saturating_sub(1);
        cell.tainted = is_late;
        if !is_late || cell.watchers > 0 {
            self.observations += 1;
            self.observing = self.observations;
            self.take(id, answer, now);
            self.observing = 0;
        }
        is_late
    }

    fn take(&mut self, id: CellId, answer: Answer, now: Time) {
        let Some(cell) = self.cell_mut(id) else { return };
        // Of what its driver cannot tell, it does not report the changes.
        cell.live = cell.watchers > 0 && answer != Answer::Unknown;
        let query = cell.query.clone();
        if let Query::Fact { fluent, args } = &*query {
            let value = truth_of(&answer);
            if value == Truth::Unknown && cell.watchers == 0 {
                // Nobody can tell now: what was believed stands.
                return;
            }
            let change =
                BeliefChange { fluent: fluent.clone(), args: args.clone(), value, sure: true, rest: false };
            // That none fits says something of each; that some does, or that it is not known, says nothing of
            // any.
            if args.contains(&Pattern::Any) && value != Truth::False {
                if value == Truth::True && self.fact(fluent, args).0 == Truth::False {
                    // One fits although none was believed to: which one it is, is not known.
                    self.apply(&BeliefChange { value: Truth::Unknown, ..change }, now);
                }
                self.set(id, answer, now);
            } else {
                self.apply(&change, now);
            }
        } else {
            self.set(id, answer, now);
        }
    }

    /// Answer of the pattern writes for a fact or a pattern without a cell.
    pub(crate) fn wide_answer(&self, fluent: &str, args: &[Pattern]) -> (Answer, (u64, u64)) {
        let unknown = (Answer::Unknown, (0, 0));
        let Some(facts) = self.fluents.get(fluent) else { return unknown };
        for wide in facts.wides.iter().rev() {
            if covers(&wide.args, args) {
                if !args.contains(&Pattern::Any) {
                    return (wide.answer.clone(), (wide.seen, wide.changed));
                }
                if wide.answer != Answer::Truth(false) {
                    return unknown;
                }
                // That none fits is so since the last of those that fitted has changed.
                let mut changed = wide.changed;
                for cell in self.covered(fluent, args).filter_map(|id| self.cell(id)) {
                    if cell.answer != Answer::Truth(false) {
                        return unknown;
                    }
                    changed = changed.max(cell.changed);
                }
                return (Answer::Truth(false), (wide.seen, changed));
            }
            // A later write to some of them: only where it says the same does an earlier one stand.
            if overlaps(&wide.args, args) && wide.answer != Answer::Truth(false) {
                return unknown;
            }
        }
        unknown
    }

    /// Of a fact that is believed true and fits a pattern: the numbers of the observation and of the change.
    fn witness(&self, fluent: &str, args: &[Pattern]) -> Option<(u64, u64)> {
        let covered = self.covered(fluent, args).filter_map(|id| self.cell(id));
        let mut holding = covered.filter(|cell| cell.answer == Answer::Truth(true));
        holding.next().map(|cell| (cell.seen, cell.changed))
    }

    /// The cells of single facts that fit a pattern.
    fn covered<'a>(&'a self, fluent: &str, args: &'a [Pattern]) -> impl Iterator<Item = CellId> + 'a {
        let cells = self.fluents.get(fluent).map_or(&[][..], |facts| &facts.cells);
        cells.iter().copied().filter(move |id| {
            self.cell(*id).is_some_and(
                |cell| matches!(&*cell.query, Query::Fact { args: own, .. } if covers(args, own)),
            )
        })
    }

    fn write_one(&mut self, change: &BeliefChange, now: Time) {
        let query = Query::Fact { fluent: change.fluent.clone(), args: change.args.clone() };
        let id = self.intern(query);
        let old = self.cell(id).map_or(Truth::Unknown, |cell| truth_of(&cell.answer));
        let new = if change.sure { change.value } else { old.joined(change.value) };
        self.write_cell(id, new, now);
        // An observation changes nothing: what was not known to hold is not what made a pattern true.
        let was_so = old == Truth::True || (old == Truth::Unknown && self.observing == 0);
        self.unsettle_patterns(change, (was_so, new), now);
    }

    fn write_wide(&mut self, change: &BeliefChange, now: Time) {
        // An observation changes nothing: only what was known to hold may be what made a pattern true.
        let was_so = self.observing == 0 || self.fact(&change.fluent, &change.args).0 == Truth::True;
        let written = if change.sure { change.value } else { Truth::Unknown };
        let ids: Vec<CellId> =
            if change.rest { Vec::new() } else { self.covered(&change.fluent, &change.args).collect() };
        for id in ids {
            let old = self.cell(id).map_or(Truth::Unknown, |cell| truth_of(&cell.answer));
            let new = if change.sure { change.value } else { old.joined(change.value) };
            self.write_cell(id, new, now);
        }
        let (seen, changed) = (self.observing, self.number());
        if let Some(facts) = self.fluents.get_mut(&change.fluent) {
            facts.wides.retain(|wide| !covers(&change.args, &wide.args));
            let (args, answer) = (change.args.clone(), answer_of(written));
            facts.wides.push(PatternWrite { args, answer, seen, changed });
        }
        self.unsettle_patterns(change, (was_so, written), now);
    }

    /// Updates the cells with `any` that a write touches; `was_so` is true if what is written may have held
    /// before.
    fn unsettle_patterns(&mut self, change: &BeliefChange, (was_so, written): (bool, Truth), now: Time) {
        let Some(facts) = self.fluents.get(&change.fluent) else { return };
        let mut touched = Vec::new();
        for id in &facts.patterns {
            let Some(cell) = self.cell(*id) else { continue };
            let Query::Fact { args, .. } = &*cell.query else { continue };
            if !overlaps(&change.args, args) {
                continue;
            }
            let own = truth_of(&cell.answer);
            let new = match (own, written) {
                (_, written) if covers(&change.args, args) => written,
                (_, Truth::True) => Truth::True,
                (own, Truth::False) if !was_so => own,
                // It may have been the one that held, or it may be the one that holds.
                (Truth::True | Truth::Unknown, _) | (Truth::False, Truth::Unknown) => Truth::Unknown,
                (Truth::False, Truth::False) => Truth::False,
            };
            touched.push((*id, new));
        }
        for (id, new) in touched {
            self.write_cell(id, new, now);
            // What fits the pattern may have changed even where its own answer has not.
            self.note(id);
        }
    }

    /// Makes the changes of one call, which are made together.
    pub(crate) fn apply_all(&mut self, changes: &[BeliefChange], now: Time) {
        self.watched.clear();
        changes.iter().for_each(|change| self.apply(change, now));
        self.watched.clear();
    }

    /// Writes what an observation or an effect says of a cell. An effect takes nothing back that is watched:
    /// its driver reports every change.
    fn write_cell(&mut self, id: CellId, truth: Truth, now: Time) {
        let Some(cell) = self.cell(id).filter(|cell| cell.live && self.observing == 0) else {
            self.set(id, answer_of(truth), now);
            return;
        };
        let answer = cell.answer.clone();
        let before =
            self.watched.iter().find(|(watched, _)| *watched == id).map(|(_, before)| before.clone());
        if truth != Truth::Unknown {
            if before.is_none() {
                self.watched.push((id, answer));
            }
            self.set(id, answer_of(truth), now);
        } else if let Some(before) = before {
            // Another effect of the same call leaves open what this one has said.
            self.set(id, before, now);
        }
    }

    fn set(&mut self, id: CellId, answer: Answer, now: Time) {
        let (seen, changed) = (self.observing, self.number());
        let Some(cell) = self.cell_mut(id) else { return };
        cell.changed = changed;
        cell.at = now;
        cell.seen = seen;
        cell.written = true;
        if seen == 0 {
            cell.late = cell.due;
            cell.tainted = false;
        }
        if cell.answer != answer {
            cell.answer = answer;
            self.note(id);
        }
    }

    /// Number of what changes now: of the observation, or of an effect.
    fn number(&mut self) -> u64 {
        if self.observing == 0 {
            self.observations += 1;
        }
        self.observations
    }

    pub(crate) fn note(&mut self, id: CellId) {
        let mut changed = std::mem::take(&mut self.changed);
        if let Some(cell) = self.cell(id) {
            changed.extend_from_slice(&cell.dependents);
        }
        self.changed = changed;
    }
}

/// The truth that an answer to a fact gives.
pub(crate) fn truth_of(answer: &Answer) -> Truth {
    match answer {
        Answer::Truth(truth) => Truth::from(*truth),
        Answer::Unknown | Answer::Value(_) => Truth::Unknown,
    }
}

fn answer_of(truth: Truth) -> Answer {
    match truth {
        Truth::True => Answer::Truth(true),
        Truth::False => Answer::Truth(false),
        Truth::Unknown => Answer::Unknown,
    }
}

/// True if every fact of `other` is one of `wide`.
pub(crate) fn covers(wide: &[Pattern], other: &[Pattern]) -> bool {
    wide.len() == other.len()
        && wide.iter().zip(other).all(|(wide, other)| *wide == Pattern::Any || wide == other)
}

/// True if some fact is one of both.
pub(super) fn overlaps(a: &[Pattern], b: &[Pattern]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| *a == Pattern::Any || *b == Pattern::Any || a == b)
}
