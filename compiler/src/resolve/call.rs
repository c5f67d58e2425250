//! Calls of primitives and of sub-policies.

use std::sync::Arc;

use motet_syntax::ast::{Arg, Do, Expr, ExprKind, Manner, Name, Policy, PrimitiveKind};
use motet_syntax::{Span, Syntax};
use smallvec::{SmallVec, smallvec};
use smol_str::SmolStr;

use super::diagnostics::{
    EmptyList, IgnoredArgument, NoMotion, NoResult, PoseForEntity, Recursion, UnknownPrimitive,
};
use super::result::PolicyResult;
use super::step::StepResolver;
use super::step_suggestion::suggested_step;
use crate::declare::PrimitiveDef;
use crate::declare::diagnostics::{BadDeclaration, MissingArgument, TooManyArguments, UnknownParameter};
use crate::declare::elaborator::{Expected, ValueRole};
use crate::declare::library::ParamDef;
use crate::declare::name::{list, near};
use crate::declare::{notation, words};
use crate::ir::{self, Base, BlockSlot, StepId, StepKind, StepPosition, Term, Ty};

/// Greatest number of arguments of a call: each is looked for among the others.
const MAX_ARGUMENTS: usize = 256;

/// A parameter from the view of a call.
struct FormalParam<'p> {
    name: &'p SmolStr,
    ty: Ty,
    optional: bool,
}

/// Parameters of a callee: usually few.
type Formals<'p> = SmallVec<[FormalParam<'p>; 4]>;

