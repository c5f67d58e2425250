//! Achievers: calls whose effects include a given fact.

use motet_syntax::ast::{Arg, Call, CompareOp, Do, Expr, ExprKind, Name, PrimitiveKind};
use motet_syntax::{Span, Syntax};
use smol_str::SmolStr;

use crate::declare::{EffectDef, Library, PrimitiveDef};
use crate::environment::Environment;
use crate::facts::{ANY, FactKey, TruthSet, arg};
use crate::ir::{Base, BindingId, Condition, Entity, Fluent, Kind, Primitive, ROBOT, StepKind, Term, Ty};
use crate::prove::Prover;
use crate::prove::evaluation::CallFrame;

/// Maximal number of choices for an argument, and of repairs for a diagnostic.
pub(crate) const MAX_CANDIDATES: usize = 4;

/// A call that a plan or a repair proposes.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct CandidateCall {
    pub(crate) primitive: Primitive,
    pub(crate) args: Vec<Term>,
    /// Entity that a perception is to find.
    pub(crate) result: Option<Entity>,
    /// Binding whose stale value the call replaces.
    pub(crate) again: Option<BindingId>,
}

/// A call that achieves a subgoal.
#[derive(Clone, Debug)]
pub(crate) struct Achiever<'l> {
    pub(crate) call: CandidateCall,
    pub(crate) subgoal: Subgoal,
    /// Condition of the effect, with its entity, if it does not hold yet.
    pub(crate) when: Option<(&'l Condition, Option<Entity>)>,
}

/// A fact to achieve: fluent, key and truth value.
pub(crate) type Subgoal = (Fluent, FactKey, bool);

/// Arguments for which an effect matches a fact; `None` for those that stay open.
pub(super) struct Unification {
    args: Vec<Option<Term>>,
    /// Entity that a perception has to find.
    result: Option<Entity>,
}

/// Applicability of an effect in the present state.
enum Applies<'e> {
    Yes,
    /// Only under a condition that does not hold yet, for an entity.
    Under(&'e Condition, Option<Entity>),
    No,
}

