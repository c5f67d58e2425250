//! Templates: policies that are resolved once, and instantiated for each call that is tried.

use motet_syntax::ast::PrimitiveKind;
use motet_syntax::{Diagnostic, Mistake, Severity};
use smol_str::SmolStr;

use super::ArgumentValue;
use crate::declare::{Library, NeedDef};
use crate::ir::{
    Base, BindingId, Block, Condition, Fact, Program, Reaction, Step, StepId, StepKind, Term, When,
};
use crate::prove::evaluation::CallFrame;
use crate::resolve::errors::Recursion;
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
    /// Needs of the first steps that no step before them changes: they hold at the call, or are refuted.
    heads: Vec<NeedDef>,
}

impl PolicyTemplate {
    /// Resolves the policy with a name. `None` if there is none, or if it can only be resolved with its
    /// arguments.
    #[must_use]
    pub fn new(session: &Session, name: &str) -> Option<Self> {
        let (library, environment) = session.parts();
        let policy = library.names.policies.get(name).and_then(|index| library.policies.get(*index))?;
        let terms: Vec<Term> = (0..u16::try_from(policy.params.len()).ok()?).map(Term::Param).collect();
        let mut program = Program::default();
        let (_, said) = crate::resolve::resolve_inlined(policy, terms, (library, environment), &mut program);
        if said.iter().any(|said| said.severity == Severity::Error) {
            return None;
        }
        let (mut fluents, mut uses, mut calls) = (0, 0, Vec::new());
        for step in &program.steps {
            fluents |= super::fluents::of_step(&step.kind, library);
            match &step.kind {
                StepKind::Call(call) => uses |= library.primitive(call.primitive).map_or(0, |def| def.uses),
                StepKind::Inline { policy, .. } => calls.push(policy.clone()),
                _ => {}
            }
        }
        let heads = heads(&program, library);
        Some(Self { program, fluents, uses, calls, heads })
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
        let writer = Writer { args, first, bound };
        program.bindings.extend(self.program.bindings.iter().cloned());
        for step in &self.program.steps {
            let kind = writer.kind(&step.kind);
            if let StepKind::Call(call) = &step.kind
                && let StepKind::Call(made) = &kind
            {
                let text = made.args.iter().find_map(|arg| match arg {
                    Term::Text(text) => Some(text),
                    _ => None,
                });
                let perceives = library
                    .primitive(call.primitive)
                    .is_some_and(|def| def.form == PrimitiveKind::Perception);
                let binding = made.binds.and_then(|id| program.bindings.get_mut(id.index()));
                if let Some(binding) = binding.filter(|binding| matches!(binding.ty.base, Base::Entity(_))) {
                    binding.description = text.filter(|_| perceives).cloned();
                }
            }
            let position = crate::ir::StepPosition {
                parent: step.position.parent.map(|id| writer.step(id)),
                ..step.position
            };
            program.steps.push(Step { kind, span: step.span, position, bounds: step.bounds });
        }
        StepId(first)
    }
}

/// Needs of the first calls that no call before them changes; their parameters are those of the policy.
fn heads(program: &Program, library: &Library) -> Vec<NeedDef> {
    let mut heads = Vec::new();
    let mut changed = 0;
    let body = program.steps.first().map(|step| &step.kind);
    let Some(StepKind::Inline { body, .. }) = body else { return heads };
    for step in body.iter().filter_map(|id| program.step(*id)) {
        let StepKind::Call(call) = &step.kind else { break };
        let Some(def) = library.primitive(call.primitive) else { break };
        let writer = Writer { args: &call.args, first: 0, bound: 0 };
        for need in def.needs.iter().filter(|need| super::fluents::of_need(need) & changed == 0) {
            let need = NeedDef {
                condition: writer.condition(&need.condition),
                when: need.when.as_ref().map(|when| writer.condition(when)),
                each: need.each,
                span: need.span,
            };
            let binds = |condition: &Condition| condition.any_term(&|term| matches!(term, Term::Binding(_)));
            if !binds(&need.condition) && !need.when.as_ref().is_some_and(binds) {
                heads.push(need);
            }
        }
        changed |= super::fluents::of_effects(def, library);
    }
    heads
}

/// Replaces parameters by arguments, and renumbers steps and bindings.
struct Writer<'a> {
    args: &'a [Term],
    first: u32,
    bound: u32,
}

