//! Candidates of a quantified need or effect: the entities of a kind for which its `when` may hold.

use motet_syntax::ast::{CompareOp, PrimitiveKind};
use smallvec::SmallVec;

use super::Prover;
use super::effects::{Certainty, Entities, certainty};
use super::evaluation::CallFrame;
use crate::declare::{NeedDef, PrimitiveDef};
use crate::facts::{ANY, FactKey, TruthSet, effort};
use crate::ir::{Base, Condition, Entity, Fact, Kind, Term, Ty};

/// Entities of a kind for which a condition may hold.
#[derive(Debug, Default)]
pub(crate) struct Candidates {
    /// Those that are of the kind.
    pub(crate) known: Entities,
    /// Symbols of a wider kind: what they stand for may be of this one.
    pub(crate) doubtful: Entities,
    /// Certainty with which it holds for those that have no name; `None` if it does not.
    pub(crate) rest: Option<Certainty>,
}

impl Prover<'_> {
    /// Entities of a kind for which a quantified need is asked.
    pub(crate) fn asked(&self, need: &NeedDef, kind: Kind, frame: CallFrame<'_>) -> Candidates {
        if need.when.is_some() {
            return self.candidates(need.when.as_ref(), kind, frame);
        }
        let is_about_each =
            |part: &Condition| matches!(part, Condition::Fact(fact) if fact.args.contains(&Some(Term::Each)));
        let found = self.named(kind);
        Candidates { rest: found.rest.filter(|_| need.condition.any(&is_about_each)), ..found }
    }

    /// Entities of a kind for which `when` may hold.
    pub(super) fn candidates(
        &self,
        when: Option<&Condition>,
        kind: Kind,
        frame: CallFrame<'_>,
    ) -> Candidates {
        let others = |rest| Candidates { rest: Some(rest), ..Candidates::default() };
        match when {
            None => others(Certainty::Always),
            Some(
                Condition::Compare(CompareOp::Equal, Term::Each, other)
                | Condition::Compare(CompareOp::Equal, other, Term::Each),
            ) => {
                // Nobody knows which one it is.
                let Some(only) = self.argument(other, frame) else { return others(Certainty::Unknown) };
                let mut found = Candidates::default();
                self.sort(Entity(only), kind, &mut found);
                found
            }
            Some(Condition::Fact(fact)) if fact.args.contains(&Some(Term::Each)) => {
                self.candidates_by_fact(fact, kind, frame)
            }
            Some(_) => self.named(kind),
        }
    }

    /// Entities of a kind of which a fact may hold.
    fn candidates_by_fact(&self, fact: &Fact, kind: Kind, frame: CallFrame<'_>) -> Candidates {
        let unknown = Candidates { rest: Some(Certainty::Unknown), ..Candidates::default() };
        let key = self.key(fact, CallFrame { each: None, ..frame });
        let place = fact.args.iter().position(|arg| *arg == Some(Term::Each));
        let Some((pattern, place)) = key.zip(place) else { return unknown };
        let has_entry = self.state.facts.entry(fact.fluent, pattern).is_some();
        let aliases = if has_entry {
            Some(SmallVec::from_slice(&[pattern]))
        } else {
            self.aliases(fact.fluent, pattern)
        };
        let Some(aliases) = aliases else { return unknown };
        let (mut found, mut rest) = (Candidates::default(), TruthSet::default());
        for pattern in aliases {
            rest = rest.join(self.state.facts.get(fact.fluent, pattern));
            let mut parts: SmallVec<[FactKey; 8]> = SmallVec::new();
            self.state.facts.parts(fact.fluent, pattern, |key| parts.push(key));
            for key in parts {
                let value = self.state.facts.get(fact.fluent, key);
                if value.is_false() {
                    continue;
                }
                if key.arg(place) == ANY {
                    // It may hold for any of them.
                    rest = rest.join(value);
                } else {
                    self.sort(Entity(key.arg(place)), kind, &mut found);
                }
            }
        }
        for entities in [&mut found.known, &mut found.doubtful] {
            entities.sort_unstable();
            entities.dedup();
        }
        found.rest = if rest.is_false() { None } else { certainty(rest) };
        found
    }

    /// Adds an entity to the candidates of a kind, if it may be one.
    fn sort(&self, entity: Entity, kind: Kind, found: &mut Candidates) {
        if self.is_of_kind(entity, kind) {
            found.known.push(entity);
        } else if self.symbols.get(entity).is_some_and(|symbol| self.library.is_kind(kind, symbol.kind)) {
            found.doubtful.push(entity);
        }
    }

    /// Returns whether all entities of a kind have a name: in a closed world without perceptions of any.
    pub(super) fn are_all_named(&self, kind: Kind) -> bool {
        let is_found = |def: &PrimitiveDef| match def.result {
            Some(Ty { base: Base::Entity(of), .. }) if def.form == PrimitiveKind::Perception => {
                self.library.is_kind(of, kind) || self.library.is_kind(kind, of)
            }
            _ => false,
        };
        self.library.closed_world && !self.library.primitives.iter().any(is_found)
    }

    /// All entities of a kind that have a name. Where the environment has none of the kind, there may be
    /// others.
    fn named(&self, kind: Kind) -> Candidates {
        let known: Entities = self.of_kind(kind, usize::MAX).into();
        let rest = known.is_empty().then_some(Certainty::Unknown);
        let mut found = Candidates { known, rest, ..Candidates::default() };
        effort::spend(self.symbols.len().1);
        self.symbols.iter().for_each(|(symbol, _)| self.sort(symbol, kind, &mut found));
        found
    }
}
