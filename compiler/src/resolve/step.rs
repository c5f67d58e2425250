//! Resolution of steps and blocks.

use motet_syntax::ast::{Block, Catch, CatchOn, End, Policy, Reaction, Step, StepKind, When};
use motet_syntax::{Diagnostic, Span};
use smol_str::SmolStr;

use super::errors::{Shadows, TooManySteps};
use crate::declare::elaborator::{Elaborator, Expected, ValueRole};
use crate::declare::errors::{NotACondition, UnknownFailure, WrongType};
use crate::declare::name::{list, near};
use crate::ir::{self, Base, Binding, BindingId, BlockSlot, Program, StepId, StepPosition, Term, Ty};

/// Maximal number of steps of a policy with its sub-policies inlined.
pub const MAX_NODES: usize = 100_000;

/// Default deadline of a `wait` or `pause`, in seconds.
pub(super) const DEFAULT_WAIT_SECS: f64 = 60.0;

/// Resolves steps into the arena of a program.
pub(super) struct StepResolver<'a> {
    pub(super) elaborator: Elaborator<'a>,
    pub(super) program: Program,
    /// The inlined policy whose body is being resolved.
    pub(super) inline: Option<StepId>,
    /// Names of the policies that are being inlined, outermost first.
    pub(super) calls: Vec<SmolStr>,
    full: bool,
}

impl<'a> StepResolver<'a> {
    pub(super) fn new(elaborator: Elaborator<'a>) -> Self {
        Self { elaborator, program: Program::default(), inline: None, calls: Vec::new(), full: false }
    }

    pub(super) fn finish(self) -> Vec<Diagnostic> {
        self.elaborator.diagnostics
    }

    pub(super) fn policy(&mut self, policy: &Policy) -> Program {
        self.program.name = policy.name.text.clone();
        self.program.robot = self.elaborator.library.robot.clone();
        self.program.span = policy.span;
        self.calls.push(policy.name.text.clone());
        self.program.steps.reserve(2 * policy.body.steps.len());
        if let Some(goal) = &policy.achieves {
            self.program.achieves = Some((self.elaborator.condition(goal), goal.span));
        }
        // The parameters of a sub-policy that is checked by itself may be anything of their type.
        for param in &policy.params {
            let ty = crate::declare::resolve_type(&mut self.elaborator, &param.ty);
            let id = self.bind(param.name.text.clone(), ty, param.name.span, None);
            self.elaborator.scope.push(param.name.text.clone(), Term::Binding(id), ty, param.name.span);
            if let Some(binding) = self.elaborator.bindings.get_mut(id.index()) {
                binding.is_param = true;
                binding.uses = 1;
            }
        }
        self.program.body = self.block(&policy.body, None, BlockSlot::Steps);
        let mut program = std::mem::take(&mut self.program);
        program.bindings = std::mem::take(&mut self.elaborator.bindings);
        program
    }

    pub(super) fn block(&mut self, block: &Block, parent: Option<StepId>, slot: BlockSlot) -> ir::Block {
        let mark = self.elaborator.scope.mark();
        let mut steps = Vec::with_capacity(block.steps.len());
        for (index, step) in block.steps.iter().enumerate() {
            let position = StepPosition { parent, slot, index: u32::try_from(index).unwrap_or(u32::MAX) };
            match self.step(step, position) {
                Some(id) => steps.push(id),
                None if self.full => break,
                None => {}
            }
        }
        self.elaborator.scope.back_to(mark);
        steps
    }

    /// Reserves the next place in the arena, so that a parent precedes its children.
    pub(super) fn reserve(&mut self, span: Span, position: StepPosition) -> Option<StepId> {
        if self.program.steps.len() >= MAX_NODES {
            if !self.full {
                self.elaborator.report(TooManySteps { span, limit: MAX_NODES });
            }
            self.full = true;
            return None;
        }
        let id = StepId(u32::try_from(self.program.steps.len()).ok()?);
        let kind = ir::StepKind::Sequence { name: SmolStr::default(), body: Vec::new() };
        self.program.steps.push(ir::Step { kind, span, position, bounds: (0.0, 0.0) });
        Some(id)
    }

