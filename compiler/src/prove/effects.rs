//! Effects on the facts: makes, unsettles, and stale perceptions.

use std::cell::OnceCell;

use motet_syntax::ast::PrimitiveKind;

use super::Prover;
use super::call::pose_step;
use super::candidates::Candidates;
use super::evaluation::{CallFrame, MAX_ALIASES};
use crate::facts::{ANY, Atom, Cause, FactKey, TruthSet, effort};
use smallvec::SmallVec;
use smol_str::SmolStr;

use crate::declare::{EffectDef, PerceptionLifetime, PrimitiveDef};
use crate::ir::{Condition, Entity, Fact, Fluent, Kind, NOBODY, StepId, Term, Ty};

/// Maximal number of facts that one with symbols may be, before all facts of its fluent are weakened.
const MAX_INSTANCES: usize = 4096;

/// A change of a fact by a step, computed in the state before it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FactChange {
    pub(crate) fluent: Fluent,
    pub(crate) key: FactKey,
    pub(crate) truth: bool,
    pub(super) sure: Certainty,
    /// Place of an argument, `any` in the key: only entities that have no name there feel the change.
    pub(super) nameless: Option<usize>,
}

impl FactChange {
    /// A change of a fact, or of all facts that a pattern covers.
    pub(super) fn new(fluent: Fluent, key: FactKey, truth: bool, sure: Certainty) -> Self {
        Self { fluent, key, truth, sure, nameless: None }
    }

    /// A fact that may have changed on some path.
    pub(super) fn perhaps(fluent: Fluent, key: FactKey) -> Self {
        Self::new(fluent, key, true, Certainty::Sometimes)
    }

    /// A fact of which nothing is known any more.
    pub(super) fn unknown(fluent: Fluent, key: FactKey) -> Self {
        Self { sure: Certainty::Unknown, ..Self::perhaps(fluent, key) }
    }

    /// Returns whether the change happens on every path.
    pub(crate) fn is_sure(&self) -> bool {
        self.sure == Certainty::Always
    }
}

/// Certainty of the condition of an effect.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Certainty {
    Always,
    Sometimes,
    Unknown,
    /// An argument has an error: the change may be about any entity.
    Misread,
}

/// Entities that a contract mentions: usually few.
pub(super) type Entities = SmallVec<[Entity; 8]>;

