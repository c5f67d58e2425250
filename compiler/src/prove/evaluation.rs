//! Evaluation of conditions and terms on the fact store.

use motet_syntax::ast::{ArithOp, CompareOp};
use smallvec::SmallVec;

use super::Prover;
use crate::facts::{ANY, Cause, FactKey, TruthSet, effort};
use crate::ir::{Base, Catch, Condition, Entity, Fact, Fluent, Kind, StepKind, Term};

/// Meaning of a contract's parameters, result and quantified variable at one call.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CallFrame<'c> {
    pub(crate) args: &'c [Term],
    pub(crate) result: Option<Entity>,
    pub(crate) each: Option<Entity>,
}

/// Maximal number of entities behind a symbol that are examined one by one.
pub(super) const MAX_ALIASES: usize = 64;
/// Maximal number of facts of a pattern that are examined one by one.
const MAX_FACTS: usize = MAX_ALIASES * MAX_ALIASES;

impl Prover<'_> {
    /// Argument of a key; `None` if the term's entity is unknown.
    pub(crate) fn argument(&self, term: &Term, frame: CallFrame<'_>) -> Option<u16> {
        match term {
            Term::Entity(entity) => Some(entity.0),
            Term::Case(_, case) => Some(*case),
            Term::Binding(id) => self.symbols.of_binding(id.index()).map(|entity| entity.0),
            Term::Param(index) => match frame.args.get(usize::from(*index))? {
                // An argument is never itself a parameter, so this ends.
                Term::Param(_) => None,
                term => self.argument(term, frame),
            },
            Term::First(list) => {
                let Term::List(items) = self.literal(list, frame)? else { return None };
                self.argument(items.first()?, frame)
            }
            Term::Result => frame.result.map(|entity| entity.0),
            Term::Each => frame.each.map(|entity| entity.0),
            _ => None,
        }
    }

    /// Key of a fact; `None` if an argument is unknown. An unbound `each` becomes `any`.
    pub(crate) fn key(&self, fact: &Fact, frame: CallFrame<'_>) -> Option<FactKey> {
        let mut key = FactKey(0);
        for (index, term) in fact.args.iter().enumerate() {
            let arg = match term {
                None => self.only_case(fact.fluent, index).unwrap_or(ANY),
                Some(Term::Each) if frame.each.is_none() => ANY,
                Some(term) => self.argument(term, frame)?,
            };
            key = key.with(index, arg);
        }
        Some(key)
    }

    /// Key of a fact, in which each argument that is unknown is `any`.
    pub(super) fn widest_key(&self, fact: &Fact, frame: CallFrame<'_>) -> FactKey {
        let args = fact.args.iter().enumerate().map(|(index, term)| match term {
            None => self.only_case(fact.fluent, index).unwrap_or(ANY),
            Some(term) => self.argument(term, frame).unwrap_or(ANY),
        });
        FactKey::new(args)
    }

    /// The case that `any` stands for, where the enumeration of a parameter has one: the hand of a robot with
    /// one hand.
    fn only_case(&self, fluent: Fluent, index: usize) -> Option<u16> {
        let (_, ty) = self.library.fluent(fluent)?.params.get(index)?;
        let Base::Enum(of) = ty.base else { return None };
        let cases = &self.library.enums.get(of.index())?.cases;
        (ty.lists == 0 && cases.len() == 1).then_some(0)
    }

    /// Value of a single fact, resolved through symbols.
    pub(crate) fn read(&self, fluent: Fluent, key: FactKey) -> TruthSet {
        if self.symbols.is_empty() || self.state.facts.entry(fluent, key).is_some() {
            return self.state.facts.get(fluent, key);
        }
        let Some(def) = self.library.fluent(fluent) else { return self.state.facts.get(fluent, key) };
        for (index, (_, ty)) in def.params.iter().enumerate() {
            let entity = Entity(key.arg(index));
            if ty.kind().is_none() {
                continue;
            }
            let Some(symbol) = self.symbols.get(entity) else { continue };
            // The fact of a symbol is what all that it may be agree on, and unobserved where they do not.
            let all;
            let candidates: &[Entity] = match &symbol.may_be {
                Some(list) => list,
                None => {
                    all = self.of_kind(symbol.kind, MAX_ALIASES + 1);
                    &all
                }
            };
            if candidates.len() > MAX_ALIASES {
                return TruthSet::open(Cause::NOTHING);
            }
            let generic = symbol.may_be.is_none().then(|| self.state.facts.get(fluent, key));
            let known = candidates.iter().map(|candidate| self.value(fluent, key.with(index, candidate.0)));
            let mut values = known.chain(generic);
            let Some(first) = values.next() else { return self.state.facts.get(fluent, key) };
            return if values.all(|value| value.same_set(first)) {
                first
            } else {
                TruthSet::open(Cause::NOTHING)
            };
        }
        self.state.facts.get(fluent, key)
    }

    /// Returns whether an entity or symbol is of a kind.
    pub(crate) fn is_of_kind(&self, entity: Entity, kind: Kind) -> bool {
        self.symbols.kind(self.environment, entity).is_some_and(|found| self.library.is_kind(found, kind))
    }

    /// Entities of a kind in the environment, at most `most`.
    pub(crate) fn of_kind(&self, kind: Kind, most: usize) -> Vec<Entity> {
        effort::spend(self.environment.entities().len());
        let entities = self.environment.entities().iter();
        let fitting = entities.filter(|(.., other)| self.library.is_kind(*other, kind));
        fitting.map(|(id, ..)| id).take(most).collect()
    }

    /// Possible values of a condition.
    pub(crate) fn evaluate(&self, condition: &Condition, frame: CallFrame<'_>) -> TruthSet {
        effort::spend(1);
        if effort::is_used_up() {
            // The proof is given up at the next step.
            return TruthSet::NOTHING_KNOWN;
        }
        match condition {
            Condition::Literal(value) => TruthSet::of(*value, Cause::NOTHING),
            // An error that was reported: neither it nor its negation is refuted.
            Condition::Unknown => TruthSet::default(),
            Condition::Fact(fact) => self.evaluate_fact(fact, frame),
            Condition::Compare(op, left, right) => {
                let known = self.compare(*op, left, right, frame);
                if known == TruthSet::NOTHING_KNOWN { self.recall(*op, left, right) } else { known }
            }
            Condition::MonitoredMeasure(id) => {
                let watched = self.state.watched.iter().any(|watched| watched.measures.contains(id));
                TruthSet::of(watched, Cause::NOTHING)
            }
            Condition::MonitoredFluent(id) => {
                let watched = self.state.watched.iter().any(|watched| watched.fluents.contains(id));
                TruthSet::of(watched, Cause::NOTHING)
            }
            Condition::Not(inner) => self.evaluate(inner, frame).not(),
            Condition::All(parts) => {
                let parts = parts.iter().map(|part| self.evaluate(part, frame));
                parts.fold(TruthSet::yes(Cause::NOTHING), TruthSet::and)
            }
            Condition::AnyOf(parts) => {
                let parts = parts.iter().map(|part| self.evaluate(part, frame));
                parts.fold(TruthSet::no(Cause::NOTHING), TruthSet::or)
            }
        }
    }

    fn evaluate_fact(&self, fact: &Fact, frame: CallFrame<'_>) -> TruthSet {
        let Some(key) = self.key(fact, frame) else { return TruthSet::NOTHING_KNOWN };
        if self.library.fluent(fact.fluent).is_some_and(|def| def.derived) {
            return TruthSet::NOTHING_KNOWN;
        }
        self.value(fact.fluent, key)
    }

    /// Value of a fact, or of a pattern: whether some fact that it covers holds.
    pub(super) fn value(&self, fluent: Fluent, key: FactKey) -> TruthSet {
        if !key.is_pattern() {
            return self.read(fluent, key);
        }
        // Some entity: all the rest, then those that are known one by one, in an order of their own: the
        // cause is the last one's.
        let known = self.known_parts(fluent, key);
        let rest = self.rest(fluent, key, &known);
        known.into_iter().fold(rest, |some, part| {
            let value = if part.is_pattern() {
                self.rest(fluent, part, &self.known_parts(fluent, part))
            } else {
                self.read(fluent, part)
            };
            value.or(some)
        })
    }

    /// Facts and patterns with values of their own that a pattern covers, in order.
    fn known_parts(&self, fluent: Fluent, pattern: FactKey) -> SmallVec<[FactKey; 8]> {
        let mut known = SmallVec::new();
        self.state.facts.parts(fluent, pattern, |key| known.push(key));
        known.sort_unstable();
        known.dedup();
        known
    }

    /// Value of the facts of a pattern that have no value of their own.
    fn rest(&self, fluent: Fluent, pattern: FactKey, known: &[FactKey]) -> TruthSet {
        let rest = self.read(fluent, pattern);
        if rest.yes.is_some() && !known.is_empty() && self.are_all(fluent, pattern, known) {
            // There may be no rest that has it.
            return rest.join(TruthSet::no(Cause::NOTHING));
        }
        rest
    }

    /// Returns whether some facts and patterns may be all that a pattern covers, of the entities of the
    /// environment.
    fn are_all(&self, fluent: Fluent, pattern: FactKey, known: &[FactKey]) -> bool {
        let Some(def) = self.library.fluent(fluent) else { return false };
        let has_patterns = known.iter().any(|key| key.is_pattern());
        let most = if has_patterns { MAX_ALIASES } else { known.len() };
        let open = def.params.iter().enumerate().filter(|(index, _)| pattern.arg(*index) == ANY);
        let args: Vec<(usize, Vec<u16>)> = open
            .map(|(index, (_, ty))| match (ty.kind(), ty.base) {
                (Some(kind), _) => {
                    let entities = self.of_kind(kind, most + 1).into_iter();
                    (index, entities.map(|entity| entity.0).collect())
                }
                (None, Base::Enum(of)) => {
                    let cases = self.library.enums.get(of.index()).map_or(0, |of| of.cases.len());
                    (index, (0..).take(cases).collect())
                }
                (None, _) => (index, Vec::new()),
            })
            .collect();
        let all = args.iter().fold(1, |all: usize, (_, choices)| all.saturating_mul(choices.len()));
        let named: Vec<FactKey> =
            known.iter().copied().filter(|key| !self.has_symbol(fluent, *key)).collect();
        if !has_patterns {
            return all <= named.len();
        }
        // Each of them, one after the other: the choices are the digits of its number.
        effort::spend(all.min(MAX_FACTS).saturating_mul(named.len()));
        all > MAX_FACTS
            || (0..all).all(|mut number| {
                let fact = args.iter().fold(pattern, |fact, (index, choices)| {
                    let choice = choices.get(number % choices.len().max(1)).copied().unwrap_or(ANY);
                    number /= choices.len().max(1);
                    fact.with(*index, choice)
                });
                named.iter().any(|key| key.covers(fact))
            })
    }

    fn compare(&self, op: CompareOp, left: &Term, right: &Term, frame: CallFrame<'_>) -> TruthSet {
        if let (Some(a), Some(b)) = (self.number(left, frame), self.number(right, frame)) {
            let holds = match op {
                CompareOp::Equal => a == b,
                CompareOp::Unequal => a != b,
                CompareOp::Less => a < b,
                CompareOp::AtMost => a <= b,
                CompareOp::More => a > b,
                CompareOp::AtLeast => a >= b,
            };
            return TruthSet::of(holds, Cause::START);
        }
        let equal = match op {
            CompareOp::Equal => true,
            CompareOp::Unequal => false,
            CompareOp::Less | CompareOp::AtMost | CompareOp::More | CompareOp::AtLeast => {
                return TruthSet::NOTHING_KNOWN;
            }
        };
        let caught = self.caught(left, right).or_else(|| self.caught(right, left));
        let same = match (self.argument(left, frame), self.argument(right, frame)) {
            _ if caught.is_some() => caught,
            (Some(a), Some(b)) if a == b => Some(true),
            (Some(a), Some(b)) => {
                let may = self.symbols.may_equal(self.library, self.environment, Entity(a), Entity(b));
                (!may).then_some(false)
            }
            _ => match (self.literal(left, frame), self.literal(right, frame)) {
                (Some(Term::Text(a)), Some(Term::Text(b))) => Some(a == b),
                (Some(Term::Bool(a)), Some(Term::Bool(b))) => Some(a == b),
                _ => None,
            },
        };
        same.map_or(TruthSet::NOTHING_KNOWN, |same| TruthSet::of(same == equal, Cause::START))
    }

    /// Equality of the kind of a failure that a handler caught and a kind, where the handler catches only
    /// that kind, or not that kind.
    fn caught(&self, term: &Term, kind: &Term) -> Option<bool> {
        let (Term::Binding(id), Term::Case(_, kind)) = (term, kind) else { return None };
        let binder = self.program.bindings.get(id.index())?.binders.first()?;
        let StepKind::Try { catches, .. } = &self.program.step(*binder)?.kind else { return None };
        let is_its = |catch: &&Catch| catch.binds.is_some_and(|caught| caught.kind == *id);
        let mut on = catches.iter().find(is_its)?.on.as_ref()?.iter().map(|(on, _)| on.0 == *kind);
        let first = on.next()?;
        on.all(|other| other == first).then_some(first)
    }

    fn literal<'t>(&self, term: &'t Term, frame: CallFrame<'t>) -> Option<&'t Term> {
        match term {
            Term::Param(index) => frame.args.get(usize::from(*index)),
            term => Some(term),
        }
    }

    /// Number of a term, if it is constant.
    pub(crate) fn number(&self, term: &Term, frame: CallFrame<'_>) -> Option<f64> {
        match term {
            Term::Int(value) => Some(*value as f64),
            Term::Number(value) => Some(*value),
            Term::Param(index) => match frame.args.get(usize::from(*index))? {
                Term::Param(_) => None,
                term => self.number(term, frame),
            },
            Term::Field(of, name) => self.environment.number(Entity(self.argument(of, frame)?), name),
            Term::Arith(op, left, right) => {
                let (a, b) = (self.number(left, frame)?, self.number(right, frame)?);
                let value = match op {
                    ArithOp::Add => a + b,
                    ArithOp::Subtract => a - b,
                    ArithOp::Multiply => a * b,
                    ArithOp::Divide => a / b,
                };
                value.is_finite().then_some(value)
            }
            // An argument may be a list that is written out.
            Term::Count(list) => match self.literal(list, frame)? {
                Term::List(items) => Some(items.len() as f64),
                _ => None,
            },
            _ => None,
        }
    }
}