    pub(super) fn fill(&mut self, id: StepId, kind: ir::StepKind) -> Option<StepId> {
        self.program.steps.get_mut(id.index())?.kind = kind;
        Some(id)
    }

    pub(super) fn bind(
        &mut self,
        name: SmolStr,
        ty: Ty,
        span: Span,
        description: Option<SmolStr>,
    ) -> BindingId {
        let id = BindingId(u32::try_from(self.elaborator.bindings.len()).unwrap_or(u32::MAX));
        self.elaborator.bindings.push(Binding { name, ty, span, description, is_param: false, uses: 0 });
        id
    }

    /// Makes a binding visible to the end of the block.
    pub(super) fn name(&mut self, name: &SmolStr, id: BindingId, ty: Ty, span: Span) {
        let first = self.elaborator.scope.find(name).map(|entry| entry.span);
        // What a policy of the library calls its own is read there before any entity, and is for nobody
        // else to see.
        let hides = self.inline.is_none() && self.elaborator.entities.find(name).is_some();
        if first.is_some() || hides {
            self.elaborator.report(Shadows { span, name: name.clone(), first });
        }
        self.elaborator.scope.push(name.clone(), Term::Binding(id), ty, span);
    }

    pub(super) fn step(&mut self, step: &Step, position: StepPosition) -> Option<StepId> {
        if let StepKind::Do(call) = &step.kind {
            return self.call(call, step.span, position);
        }
        let id = self.reserve(step.span, position)?;
        let kind = match &step.kind {
            StepKind::Do(_) => return None,
            StepKind::Sequence { name, body } => ir::StepKind::Sequence {
                name: name.text.clone(),
                body: self.block(body, Some(id), BlockSlot::Steps),
            },
            StepKind::If { condition, then, otherwise } => ir::StepKind::If {
                condition: self.elaborator.condition(condition),
                span: condition.span,
                then: self.block(then, Some(id), BlockSlot::Then),
                otherwise: otherwise.as_ref().map(|block| self.block(block, Some(id), BlockSlot::Else)),
            },
            StepKind::Wait { condition, within } => ir::StepKind::Wait {
                condition: self.elaborator.condition(condition),
                within_secs: self.seconds_or(within.as_ref(), "the deadline of a `wait`"),
            },
            StepKind::Monitor { whens, body } => {
                let whens =
                    whens.iter().enumerate().map(|(index, when)| self.when(when, id, index)).collect();
                ir::StepKind::Monitor { whens, body: self.block(body, Some(id), BlockSlot::During) }
            }
            StepKind::Try { body, catches } => {
                let body = self.block(body, Some(id), BlockSlot::Try);
                let catches =
                    catches.iter().enumerate().map(|(index, catch)| self.catch(catch, id, index)).collect();
                ir::StepKind::Try { body, catches }
            }
            StepKind::Repeat { times, body, until } => {
                let times = self.elaborator.count(times, "the count of a `repeat`", 1).unwrap_or(1);
                let body = self.block(body, Some(id), BlockSlot::Steps);
                let until = until.as_ref().map(|until| (self.elaborator.condition(until), until.span));
                ir::StepKind::Repeat { times, body, until }
            }
            StepKind::Each { item, list, at_most, body } => {
                let (term, ty) = self.list_of(list);
                let at_most = self.elaborator.count(at_most, "the length of an `each`", 1).unwrap_or(1);
                let mark = self.elaborator.scope.mark();
                let binding = self.bind(item.text.clone(), ty, item.span, None);
                self.name(&item.text, binding, ty, item.span);
                let body = self.block(body, Some(id), BlockSlot::Steps);
                self.elaborator.scope.back_to(mark);
                ir::StepKind::Each { item: binding, list: term, at_most, body }
            }
            StepKind::Parallel { branches } => {
                let branches = branches.iter().enumerate();
                let slot = |index: usize| BlockSlot::Branch(u16::try_from(index).unwrap_or(u16::MAX));
                ir::StepKind::Parallel {
                    branches: branches
                        .map(|(index, block)| self.block(block, Some(id), slot(index)))
                        .collect(),
                }
            }
            StepKind::End(end) => ir::StepKind::End { kind: end.kind, of: self.inline, why: self.why(end) },
        };
        self.fill(id, kind)
    }

