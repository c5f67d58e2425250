//! Templates: policies that are resolved once, and instantiated for each call that is tried; and the fluents
//! that a step needs, tests or changes. Two steps without a common fluent cannot refute each other.

use motet_syntax::ast::PrimitiveKind;
use motet_syntax::{Diagnostic, Mistake, Severity};
use smallvec::SmallVec;
use smol_str::SmolStr;

use super::ArgumentValue;
use crate::declare::{Library, NeedDef, PrimitiveDef};
use crate::environment::Environment;
use crate::ir::{Base, Condition, Fluent, Program, Rewrite, Step, StepId, StepKind, Substitution, Term};
use crate::prove::evaluation::CallFrame;
use crate::resolve::ResolvedStep;
use crate::resolve::diagnostics::Recursion;
use crate::session::Session;

/// A policy with open parameters.
#[derive(Clone, Debug)]
pub struct PolicyTemplate {
    program: Program,
    /// Bits of the fluents that it mentions, see [`super::IncrementalChecker::fluents`].
    pub(super) fluents: u64,
    pub(super) uses: u64,
    /// Names of the policies in it, its own first.
    calls: Vec<SmolStr>,
    goes_on: bool,
    /// Needs of the first steps that no step before them changes: they hold at the call, or are refuted.
    heads: Vec<NeedDef>,
}

impl PolicyTemplate {
    /// Resolves the policy with a name. `None` if there is none, or if it can only be resolved with its
    /// arguments.
    #[must_use]
    pub fn new(session: &Session, name: &str) -> Option<Self> {
        let (library, environment) = session.parts();
        let (mut program, made) = resolved(name, (library, environment))?;
        if made.diagnostics.iter().any(|said| said.severity == Severity::Error) {
            return None;
        }
        let (mut fluents, mut uses, mut calls) = (0, 0, Vec::new());
        for step in &program.steps {
            fluents |= of_step(&step.kind, library);
            match &step.kind {
                StepKind::Call(call) => uses |= library.primitive(call.primitive).map_or(0, |def| def.uses),
                StepKind::Inline { policy, .. } => calls.push(policy.clone()),
                _ => {}
            }
        }
        crate::limits::fill_in_bounds(&mut program, 0, library);
        let heads = heads(&program, library);
        Some(Self { program, fluents, uses, calls, goes_on: made.goes_on, heads })
    }

    /// Returns whether control can come behind a call of the policy with a name, or the template made of it.
    /// A policy whose every path ends in `fail` or `replan` never goes on.
    #[must_use]
    pub fn goes_on(session: &Session, name: &str, template: Option<&Self>) -> bool {
        match template {
            Some(template) => template.goes_on,
            None => resolved(name, session.parts()).is_none_or(|(_, made)| made.goes_on),
        }
    }

    /// Returns whether a condition in the policy compares values.
    #[must_use]
    pub fn compares(&self) -> bool {
        let mut conditions = self.program.steps.iter().flat_map(|step| step.kind.conditions());
        conditions.any(|condition| condition.any(&|part| matches!(part, Condition::Compare(..))))
    }

    /// Appends the policy with arguments to a program, and returns its first step.
    pub(super) fn write(&self, args: &[Term], library: &Library, program: &mut Program) -> StepId {
        let first = u32::try_from(program.steps.len()).unwrap_or(u32::MAX);
        let bound = u32::try_from(program.bindings.len()).unwrap_or(u32::MAX);
        let substitution = Substitution { args, first_step: first, first_binding: bound };
        for binding in &self.program.bindings {
            let mut binding = binding.clone();
            binding.binders.iter_mut().for_each(|id| substitution.step(id));
            // The calls below give the descriptions, which may be arguments.
            binding.descriptions = Some(SmallVec::new()).filter(|_| !binding.binders.is_empty());
            program.bindings.push(binding);
        }
        for step in &self.program.steps {
            let mut kind = step.kind.clone();
            substitution.kind(&mut kind);
            if let StepKind::Call(call) = &kind
                && let Some(binding) = call.binds.and_then(|id| program.bindings.get_mut(id.index()))
            {
                let is_found = matches!(binding.ty.base, Base::Entity(_))
                    && library
                        .primitive(call.primitive)
                        .is_some_and(|def| def.form == PrimitiveKind::Perception);
                let text = call.text().filter(|_| is_found);
                binding.descriptions = binding.descriptions.take().zip(text).map(|(mut all, text)| {
                    all.push(text.clone());
                    all
                });
            }
            let mut position = step.position;
            position.parent.iter_mut().for_each(|id| substitution.step(id));
            program.steps.push(Step { kind, span: step.span, position, bounds: step.bounds });
        }
        StepId(first)
    }
}