impl<'a> Prover<'a> {
    /// Calls that achieve a subgoal, in the order of the library; those with an open condition last.
    pub(crate) fn achievers(&self, subgoal: Subgoal) -> Vec<Achiever<'a>> {
        let library = self.library;
        let mut found: Vec<Achiever<'a>> = Vec::new();
        let mut under = Vec::new();
        for (index, def) in library.primitives.iter().enumerate() {
            let Some(primitive) = u16::try_from(index).ok().map(Primitive).filter(|_| def.provided) else {
                continue;
            };
            for effect in
                def.makes.iter().filter(|effect| effect.fact.fluent == subgoal.0 && effect.value == subgoal.2)
            {
                let Some(Unification { args, result }) = self.unify(def, effect, subgoal.1) else { continue };
                let calls = match def.result {
                    Some(_) => self.perceive(primitive, def, args, result),
                    None => {
                        let all = self.meeting(def, effect, (subgoal.1, args)).into_iter();
                        all.flat_map(|args| self.fill(def, args))
                            .map(|args| CandidateCall { primitive, args, result: None, again: None })
                            .collect()
                    }
                };
                for call in calls {
                    if found.iter().any(|other| other.call == call) {
                        continue;
                    }
                    match self.applies(effect, &call, subgoal.1) {
                        Applies::Yes => found.push(Achiever { call, subgoal, when: None }),
                        Applies::Under(when, each) => {
                            under.push(Achiever { call, subgoal, when: Some((when, each)) });
                        }
                        Applies::No => {}
                    }
                }
            }
        }
        under.retain(|achiever| found.iter().all(|other| other.call != achiever.call));
        found.extend(under);
        found
    }

    /// Facts that a pattern covers and that may hold, with their values.
    pub(crate) fn may_hold(&self, fluent: Fluent, key: FactKey) -> Vec<(FactKey, TruthSet)> {
        let mut held = Vec::new();
        self.state.facts.entries(fluent, key, |key, value| {
            if value.yes.is_some() {
                held.push((key, value));
            }
        });
        held.sort_unstable_by_key(|(key, _)| *key);
        held
    }

    /// Calls of a perception that finds an entity: by a description that fits it alone, or as in the step
    /// that found it before.
    fn perceive(
        &self,
        primitive: Primitive,
        def: &PrimitiveDef,
        args: Vec<Option<Term>>,
        result: Option<Entity>,
    ) -> Vec<CandidateCall> {
        let Some(found) = result.filter(|_| def.form == PrimitiveKind::Perception) else { return Vec::new() };
        if let Some(binding) = self.symbols.binding_of(found) {
            return self.as_before(primitive, found, binding).into_iter().collect();
        }
        let Some(kind) = def.result.and_then(|ty| ty.kind()) else { return Vec::new() };
        let Some(name) = self.environment.entities().name(found) else { return Vec::new() };
        let Some(description) = self.environment.description_of(self.library, name, (found, kind)) else {
            return Vec::new();
        };
        let mut args = args;
        let described = def.params.iter().zip(&mut args).find(|(param, _)| param.ty == Ty::TEXT);
        let Some((_, slot)) = described else { return Vec::new() };
        *slot = Some(Term::Text(description));
        self.look_where_it_is(def, &mut args, found);
        let all = self.fill(def, args).into_iter();
        all.map(|args| CandidateCall { primitive, args, result: Some(found), again: None }).collect()
    }

    /// Fills the free arguments of a perception with the place where the entity is known to be.
    fn look_where_it_is(&self, def: &PrimitiveDef, args: &mut [Option<Term>], found: Entity) {
        let Some(at) = self.library.lang_items.at else { return };
        let takes_two = self.library.fluent(at).is_some_and(|def| def.params.len() == 2);
        let mut places = Vec::new();
        if takes_two {
            self.state.facts.entries(at, FactKey::new([arg(found), ANY].into_iter()), |key, value| {
                if value.is_true() {
                    places.push(Entity(key.arg(1)));
                }
            });
        }
        places.sort_unstable();
        for (param, slot) in
            def.params.iter().zip(args).filter(|(param, slot)| slot.is_none() && param.default.is_none())
        {
            let Some(kind) = param.ty.kind_within() else { continue };
            let place = places.iter().find(|place| self.is_of_kind(**place, kind));
            *slot = place.map(|place| argument_of(param.ty, *place));
        }
    }

    /// Repeats the step that bound a symbol.
    fn as_before(&self, primitive: Primitive, found: Entity, binding: usize) -> Option<CandidateCall> {
        let again = BindingId(u32::try_from(binding).ok()?);
        // What several paths bind, no step of one path finds again.
        self.program.bindings.get(binding).filter(|binding| binding.binders.len() == 1)?;
        let calls = self.program.steps.iter().filter_map(|step| match &step.kind {
            StepKind::Call(call) => Some(call),
            _ => None,
        });
        let call = calls.filter(|call| call.primitive == primitive).find(|call| call.binds == Some(again))?;
        Some(CandidateCall { primitive, args: call.args.to_vec(), result: Some(found), again: Some(again) })
    }

    /// Arguments that meet the condition of an effect: `pick` makes a table clear of what stands on it. One
    /// choice with the arguments as they are where nothing is known to meet it.
    fn meeting(
        &self,
        def: &PrimitiveDef,
        effect: &EffectDef,
        (key, args): (FactKey, Vec<Option<Term>>),
    ) -> Vec<Vec<Option<Term>>> {
        let each = effect.fact.args.iter().position(|arg| *arg == Some(Term::Each));
        let (Some(Condition::Fact(fact)), Some(each)) = (&effect.when, each) else { return vec![args] };
        let is_open = |at: u16| args.get(usize::from(at)).is_some_and(Option::is_none);
        let open = |term: &Option<Term>| matches!(term, Some(Term::Param(at)) if is_open(*at));
        let holes: Vec<usize> =
            (0..fact.args.len()).filter(|at| fact.args.get(*at).is_some_and(open)).collect();
        let ([hole], true) = (holes.as_slice(), fact.args.contains(&Some(Term::Each))) else {
            return vec![args];
        };
        let Some(Some(Term::Param(param))) = fact.args.get(*hole) else { return vec![args] };
        let values = fact.args.iter().map(|term| match term {
            Some(Term::Each) => key.arg(each),
            _ => ANY,
        });
        let held = self.may_hold(fact.fluent, FactKey::new(values));
        let held = held.into_iter().filter(|(_, value)| value.is_true()).filter_map(|(known, _)| {
            let mut args = args.clone();
            self.bind_arg(def, &mut args, *param, known.arg(*hole))?;
            Some(args)
        });
        let found: Vec<_> = held.take(MAX_CANDIDATES).collect();
        if found.is_empty() { vec![args] } else { found }
    }

    /// Unifies an effect with a fact.
    pub(super) fn unify(&self, def: &PrimitiveDef, effect: &EffectDef, key: FactKey) -> Option<Unification> {
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
                    let kind = self.symbols.kind(self.environment, Entity(value))?;
                    let is_it = self.library.fits(def.result?, Ty::plain(Base::Entity(kind)));
                    result = Some(is_it.then_some(Entity(value))?);
                }
                Some(term) if self.argument(term, CallFrame::default()) == Some(value) => {}
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
        Some(Unification { args, result })
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
                let kind = self.symbols.kind(self.environment, Entity(value))?;
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

    /// Decides whether an effect of a call applies to a fact in the present state.
    fn applies<'e>(&self, effect: &'e EffectDef, call: &CandidateCall, key: FactKey) -> Applies<'e> {
        let place = effect.fact.args.iter().position(|arg| *arg == Some(Term::Each));
        let each = place.map(|index| Entity(key.arg(index)));
        let is_of_kind = match (effect.each, each) {
            (Some(kind), Some(each)) => self.is_of_kind(each, kind),
            _ => true,
        };
        let frame = CallFrame { args: &call.args, result: call.result, each };
        match &effect.when {
            _ if !is_of_kind => Applies::No,
            None => Applies::Yes,
            Some(when) if self.evaluate(when, frame).is_true() => Applies::Yes,
            Some(when) => Applies::Under(when, each),
        }
    }

    /// All ways to fill the open arguments: from the needs of the primitive in the present state.
    pub(super) fn fill(&self, def: &PrimitiveDef, args: Vec<Option<Term>>) -> Vec<Vec<Term>> {
        let mut all = vec![args];
        for (index, param) in def.params.iter().enumerate() {
            let mut next = Vec::new();
            for args in all {
                if args.get(index).is_some_and(Option::is_some) {
                    next.push(args);
                    continue;
                }
                let default = param.default_after(|earlier| args.get(earlier)?.as_ref());
                let choices = match (default, param.ty.kind_within()) {
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

    /// Candidates for a parameter: entities for which a need of the primitive holds, or else a few of its
    /// kind.
    pub(super) fn choices(&self, def: &PrimitiveDef, index: usize, args: &[Option<Term>]) -> Vec<Term> {
        let Some(param) = def.params.get(index) else { return Vec::new() };
        let Some(kind) = param.ty.kind_within() else { return Vec::new() };
        let mut found = Vec::new();
        // Only what the hand holds, or may hold, can be put down.
        let (mut must_be_held, mut may_be_held) = (false, Vec::new());
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
            let pattern = fact.args.iter().enumerate().try_fold(FactKey(0), |key, (at, term)| {
                let value = match term {
                    _ if at == place => ANY,
                    None => ANY,
                    Some(Term::Param(other)) => match args.get(usize::from(*other)) {
                        Some(Some(term)) => self.argument(term, CallFrame::default())?,
                        _ => ANY,
                    },
                    Some(term) => self.argument(term, CallFrame::default())?,
                };
                Some(key.with(at, value))
            });
            let Some(pattern) = pattern else { continue };
            let is_held = self.library.lang_items.holding == Some(fact.fluent);
            must_be_held |= is_held;
            self.state.facts.entries(fact.fluent, pattern, |key, value| {
                if value.is_true() {
                    found.push(Entity(key.arg(place)));
                } else if is_held && key.arg(place) != ANY && !value.is_false() {
                    may_be_held.push(Entity(key.arg(place)));
                }
            });
        }
        if found.is_empty() {
            found = may_be_held;
        }
        found.sort_unstable();
        found.dedup();
        found.retain(|entity| self.is_of_kind(*entity, kind));
        if found.is_empty() && !must_be_held {
            let surface = self.library.lang_items.surface.unwrap_or(Kind::ROOT);
            if self.library.is_kind(surface, kind) {
                found = self.of_kind(surface, MAX_CANDIDATES);
            }
            // Of the robot itself only what a need says of it could be meant.
            let others = self.of_kind(kind, MAX_CANDIDATES + 1).into_iter().filter(|entity| *entity != ROBOT);
            let others: Vec<Entity> = others.filter(|entity| !found.contains(entity)).collect();
            found.extend(others);
        }
        // Furniture is a better place to put something than a thing or a person.
        let rank = |entity: &Entity| {
            let items = &self.library.lang_items;
            let is = |kind: Option<Kind>| self.is_of_kind(*entity, kind.unwrap_or(Kind::ROOT));
            if is(items.surface) { 0 } else { 1 + usize::from(!is(items.container)) }
        };
        found.sort_by_key(rank);
        found.truncate(MAX_CANDIDATES);
        found.into_iter().map(|entity| argument_of(param.ty, entity)).collect()
    }
}

/// An entity as an argument: for a list, the list of it.
fn argument_of(ty: Ty, entity: Entity) -> Term {
    let one = Term::Entity(entity);
    if ty.lists == 0 { one } else { Term::List(vec![one]) }
}

/// The one entity of an argument.
pub(super) fn entity_of(arg: &Term) -> Option<Entity> {
    let one = if let Term::List(items) = arg { items.first().filter(|_| items.len() == 1)? } else { arg };
    if let Term::Entity(entity) = one { Some(*entity) } else { None }
}

/// Writes a call in a syntax, without defaults, with these names of bindings. `None` if an argument has no
/// spelling in the language.
pub(crate) fn spell_call(
    proposed: &CandidateCall,
    library: &Library,
    environment: &Environment,
    syntax: Syntax,
    name_of: impl Fn(BindingId) -> Option<SmolStr>,
) -> Option<Do> {
    let def = library.primitive(proposed.primitive)?;
    let span = Span::default();
    let mut args = Vec::new();
    let mut is_plain = syntax == Syntax::Text;
    for (term, param) in proposed.args.iter().zip(&def.params) {
        if param.default_after(|earlier| proposed.args.get(earlier)) == Some(term) {
            is_plain = false;
            continue;
        }
        let kind = match term {
            Term::Binding(id) => ExprKind::Binding(name_of(*id)?),
            term => spelled(term, library, environment)?,
        };
        let name = (!is_plain).then(|| Name { text: param.name.clone(), span });
        args.push(Arg { name, value: Expr { kind, span }, span });
    }
    let call = Call { name: Name { text: def.name.clone(), span }, args, span };
    Some(Do { call, bind: None, manner: None, within: None, retry: None })
}

/// Spelling of a value; `None` if it has none in the language, or one that depends on its place.
fn spelled(term: &Term, library: &Library, environment: &Environment) -> Option<ExprKind> {
    Some(match term {
        // A symbol has no name but that of a binding.
        Term::Entity(entity) => ExprKind::Name(environment.entities().name(*entity)?.clone()),
        Term::Case(of, case) => ExprKind::Name(library.case_name(*of, *case).into()),
        Term::Text(text) => ExprKind::Text(text.clone()),
        Term::Bool(value) => ExprKind::Bool(*value),
        // A number would need the unit that its parameter has; no primitive that makes a fact asks for one.
        Term::List(items) => match items.as_slice() {
            [one] => spelled(one, library, environment)?,
            items => {
                let span = Span::default();
                let items =
                    items.iter().map(|item| Some(Expr { kind: spelled(item, library, environment)?, span }));
                ExprKind::List(items.collect::<Option<_>>()?)
            }
        },
        _ => return None,
    })
}
