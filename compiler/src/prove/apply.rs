//! What a step does to the facts: effects, what it unsettles, and what it makes stale.

use motet_syntax::ast::{CompareOp, PrimitiveKind};

use super::Prover;
use super::eval::{Frame, MAX_ALIASES};
use super::facts::{ANY, Key};
use super::value::{Cause, Value};
use smallvec::SmallVec;
use smol_str::SmolStr;

use crate::ir::{Condition, Entity, Fluent, Kind, StepId, Term, Ty};
use crate::library::{EffectDef, PrimitiveDef, ResourceSet};

/// A change that a step will make, worked out in the state before it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Change {
    pub(crate) fluent: Fluent,
    pub(crate) key: Key,
    pub(crate) truth: bool,
    sure: Sure,
}

impl Change {
    /// Whether it happens on every path.
    pub(crate) fn is_sure(&self) -> bool {
        self.sure == Sure::Always
    }
}

/// Whether the condition of an effect holds.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Sure {
    /// On every path.
    Always,
    /// On some paths.
    Sometimes,
    /// Only observation can tell.
    Unknown,
    /// An argument was reported as wrong: it may be about anything, and nothing is known of that.
    Misread,
}

/// Entities that a contract speaks of: few, as a rule.
type Entities = SmallVec<[Entity; 8]>;

/// Until when a perception stays true.
#[derive(Clone, Debug)]
pub(crate) struct Lasting {
    pub(crate) resources: ResourceSet,
    pub(crate) entities: Vec<Entity>,
}

