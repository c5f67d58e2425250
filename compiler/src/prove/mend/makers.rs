//! Which calls make a fact.

use motet_syntax::ast::{CompareOp, PrimitiveKind};

use super::{MAX_PROPOSALS, Maker, Proposed, Want};
use crate::ir::{Base, BindingId, Condition, Entity, Primitive, ROBOT, StepKind, Term, Ty};
use crate::library::{EffectDef, PrimitiveDef};
use crate::prove::Prover;
use crate::prove::eval::Frame;
use crate::prove::facts::{ANY, Key, arg};

/// The arguments for which an effect is about a fact; those that it leaves open are none.
pub(super) struct Unified {
    args: Vec<Option<Term>>,
    /// What a perception has to find.
    result: Option<Entity>,
}

/// Whether an effect comes about.
enum Applies<'e> {
    Yes,
    /// Under a condition that does not hold yet, for an entity.
    Under(&'e Condition, Option<Entity>),
    No,
}

impl<'a> Prover<'a> {
    /// Calls that make a fact, in the order of the library; those of which an effect still stands under a condition last.
    pub(crate) fn makers(&self, want: Want) -> Vec<Maker<'a>> {
        let library = self.library;
        let mut found: Vec<Maker<'a>> = Vec::new();
        let mut under = Vec::new();
        for (index, def) in library.primitives.iter().enumerate() {
            let Some(primitive) = u16::try_from(index).ok().map(Primitive).filter(|_| def.provided) else {
                continue;
            };
            for effect in
                def.makes.iter().filter(|effect| effect.fact.fluent == want.0 && effect.value == want.2)
            {
                let Some(Unified { args, result }) = self.unify(def, effect, want.1) else { continue };
                let calls = match def.result {
                    Some(_) => self.perceive(primitive, def, args, result),
                    None => {
                        let all = self.fill(def, args).into_iter();
                        all.map(|args| Proposed { primitive, args, result: None, again: None }).collect()
                    }
                };
                for call in calls {
                    if found.iter().any(|other| other.call == call) {
                        continue;
                    }
                    match self.applies(effect, &call, want.1) {
                        Applies::Yes => found.push(Maker { call, want, when: None }),
                        Applies::Under(when, each) => {
                            under.push(Maker { call, want, when: Some((when, each)) });
                        }
                        Applies::No => {}
                    }
                }
            }
        }
        under.retain(|maker| found.iter().all(|other| other.call != maker.call));
        found.extend(under);
        found
    }

    /// Calls of a perception that finds one thing: what a description finds by the name of the thing, or by another that
    /// only it has, any other as it was found before.
    fn perceive(
        &self,
        primitive: Primitive,
        def: &PrimitiveDef,
        args: Vec<Option<Term>>,
        result: Option<Entity>,
    ) -> Vec<Proposed> {
        let Some(found) = result.filter(|_| def.form == PrimitiveKind::Perception) else { return Vec::new() };
        if let Some(binding) = self.symbols.binding_of(found) {
            return self.as_before(primitive, found, binding).into_iter().collect();
        }
        let Some(kind) = def.result.and_then(|ty| ty.kind()) else { return Vec::new() };
        let Some(name) = self.world.entities().name(found) else { return Vec::new() };
        let Some(description) = self.world.description_of(self.library, name, (found, kind)) else {
            return Vec::new();
        };
        let mut args = args;
        let described = def.params.iter().zip(&mut args).find(|(param, _)| param.ty == Ty::TEXT);
        let Some((_, slot)) = described else { return Vec::new() };
        *slot = Some(Term::Text(description));
        self.look_where_it_is(def, &mut args, found);
        let all = self.fill(def, args).into_iter();
        all.map(|args| Proposed { primitive, args, result: Some(found), again: None }).collect()
    }

    /// An argument of which nothing says what it is, of a call that finds a thing, is where the thing is known to be: who
    /// looks for it looks there first.
    fn look_where_it_is(&self, def: &PrimitiveDef, args: &mut [Option<Term>], found: Entity) {
        let Some(at) = self.library.names.fluents.get("at").copied() else { return };
        let takes_two = self.library.fluent(at).is_some_and(|def| def.params.len() == 2);
        let mut places = Vec::new();
        if takes_two {
            self.facts.entries(at, Key::new([arg(found), ANY].into_iter()), |key, value| {
                if value.is_true() {
                    places.push(Entity(key.arg(1)));
                }
            });
        }
        places.sort_unstable();
        for (param, slot) in
            def.params.iter().zip(args).filter(|(param, slot)| slot.is_none() && param.default.is_none())
        {
            let Some(kind) = param.ty.kind() else { continue };
            let place = places.iter().find(|place| self.is_of_kind(**place, kind));
            *slot = place.map(|place| Term::Entity(*place));
        }
    }

    /// The step that bound a symbol, once more.
    fn as_before(&self, primitive: Primitive, found: Entity, binding: usize) -> Option<Proposed> {
        let again = BindingId(u32::try_from(binding).ok()?);
        let calls = self.program.steps.iter().filter_map(|step| match &step.kind {
            StepKind::Call(call) => Some(call),
            _ => None,
        });
        let call = calls.filter(|call| call.primitive == primitive).find(|call| call.binds == Some(again))?;
        Some(Proposed { primitive, args: call.args.to_vec(), result: Some(found), again: Some(again) })
    }

    /// What makes an effect be about a fact.
    pub(super) fn unify(&self, def: &PrimitiveDef, effect: &EffectDef, key: Key) -> Option<Unified> {
        let mut result = None;
        let mut args: Vec<Option<Term>> = vec![None; def.params.len()];
        let mut each = None;
        for (index, term) in effect.fact.args.iter().enumerate() {
            let value = key.arg(index);
            match term {
                None => {}
                Some(_) if value == ANY => {}
                Some(Term::Param(at)) => self.bind_arg(def, &mut args, *at, value)?,
                Some(Term::Each) => each = Some(value),
                Some(Term::Result) => {
                    let kind = self.symbols.kind(self.world, Entity(value))?;
                    let is_it = self.library.fits(def.result?, Ty::plain(Base::Entity(kind)));
                    result = Some(is_it.then_some(Entity(value))?);
                }
                Some(term) if self.argument(term, Frame::default()) == Some(value) => {}
                Some(_) => return None,
            }
        }
        if let (Some(value), Some(Condition::Compare(CompareOp::Equal, left, right))) = (each, &effect.when) {
            match (left, right) {
                (Term::Each, Term::Param(at)) | (Term::Param(at), Term::Each) => {
                    self.bind_arg(def, &mut args, *at, value)?;
                }
                _ => {}
            }
        }
        Some(Unified { args, result })
    }

    pub(super) fn bind_arg(
        &self,
        def: &PrimitiveDef,
        args: &mut [Option<Term>],
        at: u16,
        value: u16,
    ) -> Option<()> {
        let term = match def.params.get(usize::from(at))?.ty {
            Ty { base: Base::Enum(id), lists: 0 } => Term::Case(id, value),
            ty => {
                let kind = self.symbols.kind(self.world, Entity(value))?;
                self.library.fits(ty, Ty::plain(Base::Entity(kind))).then_some(Term::Entity(Entity(value)))?
            }
        };
        let slot = args.get_mut(usize::from(at))?;
        match slot {
            Some(other) if *other != term => None,
            _ => {
                *slot = Some(term);
                Some(())
            }
        }
    }

    /// Whether the effect is about the fact at this call, in the state as it is.
    fn applies<'e>(&self, effect: &'e EffectDef, call: &Proposed, key: Key) -> Applies<'e> {
        let place = effect.fact.args.iter().position(|arg| *arg == Some(Term::Each));
        let each = place.map(|index| Entity(key.arg(index)));
        let is_of_kind = match (effect.each, each) {
            (Some(kind), Some(each)) => self.is_of_kind(each, kind),
            _ => true,
        };
        let frame = Frame { args: &call.args, result: call.result, each };
        match &effect.when {
            _ if !is_of_kind => Applies::No,
            None => Applies::Yes,
            Some(when) if self.evaluate(when, frame).is_true() => Applies::Yes,
            Some(when) => Applies::Under(when, each),
        }
    }

    /// What the open arguments may be: what the primitive's own needs say of them in the state as it is.
    pub(super) fn fill(&self, def: &PrimitiveDef, args: Vec<Option<Term>>) -> Vec<Vec<Term>> {
        let mut all = vec![args];
        for (index, param) in def.params.iter().enumerate() {
            let mut next = Vec::new();
            for args in all {
                if args.get(index).is_some_and(Option::is_some) {
                    next.push(args);
                    continue;
                }
                let choices = match (&param.default, param.ty.kind()) {
                    (Some(default), _) => vec![default.clone()],
                    (None, Some(_)) => self.choices(def, index, &args),
                    (None, None) => Vec::new(),
                };
                for choice in choices {
                    let mut args = args.clone();
                    if let Some(slot) = args.get_mut(index) {
                        *slot = Some(choice);
                    }
                    next.push(args);
                }
            }
            all = next;
        }
        all.into_iter().filter_map(|args| args.into_iter().collect()).collect()
    }

    /// Entities that may stand for a parameter: those for which a need of the primitive is known to hold; else any few.
    pub(super) fn choices(&self, def: &PrimitiveDef, index: usize, args: &[Option<Term>]) -> Vec<Term> {
        let Some(param) = def.params.get(index) else { return Vec::new() };
        let Some(kind) = param.ty.kind() else { return Vec::new() };
        let mut found = Vec::new();
        let facts = def.needs.iter().flat_map(|need| match &need.condition {
            Condition::AnyOf(parts) => parts.as_slice(),
            only => std::slice::from_ref(only),
        });
        for fact in facts {
            let Condition::Fact(fact) = fact else { continue };
            if fact.args.contains(&Some(Term::Each)) {
                continue;
            }
            let is_it =
                |term: &Option<Term>| matches!(term, Some(Term::Param(at)) if usize::from(*at) == index);
            let Some(place) = fact.args.iter().position(is_it) else { continue };
            let pattern = fact.args.iter().enumerate().try_fold(Key(0), |key, (at, term)| {
                let value = match term {
                    _ if at == place => ANY,
                    None => ANY,
                    Some(Term::Param(other)) => match args.get(usize::from(*other)) {
                        Some(Some(term)) => self.argument(term, Frame::default())?,
                        _ => ANY,
                    },
                    Some(term) => self.argument(term, Frame::default())?,
                };
                Some(key.with(at, value))
            });
            let Some(pattern) = pattern else { continue };
            self.facts.entries(fact.fluent, pattern, |key, value| {
                if value.is_true() {
                    found.push(Entity(key.arg(place)));
                }
            });
        }
        found.sort_unstable();
        found.dedup();
        found.retain(|entity| self.is_of_kind(*entity, kind));
        if found.is_empty() {
            let surface = self.library.kind_named("Surface");
            if self.library.is_kind(surface, kind) {
                found = self.of_kind(surface, MAX_PROPOSALS);
            }
            // Of the robot itself only what a need says of it could be meant.
            let others = self.of_kind(kind, MAX_PROPOSALS + 1).into_iter().filter(|entity| *entity != ROBOT);
            let others: Vec<Entity> = others.filter(|entity| !found.contains(entity)).collect();
            found.extend(others);
        }
        // Furniture is a better place to put something than a thing or a person.
        let rank = |entity: &Entity| {
            let is = |name| self.is_of_kind(*entity, self.library.kind_named(name));
            if is("Surface") { 0 } else { 1 + usize::from(!is("Container")) }
        };
        found.sort_by_key(rank);
        found.truncate(MAX_PROPOSALS);
        found.into_iter().map(Term::Entity).collect()
    }
}
