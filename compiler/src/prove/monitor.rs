//! Monitors: the body under watch, and what their reactions start from.

use motet_syntax::ast::EndKind;

use super::collector::{Collector, Enclosing};
use super::errors::NeverFires;
use super::evaluation::CallFrame;
use super::{Prover, Volatile, Watched};
use crate::facts::Cause;
use crate::facts::{Delta, FactKey};
use crate::ir::{Condition, Entity, Reaction, StepId, TIMEOUT, Term, When};

impl Prover<'_> {
    pub(crate) fn monitor(&mut self, id: StepId, whens: &[When], body: &[StepId]) {
        if whens.iter().all(|when| self.is_outside(when)) {
            return self.watch(id, whens, body);
        }
        if !self.enter_fixpoint(id) {
            return;
        }
        let mark = self.facts.mark();
        let said = self.said();
        let volatile = self.volatile.len();
        self.disturb(id, whens, &Delta::default(), mark, volatile);
        let watched = self.watched_by(whens);
        self.watched.push(watched);
        let restarts = whens.iter().filter(|when| matches!(when.reaction, Reaction::Restart { .. }));
        let restarts: Vec<_> = restarts.collect();
        let mut head = Delta::default();
        // The body may begin again from any of its states, where a restart asks for it.
        let (end, states) = loop {
            self.unsay(said);
            self.live = true;
            self.facts.replay(&head);
            self.enclosing.push(Enclosing::Monitor { states: Collector::new(mark) });
            self.erode();
            self.see_states();
            for when in whens.iter().filter(|when| when.hold_secs == 0.0) {
                self.live &= self.assume(&when.condition, false, Cause::step(id), CallFrame::default());
            }
            if self.live {
                self.block(body);
                self.erode();
            } else {
                // It fires at once: the body never runs.
                self.live = false;
            }
            let end = self.live.then(|| self.facts.delta(mark));
            let states = match self.enclosing.pop() {
                Some(Enclosing::Monitor { states }) => states.delta(),
                _ => Delta::default(),
            };
            self.back_to(mark);
            // A reaction may run in any state of the body, and again in what it left.
            let grown = self.disturb(id, whens, &states, mark, volatile);
            let mut next = head.clone();
            for when in &restarts {
                self.facts.replay(&states);
                if self.assume(&when.condition, true, Cause::step(id), CallFrame::default()) {
                    let way = self.facts.delta(mark);
                    self.back_to(mark);
                    next = next.or(&way, &self.facts);
                } else {
                    self.back_to(mark);
                }
            }
            if !grown && next.same_sets(&head, &self.facts) {
                break (end, states);
            }
            head = next;
        };
        self.watched.pop();
        self.volatile.truncate(volatile);
        for when in whens {
            self.react(id, when, &states, mark);
        }
        self.fixpoints -= 1;
        self.meet(mark, end.as_slice());
    }

    /// What the conditions of a monitor speak of.
    fn watched_by(&self, whens: &[When]) -> Watched {
        let mut watched = Watched::default();
        for when in whens {
            visit(&when.condition, &mut watched, &mut |term| self.argument(term, CallFrame::default()));
        }
        watched
    }

    /// Whether a reaction leaves the policy, or only waits, so that there is nothing to prove of it.
    fn is_outside(&self, when: &When) -> bool {
        let caught = self.enclosing.iter().any(|enclosing| matches!(enclosing, Enclosing::Try { .. }));
        let outside = match &when.reaction {
            Reaction::Pause { .. } => !caught,
            Reaction::End { kind: EndKind::Fail | EndKind::Replan, of: None, .. } => true,
            Reaction::End { kind: EndKind::Replan, .. } => true,
            Reaction::Restart { .. } | Reaction::Resume { .. } | Reaction::End { .. } => false,
        };
        outside && !constant(&when.condition)
    }

    /// A monitor whose reactions need no proof: its body, under watch.
    fn watch(&mut self, id: StepId, whens: &[When], body: &[StepId]) {
        for when in whens.iter().filter(|when| when.hold_secs == 0.0) {
            self.live &= self.assume(&when.condition, false, Cause::step(id), CallFrame::default());
        }
        let watched = self.watched_by(whens);
        self.watched.push(watched);
        if self.live {
            self.block(body);
        }
        self.watched.pop();
    }

    /// What the blocks of `resume` reactions change, from any of these states, may change at any moment of the body. Whether
    /// that is more than was known of it; rows from `first` are those of this monitor.
    fn disturb(&mut self, id: StepId, whens: &[When], states: &Delta, mark: usize, first: usize) -> bool {
        let mut grown = false;
        for when in whens {
            let Reaction::Resume { body, .. } = &when.reaction else { continue };
            let said = self.said();
            self.live = true;
            self.facts.replay(states);
            self.assume(&when.condition, true, Cause::step(id), CallFrame::default());
            let seen = self.facts.mark();
            self.rehearsals += 1;
            self.block(body);
            for (fluent, key) in self.facts.touched(seen) {
                let value = self.facts.get(fluent, key);
                let mut rows = self.volatile.iter_mut().skip(first);
                match rows.find(|row| row.fluent == fluent && row.key == key && row.when == when.span) {
                    Some(row) => {
                        let joined = row.value.join(value);
                        grown |= !joined.same_set(row.value);
                        row.value = joined;
                    }
                    None => {
                        self.volatile.push(Volatile { fluent, key, value, when: when.span });
                        grown = true;
                    }
                }
            }
            self.back_to(mark);
            self.unsay(said);
            self.rehearsals -= 1;
            self.live = true;
        }
        grown
    }

    /// Reactions may have run just now: what they change may be so, or as it was.
    pub(crate) fn erode(&mut self) {
        if self.volatile.is_empty() {
            return;
        }
        let rows = std::mem::take(&mut self.volatile);
        let single = rows.iter().filter(|row| !row.key.is_pattern());
        let single = single.map(|row| (row, self.read(row.fluent, row.key).join(row.value)));
        let single: Vec<_> = single.collect();
        for row in rows.iter().filter(|row| row.key.is_pattern()) {
            // A narrower row of the same reaction says more of what it covers.
            let is_told = |key: FactKey| {
                rows.iter().any(|other| {
                    (other.fluent, other.when) == (row.fluent, row.when)
                        && other.key != row.key
                        && row.key.covers(other.key)
                        && other.key.covers(key)
                })
            };
            self.facts.change(
                row.fluent,
                row.key,
                |key, known| {
                    if is_told(key) { known } else { known.join(row.value) }
                },
            );
        }
        for (row, value) in single {
            if self.facts.get(row.fluent, row.key) != value {
                self.facts.set(row.fluent, row.key, value);
            }
        }
        self.volatile = rows;
    }

    /// Proves a reaction from the states in which it can start.
    fn react(&mut self, id: StepId, when: &When, states: &Delta, mark: usize) {
        self.facts.replay(states);
        self.live = self.assume(&when.condition, true, Cause::step(id), CallFrame::default());
        if !self.live && constant(&when.condition) {
            self.diagnostics.push(NeverFires { span: when.span }.into());
        }
        if self.live {
            let depth = self.enclosing.len();
            let exhausted = self.library.lang_items.exhausted;
            match &when.reaction {
                Reaction::Pause { .. } => self.throw(TIMEOUT, depth),
                Reaction::Restart { .. } => {
                    if let Some(kind) = exhausted {
                        self.throw(kind, depth);
                    }
                }
                Reaction::Resume { body, .. } => {
                    if let Some(kind) = exhausted {
                        self.throw(kind, depth);
                    }
                    self.block(body);
                }
                Reaction::End { kind, of, .. } => self.end(None, *kind, *of, when.span),
            }
        } else if let Reaction::Resume { body, .. } = &when.reaction {
            // A condition that only the environment can bring about still needs its block proved.
            self.live = true;
            self.block(body);
        }
        self.back_to(mark);
        self.live = true;
    }
}

