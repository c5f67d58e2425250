//! Stage 1, name resolution and typing: from a syntax tree to a [`Program`] in which every name is an id,
//! every argument has its place, and every sub-policy is inlined.
//!
//! Names and types are one stage, because the expected type decides whether a plain string of the JSON syntax
//! is an entity, a case, a quantity or a text.
//!
//! Guarded by the pages in `compiler/codes`, which `compiler/tests/compiler/explain.rs` runs.

mod call;
pub(crate) mod diagnostics;
mod path;
mod result;
mod step;
mod step_suggestion;

use motet_syntax::ast::{Expr, ExprKind, Policy};
use motet_syntax::{Diagnostic, Span, Syntax};
use smol_str::SmolStr;

use self::result::PolicyResult;
pub use self::step::MAX_NODES;
use self::step::StepResolver;
use crate::declare::elaborator::{Elaborator, Expected, ValueRole};
use crate::declare::name::Scope;
use crate::declare::{Library, PrimitiveDef};
use crate::environment::Environment;
use crate::ir::{BlockSlot, MotionKind, Program, StepId, StepPosition, Term};

/// Resolves one policy.
pub(crate) fn resolve(
    policy: &Policy,
    form: Syntax,
    library: &Library,
    environment: &Environment,
) -> (Program, Vec<Diagnostic>) {
    let elaborator = Elaborator::new(library, environment.entities(), environment.has_scene(), form);
    let mut steps = StepResolver::new(elaborator);
    let program = steps.policy(policy);
    (program, steps.finish())
}

/// Resolves one policy, and records the scope before the step with the span `point`.
pub(crate) fn resolve_at(
    policy: &Policy,
    point: Span,
    form: Syntax,
    library: &Library,
    environment: &Environment,
) -> (Program, Option<Scope>) {
    let elaborator = Elaborator::new(library, environment.entities(), environment.has_scene(), form);
    let mut steps = StepResolver::new(elaborator);
    steps.point = Some(point);
    let program = steps.policy(policy);
    (program, steps.scope_at_point)
}

/// A step that was resolved by itself.
#[derive(Debug)]
pub(crate) struct ResolvedStep {
    pub(crate) id: Option<StepId>,
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// False if control never reaches its end.
    pub(crate) goes_on: bool,
    /// Scope before the step in it that was asked for.
    pub(crate) scope_at_point: Option<Scope>,
}

/// Resolves one more step of the body of the policy `name`, inside of the rules of the step `kept`: appends
/// it to `program`, and adds its bindings to `scope`. Records the scope before the step in it with the span
/// `point`.
pub(crate) fn resolve_step(
    step: &motet_syntax::ast::Step,
    (kept, point): (Option<StepId>, Span),
    (form, name): (Syntax, &smol_str::SmolStr),
    (library, environment): (&Library, &Environment),
    program: &mut Program,
    scope: &mut Scope,
) -> ResolvedStep {
    let elaborator = Elaborator {
        scope: std::mem::take(scope),
        bindings: std::mem::take(&mut program.bindings),
        ..Elaborator::new(library, environment.entities(), environment.has_scene(), form)
    };
    let mut steps = StepResolver::new(elaborator);
    steps.point = Some(point);
    steps.program = std::mem::take(program);
    let declared = steps.program.result.and_then(|id| steps.elaborator.bindings.get(id.index()));
    steps.result = PolicyResult::new(declared.map(|binding| binding.ty), steps.program.result);
    steps.calls.push(name.clone());
    let index = u32::try_from(steps.program.body.len()).unwrap_or(u32::MAX);
    let slot = if kept.is_some() { BlockSlot::Kept } else { BlockSlot::Steps };
    let place = StepPosition { parent: kept, slot, index };
    let id = steps.step(step, place);
    *program = std::mem::take(&mut steps.program);
    program.bindings = std::mem::take(&mut steps.elaborator.bindings);
    *scope = std::mem::take(&mut steps.elaborator.scope);
    steps.resolved(id)
}

/// Appends a call of a policy with arguments to a program, and returns its first step.
pub(crate) fn resolve_inlined(
    policy: &Policy,
    args: Vec<Term>,
    (library, environment): (&Library, &Environment),
    program: &mut Program,
) -> ResolvedStep {
    let elaborator = Elaborator {
        bindings: std::mem::take(&mut program.bindings),
        ..Elaborator::new(library, environment.entities(), environment.has_scene(), Syntax::Text)
    };
    let mut steps = StepResolver::new(elaborator);
    steps.program = std::mem::take(program);
    steps.calls.push(steps.program.name.clone());
    let id = steps.write_out(policy, args);
    *program = std::mem::take(&mut steps.program);
    program.bindings = std::mem::take(&mut steps.elaborator.bindings);
    steps.resolved(id)
}

/// Type-checks the arguments of a motion query as a call of a primitive with this motion would; empty if one
/// of the robot's primitives accepts them. Checks only parameters of the primitive; the last arguments may be
/// left out.
pub(crate) fn check_motion(
    name: &str,
    args: &[(SmolStr, Span)],
    library: &Library,
    environment: &Environment,
) -> Vec<Diagnostic> {
    let kind = MotionKind::from_name(name);
    let mut least: Option<Vec<Diagnostic>> = None;
    for def in library.primitives.iter().filter(|def| def.provided) {
        let Some((_, terms)) =
            def.motion.as_ref().filter(|(own, terms)| Some(*own) == kind && terms.len() >= args.len())
        else {
            continue;
        };
        let said = taken(def, terms, args, library, environment);
        if least.as_ref().is_none_or(|least| said.len() < least.len()) {
            least = Some(said);
        }
    }
    least.unwrap_or_default()
}

fn taken(
    def: &PrimitiveDef,
    terms: &[Term],
    args: &[(SmolStr, Span)],
    library: &Library,
    environment: &Environment,
) -> Vec<Diagnostic> {
    let mut elaborator =
        Elaborator::new(library, environment.entities(), environment.has_scene(), Syntax::Text);
    for (term, (name, span)) in terms.iter().zip(args) {
        let Term::Param(index) = term else { continue };
        let Some(param) = def.params.get(usize::from(*index)) else { continue };
        let expr = Expr { kind: ExprKind::Name(name.clone()), span: *span };
        elaborator.term_of(&expr, Expected { ty: param.ty, place: ValueRole::Param(&param.name, &def.name) });
    }
    elaborator.diagnostics
}