    fn list_of(&mut self, list: &motet_syntax::ast::Expr) -> (Term, Ty) {
        let (term, ty) = self.elaborator.term(list, None);
        match ty.element() {
            Some(element) => (term, element),
            None => {
                if ty.base != Base::Unknown {
                    let actual = self.elaborator.library.type_name(ty);
                    let place = "the list of an `each`".to_owned();
                    self.elaborator.report(WrongType {
                        span: list.span,
                        expected: "a list".to_owned(),
                        actual,
                        place,
                        example: None,
                        instead: None,
                    });
                }
                (Term::Unknown, Ty::UNKNOWN)
            }
        }
    }

    fn why(&mut self, end: &End) -> Option<Term> {
        let wanted = Expected { ty: Ty::TEXT, place: ValueRole::Named("the reason of an ending") };
        end.why.as_ref().map(|why| self.elaborator.term_of(why, wanted))
    }

    fn seconds_or(&mut self, expr: Option<&motet_syntax::ast::Expr>, place: &'static str) -> f64 {
        expr.and_then(|expr| self.elaborator.seconds(expr, place)).unwrap_or(DEFAULT_WAIT_SECS)
    }

    fn when(&mut self, when: &When, monitor: StepId, index: usize) -> ir::When {
        let slot = BlockSlot::Reaction(u16::try_from(index).unwrap_or(u16::MAX));
        let condition = self.elaborator.condition(&when.condition);
        let hold = when.hold.as_ref();
        let hold_secs =
            hold.and_then(|hold| self.elaborator.seconds(hold, "the time of a `for`")).unwrap_or(0.0);
        let reaction = match &when.reaction {
            Reaction::Pause { within, .. } => {
                ir::Reaction::Pause { within_secs: self.seconds_or(within.as_ref(), "the time of a `pause`") }
            }
            Reaction::Restart { at_most, .. } => ir::Reaction::Restart {
                at_most: self.elaborator.count(at_most, "the count of a `restart`", 1).unwrap_or(1),
            },
            Reaction::Resume { at_most, body, .. } => ir::Reaction::Resume {
                at_most: self.elaborator.count(at_most, "the count of a `resume`", 1).unwrap_or(1),
                body: self.block(body, Some(monitor), slot),
            },
            Reaction::End(end) => ir::Reaction::End { kind: end.kind, of: self.inline, why: self.why(end) },
        };
        ir::When { condition, span: when.condition.span, hold_secs, reaction }
    }

    fn catch(&mut self, catch: &Catch, id: StepId, index: usize) -> ir::Catch {
        let on = match &catch.on {
            CatchOn::Any(_) => None,
            CatchOn::Kinds(names) => {
                let library = self.elaborator.library;
                let mut kinds = Vec::with_capacity(names.len());
                for name in names {
                    match library.names.failures.get(&name.text) {
                        Some(kind) => kinds.push((*kind, name.span)),
                        None => {
                            let known = || library.failures.iter().map(|(name, _)| name);
                            let near = near(&name.text, known().map(SmolStr::as_str));
                            let known = list(known().cloned());
                            self.elaborator.report(UnknownFailure {
                                span: name.span,
                                name: name.text.clone(),
                                near,
                                known,
                            });
                        }
                    }
                }
                Some(kinds)
            }
        };
        let slot = BlockSlot::Catch(u16::try_from(index).unwrap_or(u16::MAX));
        let span = if let CatchOn::Any(span) = &catch.on { *span } else { catch.span };
        ir::Catch { on, span, body: self.block(&catch.body, Some(id), slot) }
    }

    /// Reports a condition in place of a step.
    pub(super) fn misplaced(&mut self, span: Span) {
        self.elaborator.report(NotACondition { span, found: "a condition", wanted: "a step" });
    }
}