impl Writer<'_> {
    fn step(&self, id: StepId) -> StepId {
        StepId(id.0.saturating_add(self.first))
    }

    fn binding(&self, id: BindingId) -> BindingId {
        BindingId(id.0.saturating_add(self.bound))
    }

    fn block(&self, block: &Block) -> Block {
        block.iter().map(|id| self.step(*id)).collect()
    }

    fn term(&self, term: &Term) -> Term {
        match term {
            Term::Param(index) => self.args.get(usize::from(*index)).cloned().unwrap_or(Term::Unknown),
            Term::Binding(id) => Term::Binding(self.binding(*id)),
            Term::List(terms) => Term::List(terms.iter().map(|term| self.term(term)).collect()),
            Term::Field(of, name) => Term::Field(Box::new(self.term(of)), name.clone()),
            Term::Measure(id, args) => Term::Measure(*id, args.iter().map(|arg| self.term(arg)).collect()),
            Term::Arith(op, left, right) => {
                Term::Arith(*op, Box::new(self.term(left)), Box::new(self.term(right)))
            }
            Term::Bool(_)
            | Term::Int(_)
            | Term::Number(_)
            | Term::Text(_)
            | Term::Case(..)
            | Term::Entity(_)
            | Term::Result
            | Term::Each
            | Term::Unknown => term.clone(),
        }
    }

    fn condition(&self, condition: &Condition) -> Condition {
        let all = |parts: &[Condition]| parts.iter().map(|part| self.condition(part)).collect();
        match condition {
            Condition::Fact(fact) => {
                let args = fact.args.iter().map(|arg| arg.as_ref().map(|arg| self.term(arg)));
                Condition::Fact(Fact { fluent: fact.fluent, args: args.collect() })
            }
            Condition::Compare(op, left, right) => Condition::Compare(*op, self.term(left), self.term(right)),
            Condition::Not(inner) => Condition::Not(Box::new(self.condition(inner))),
            Condition::All(parts) => Condition::All(all(parts)),
            Condition::AnyOf(parts) => Condition::AnyOf(all(parts)),
            Condition::Literal(_)
            | Condition::MonitoredMeasure(_)
            | Condition::MonitoredFluent(_)
            | Condition::Unknown => condition.clone(),
        }
    }

    fn reaction(&self, reaction: &Reaction) -> Reaction {
        match reaction {
            Reaction::Pause { .. } | Reaction::Restart { .. } => reaction.clone(),
            Reaction::Resume { at_most, body } => {
                Reaction::Resume { at_most: *at_most, body: self.block(body) }
            }
            Reaction::End { kind, of, why } => Reaction::End {
                kind: *kind,
                of: of.map(|id| self.step(id)),
                why: why.as_ref().map(|why| self.term(why)),
            },
        }
    }

    fn kind(&self, kind: &StepKind) -> StepKind {
        match kind {
            StepKind::Call(call) => StepKind::Call(crate::ir::Call {
                args: call.args.iter().map(|arg| self.term(arg)).collect(),
                binds: call.binds.map(|id| self.binding(id)),
                spans: call.spans.clone(),
                units: call.units.clone(),
                ..*call
            }),
            StepKind::Sequence { name, body } => {
                StepKind::Sequence { name: name.clone(), body: self.block(body) }
            }
            StepKind::Inline { policy, body } => {
                StepKind::Inline { policy: policy.clone(), body: self.block(body) }
            }
            StepKind::If { condition, span, then, otherwise } => StepKind::If {
                condition: self.condition(condition),
                span: *span,
                then: self.block(then),
                otherwise: otherwise.as_ref().map(|block| self.block(block)),
            },
            StepKind::Wait { condition, within_secs } => {
                StepKind::Wait { condition: self.condition(condition), within_secs: *within_secs }
            }
            StepKind::Monitor { whens, body } => {
                let when = |when: &When| When {
                    condition: self.condition(&when.condition),
                    reaction: self.reaction(&when.reaction),
                    ..*when
                };
                StepKind::Monitor { whens: whens.iter().map(when).collect(), body: self.block(body) }
            }
            StepKind::Try { body, catches } => {
                let catch = |catch: &crate::ir::Catch| crate::ir::Catch {
                    on: catch.on.clone(),
                    body: self.block(&catch.body),
                    ..*catch
                };
                StepKind::Try { body: self.block(body), catches: catches.iter().map(catch).collect() }
            }
            StepKind::Repeat { times, body, until } => StepKind::Repeat {
                times: *times,
                body: self.block(body),
                until: until.as_ref().map(|(until, span)| (self.condition(until), *span)),
            },
            StepKind::Each { item, list, at_most, body } => StepKind::Each {
                item: self.binding(*item),
                list: self.term(list),
                at_most: *at_most,
                body: self.block(body),
            },
            StepKind::Parallel { branches } => {
                StepKind::Parallel { branches: branches.iter().map(|block| self.block(block)).collect() }
            }
            StepKind::End { kind, of, why } => StepKind::End {
                kind: *kind,
                of: of.map(|id| self.step(id)),
                why: why.as_ref().map(|why| self.term(why)),
            },
            StepKind::Unknown => StepKind::Unknown,
        }
    }
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
        let Self { program, proof, inside, .. } = self;
        let id = match template {
            Some(template) => Some(template.write(&terms, library, program)),
            None => {
                let policy = library.names.policies.get(name).and_then(|index| library.policies.get(*index));
                let policy = policy.map(std::sync::Arc::clone);
                policy.and_then(|policy| {
                    let made =
                        crate::resolve::resolve_inlined(&policy, terms, (library, environment), program);
                    let recurses = |said: &Diagnostic| said.code == Recursion::CODE;
                    made.0.filter(|_| !made.1.iter().any(recurses))
                })
            }
        };
        let symbols = proof.symbols.len();
        proof.symbols.extend(program, library, environment);
        let given = (&*program, library, environment);
        let permits = id.is_some_and(|id| match inside {
            None if !proof.live => true,
            None => proof.here(given, |prover| prover.permits(id)),
            Some((_, states_at_point)) => {
                states_at_point.iter_mut().all(|state| proof.at(state, given, |prover| prover.permits(id)))
            }
        });
        proof.symbols.truncate(symbols);
        program.steps.truncate(steps);
        program.bindings.truncate(bindings);
        permits
    }
}