/// A policy of the library with open parameters, as a program of its own; `None` if there is none.
fn resolved(name: &str, (library, environment): (&Library, &Environment)) -> Option<(Program, ResolvedStep)> {
    let policy = library.names.policies.get(name).and_then(|index| library.policies.get(*index))?;
    let terms: Vec<Term> = (0..u16::try_from(policy.params.len()).ok()?).map(Term::Param).collect();
    let mut program = Program::default();
    let made = crate::resolve::resolve_inlined(policy, terms, (library, environment), &mut program);
    Some((program, made))
}

/// Needs of the first calls that no call before them changes; their parameters are those of the policy.
fn heads(program: &Program, library: &Library) -> Vec<NeedDef> {
    let (mut heads, mut changed) = (Vec::new(), 0);
    let first = program.steps.first().map(|step| &step.kind);
    if let Some(StepKind::Inline { body, .. }) = first {
        heads_of(body, (program, library), &mut changed, &mut heads);
    }
    heads
}

/// Adds the needs of a block, up to the first step that may not be reached, or behind which one may know
/// more. Returns false if there is such a step.
fn heads_of(
    block: &[StepId],
    given: (&Program, &Library),
    changed: &mut u64,
    heads: &mut Vec<NeedDef>,
) -> bool {
    let (program, library) = given;
    block.iter().all(|id| match program.step(*id).map(|step| &step.kind) {
        Some(StepKind::Call(call)) => {
            let Some(def) = library.primitive(call.primitive).filter(|_| !call.is_faulty) else {
                return false;
            };
            let substitution = Substitution { args: &call.args, first_step: 0, first_binding: 0 };
            for need in def.needs.iter().filter(|need| of_need(need) & *changed == 0) {
                let mut need = need.clone();
                substitution.condition(&mut need.condition);
                need.when.iter_mut().for_each(|when| substitution.condition(when));
                let binds =
                    |condition: &Condition| condition.any_term(&|term| matches!(term, Term::Binding(_)));
                if !binds(&need.condition) && !need.when.as_ref().is_some_and(binds) {
                    heads.push(need);
                }
            }
            *changed |= of_effects(def, library);
            true
        }
        Some(StepKind::Inline { body, .. } | StepKind::Sequence { body, .. }) => {
            heads_of(body, given, changed, heads)
        }
        // A loop runs its body at least once, as far as a proof knows.
        Some(StepKind::Each { body, .. } | StepKind::Repeat { body, .. }) => {
            heads_of(body, given, changed, heads);
            false
        }
        Some(StepKind::Let { .. } | StepKind::Delay { .. }) => true,
        _ => false,
    })
}

impl super::IncrementalChecker {
    /// Returns whether a call of a policy is permitted at the program point, as far as the state there
    /// decides. While an argument is unknown, only the needs of its first steps are checked.
    pub fn permits_policy(
        &mut self,
        session: &Session,
        (name, template): (&str, Option<&PolicyTemplate>),
        args: &[Option<ArgumentValue>],
    ) -> bool {
        if template.is_some_and(|template| template.calls.contains(&self.program.name)) {
            return false;
        }
        let given = args.iter().take_while(|arg| arg.is_some()).count();
        let terms: Vec<Term> =
            args.iter().map(|arg| arg.as_ref().map_or(Term::Unknown, |value| value.0.clone())).collect();
        let heads = template.map(|template| template.heads.as_slice()).unwrap_or_default();
        let is_known = |need: &&NeedDef| need.last_param().is_none_or(|last| usize::from(last) < given);
        let permits = self.everywhere(session, |prover| {
            let frame = CallFrame { args: &terms, result: None, each: None };
            !heads.iter().filter(is_known).any(|need| prover.need(need, frame).0.no.is_some())
        });
        permits && (given < args.len() || self.permits_open_policy(session, (name, template), args))
    }