impl Prover<'_> {
    /// Computes the changes of effects in the present state.
    pub(crate) fn changes(&self, effects: &[EffectDef], frame: CallFrame<'_>, changes: &mut Vec<FactChange>) {
        changes.clear();
        for effect in effects.iter().take_while(|_| !effort::is_used_up()) {
            match effect.each {
                None => self.change(effect, frame, changes),
                Some(kind) => self.change_each(effect, kind, frame, changes),
            }
        }
        // A fact that is both made and unmade is made.
        changes.sort_by_key(|change| change.truth);
    }

    fn change(&self, effect: &EffectDef, frame: CallFrame<'_>, changes: &mut Vec<FactChange>) {
        effort::spend(effort::WRITE);
        let sure = effect
            .when
            .as_ref()
            .map_or(Some(Certainty::Always), |when| certainty(self.evaluate(when, frame)));
        let Some(sure) = sure else { return };
        let fluent = effect.fact.fluent;
        let key = self.key(&effect.fact, frame);
        let (key, sure) = key.map_or((FactKey::ALL, Certainty::Misread), |key| (key, sure));
        changes.push(FactChange::new(fluent, key, effect.value, sure));
    }

    /// Forgets all facts, after a step with an error.
    pub(crate) fn forget_all(&mut self, cause: Cause) {
        for index in 0..self.library.fluents.len() {
            let fluent = Fluent(u16::try_from(index).unwrap_or(u16::MAX));
            self.state.facts.set(fluent, FactKey::ALL, TruthSet::open(cause));
        }
    }

    fn change_each(
        &self,
        effect: &EffectDef,
        kind: Kind,
        frame: CallFrame<'_>,
        changes: &mut Vec<FactChange>,
    ) {
        let Candidates { known, doubtful, rest } = self.candidates(effect.when.as_ref(), kind, frame);
        for candidate in &known {
            self.change(effect, CallFrame { each: Some(*candidate), ..frame }, changes);
        }
        let first = changes.len();
        for candidate in &doubtful {
            self.change(effect, CallFrame { each: Some(*candidate), ..frame }, changes);
        }
        changes.iter_mut().skip(first).for_each(|change| change.sure = change.sure.max(Certainty::Unknown));
        let Some(sure) = rest else {
            // Those that have a name are all among the candidates.
            let holds = |when: &Condition| {
                certainty(self.evaluate(when, CallFrame { each: Some(NOBODY), ..frame })).is_some()
            };
            if effect.when.as_ref().is_some_and(holds) {
                self.change_nameless(effect, frame, changes);
            }
            return;
        };
        if self.covers(effect, kind) {
            // Without an argument that tells them apart, it happens if there is one of them.
            let is_about = effect.fact.args.contains(&Some(Term::Each));
            let is_one = is_about || effect.when.is_none() && !self.of_kind(kind, 1).is_empty();
            let sure = if is_one { sure } else { sure.max(Certainty::Unknown) };
            // Those of which nothing is known by name: one pattern for all of them.
            if let Some(key) = self.key(&effect.fact, CallFrame { each: None, ..frame }) {
                changes.push(FactChange::new(effect.fact.fluent, key, effect.value, sure));
            }
            return;
        }
        self.change_nameless(effect, frame, changes);
        // The fluent is also about entities of other kinds, which a pattern would take in: each by its name.
        let named = self.of_kind(kind, usize::MAX).into_iter();
        for entity in named.filter(|entity| known.binary_search(entity).is_err()) {
            self.change(effect, CallFrame { each: Some(entity), ..frame }, changes);
        }
        effort::spend(self.symbols.len().1);
        for (entity, symbol) in self.symbols.iter() {
            let first = changes.len();
            if self.library.is_kind(symbol.kind, kind) || self.library.is_kind(kind, symbol.kind) {
                self.change(effect, CallFrame { each: Some(entity), ..frame }, changes);
            }
            if !self.library.is_kind(symbol.kind, kind) {
                // It may be of the kind.
                changes.iter_mut().skip(first).for_each(|change| change.sure = Certainty::Unknown);
            }
        }
    }

    /// Adds the change of the entities that have no name yet: nobody knows if there are any.
    fn change_nameless(&self, effect: &EffectDef, frame: CallFrame<'_>, changes: &mut Vec<FactChange>) {
        let fluent = effect.fact.fluent;
        let Some(key) = self.key(&effect.fact, CallFrame { each: None, ..frame }) else { return };
        if effect.each.is_some_and(|kind| self.are_all_named(kind)) {
            return;
        }
        let mut open = (0..effect.fact.args.len()).filter(|index| key.arg(*index) == ANY);
        let is_each = |place: &usize| effect.fact.args.get(*place) == Some(&Some(Term::Each));
        // Else the facts of a name cannot be told from the others: nothing is known of any.
        let nameless = open.next().filter(is_each).filter(|_| open.next().is_none());
        let nameless = nameless.filter(|_| !self.has_symbol(fluent, key));
        let change = FactChange::new(fluent, key, effect.value, Certainty::Unknown);
        changes.push(FactChange { nameless, ..change });
    }

    /// Returns whether one pattern covers what an effect is about, and nothing else: its `each` stands in one
    /// place, and all entities there are of a kind.
    fn covers(&self, effect: &EffectDef, kind: Kind) -> bool {
        let Some(def) = self.library.fluent(effect.fact.fluent) else { return true };
        if effect.fact.args.iter().filter(|arg| **arg == Some(Term::Each)).count() > 1 {
            return false;
        }
        let mut places = effect.fact.args.iter().zip(&def.params);
        places.all(|(arg, (_, ty))| {
            *arg != Some(Term::Each) || ty.kind().is_none_or(|all| self.library.is_kind(all, kind))
        })
    }

    /// A fact or pattern with all that it may be, whatever its symbols are.
    pub(super) fn instances(&self, (fluent, key): Atom) -> Vec<Atom> {
        let all = self.aliases(fluent, key);
        all.map_or_else(
            || vec![(fluent, FactKey::ALL)],
            |all| all.into_iter().map(|key| (fluent, key)).collect(),
        )
    }

    /// A pattern with all its instances under the entities that its symbols may be; `None` if these are too
    /// many.
    pub(super) fn aliases(&self, fluent: Fluent, pattern: FactKey) -> Option<SmallVec<[FactKey; 4]>> {
        let mut found: SmallVec<[FactKey; 4]> = SmallVec::from_slice(&[pattern]);
        if self.symbols.is_empty() {
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

    /// Writes changes, negative ones first, so that a fact that is both made and unmade holds.
    pub(crate) fn make(&mut self, changes: &[FactChange], cause: Cause) {
        for change in changes.iter().take_while(|_| !effort::is_used_up()) {
            let new = TruthSet::of(change.truth, cause);
            match change.sure {
                Certainty::Always => self.write(change, cause, |_| new),
                Certainty::Sometimes => self.write(change, cause, |old| old.join(new)),
                Certainty::Unknown => self.write(change, cause, |old| old.maybe(new, cause)),
                Certainty::Misread => self.write(change, cause, |_| TruthSet::open(cause)),
            }
        }
    }

    /// Makes the facts of changes unobserved.
    pub(crate) fn unsettle(&mut self, changes: &[FactChange], cause: Cause) {
        let open = TruthSet::open(cause);
        for change in changes.iter().take_while(|_| !effort::is_used_up()) {
            match change.sure {
                Certainty::Sometimes => self.write(change, cause, |old| old.join(open)),
                Certainty::Always | Certainty::Unknown | Certainty::Misread => {
                    self.write(change, cause, |_| open)
                }
            }
        }
    }

    /// Writes a fact, and weakens the facts that may be the same.
    fn write(&mut self, change: &FactChange, cause: Cause, new: impl Fn(TruthSet) -> TruthSet) {
        let FactChange { fluent, key, sure, nameless, .. } = *change;
        if let Some(place) = nameless {
            self.keep_names(fluent, key, place);
            let is_nameless = |part: FactKey| part.arg(place) == ANY;
            self.state.facts.change(fluent, key, |part, old| if is_nameless(part) { new(old) } else { old });
        } else if sure == Certainty::Always {
            self.state.facts.set(fluent, key, new(TruthSet::default()));
        } else if self.symbols.is_empty() || key.is_pattern() {
            self.state.facts.change(fluent, key, |_, old| new(old));
        } else {
            // What is known of a binding is what is known of all that it may be.
            let known = self.read(fluent, key);
            self.state.facts.set(fluent, key, new(known));
        }
        if let Some(written) = &mut self.control.written {
            written.push((fluent, key));
        }
        if self.symbols.is_empty() {
            return;
        }
        // Only a symbol can be the same as something else.
        let symbolic = self.has_symbol(fluent, key);
        if let Some(aliased) = self.aliased.get_mut(fluent.index()) {
            *aliased |= symbolic;
            if *aliased {
                let value = self.state.facts.get(fluent, key);
                self.echo(fluent, key, value, cause);
            }
        }
    }

    /// Value that an observation has shown, as the run knows it: a belief about another name may have
    /// answered, and may last only for a time.
    fn as_believed(&self, fluent: Fluent, key: FactKey, mut value: TruthSet) -> TruthSet {
        if self.state.lasting.is_empty()
            || self.symbols.is_empty()
            || !self.library.perceived.contains(&fluent)
        {
            return value;
        }
        let params = self.library.fluent(fluent).map_or(&[][..], |def| &def.params);
        self.state.facts.written_parts(fluent, |other| {
            if other != key && self.may_be_same(params, key, other) {
                let TruthSet { yes, no, .. } = self.state.facts.get(fluent, other);
                for (own, believed) in [(&mut value.yes, yes), (&mut value.no, no)] {
                    if let Some(seen) = believed.seen().filter(|_| own.is_some()) {
                        *own = own.join(seen);
                    }
                }
            }
        });
        value
    }

    /// Writes what is known of each entity with a name that a pattern covers as an entry of its own.
    fn keep_names(&mut self, fluent: Fluent, pattern: FactKey, place: usize) {
        let param = self.library.fluent(fluent).and_then(|def| def.params.get(place));
        let Some(kind) = param.and_then(|(_, ty)| ty.kind()) else { return };
        let is_fit = |of: Kind| self.library.is_kind(of, kind) || self.library.is_kind(kind, of);
        let symbols = self.symbols.iter().filter(|(_, symbol)| is_fit(symbol.kind));
        let symbols: Vec<Entity> = symbols.map(|(entity, _)| entity).collect();
        if !symbols.is_empty() {
            self.alias(fluent);
        }
        let entities = self.of_kind(kind, usize::MAX);
        effort::spend(effort::WRITE * (entities.len() + symbols.len()));
        for entity in entities.into_iter().chain(symbols) {
            let key = pattern.with(place, entity.0);
            if self.state.facts.entry(fluent, key).is_none() {
                let known = self.read(fluent, key);
                self.state.facts.set(fluent, key, known);
            }
        }
    }

    /// Writes what an observation has shown of a fact. From then on what happens to an entity is felt by
    /// what is known of a symbol that it may be. What a branch beside this one may change is not learnt: it
    /// may be otherwise when the next step begins.
    pub(super) fn learn(&mut self, fluent: Fluent, key: FactKey, value: TruthSet) {
        if self.is_disturbed(fluent, key) {
            return;
        }
        let value = self.as_believed(fluent, key, value);
        self.state.facts.set(fluent, key, value);
        if !self.symbols.is_empty() && self.has_symbol(fluent, key) {
            self.alias(fluent);
        }
    }

    /// Lets the facts of a fluent feel from now on what happens to the entities that its symbols may be.
    fn alias(&mut self, fluent: Fluent) {
        self.aliased.get_mut(fluent.index()).into_iter().for_each(|aliased| *aliased = true);
    }

    /// Writes a fact that something outside may have changed, as [`learn`](Self::learn) does, and weakens the
    /// facts that may be the same.
    pub(super) fn see_change(&mut self, fluent: Fluent, key: FactKey, value: TruthSet, cause: Cause) {
        if self.is_disturbed(fluent, key) {
            // It was so. Since then the branch beside may have changed it.
            let unknown = FactChange::unknown(fluent, key);
            return self.write(&unknown, cause, |old| old.maybe(value, cause));
        }
        let value = self.as_believed(fluent, key, value);
        self.write(&FactChange::new(fluent, key, true, Certainty::Always), cause, |_| value);
    }

    /// Returns whether a branch beside the present one may change a fact, or one of a pattern.
    fn is_disturbed(&self, fluent: Fluent, key: FactKey) -> bool {
        effort::spend(self.control.disturbed.len());
        self.control.disturbed.iter().any(|(other, changed)| {
            *other == fluent
                && (key.meets(*changed) || self.has_symbol(fluent, key) || self.has_symbol(fluent, *changed))
        })
    }

    /// Atoms that facts of conditions may be about, without those of derived fluents.
    pub(super) fn atoms_of(&self, facts: Vec<&Fact>) -> Vec<Atom> {
        let mut atoms = Vec::new();
        for fact in facts {
            let is_derived = self.library.fluent(fact.fluent).is_some_and(|def| def.derived);
            if is_derived {
                continue;
            }
            let key = self.widest_key(fact, CallFrame::default());
            atoms.extend(self.instances((fact.fluent, key)));
            // What is known of other names may be about the same.
            let params = self.library.fluent(fact.fluent).map_or(&[][..], |def| &def.params);
            self.state.facts.written_parts(fact.fluent, |other| {
                if self.has_symbol(fact.fluent, other) && self.may_be_same(params, key, other) {
                    atoms.push((fact.fluent, other));
                }
            });
        }
        atoms
    }

    /// Returns whether an argument of a fact is a symbol.
    pub(super) fn has_symbol(&self, fluent: Fluent, key: FactKey) -> bool {
        self.library.fluent(fluent).is_some_and(|def| {
            let entities = def.params.iter().enumerate().filter(|(_, (_, ty))| ty.kind().is_some());
            entities.into_iter().any(|(index, _)| self.symbols.get(Entity(key.arg(index))).is_some())
        })
    }

    /// Weakens the facts that may be the same as a written one.
    fn echo(&mut self, fluent: Fluent, key: FactKey, value: TruthSet, cause: Cause) {
        let library = self.library;
        let Some(def) = library.fluent(fluent) else { return };
        let mut targets: Vec<FactKey> = Vec::new();
        let mut feels = |other: FactKey| {
            if other != key && !key.covers(other) && self.may_be_same(&def.params, key, other) {
                targets.push(other);
            }
        };
        if self.has_symbol(fluent, key) {
            self.state.facts.parts(fluent, FactKey::ALL, &mut feels);
        } else {
            // What is no symbol may be one, and the facts at the start speak of none.
            self.state.facts.written_parts(fluent, &mut feels);
        }
        // Entities behind the symbols that have no entry yet.
        let mut instances = vec![key];
        for (index, (_, ty)) in def.params.iter().enumerate() {
            let symbol = self.symbols.get(Entity(key.arg(index))).filter(|_| ty.kind().is_some());
            let Some(symbol) = symbol else { continue };
            let candidates = symbol.may_be.clone().unwrap_or_else(|| self.of_kind(symbol.kind, usize::MAX));
            if instances.len().saturating_mul(candidates.len()) > MAX_INSTANCES {
                return self.state.facts.change(fluent, FactKey::ALL, |_, old| old.maybe(value, cause));
            }
            let known = instances.clone();
            instances.extend(candidates.iter().flat_map(|it| known.iter().map(|key| key.with(index, it.0))));
        }
        for other in instances.into_iter().filter(|other| *other != key) {
            if other.is_pattern() {
                self.state.facts.change(fluent, other, |_, old| old.maybe(value, cause));
            } else if self.state.facts.entry(fluent, other).is_none() {
                targets.push(other);
            }
        }
        // Of a pattern without a symbol the instances are weakened one by one.
        targets.retain(|other| !other.is_pattern() || self.has_symbol(fluent, *other));
        for other in targets {
            if other.is_pattern() {
                self.state.facts.change(fluent, other, |_, old| old.maybe(value, cause));
                continue;
            }
            let known = self.state.facts.get(fluent, other);
            let felt = known.maybe(value, cause);
            if felt != known {
                self.state.facts.set(fluent, other, felt);
            }
        }
    }

    pub(super) fn may_be_same(&self, params: &[(SmolStr, Ty)], a: FactKey, b: FactKey) -> bool {
        params.iter().enumerate().all(|(index, (_, ty))| {
            let (one, two) = (a.arg(index), b.arg(index));
            one == two
                || one == ANY
                || two == ANY
                || (ty.kind().is_some()
                    && self.symbols.may_equal(self.library, self.environment, Entity(one), Entity(two)))
        })
    }

    /// Makes perceived facts stale once a step uses their resource or moves their entity.
    pub(crate) fn make_stale(&mut self, step: StepId, def: &PrimitiveDef, frame: CallFrame<'_>) {
        let (seen, seen_before) = (&self.state.lasting, &self.environment.lasting);
        if seen.is_empty() && seen_before.is_empty() {
            return;
        }
        let moved = self.moved(def, frame);
        let may_equal = |a, b| self.symbols.may_equal(self.library, self.environment, a, b);
        let end_of = |of: &PerceptionLifetime| {
            if of.resources & def.uses != 0 || of.entities.iter().any(|entity| moved.named.contains(entity)) {
                return Some(Certainty::Always);
            }
            let others = moved.named.iter().chain(&moved.perhaps);
            let mut pairs =
                of.entities.iter().flat_map(|one| others.clone().map(move |other| (*one, *other)));
            let may_end =
                moved.others && !of.entities.is_empty() || pairs.any(|(one, other)| may_equal(one, other));
            may_end.then_some(Certainty::Unknown)
        };
        let of_several = OnceCell::new();
        let end = |cause: Cause| {
            if cause == Cause::SEEN_BY_SEVERAL {
                *of_several.get_or_init(|| {
                    effort::spend(seen.len() + seen_before.len());
                    seen.values().chain(seen_before).filter_map(end_of).min()
                })
            } else if let Some(index) = cause.as_seen_at_start() {
                seen_before.get(index).and_then(end_of)
            } else {
                cause.as_step().and_then(|by| seen.get(&by)).and_then(end_of)
            }
        };
        let cause = Cause::step(step);
        let after = |value: TruthSet| {
            let ends = [value.yes, value.no].map(end);
            if ends == [None; 2] {
                return value;
            }
            let kept = |cause, end| if end == Some(Certainty::Always) { Cause::NONE } else { cause };
            let [yes, no] = ends;
            let rest = TruthSet { yes: kept(value.yes, yes), no: kept(value.no, no), ..value };
            rest.join(TruthSet::open(cause))
        };
        let mut stale: SmallVec<[_; 8]> = SmallVec::new();
        for fluent in self.library.perceived.iter().copied() {
            let take = |key| {
                let value = self.state.facts.get(fluent, key);
                if after(value) != value {
                    stale.push((fluent, key));
                }
            };
            match seen_before.is_empty() {
                true => self.state.facts.written_parts(fluent, take),
                false => self.state.facts.parts(fluent, FactKey::ALL, take),
            }
        }
        let mut poses: SmallVec<[_; 8]> = SmallVec::new();
        self.state.facts.written(self.fresh, |key, value| {
            let is_over = || end(Cause::step(pose_step(key))) == Some(Certainty::Always);
            if value.yes.is_some() && is_over() {
                poses.push((key, TruthSet { yes: Cause::NONE, ..value }.join(TruthSet::no(cause))));
            }
        });
        // The order of a table is not that of the document.
        stale.sort_unstable_by_key(|(fluent, key)| (!key.is_pattern(), *fluent, *key));
        poses.sort_unstable_by_key(|(key, _)| *key);
        for (fluent, key) in stale {
            self.state.facts.change(fluent, key, |_, value| after(value));
        }
        for (key, value) in poses {
            self.state.facts.set(self.fresh, key, value);
        }
    }

    /// Entities that a step moves: the first arguments of an action's effects.
    fn moved(&self, def: &PrimitiveDef, frame: CallFrame<'_>) -> Moved {
        let mut moved = Moved::default();
        if def.form == PrimitiveKind::Perception {
            return moved;
        }
        for effect in def.makes.iter().chain(&def.unsettles) {
            match (effect.fact.args.first(), effect.each) {
                (Some(Some(Term::Each)), Some(kind)) => {
                    let found = self.candidates(effect.when.as_ref(), kind, frame);
                    moved.perhaps.extend(found.known.into_iter().chain(found.doubtful));
                    moved.others |= found.rest.is_some();
                }
                (Some(Some(term)), _) => moved.named.extend(self.argument(term, frame).map(Entity)),
                (Some(None) | None, _) => {}
            }
        }
        moved.named.dedup();
        moved
    }
}

/// Entities that a step moves.
#[derive(Debug, Default)]
struct Moved {
    named: Entities,
    /// Those that it moves under a condition, which may hold.
    perhaps: Entities,
    /// Set where it may hold for others, too.
    others: bool,
}

/// Makes the changes of a first attempt those of any attempt: only what all of them change is certain.
pub(super) fn weaken(first: &mut Vec<FactChange>, later: &[FactChange]) {
    let is_in = |changes: &[FactChange], change: &FactChange| {
        let same = |other: &&FactChange| {
            (other.fluent, other.key, other.truth, other.nameless)
                == (change.fluent, change.key, change.truth, change.nameless)
        };
        changes.iter().find(same).map(|other| other.sure)
    };
    let added: Vec<FactChange> =
        later.iter().filter(|change| is_in(first, change).is_none()).copied().collect();
    for change in first.iter_mut().filter(|change| change.is_sure()) {
        if is_in(later, change) != Some(Certainty::Always) {
            change.sure = Certainty::Unknown;
        }
    }
    let unsure = |change: FactChange| FactChange { sure: change.sure.max(Certainty::Unknown), ..change };
    first.extend(added.into_iter().map(unsure));
    first.sort_by_key(|change| change.truth);
}

pub(super) fn certainty(value: TruthSet) -> Option<Certainty> {
    if value.open.is_some() {
        Some(Certainty::Unknown)
    } else if value.no.is_some() && value.yes.is_some() {
        Some(Certainty::Sometimes)
    } else {
        value.yes.is_some().then_some(Certainty::Always)
    }
}