impl StepResolver<'_> {
    pub(super) fn call(&mut self, call: &Do, span: Span, position: StepPosition) -> Option<StepId> {
        let library = self.elaborator.library;
        let name = &call.call.name.text;
        if let Some(arg) = call.call.args.get(MAX_ARGUMENTS) {
            let (span, callee, most) = (arg.span, name.clone(), MAX_ARGUMENTS);
            self.elaborator.report(TooManyArguments { span, callee, most, twice: None });
            return self.unknown(span, position);
        }
        if self.calls.contains(name) {
            self.elaborator.report(Recursion { span: call.call.name.span, name: name.clone() });
            return self.unknown(span, position);
        }
        if let Some(id) = library.names.primitives.get(name).copied() {
            let def = library.primitive(id)?;
            return self.primitive(call, id, def, span, position);
        }
        if let Some(policy) = library.names.policies.get(name).and_then(|index| library.policies.get(*index))
        {
            return self.inline(call, &Arc::clone(policy), span, position);
        }
        if let (Some(bind), None, None) = (&call.bind, &call.within, &call.retry)
            && call.manner.is_none()
            && self.elaborator.has_value(name)
        {
            let value = Expr { kind: ExprKind::Call(call.call.clone()), span: call.call.span };
            let id = self.reserve(span, position)?;
            let kind = self.let_value(id, bind, &value);
            return self.fill(id, kind);
        }
        if library.names.fluents.contains_key(name) || library.names.measures.contains_key(name) {
            self.misplaced(call.call.name.span);
            return self.unknown(span, position);
        }
        let step = suggested_step(call, library, self.elaborator.form);
        let provided = library.primitives.iter().filter(|def| def.provided).map(|def| def.name.as_str());
        let policies = library.policies.iter().map(|policy| policy.name.text.as_str());
        let near = near(name, provided.chain(policies).filter(|known| self.may_mean(call, known)));
        let cannot = match self.elaborator.form {
            Syntax::Text => "cannot \"why\"",
            Syntax::Json => "{\"end\": \"cannot\", \"why\": …}",
        };
        let (span, name) = (call.call.name.span, name.clone());
        self.elaborator.report(UnknownPrimitive { span, name, step, near, cannot });
        // What it binds exists all the same, so that its uses are not reported as well.
        if let Some(bind) = &call.bind {
            let id = self.bind(bind.text.clone(), Ty::UNKNOWN, bind.span, None, None);
            self.name(&bind.text, id, Ty::UNKNOWN, bind.span);
            if let Some(binding) = self.elaborator.bindings.get_mut(id.index()) {
                binding.uses = 1;
            }
        }
        for arg in &call.call.args {
            self.use_names(&arg.value);
        }
        self.unknown(span, position)
    }

    /// Checks if a callee may be a misspelt one: it takes the arguments, and is no other phrase with the same
    /// verb, as `turn` and `turn_on` are.
    fn may_mean(&self, call: &Do, known: &str) -> bool {
        let library = self.elaborator.library;
        let def = library.names.primitives.get(known).and_then(|id| library.primitive(*id));
        let policy = || library.names.policies.get(known).and_then(|index| library.policies.get(*index));
        let most = def.map(|def| def.params.len()).or_else(|| policy().map(|policy| policy.params.len()));
        let is_phrase = |name: &str| name.trim_matches('_').contains(['_', '-']);
        let name = call.call.name.text.as_str();
        let is_other = is_phrase(name) && !is_phrase(known) && name.split(['_', '-']).next() == Some(known);
        !is_other && most.is_none_or(|most| call.call.args.len() <= most)
    }

    /// Step with an error that was reported.
    fn unknown(&mut self, span: Span, position: StepPosition) -> Option<StepId> {
        let id = self.reserve(span, position)?;
        self.fill(id, StepKind::Unknown)
    }

    /// Marks the names in the arguments of an unknown callee as used, without reports.
    fn use_names(&mut self, expr: &Expr) {
        let (said, errors) = (self.elaborator.diagnostics.len(), self.elaborator.errors);
        self.elaborator.term(expr, None);
        self.elaborator.diagnostics.truncate(said);
        self.elaborator.errors = errors;
    }

    fn primitive(
        &mut self,
        call: &Do,
        primitive: ir::Primitive,
        def: &PrimitiveDef,
        span: Span,
        position: StepPosition,
    ) -> Option<StepId> {
        let id = self.reserve(span, position)?;
        let formals: Formals<'_> = def
            .params
            .iter()
            .map(|param| FormalParam { name: &param.name, ty: param.ty, optional: param.default.is_some() })
            .collect();
        let said = self.elaborator.diagnostics.len();
        let given = self.match_arguments(call, &def.name, &formals);
        let mut args: SmallVec<[Term; 2]> = SmallVec::with_capacity(given.len());
        let mut spans = SmallVec::with_capacity(given.len());
        let mut units = SmallVec::with_capacity(given.len());
        let mut description = None;
        for ((arg, param), formal) in given.into_iter().zip(&def.params).zip(&formals) {
            let twin = arg.filter(|expr| is_pose(expr)).and_then(|_| self.for_pose(call, def, param));
            let (term, at) = match (arg, twin) {
                (Some(&Expr { span, .. }), Some(twin)) => {
                    let (callee, name, param) = (def.name.clone(), call.call.name.span, param.name.clone());
                    self.elaborator.report(PoseForEntity { span, callee, name, param, twin });
                    (Term::Unknown, span)
                }
                (Some(expr), None) => {
                    let wanted = Expected { ty: formal.ty, place: ValueRole::Param(&param.name, &def.name) };
                    (self.elaborator.term_of(expr, wanted), expr.span)
                }
                (None, _) => {
                    let default = param.default_after(|earlier| args.get(earlier)).cloned();
                    (default.unwrap_or(Term::Unknown), call.call.span)
                }
            };
            if let (Term::Text(text), None, PrimitiveKind::Perception) = (&term, &description, def.form) {
                description = Some(text.clone());
            }
            self.check_not_empty(&term, args.len(), def, at);
            args.push(term);
            spans.push(at);
            units.push(arg.and_then(Expr::unit));
        }
        let has_error = self.elaborator.is_behind_gap || self.elaborator.diagnostics.len() > said;
        let is_faulty = has_error && args.contains(&Term::Unknown);
        let manner = call.manner.as_ref().and_then(|manner| self.manner(manner, def));
        let within_secs =
            call.within.as_ref().and_then(|within| self.elaborator.deadline(within, "a deadline"));
        let retries =
            call.retry.as_ref().and_then(|retry| self.elaborator.count(retry, "the count of a `retry`", 0));
        let binds = match (def.result, &call.bind) {
            (Some(ty), Some(name)) => {
                let described = description.filter(|_| matches!(ty.base, Base::Entity(_)));
                let binding = self.bind(name.text.clone(), ty, name.span, Some(id), described);
                self.name(&name.text, binding, ty, name.span);
                Some(binding)
            }
            (Some(ty), None) => {
                let described = description.filter(|_| matches!(ty.base, Base::Entity(_)));
                Some(self.bind(SmolStr::new_static("_"), ty, span, Some(id), described))
            }
            (None, Some(name)) => {
                let mistake = NoResult { span: name.span, callee: def.name.clone(), name: name.text.clone() };
                self.elaborator.report(mistake);
                let binding = self.bind(name.text.clone(), Ty::UNKNOWN, name.span, None, None);
                self.name(&name.text, binding, Ty::UNKNOWN, name.span);
                None
            }
            (None, None) => None,
        };
        let retries = retries.unwrap_or(0);
        let call = ir::Call { primitive, args, spans, units, binds, manner, within_secs, retries, is_faulty };
        self.fill(id, StepKind::Call(call))
    }

    /// The primitive that takes a pose under the name of a parameter that takes an entity, and all else that
    /// the call gives.
    fn for_pose(&self, call: &Do, def: &PrimitiveDef, param: &ParamDef) -> Option<SmolStr> {
        param.ty.kind()?;
        let is_given = |name: &SmolStr| {
            let named = |arg: &Arg| arg.name.as_ref().is_some_and(|given| given.text == *name);
            call.call.args.iter().any(named)
                || def
                    .params
                    .iter()
                    .position(|known| known.name == *name)
                    .is_some_and(|at| call.call.args.get(at).is_some_and(|arg| arg.name.is_none()))
        };
        let fits = |other: &&PrimitiveDef| {
            let takes = |wanted: &SmolStr| other.params.iter().find(|known| known.name == *wanted);
            let is_pose = takes(&param.name).is_some_and(|known| known.ty == Ty::plain(Base::Pose));
            let is_full = other.params.iter().all(|known| known.default.is_some() || is_given(&known.name));
            let has_all =
                def.params.iter().all(|known| !is_given(&known.name) || takes(&known.name).is_some());
            other.provided && is_pose && is_full && has_all
        };
        let mut twins = self.elaborator.library.primitives.iter().filter(fits);
        let twin = twins.next()?.name.clone();
        twins.next().is_none().then_some(twin)
    }

    /// Reports an empty list for a parameter of whose first element the motion needs.
    fn check_not_empty(&mut self, arg: &Term, index: usize, def: &PrimitiveDef, span: Span) {
        let is_first = |of: &Term| match of {
            Term::First(list) => matches!(**list, Term::Param(param) if usize::from(param) == index),
            _ => false,
        };
        let is_needed = def.motion.as_ref().is_some_and(|(_, args)| args.iter().any(is_first));
        if matches!(arg, Term::List(items) if items.is_empty()) && is_needed {
            let name = def.params.get(index).map(|param| param.name.clone()).unwrap_or_default();
            self.elaborator.report(EmptyList { span, name, callee: def.name.clone() });
        }
    }

    /// The manner of a call; an error for a primitive that moves nothing.
    fn manner(&mut self, manner: &Manner, def: &PrimitiveDef) -> Option<motet_graph::Manner> {
        let library = self.elaborator.library;
        if !library.moves(def) {
            let is_text = self.elaborator.form == Syntax::Text;
            self.elaborator.report(NoMotion { span: manner.span(), callee: def.name.clone(), is_text });
            return None;
        }
        match manner {
            Manner::Slowly(_) => Some(library.manners.slowly),
            Manner::Gently(_) => Some(library.manners.gently),
            Manner::At(ratio, _) => {
                let part = self.elaborator.part(ratio, "the part of the robot's speed")?;
                Some(motet_graph::Manner { speed: part, acceleration: part })
            }
        }
    }

    fn inline(&mut self, call: &Do, policy: &Policy, span: Span, position: StepPosition) -> Option<StepId> {
        let name = policy.name.text.clone();
        let id = self.reserve(span, position)?;
        if let Some(bind) = call.bind.as_ref().filter(|_| policy.result.is_none()) {
            self.elaborator.report(NoResult {
                span: bind.span,
                callee: name.clone(),
                name: bind.text.clone(),
            });
        }
        if let Some(manner) = &call.manner {
            self.elaborator.report(BadDeclaration {
                span: manner.span(),
                what: format!("`{name}` is a policy, which has no manner of its own"),
                remedy: "put the manner on those of its steps that move".to_owned(),
            });
        }
        for clause in [&call.within, &call.retry].into_iter().flatten() {
            self.elaborator.report(BadDeclaration {
                span: clause.span,
                what: format!("`{name}` is a policy, which has neither a deadline nor retries"),
                remedy: "put them on its steps, or use `try` and `repeat` around the call".to_owned(),
            });
        }
        let mut types = Vec::with_capacity(policy.params.len());
        for param in &policy.params {
            types.push(crate::declare::resolve_type(&mut self.elaborator, &param.ty));
        }
        let formals: Formals<'_> = policy
            .params
            .iter()
            .zip(&types)
            .map(|(param, ty)| FormalParam {
                name: &param.name.text,
                ty: *ty,
                optional: param.default.is_some(),
            })
            .collect();
        let given = self.match_arguments(call, &name, &formals);
        let mut terms = Vec::with_capacity(given.len());
        for ((arg, param), ty) in given.into_iter().zip(&policy.params).zip(&types) {
            let wanted = Expected { ty: *ty, place: ValueRole::Param(&param.name.text, &name) };
            let term = match (arg, &param.default) {
                (Some(expr), _) => self.elaborator.term_of(expr, wanted),
                (None, Some(default)) => self.in_text(|steps| steps.elaborator.term_of(default, wanted)),
                (None, None) => Term::Unknown,
            };
            terms.push(term);
        }
        let result = policy.result.as_ref();
        let result = result.map(|ty| crate::declare::resolve_type(&mut self.elaborator, ty));
        let bound = call.bind.as_ref().zip(result);
        let binding = bound.map(|(bind, ty)| self.bind(bind.text.clone(), ty, bind.span, None, None));
        let outer = std::mem::replace(&mut self.result, PolicyResult::new(result, binding));
        let id = self.body(id, policy, &types, terms);
        let result = std::mem::replace(&mut self.result, outer);
        if let Some((bind, ty)) = bound {
            self.name_result(bind, ty, result);
        }
        id
    }

    /// Inlines a call of a policy outside of any step.
    pub(super) fn write_out(&mut self, policy: &Policy, args: Vec<Term>) -> Option<StepId> {
        if self.calls.contains(&policy.name.text) {
            let (span, name) = (policy.name.span, policy.name.text.clone());
            self.elaborator.report(Recursion { span, name });
            return None;
        }
        let id =
            self.reserve(policy.span, StepPosition { parent: None, slot: BlockSlot::Steps, index: 0 })?;
        let types = policy.params.iter();
        let types: Vec<Ty> =
            types.map(|param| crate::declare::resolve_type(&mut self.elaborator, &param.ty)).collect();
        let result = policy.result.as_ref();
        let result = result.map(|ty| crate::declare::resolve_type(&mut self.elaborator, ty));
        let outer = std::mem::replace(&mut self.result, PolicyResult::new(result, None));
        let id = self.body(id, policy, &types, args);
        self.result = outer;
        id
    }

    /// Inlines the steps of a policy with arguments.
    fn body(&mut self, id: StepId, policy: &Policy, types: &[Ty], args: Vec<Term>) -> Option<StepId> {
        let name = policy.name.text.clone();
        let mark = self.elaborator.scope.mark();
        self.elaborator.scope.raise_barrier();
        for ((param, ty), term) in policy.params.iter().zip(types).zip(args) {
            self.elaborator.scope.push(param.name.text.clone(), term, *ty, param.name.span);
        }
        let (outer, is_done) = (self.inline.replace(id), std::mem::take(&mut self.is_done));
        self.calls.push(name.clone());
        let body = self.in_text(|steps| steps.whole(policy, Some(id)));
        self.check_given(policy);
        self.calls.pop();
        self.inline = outer;
        self.goes_on |= std::mem::replace(&mut self.is_done, is_done);
        self.elaborator.scope.back_to(mark);
        self.fill(id, StepKind::Inline { policy: name, body })
    }

    /// Elaborates in text syntax, which sub-policies always have.
    fn in_text<T>(&mut self, run: impl FnOnce(&mut Self) -> T) -> T {
        let form = std::mem::replace(&mut self.elaborator.form, motet_syntax::Syntax::Text);
        let result = run(self);
        self.elaborator.form = form;
        result
    }

    /// Matches arguments with parameters.
    fn match_arguments<'e>(
        &mut self,
        call: &'e Do,
        callee: &SmolStr,
        formals: &[FormalParam<'_>],
    ) -> SmallVec<[Option<&'e Expr>; 4]> {
        let mut given: SmallVec<[Option<&Expr>; 4]> = smallvec![None; formals.len()];
        if let Some((arg, items)) = notation::arguments_in_order(&call.call.args, self.elaborator.form)
            && items.len() <= formals.len()
            && !formals.iter().any(|formal| arg.name.as_ref().is_some_and(|name| name.text == *formal.name))
        {
            let names: Vec<&str> = formals.iter().map(|formal| formal.name.as_str()).collect();
            self.elaborator.note_arguments((arg, items), &names);
            given.iter_mut().zip(items).for_each(|(slot, item)| *slot = Some(item));
            self.report_missing(call, callee, formals, (&given, 0));
            return given;
        }
        let mut unknown = 0;
        for (position, arg) in call.call.args.iter().enumerate() {
            let index = match &arg.name {
                None => position,
                Some(name) => match formals.iter().position(|formal| *formal.name == name.text) {
                    Some(index) => index,
                    None if self.is_prose(&name.text, arg, formals, call) => {
                        let (span, name) = (name.span, name.text.clone());
                        self.elaborator.report(IgnoredArgument { span, name, callee: callee.clone() });
                        continue;
                    }
                    None if let Some(index) = self.other_name(name, formals, call) => index,
                    None => {
                        unknown += 1;
                        let near = self.parameter_meant(call, &name.text, formals);
                        let known = list(formals.iter().map(|formal| formal.name.clone()));
                        let (name, span) = (name.text.clone(), name.span);
                        self.elaborator.report(UnknownParameter {
                            span,
                            name,
                            callee: callee.clone(),
                            near,
                            known,
                        });
                        continue;
                    }
                },
            };
            match given.get_mut(index) {
                Some(slot @ None) => *slot = Some(&arg.value),
                Some(Some(_)) => {
                    let twice = formals.get(index).map(|formal| formal.name.clone());
                    let most = formals.len();
                    self.elaborator.report(TooManyArguments {
                        span: arg.span,
                        callee: callee.clone(),
                        most,
                        twice,
                    });
                }
                None => {
                    let most = formals.len();
                    self.elaborator.report(TooManyArguments {
                        span: arg.span,
                        callee: callee.clone(),
                        most,
                        twice: None,
                    });
                }
            }
        }
        self.report_missing(call, callee, formals, (&given, unknown));
        given
    }

    /// Reports the parameters without an argument, if there are more of them than `unknown` arguments: one
    /// under a wrong name is most likely the one that is missing.
    fn report_missing(
        &mut self,
        call: &Do,
        callee: &SmolStr,
        formals: &[FormalParam<'_>],
        (given, unknown): (&[Option<&Expr>], usize),
    ) {
        let missing = formals.iter().zip(given).filter(|(formal, slot)| slot.is_none() && !formal.optional);
        for (formal, _) in missing.skip(unknown) {
            let ty = self.elaborator.library.type_name(formal.ty);
            let (callee, param) = (callee.clone(), formal.name.clone());
            self.elaborator.report(MissingArgument { span: call.call.span, callee, param, ty });
        }
    }

    /// The place of the parameter for which a key of JSON is another name, where that is told with a note.
    fn other_name(&mut self, name: &Name, formals: &[FormalParam<'_>], call: &Do) -> Option<usize> {
        let is_given = |known: &str| {
            call.call.args.iter().any(|arg| arg.name.as_ref().is_some_and(|name| name.text == known))
        };
        let free = formals.iter().map(|formal| formal.name.as_str()).filter(|param| !is_given(param));
        let meant = words::parameter(&name.text, free).filter(|_| self.elaborator.form == Syntax::Json)?;
        // Two keys may be other names for the same one.
        let is_same = |arg: &Arg| {
            let other = arg.name.as_ref().filter(|other| other.text != name.text);
            other.is_some_and(|other| words::parameter(&other.text, std::iter::once(meant)).is_some())
        };
        let index = formals.iter().position(|formal| formal.name == meant)?;
        if call.call.args.iter().any(is_same) {
            return None;
        }
        self.elaborator.note_parameter(name, meant);
        Some(index)
    }

    /// Checks for a key of JSON that only explains the step, and is no other name of a parameter.
    fn is_prose(&self, name: &str, arg: &Arg, formals: &[FormalParam<'_>], call: &Do) -> bool {
        let is_label = matches!(arg.value.kind, ExprKind::Plain(_) | ExprKind::Number(_));
        let is_given = |known: &str| {
            call.call.args.iter().any(|arg| arg.name.as_ref().is_some_and(|name| name.text == known))
        };
        let free = formals.iter().map(|formal| formal.name.as_str()).filter(|param| !is_given(param));
        self.elaborator.form == Syntax::Json
            && is_label
            && words::is_prose(name)
            && words::parameter(name, free).is_none()
    }

    /// The parameter, or in JSON the key of a step, that an unknown name probably means.
    fn parameter_meant(&self, call: &Do, name: &str, formals: &[FormalParam<'_>]) -> Option<SmolStr> {
        let is_given = |known: &str| {
            call.call.args.iter().any(|arg| arg.name.as_ref().is_some_and(|name| name.text == known))
        };
        let params = || formals.iter().map(|formal| formal.name.as_str());
        let keys = [
            ("manner", call.manner.is_none()),
            ("within", call.within.is_none()),
            ("retry", call.retry.is_none()),
            ("as", call.bind.is_none()),
        ];
        let is_json = self.elaborator.form == Syntax::Json;
        let free_keys = keys.into_iter().filter(|(_, is_free)| is_json && *is_free).map(|(key, _)| key);
        let free = params().filter(|param| !is_given(param)).chain(free_keys);
        let meant = words::parameter(name, free).map(SmolStr::new);
        meant.or_else(|| near(name, params())).or_else(|| only_missing(call, formals))
    }
}

/// Returns whether an expression writes out a pose: by its word, or as three or four numbers.
fn is_pose(expr: &Expr) -> bool {
    let is_number = |item: &Expr| matches!(item.kind, ExprKind::Number(_) | ExprKind::Quantity(..));
    match &expr.kind {
        ExprKind::Call(call) => call.is_pose(),
        ExprKind::List(items) => (3..=4).contains(&items.len()) && items.iter().all(is_number),
        _ => false,
    }
}

/// The one parameter without default that has no argument: probably what a wrong name stands for.
fn only_missing(call: &Do, formals: &[FormalParam<'_>]) -> Option<SmolStr> {
    let args = &call.call.args;
    let is_given = |formal: &FormalParam<'_>| {
        args.iter().any(|arg| arg.name.as_ref().is_some_and(|name| name.text == *formal.name))
    };
    let named = args.iter().all(|arg| arg.name.is_some());
    let mut missing = formals.iter().filter(|formal| named && !formal.optional && !is_given(formal));
    match (missing.next(), missing.next()) {
        (Some(only), None) => Some(only.name.clone()),
        _ => None,
    }
}
