//! A policy that steps call, resolved once and written out for each call that is tried.

use motet_syntax::ast::PrimitiveKind;
use motet_syntax::{Diagnostic, Mistake, Severity};
use smol_str::SmolStr;

use super::Value;
use crate::ir::{
    Base, BindingId, Block, Condition, Fact, Program, Reaction, Step, StepId, StepKind, Term, When,
};
use crate::library::{Library, NeedDef};
use crate::prove::eval::Frame;
use crate::resolve::errors::Recursion;
use crate::session::Session;

/// A policy with its parameters open.
#[derive(Clone, Debug)]
pub struct Template {
    program: Program,
    /// The bits of the fluents that it speaks of, see [`super::Draft::fluents`].
    pub(super) fluents: u64,
    pub(super) uses: u64,
    /// The policies in it, itself first.
    calls: Vec<SmolStr>,
    /// What its first steps need that no step before them changes: it holds where the policy is called, or is refuted.
    heads: Vec<NeedDef>,
}

impl Template {
    /// The policy with this name; none where there is none, or where it can only be resolved with its arguments.
    #[must_use]
    pub fn new(session: &Session, name: &str) -> Option<Self> {
        let (library, world) = session.parts();
        let policy = library.names.policies.get(name).and_then(|index| library.policies.get(*index))?;
        let terms: Vec<Term> = (0..u16::try_from(policy.params.len()).ok()?).map(Term::Param).collect();
        let mut program = Program::default();
        let (_, said) = crate::resolve::resolve_inlined(policy, terms, (library, world), &mut program);
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

    /// Whether a condition in it compares anything: texts, say.
    #[must_use]
    pub fn compares(&self) -> bool {
        let mut conditions = self.program.steps.iter().flat_map(|step| step.kind.conditions());
        conditions.any(|condition| condition.any(&|part| matches!(part, Condition::Compare(..))))
    }

    /// Appends the policy to a program with these arguments; its first step.
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
            let place =
                crate::ir::Place { parent: step.place.parent.map(|id| writer.step(id)), ..step.place };
            program.steps.push(Step { kind, span: step.span, place, bounds: step.bounds });
        }
        StepId(first)
    }
}

/// The needs of the first calls of a policy of which nothing was changed before; their parameters are those of the policy.
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

/// Puts arguments in the place of parameters, and numbers steps and bindings anew.
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

impl super::Draft {
    /// Whether a call of a policy may stand at the place, as far as the state there tells. While an argument is not known
    /// yet only what its first steps need is asked for.
    pub fn permits_policy(
        &mut self,
        session: &Session,
        (name, template): (&str, Option<&Template>),
        args: &[Option<Value>],
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
            let frame = Frame { args: &terms, result: None, each: None };
            !heads.iter().filter(is_known).any(|need| prover.need(need, frame).0.no.is_some())
        });
        permits && (given < args.len() || self.permits_open_policy(session, (name, template), args))
    }

    /// The same by a proof of all its steps, in which an argument that is not known yet may be anything: what is refuted then is
    /// refuted whatever it is. It costs more than a proof with all arguments.
    pub fn permits_open_policy(
        &mut self,
        session: &Session,
        (name, template): (&str, Option<&Template>),
        args: &[Option<Value>],
    ) -> bool {
        let (library, world) = session.parts();
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
                    let made = crate::resolve::resolve_inlined(&policy, terms, (library, world), program);
                    let recurses = |said: &Diagnostic| said.code == Recursion::CODE;
                    made.0.filter(|_| !made.1.iter().any(recurses))
                })
            }
        };
        let symbols = proof.symbols.len();
        proof.symbols.extend(program, library, world);
        let given = (&*program, library, world);
        let permits = id.is_some_and(|id| match inside {
            None if !proof.live => true,
            None => proof.here(given, |prover| prover.permits(id)),
            Some((_, stands)) => {
                stands.iter_mut().all(|stand| proof.at(stand, given, |prover| prover.permits(id)))
            }
        });
        proof.symbols.truncate(symbols);
        program.steps.truncate(steps);
        program.bindings.truncate(bindings);
        permits
    }
}