/// Whether a condition is the same whatever happens.
fn constant(condition: &Condition) -> bool {
    match condition {
        Condition::Literal(_) => true,
        Condition::Compare(_, left, right) => fixed(left) && fixed(right),
        Condition::Not(inner) => constant(inner),
        Condition::All(parts) | Condition::AnyOf(parts) => parts.iter().all(constant),
        Condition::Fact(_)
        | Condition::MonitoredMeasure(_)
        | Condition::MonitoredFluent(_)
        | Condition::Unknown => false,
    }
}

fn fixed(term: &Term) -> bool {
    match term {
        Term::Bool(_) | Term::Int(_) | Term::Number(_) | Term::Text(_) | Term::Case(..) | Term::Entity(_) => {
            true
        }
        Term::Field(of, _) => fixed(of),
        Term::Arith(_, left, right) => fixed(left) && fixed(right),
        Term::List(items) => items.iter().all(fixed),
        Term::Binding(_) | Term::Param(_) | Term::Result | Term::Each | Term::Measure(..) | Term::Unknown => {
            false
        }
    }
}

/// Looks up an entity.
type Lookup<'l> = &'l mut dyn FnMut(&Term) -> Option<u16>;

fn visit(condition: &Condition, watched: &mut Watched, lookup: Lookup<'_>) {
    match condition {
        Condition::Fact(fact) => watched.fluents.push(fact.fluent),
        Condition::Compare(_, left, right) => {
            visit_term(left, watched, lookup);
            visit_term(right, watched, lookup);
        }
        Condition::Not(inner) => visit(inner, watched, lookup),
        Condition::All(parts) | Condition::AnyOf(parts) => {
            parts.iter().for_each(|part| visit(part, watched, lookup));
        }
        Condition::Literal(_)
        | Condition::MonitoredMeasure(_)
        | Condition::MonitoredFluent(_)
        | Condition::Unknown => {}
    }
}

fn visit_term(term: &Term, watched: &mut Watched, lookup: Lookup<'_>) {
    match term {
        Term::Measure(id, args) => {
            watched.measures.push(*id);
            watched.near.extend(args.iter().filter_map(lookup).map(Entity));
        }
        Term::Arith(_, left, right) => {
            visit_term(left, watched, lookup);
            visit_term(right, watched, lookup);
        }
        _ => {}
    }
}
