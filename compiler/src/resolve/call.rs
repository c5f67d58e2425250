//! Calls of primitives and of sub-policies, as steps.

use std::sync::Arc;

use motet_syntax::Span;
use motet_syntax::ast::{Do, Expr, Policy, PrimitiveKind};
use smallvec::{SmallVec, smallvec};
use smol_str::SmolStr;

use super::errors::{
    BadDeclaration, MissingArgument, NoResult, Recursion, TooManyArguments, UnknownParameter,
    UnknownPrimitive,
};
use super::expr::{Place as Spot, Wanted};
use super::near::{list, near};
use super::step::Steps;
use crate::ir::{self, Base, Place, Slot, StepId, StepKind, Term, Ty};
use crate::library::PrimitiveDef;

/// A parameter as a call sees it.
struct Formal<'p> {
    name: &'p SmolStr,
    ty: Ty,
    optional: bool,
}

/// The parameters of something called: few, as a rule.
type Formals<'p> = SmallVec<[Formal<'p>; 4]>;

impl Steps<'_> {
    pub(super) fn call(&mut self, call: &Do, span: Span, place: Place) -> Option<StepId> {
        let library = self.resolver.library;
        let name = &call.call.name.text;
        if self.calls.contains(name) {
            self.resolver.say(Recursion { span: call.call.name.span, name: name.clone() });
            return self.unknown(span, place);
        }
        if let Some(id) = library.names.primitives.get(name).copied() {
            let def = library.primitive(id)?;
            return self.primitive(call, id, def, span, place);
        }
        if let Some(policy) = library.names.policies.get(name).and_then(|index| library.policies.get(*index))
        {
            return self.inline(call, &Arc::clone(policy), span, place);
        }
        if library.names.fluents.contains_key(name) || library.names.measures.contains_key(name) {
            self.misplaced(call.call.name.span);
            return self.unknown(span, place);
        }
        let provided = library.primitives.iter().filter(|def| def.provided).map(|def| def.name.as_str());
        let near =
            near(name, provided.chain(library.policies.iter().map(|policy| policy.name.text.as_str())));
        self.resolver.say(UnknownPrimitive { span: call.call.name.span, name: name.clone(), near });
        // What it binds exists all the same, so that its uses are not reported as well.
        if let Some(bind) = &call.bind {
            let id = self.bind(bind.text.clone(), Ty::UNKNOWN, bind.span, None);
            self.name(&bind.text, id, Ty::UNKNOWN, bind.span);
            if let Some(binding) = self.resolver.bindings.get_mut(id.index()) {
                binding.uses = 1;
            }
        }
        for arg in &call.call.args {
            self.use_names(&arg.value);
        }
        self.unknown(span, place)
    }

    /// A step of which nothing is known, after an error that was reported.
    fn unknown(&mut self, span: Span, place: Place) -> Option<StepId> {
        let id = self.reserve(span, place)?;
        self.fill(id, StepKind::Unknown)
    }

    /// Names in the arguments of a call that does not exist count as used, and are not reported.
    fn use_names(&mut self, expr: &Expr) {
        let said = self.resolver.diagnostics.len();
        self.resolver.term(expr, None);
        self.resolver.diagnostics.truncate(said);
    }

    fn primitive(
        &mut self,
        call: &Do,
        primitive: ir::Primitive,
        def: &PrimitiveDef,
        span: Span,
        place: Place,
    ) -> Option<StepId> {
        let id = self.reserve(span, place)?;
        let formals: Formals<'_> = def
            .params
            .iter()
            .map(|param| Formal { name: &param.name, ty: param.ty, optional: param.default.is_some() })
            .collect();
        let given = self.match_arguments(call, &def.name, &formals);
        let mut args = SmallVec::with_capacity(given.len());
        let mut spans = SmallVec::with_capacity(given.len());
        let mut units = SmallVec::with_capacity(given.len());
        let mut description = None;
        for ((arg, param), formal) in given.into_iter().zip(&def.params).zip(&formals) {
            let (term, at) = match arg {
                Some(expr) => {
                    let wanted = Wanted { ty: formal.ty, place: Spot::Param(&param.name, &def.name) };
                    (self.resolver.term_of(expr, wanted), expr.span)
                }
                None => (param.default.clone().unwrap_or(Term::Unknown), call.call.span),
            };
            if let (Term::Text(text), None, PrimitiveKind::Perception) = (&term, &description, def.form) {
                description = Some(text.clone());
            }
            args.push(term);
            spans.push(at);
            units.push(arg.and_then(Expr::unit));
        }
        let within_secs = call.within.as_ref().and_then(|within| self.resolver.seconds(within, "a deadline"));
        let retries =
            call.retry.as_ref().and_then(|retry| self.resolver.count(retry, "the count of a `retry`", 0));
        let binds = match (def.result, &call.bind) {
            (Some(ty), Some(name)) => {
                let described = description.filter(|_| matches!(ty.base, Base::Entity(_)));
                let binding = self.bind(name.text.clone(), ty, name.span, described);
                self.name(&name.text, binding, ty, name.span);
                Some(binding)
            }
            (Some(ty), None) => {
                let described = description.filter(|_| matches!(ty.base, Base::Entity(_)));
                Some(self.bind(SmolStr::new_static("_"), ty, span, described))
            }
            (None, Some(name)) => {
                let mistake = NoResult { span: name.span, callee: def.name.clone(), name: name.text.clone() };
                self.resolver.say(mistake);
                let binding = self.bind(name.text.clone(), Ty::UNKNOWN, name.span, None);
                self.name(&name.text, binding, Ty::UNKNOWN, name.span);
                None
            }
            (None, None) => None,
        };
        let retries = retries.unwrap_or(0);
        self.fill(id, StepKind::Call(ir::Call { primitive, args, spans, units, binds, within_secs, retries }))
    }

    fn inline(&mut self, call: &Do, policy: &Policy, span: Span, place: Place) -> Option<StepId> {
        let name = policy.name.text.clone();
        let id = self.reserve(span, place)?;
        if let Some(bind) = &call.bind {
            self.resolver.say(NoResult { span: bind.span, callee: name.clone(), name: bind.text.clone() });
        }
        for clause in [&call.within, &call.retry].into_iter().flatten() {
            self.resolver.say(BadDeclaration {
                span: clause.span,
                what: format!("`{name}` is a policy: it has neither a deadline nor retries of its own"),
                mend: "put them on the steps inside, or use `try` and `repeat` around the call".to_owned(),
            });
        }
        let mut types = Vec::with_capacity(policy.params.len());
        for param in &policy.params {
            types.push(crate::library::resolve_type(&mut self.resolver, &param.ty));
        }
        let formals: Formals<'_> = policy
            .params
            .iter()
            .zip(&types)
            .map(|(param, ty)| Formal { name: &param.name.text, ty: *ty, optional: param.default.is_some() })
            .collect();
        let given = self.match_arguments(call, &name, &formals);
        let mut terms = Vec::with_capacity(given.len());
        for ((arg, param), ty) in given.into_iter().zip(&policy.params).zip(&types) {
            let wanted = Wanted { ty: *ty, place: Spot::Param(&param.name.text, &name) };
            let term = match (arg, &param.default) {
                (Some(expr), _) => self.resolver.term_of(expr, wanted),
                (None, Some(default)) => self.in_text(|steps| steps.resolver.term_of(default, wanted)),
                (None, None) => Term::Unknown,
            };
            terms.push(term);
        }
        self.body(id, policy, &types, terms)
    }

    /// A call of a policy outside of any step.
    pub(super) fn write_out(&mut self, policy: &Policy, args: Vec<Term>) -> Option<StepId> {
        if self.calls.contains(&policy.name.text) {
            let (span, name) = (policy.name.span, policy.name.text.clone());
            self.resolver.say(Recursion { span, name });
            return None;
        }
        let id = self.reserve(policy.span, Place { parent: None, slot: Slot::Steps, index: 0 })?;
        let types = policy.params.iter();
        let types: Vec<Ty> =
            types.map(|param| crate::library::resolve_type(&mut self.resolver, &param.ty)).collect();
        self.body(id, policy, &types, args)
    }

    /// The steps of a policy that is called with these arguments.
    fn body(&mut self, id: StepId, policy: &Policy, types: &[Ty], args: Vec<Term>) -> Option<StepId> {
        let name = policy.name.text.clone();
        let mark = self.resolver.scope.mark();
        self.resolver.scope.raise_barrier();
        for ((param, ty), term) in policy.params.iter().zip(types).zip(args) {
            self.resolver.scope.push(param.name.text.clone(), term, *ty, param.name.span);
        }
        let outer = self.inline.replace(id);
        self.calls.push(name.clone());
        let body = self.in_text(|steps| steps.block(&policy.body, Some(id), Slot::Inlined));
        self.calls.pop();
        self.inline = outer;
        self.resolver.scope.back_to(mark);
        self.fill(id, StepKind::Inline { policy: name, body })
    }

    /// Sub-policies are always text, whatever form the calling document has.
    fn in_text<T>(&mut self, run: impl FnOnce(&mut Self) -> T) -> T {
        let form = std::mem::replace(&mut self.resolver.form, motet_syntax::Syntax::Text);
        let result = run(self);
        self.resolver.form = form;
        result
    }

    /// The argument for each parameter.
    fn match_arguments<'e>(
        &mut self,
        call: &'e Do,
        callee: &SmolStr,
        formals: &[Formal<'_>],
    ) -> SmallVec<[Option<&'e Expr>; 4]> {
        let mut given: SmallVec<[Option<&Expr>; 4]> = smallvec![None; formals.len()];
        let mut unknown = 0;
        for (position, arg) in call.call.args.iter().enumerate() {
            let index = match &arg.name {
                None => position,
                Some(name) => match formals.iter().position(|formal| *formal.name == name.text) {
                    Some(index) => index,
                    None => {
                        unknown += 1;
                        let near = near(&name.text, formals.iter().map(|formal| formal.name.as_str()))
                            .or_else(|| only_missing(call, formals));
                        let known = list(formals.iter().map(|formal| formal.name.clone()));
                        let (name, span) = (name.text.clone(), name.span);
                        self.resolver.say(UnknownParameter {
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
                    self.resolver.say(TooManyArguments {
                        span: arg.span,
                        callee: callee.clone(),
                        most,
                        twice,
                    });
                }
                None => {
                    let most = formals.len();
                    self.resolver.say(TooManyArguments {
                        span: arg.span,
                        callee: callee.clone(),
                        most,
                        twice: None,
                    });
                }
            }
        }
        // An argument under a wrong name is most likely the one that is missing.
        let missing = formals.iter().zip(&given).filter(|(formal, slot)| slot.is_none() && !formal.optional);
        for (formal, _) in missing.skip(unknown) {
            let ty = self.resolver.library.type_name(formal.ty);
            let (callee, param) = (callee.clone(), formal.name.clone());
            self.resolver.say(MissingArgument { span: call.call.span, callee, param, ty });
        }
        given
    }
}

/// The one parameter without default that no argument of a call names: what an argument under a wrong name is meant for.
fn only_missing(call: &Do, formals: &[Formal<'_>]) -> Option<SmolStr> {
    let args = &call.call.args;
    let is_given = |formal: &Formal<'_>| {
        args.iter().any(|arg| arg.name.as_ref().is_some_and(|name| name.text == *formal.name))
    };
    let named = args.iter().all(|arg| arg.name.is_some());
    let mut missing = formals.iter().filter(|formal| named && !formal.optional && !is_given(formal));
    match (missing.next(), missing.next()) {
        (Some(only), None) => Some(only.name.clone()),
        _ => None,
    }
}