    /// Returns whether a call of a policy is permitted, by a proof of all its steps with unknown arguments
    /// left open: what is refuted then is refuted for every argument. Costs more than a proof with all
    /// arguments.
    pub fn permits_open_policy(
        &mut self,
        session: &Session,
        (name, template): (&str, Option<&PolicyTemplate>),
        args: &[Option<ArgumentValue>],
    ) -> bool {
        let (library, environment) = session.parts();
        let terms: Vec<Term> =
            args.iter().map(|arg| arg.as_ref().map_or(Term::Unknown, |value| value.0.clone())).collect();
        let (steps, bindings) = (self.program.steps.len(), self.program.bindings.len());
        let program = &mut self.program;
        let id = match template {
            Some(template) => Some(template.write(&terms, library, program)),
            None => {
                let policy = library.names.policies.get(name).and_then(|index| library.policies.get(*index));
                let policy = policy.map(std::sync::Arc::clone);
                policy.and_then(|policy| {
                    let made =
                        crate::resolve::resolve_inlined(&policy, terms, (library, environment), program);
                    let recurses = |said: &Diagnostic| said.code == Recursion::CODE;
                    made.id.filter(|_| !made.diagnostics.iter().any(recurses))
                })
            }
        };
        let symbols = self.proof.symbols.len();
        self.proof.symbols.extend(&self.program, library, environment);
        let permits = id.is_some_and(|id| self.everywhere(session, |prover| prover.permits(id)));
        self.proof.symbols.truncate(symbols);
        self.program.steps.truncate(steps);
        self.program.bindings.truncate(bindings);
        permits
    }
}

/// Bit for the freshness of poses.
const FRESH: u64 = 1 << 63;

/// Bit of a fluent; several may share one.
fn bit(fluent: Fluent) -> u64 {
    1 << (fluent.index() % 63)
}

impl super::IncrementalChecker {
    /// Fluents that a call with this name mentions, as bits; several may share one. All bits for an unknown
    /// name.
    #[must_use]
    pub fn fluents(session: &Session, name: &str, template: Option<&PolicyTemplate>) -> u64 {
        let library = session.parts().0;
        match (library.names.primitives.get(name).and_then(|id| library.primitive(*id)), template) {
            (Some(def), _) => of_primitive(def, library),
            (None, Some(template)) => template.fluents,
            (None, None) => u64::MAX,
        }
    }

    /// Bit of the fluent with a name.
    #[must_use]
    pub fn fluent(session: &Session, name: &str) -> u64 {
        session.parts().0.names.fluents.get(name).map_or(u64::MAX, |fluent| bit(*fluent))
    }
}

fn of_condition(condition: &Condition) -> u64 {
    match condition {
        Condition::Fact(fact) => bit(fact.fluent),
        whole => whole.parts().iter().fold(0, |all, part| all | of_condition(part)),
    }
}

fn when(when: Option<&Condition>) -> u64 {
    when.map_or(0, of_condition)
}

/// Fluents that a need mentions.
pub(super) fn of_need(need: &NeedDef) -> u64 {
    of_condition(&need.condition) | when(need.when.as_ref())
}

/// Fluents that a primitive changes, and those that the change depends on.
pub(super) fn of_effects(def: &PrimitiveDef, library: &Library) -> u64 {
    let effects = def.makes.iter().chain(&def.unsettles);
    let effects = effects.map(|effect| bit(effect.fact.fluent) | when(effect.when.as_ref()));
    let mut all = effects.fold(0, |all, more| all | more);
    // What was perceived is stale once its resource is used or its object moved.
    let moves = def.form == PrimitiveKind::Action && !(def.makes.is_empty() && def.unsettles.is_empty());
    let lasts = library.primitives.iter().filter_map(|def| def.lasts.as_ref());
    if moves || lasts.into_iter().any(|lasts| lasts.resources & def.uses != 0) {
        all |= library.perceived.iter().fold(FRESH, |all, fluent| all | bit(*fluent));
    }
    all
}

fn of_primitive(def: &PrimitiveDef, library: &Library) -> u64 {
    let mut all = def.needs.iter().fold(of_effects(def, library), |all, need| all | of_need(need));
    if def.lasts.is_some() || def.params.iter().any(|param| param.ty.base == Base::Pose) {
        all |= FRESH;
    }
    all
}

/// Fluents that a step itself mentions, without the steps in it.
pub(super) fn of_step(kind: &StepKind, library: &Library) -> u64 {
    match kind {
        StepKind::Call(call) => {
            library.primitive(call.primitive).map_or(u64::MAX, |def| of_primitive(def, library))
        }
        StepKind::Unknown => u64::MAX,
        other => other.conditions().fold(0, |all, condition| all | of_condition(condition)),
    }
}