impl Prover<'_> {
    /// The changes of a list of effects, worked out in the state as it is.
    pub(crate) fn changes(&self, effects: &[EffectDef], frame: Frame<'_>, changes: &mut Vec<Change>) {
        changes.clear();
        for effect in effects {
            match effect.each {
                None => self.change(effect, frame, changes),
                Some(kind) => self.change_each(effect, kind, frame, changes),
            }
        }
        // A fact that is both made and unmade is made.
        changes.sort_by_key(|change| change.truth);
    }

    fn change(&self, effect: &EffectDef, frame: Frame<'_>, changes: &mut Vec<Change>) {
        let sure = effect.when.as_ref().map_or(Some(Sure::Always), |when| sure(self.evaluate(when, frame)));
        let Some(sure) = sure else { return };
        let fluent = effect.fact.fluent;
        match self.key(&effect.fact, frame) {
            Some(key) => changes.push(Change { fluent, key, truth: effect.value, sure }),
            None => changes.push(Change { fluent, key: Key::ALL, truth: effect.value, sure: Sure::Misread }),
        }
    }

    /// After a step of which nothing is known, nothing is known of anything.
    pub(crate) fn forget_all(&mut self, cause: Cause) {
        for index in 0..self.library.fluents.len() {
            let fluent = Fluent(u16::try_from(index).unwrap_or(u16::MAX));
            self.facts.set(fluent, Key::ALL, Value::open(cause));
        }
    }

    fn change_each(&self, effect: &EffectDef, kind: Kind, frame: Frame<'_>, changes: &mut Vec<Change>) {
        let (known, rest) = self.candidates(effect.when.as_ref(), kind, frame);
        for candidate in &known {
            self.change(effect, Frame { each: Some(*candidate), ..frame }, changes);
        }
        let Some(sure) = rest else { return };
        if self.covers(effect, kind) {
            // Those of which nothing is known by name: one pattern for all of them.
            if let Some(key) = self.key(&effect.fact, Frame { each: None, ..frame }) {
                changes.push(Change { fluent: effect.fact.fluent, key, truth: effect.value, sure });
            }
            return;
        }
        // The fluent is also about entities of other kinds, which a pattern would take in: each by its name.
        let named = self.of_kind(kind, usize::MAX).into_iter();
        for entity in named.filter(|entity| known.binary_search(entity).is_err()) {
            self.change(effect, Frame { each: Some(entity), ..frame }, changes);
        }
        for (entity, symbol) in self.symbols.iter() {
            let first = changes.len();
            if self.library.is_kind(symbol.kind, kind) || self.library.is_kind(kind, symbol.kind) {
                self.change(effect, Frame { each: Some(entity), ..frame }, changes);
            }
            if !self.library.is_kind(symbol.kind, kind) {
                // It may be of the kind.
                changes.iter_mut().skip(first).for_each(|change| change.sure = Sure::Unknown);
            }
        }
    }

    /// Whether every entity that the fluent of an effect can be about, where the effect says `each`, is of a kind.
    fn covers(&self, effect: &EffectDef, kind: Kind) -> bool {
        let Some(def) = self.library.fluent(effect.fact.fluent) else { return true };
        let mut places = effect.fact.args.iter().zip(&def.params);
        places.all(|(arg, (_, ty))| {
            *arg != Some(Term::Each) || ty.kind().is_none_or(|all| self.library.is_kind(all, kind))
        })
    }

    /// The entities of a kind for which `when` may hold: by name, and whether it may hold for others too.
    fn candidates(&self, when: Option<&Condition>, kind: Kind, frame: Frame<'_>) -> (Entities, Option<Sure>) {
        match when {
            None => (Entities::new(), Some(Sure::Always)),
            Some(
                Condition::Compare(CompareOp::Equal, Term::Each, other)
                | Condition::Compare(CompareOp::Equal, other, Term::Each),
            ) => {
                let only = self.argument(other, frame).map(Entity);
                let fits = |entity: &Entity| self.is_of_kind(*entity, kind);
                (only.filter(fits).into_iter().collect(), None)
            }
            Some(Condition::Fact(fact)) => {
                let Some(pattern) = self.key(fact, Frame { each: None, ..frame }) else {
                    return (Entities::new(), None);
                };
                let place = fact.args.iter().position(|arg| *arg == Some(Term::Each));
                let Some(place) = place else { return (self.of_kind(kind, usize::MAX).into(), None) };
                let mut known = Entities::new();
                let mut rest = Value::default();
                let Some(aliases) = self.aliases(fact.fluent, pattern) else {
                    return (Entities::new(), Some(Sure::Unknown));
                };
                for pattern in aliases {
                    rest = rest.join(self.facts.get(fact.fluent, pattern));
                    self.facts.entries(fact.fluent, pattern, |key, value| {
                        let entity = Entity(key.arg(place));
                        if !value.is_false() && self.is_of_kind(entity, kind) {
                            known.push(entity);
                        }
                    });
                }
                known.sort_unstable();
                known.dedup();
                (known, if rest.is_false() { None } else { sure(rest) })
            }
            Some(_) => (self.of_kind(kind, usize::MAX).into(), None),
        }
    }

    /// A pattern, and the same of all that the symbols in it may be; none where those are too many to look at.
    fn aliases(&self, fluent: Fluent, pattern: Key) -> Option<SmallVec<[Key; 4]>> {
        let mut found: SmallVec<[Key; 4]> = SmallVec::from_slice(&[pattern]);
        if self.symbols.is_empty() || self.facts.entry(fluent, pattern).is_some() {
            return Some(found);
        }
        let params = self.library.fluent(fluent).map(|def| def.params.as_slice()).unwrap_or_default();
        for (index, _) in params.iter().enumerate().filter(|(_, (_, ty))| ty.kind().is_some()) {
            let Some(symbol) = self.symbols.get(Entity(pattern.arg(index))) else { continue };
            let all;
            let may_be: &[Entity] = match &symbol.may_be {
                Some(list) => list,
                None => {
                    all = self.of_kind(symbol.kind, MAX_ALIASES + 1);
                    &all
                }
            };
            if may_be.len().saturating_mul(found.len()) > MAX_ALIASES {
                return None;
            }
            let known = found.clone();
            found.extend(may_be.iter().flat_map(|entity| known.iter().map(|key| key.with(index, entity.0))));
        }
        Some(found)
    }

    /// For which entities a quantified need is asked, and whether there may be others.
    pub(crate) fn asked(&self, when: Option<&Condition>, kind: Kind, frame: Frame<'_>) -> (Entities, bool) {
        match when {
            None => (self.of_kind(kind, usize::MAX).into(), false),
            Some(_) => {
                let (known, rest) = self.candidates(when, kind, frame);
                (known, rest.is_some())
            }
        }
    }

    /// Makes changes: negative first, so that what is made wins.
    pub(crate) fn make(&mut self, changes: &[Change], cause: Cause) {
        for change in changes {
            let new = Value::of(change.truth, cause);
            match change.sure {
                Sure::Always => self.write(change, cause, |_| new),
                Sure::Sometimes => self.write(change, cause, |old| old.join(new)),
                Sure::Unknown => self.write(change, cause, |old| old.maybe(new, cause)),
                Sure::Misread => self.write(change, cause, |_| Value::open(cause)),
            }
        }
    }

    /// Leaves the facts of changes unobserved.
    pub(crate) fn unsettle(&mut self, changes: &[Change], cause: Cause) {
        let open = Value::open(cause);
        for change in changes {
            match change.sure {
                Sure::Sometimes => self.write(change, cause, |old| old.join(open)),
                Sure::Always | Sure::Unknown | Sure::Misread => self.write(change, cause, |_| open),
            }
        }
    }

    /// Writes a fact, and lets those that may be the same feel it.
    fn write(&mut self, change: &Change, cause: Cause, new: impl Fn(Value) -> Value) {
        let Change { fluent, key, sure, .. } = *change;
        if sure == Sure::Always {
            self.facts.set(fluent, key, new(Value::default()));
        } else if self.symbols.is_empty() || key.is_pattern() {
            self.facts.change(fluent, key, |_, old| new(old));
        } else {
            // What is known of a binding is what is known of all that it may be.
            let known = self.read(fluent, key);
            self.facts.set(fluent, key, new(known));
        }
        if self.symbols.is_empty() {
            return;
        }
        // Only a symbol can be the same as something else.
        let symbolic = self.has_symbol(fluent, key);
        if let Some(aliased) = self.aliased.get_mut(fluent.index()) {
            *aliased |= symbolic;
            if *aliased {
                let value = self.facts.get(fluent, key);
                self.echo(fluent, key, value, cause);
            }
        }
    }

    /// Whether an argument of a fact is an entity of which it is not known which it is.
    fn has_symbol(&self, fluent: Fluent, key: Key) -> bool {
        self.library.fluent(fluent).is_some_and(|def| {
            let entities = def.params.iter().enumerate().filter(|(_, (_, ty))| ty.kind().is_some());
            entities.into_iter().any(|(index, _)| self.symbols.get(Entity(key.arg(index))).is_some())
        })
    }

    /// An effect on one entity is a possible effect on all that it may be.
    fn echo(&mut self, fluent: Fluent, key: Key, value: Value, cause: Cause) {
        let library = self.library;
        let Some(def) = library.fluent(fluent) else { return };
        let mut targets: Vec<(Key, Value)> = Vec::new();
        let mut feels = |other: Key, known: Value| {
            if other != key && !key.covers(other) && self.may_be_same(&def.params, key, other) {
                targets.push((other, known));
            }
        };
        if self.has_symbol(fluent, key) {
            self.facts.entries(fluent, Key::ALL, &mut feels);
        } else {
            // What is no symbol may be one, and the facts at the start speak of none.
            self.facts.written(fluent, &mut feels);
        }
        // Entities behind a symbol that have no entry yet.
        for (index, (_, ty)) in def.params.iter().enumerate() {
            let symbol = self.symbols.get(Entity(key.arg(index))).filter(|_| ty.kind().is_some());
            let Some(symbol) = symbol else { continue };
            let candidates = symbol.may_be.clone().unwrap_or_else(|| self.of_kind(symbol.kind, usize::MAX));
            for candidate in candidates {
                let other = key.with(index, candidate.0);
                if !other.is_pattern() && self.facts.entry(fluent, other).is_none() {
                    targets.push((other, self.facts.get(fluent, other)));
                }
            }
        }
        for (other, known) in targets {
            let felt = known.maybe(value, cause);
            if felt != known {
                self.facts.set(fluent, other, felt);
            }
        }
    }

    fn may_be_same(&self, params: &[(SmolStr, Ty)], a: Key, b: Key) -> bool {
        params.iter().enumerate().all(|(index, (_, ty))| {
            let (one, two) = (a.arg(index), b.arg(index));
            one == two
                || one == ANY
                || two == ANY
                || (ty.kind().is_some()
                    && self.symbols.may_equal(self.library, self.world, Entity(one), Entity(two)))
        })
    }

    /// What a perception found is stale once a step uses its resource or moves its object.
    pub(crate) fn make_stale(&mut self, step: StepId, def: &PrimitiveDef, frame: Frame<'_>) {
        if self.lasting.is_empty() {
            return;
        }
        let mut moved = None;
        let mut stale: SmallVec<[_; 8]> = SmallVec::new();
        for fluent in self.library.perceived.iter().copied().chain([self.fresh]) {
            self.facts.written(fluent, |key, value| {
                let Some(source) = value.yes.as_step().filter(|source| *source != step) else { return };
                let Some(lasting) = self.lasting.get(&source) else { return };
                let used = lasting.resources & def.uses != 0;
                let mut has_moved =
                    |entity| moved.get_or_insert_with(|| self.moved(def, frame)).contains(entity);
                if used || lasting.entities.iter().any(&mut has_moved) {
                    stale.push((fluent, key, value));
                }
            });
        }
        // The order of a table is not that of the document.
        stale.sort_unstable_by_key(|(fluent, key, _)| (*fluent, *key));
        let cause = Cause::step(step);
        for (fluent, key, value) in stale {
            let rest = Value { yes: Cause::NONE, ..value };
            let gone = if fluent == self.fresh { Value::no(cause) } else { Value::open(cause) };
            self.facts.set(fluent, key, rest.join(gone));
        }
    }

    /// Entities whose place a step changes: those that an action's effects name first.
    fn moved(&self, def: &PrimitiveDef, frame: Frame<'_>) -> Entities {
        if def.form == PrimitiveKind::Perception {
            return Entities::new();
        }
        let named = |effect: &&EffectDef| effect.fact.args.first().is_some_and(Option::is_some);
        let effects = def.makes.iter().chain(&def.unsettles).filter(named);
        let mut moved: Entities = effects
            .filter_map(|effect| self.argument(effect.fact.args.first()?.as_ref()?, frame))
            .map(Entity)
            .collect();
        moved.dedup();
        moved
    }
}

fn sure(value: Value) -> Option<Sure> {
    if value.open.is_some() {
        Some(Sure::Unknown)
    } else if value.no.is_some() && value.yes.is_some() {
        Some(Sure::Sometimes)
    } else {
        value.yes.is_some().then_some(Sure::Always)
    }
}
