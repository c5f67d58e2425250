//! Resolution of steps and blocks.

use motet_syntax::ast::{
    Block, Catch, CatchOn, CompareOp, End, EndKind, Expr, Keep, KeepKind, MAX_NESTING, Name, Policy,
    Reaction, Step, StepKind, When,
};
use motet_syntax::{Diagnostic, Span, Syntax};
use smallvec::{SmallVec, smallvec};
use smol_str::{SmolStr, format_smolstr};

use super::ResolvedStep;
use super::diagnostics::{NoReason, Shadows, TooManySteps};
use super::path::{Fork, without_value};
use super::result::{PolicyResult, stands_for_itself};
use crate::declare::diagnostics::{NotACondition, UnknownFailure};
use crate::declare::elaborator::{Elaborator, Expected, ValueRole};
use crate::declare::name::{Scope, ScopeMark, list, near};
use crate::declare::unbound::Unbound;
use crate::facts::effort;
use crate::ir::{self, Binding, BindingId, BlockSlot, Condition, Program, StepId, StepPosition, Term, Ty};

/// Maximal number of steps of a policy with its sub-policies inlined.
pub const MAX_NODES: usize = 20_000;
/// Weight of a step of a policy that is inlined, in the work of a document: each of its policies may inline
/// all others.
const INLINED: usize = 2 * effort::VISIT;
/// Greatest nesting of blocks with those of the policies that are called: every stage descends into them.
const MAX_DEPTH: usize = 4 * MAX_NESTING;
/// Greatest number of branches of a parallel block, and of conditions of a monitor or rules of a `keep`: each
/// is proved beside all others.
const MAX_BRANCHES: usize = 256;

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
    /// False behind a step that never goes on.
    pub(super) goes_on: bool,
    /// True if a `done` leads behind the inlined policy.
    pub(super) is_done: bool,
    /// Result of the policy whose body is being resolved.
    pub(super) result: PolicyResult,
    /// Steps that come before the step that was resolved last.
    pub(super) before: Vec<StepId>,
    /// Span of a step before which the scope is recorded.
    pub(super) point: Option<Span>,
    /// The scope there.
    pub(super) scope_at_point: Option<Scope>,
    /// True if no more steps are resolved: there are too many, or too many errors.
    full: bool,
    /// Number of blocks around.
    depth: usize,
}

impl<'a> StepResolver<'a> {
    pub(super) fn new(elaborator: Elaborator<'a>) -> Self {
        Self {
            elaborator,
            program: Program::default(),
            inline: None,
            calls: Vec::new(),
            goes_on: true,
            is_done: false,
            result: PolicyResult::default(),
            before: Vec::new(),
            point: None,
            scope_at_point: None,
            full: false,
            depth: 0,
        }
    }

    pub(super) fn finish(self) -> Vec<Diagnostic> {
        self.elaborator.diagnostics
    }

    pub(super) fn resolved(self, id: Option<StepId>) -> ResolvedStep {
        let Self { goes_on, scope_at_point, elaborator, .. } = self;
        ResolvedStep { id, diagnostics: elaborator.diagnostics, goes_on, scope_at_point }
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
            let (first, term) = (self.elaborator.bindings.len(), self.named(&param.name, ty, None));
            self.elaborator.scope.push(param.name.text.clone(), term, ty, param.name.span);
            for binding in self.elaborator.bindings.iter_mut().skip(first) {
                binding.is_param = true;
                binding.uses = 1;
            }
        }
        if let Some(declared) = &policy.result {
            let ty = crate::declare::resolve_type(&mut self.elaborator, declared);
            let binding = self.bind(SmolStr::new_static("result"), ty, declared.span(), None, None);
            if let Some(bound) = self.elaborator.bindings.get_mut(binding.index()) {
                bound.uses = 1;
            }
            self.result = PolicyResult::new(Some(ty), Some(binding));
            self.program.result = Some(binding);
        }
        self.program.body = self.whole(policy, None);
        self.check_given(policy);
        if self.full {
            // What is not resolved may use any of them.
            self.elaborator.bindings.iter_mut().for_each(|binding| binding.uses += 1);
        }
        let mut program = std::mem::take(&mut self.program);
        program.bindings = std::mem::take(&mut self.elaborator.bindings);
        program
    }

    /// Resolves the steps of a policy, with its cleanup as one step around them; `call` is the step that
    /// inlines it.
    pub(super) fn whole(&mut self, policy: &Policy, call: Option<StepId>) -> ir::Block {
        let (steps, whole) = match call {
            None => (BlockSlot::Steps, BlockSlot::Protected),
            Some(_) => (BlockSlot::Inlined, BlockSlot::InlinedWhole),
        };
        let mut position = StepPosition { parent: call, slot: whole, index: 0 };
        if policy.keeps.is_empty() {
            return match &policy.cleanup {
                Some(cleanup) => self.cleaned(policy, cleanup, position),
                None => self.block(&policy.body, call, steps),
            };
        }
        let Some(id) = self.reserve(policy.body.span, position) else { return Vec::new() };
        let whens = self.keeps(&policy.keeps);
        position = StepPosition { parent: Some(id), slot: BlockSlot::KeptWhole, index: 0 };
        let body = match &policy.cleanup {
            Some(cleanup) => self.cleaned(policy, cleanup, position),
            None => self.block(&policy.body, Some(id), BlockSlot::Kept),
        };
        self.fill(id, ir::StepKind::Monitor { whens, body }).into_iter().collect()
    }

    /// Resolves the steps of a policy with its cleanup as one step around them.
    fn cleaned(&mut self, policy: &Policy, cleanup: &Block, position: StepPosition) -> ir::Block {
        let Some(id) = self.reserve(policy.body.span, position) else { return Vec::new() };
        let (scope, goes_on) = (self.elaborator.scope.mark(), self.goes_on);
        let body = self.block(&policy.body, Some(id), BlockSlot::Steps);
        let cleanup = self.cleanup(cleanup, id, (scope, goes_on));
        self.fill(id, ir::StepKind::Finally { body, cleanup }).into_iter().collect()
    }

    /// Resolves the cleanup of a step or policy. It sees only the names from before what it cleans up, since
    /// control may have come from anywhere in there, and what it binds is its own.
    fn cleanup(&mut self, cleanup: &Block, of: StepId, (before, goes_on): (ScopeMark, bool)) -> ir::Block {
        let outside = std::mem::replace(&mut self.goes_on, goes_on);
        let bound = self.elaborator.scope.take_since(before);
        let mark = self.elaborator.scope.mark();
        self.elaborator.scope.extend(bound.iter().map(|entry| without_value(entry, &Unbound::Cleanup)));
        let steps = self.block(cleanup, Some(of), BlockSlot::Finally);
        self.elaborator.scope.back_to(mark);
        self.elaborator.scope.extend(bound);
        self.goes_on = outside;
        steps
    }

    /// Resolves a block, whose names stay visible.
    pub(super) fn block(&mut self, block: &Block, parent: Option<StepId>, slot: BlockSlot) -> ir::Block {
        if self.depth >= MAX_DEPTH {
            self.elaborator.report(motet_syntax::diagnostics::too_deep(block.span, MAX_DEPTH));
            return Vec::new();
        }
        self.depth += 1;
        let steps = self.steps(block, parent, slot);
        self.depth -= 1;
        steps
    }

    fn steps(&mut self, block: &Block, parent: Option<StepId>, slot: BlockSlot) -> ir::Block {
        let mut steps = Vec::with_capacity(block.steps.len());
        for (index, step) in (0_u32..).zip(block.written()) {
            self.full |= self.elaborator.has_too_many_errors();
            if self.full {
                break;
            }
            let position = StepPosition { parent, slot, index };
            let id = match step {
                Some(step) => self.step(step, position),
                None => self.gap(block.span, position),
            };
            steps.append(&mut self.before);
            steps.extend(id);
        }
        steps
    }

    /// A step that could not be read: it may have bound any name, and changed anything.
    fn gap(&mut self, span: Span, position: StepPosition) -> Option<StepId> {
        self.elaborator.is_behind_gap = true;
        let id = self.reserve(span, position)?;
        self.fill(id, ir::StepKind::Unknown)
    }

    /// Resolves the one block of a step, which runs at least once.
    fn only_block(&mut self, block: &Block, (step, slot): (StepId, BlockSlot)) -> ir::Block {
        let mark = self.elaborator.scope.mark();
        let body = self.block(block, Some(step), slot);
        self.elaborator.scope.end_block(mark);
        body
    }

    /// Reserves the next place in the arena, so that a parent precedes its children.
    pub(super) fn reserve(&mut self, span: Span, position: StepPosition) -> Option<StepId> {
        let is_inlined = self.inline.is_some();
        effort::spend(if is_inlined { INLINED } else { 0 });
        let is_used_up = is_inlined && effort::is_used_up();
        if is_used_up || self.program.steps.len() >= MAX_NODES {
            if !self.full {
                let branches = is_used_up.then_some((0, "document"));
                self.elaborator.report(TooManySteps { span, limit: MAX_NODES, branches });
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

    /// Adds a binding of the result of a step, or of a value that no step finds.
    pub(super) fn bind(
        &mut self,
        name: SmolStr,
        ty: Ty,
        span: Span,
        binder: Option<StepId>,
        description: Option<SmolStr>,
    ) -> BindingId {
        let id = BindingId(u32::try_from(self.elaborator.bindings.len()).unwrap_or(u32::MAX));
        self.elaborator.bindings.push(Binding {
            name,
            ty,
            span,
            descriptions: description.map(|text| smallvec![text]),
            binders: binder.into_iter().collect::<SmallVec<_>>(),
            is_param: false,
            uses: 0,
            idle: Vec::new(),
        });
        id
    }

    /// Adds the bindings of a name, and returns what it stands for: of a failure, its kind and its text.
    fn named(&mut self, name: &Name, ty: Ty, binder: Option<StepId>) -> Term {
        if ty != Ty::plain(ir::Base::Failure) {
            return Term::Binding(self.bind(name.text.clone(), ty, name.span, binder, None));
        }
        let kinds = Ty::plain(ir::Base::Enum(self.elaborator.library.failure_kinds()));
        let kind = self.bind(format_smolstr!("{}.kind", name.text), kinds, name.span, binder, None);
        // Whoever uses the kind uses the text's binding too.
        if let Some(kind) = self.elaborator.bindings.get_mut(kind.index()) {
            kind.uses = 1;
        }
        Term::Caught(kind, self.bind(name.text.clone(), Ty::TEXT, name.span, binder, None))
    }

    /// Makes a binding visible.
    pub(super) fn name(&mut self, name: &SmolStr, id: BindingId, ty: Ty, span: Span) {
        self.name_term(name, Term::Binding(id), ty, span);
    }

    fn name_term(&mut self, name: &SmolStr, term: Term, ty: Ty, span: Span) {
        let known = self.elaborator.scope.find(name).filter(|entry| !entry.is_free);
        let first = known.map(|entry| entry.span);
        // What a policy of the library calls its own is read there before any entity, and is for nobody
        // else to see.
        let hides = self.inline.is_none() && self.elaborator.entities.find(name).is_some();
        if first.is_some() || hides {
            self.elaborator.report(Shadows { span, name: name.clone(), first });
        }
        self.elaborator.scope.push(name.clone(), term, ty, span);
    }

    pub(super) fn step(&mut self, step: &Step, position: StepPosition) -> Option<StepId> {
        if let StepKind::Do(call) = &step.kind {
            return self.call(call, step.span, position);
        }
        if self.point == Some(step.span) {
            self.scope_at_point = Some(self.elaborator.scope.clone());
        }
        let results = self.results(step, position);
        let id = self.reserve(step.span, position)?;
        let kind = match &step.kind {
            StepKind::Do(_) => return None,
            StepKind::Let { name, value } => self.let_value(id, name, value),
            StepKind::Sequence { name, body } => ir::StepKind::Sequence {
                name: name.text.clone(),
                body: self.only_block(body, (id, BlockSlot::Steps)),
            },
            StepKind::If { condition: test, then, otherwise } => {
                let condition = self.elaborator.condition(test);
                let mut fork = self.fork(id);
                let first = "the first block of the `if`";
                let then = self.path(&mut fork, (then, BlockSlot::Then), first, &Unbound::OtherPath);
                let otherwise = otherwise.as_ref().map(|block| {
                    self.path(&mut fork, (block, BlockSlot::Else), "the `else`", &Unbound::OtherPath)
                });
                if otherwise.is_none() {
                    self.path_around(&mut fork, test.span);
                }
                self.meet(fork);
                ir::StepKind::If { condition, span: test.span, then, otherwise }
            }
            StepKind::Wait { condition, within } => ir::StepKind::Wait {
                condition: self.elaborator.condition(condition),
                within_secs: self.seconds_or(within.as_ref(), "the deadline of a `wait`"),
            },
            StepKind::Delay { time } => {
                let secs = self.elaborator.seconds(time, "the time of a `wait`").unwrap_or(0.0);
                ir::StepKind::Delay { secs }
            }
            StepKind::Finally { step, cleanup } => {
                let (scope, goes_on) = (self.elaborator.scope.mark(), self.goes_on);
                let position = StepPosition { parent: Some(id), slot: BlockSlot::Protected, index: 0 };
                let last = self.step(step, position);
                let body = self.before.drain(..).chain(last).collect();
                let cleanup = self.cleanup(cleanup, id, (scope, goes_on));
                ir::StepKind::Finally { body, cleanup }
            }
            StepKind::Monitor { whens, body } => {
                let beyond = whens.get(MAX_BRANCHES).map(|when| when.span);
                self.check_count(whens.len(), "monitor", beyond);
                let numbered = whens.iter().enumerate().take(MAX_BRANCHES);
                let whens = numbered.map(|(index, when)| self.when(when, id, index)).collect();
                ir::StepKind::Monitor { whens, body: self.only_block(body, (id, BlockSlot::During)) }
            }
            StepKind::Within { time, body } => {
                let hold_secs = self.elaborator.deadline(time, "the time of a `within`").unwrap_or(0.0);
                let condition = ir::Condition::Literal(true);
                let when =
                    ir::When { condition, span: time.span, hold_secs, reaction: ir::Reaction::Timeout };
                ir::StepKind::Monitor {
                    whens: vec![when],
                    body: self.only_block(body, (id, BlockSlot::Timed)),
                }
            }
            StepKind::Keep { keeps, body } => {
                let whens = self.keeps(keeps);
                ir::StepKind::Monitor { whens, body: self.only_block(body, (id, BlockSlot::Kept)) }
            }
            StepKind::Try { body, catches } => {
                let mut fork = self.fork(id);
                let whole = "the body of the `try`";
                let body = self.path(&mut fork, (body, BlockSlot::Try), whole, &Unbound::Handler);
                let numbered = catches.iter().enumerate();
                let catches = numbered.map(|(index, catch)| self.catch(catch, &mut fork, index)).collect();
                self.meet(fork);
                ir::StepKind::Try { body, catches }
            }
            StepKind::Repeat { times, body, until } => {
                let times = self.elaborator.count(times, "the count of a `repeat`", 1).unwrap_or(1);
                let body = self.only_block(body, (id, BlockSlot::Steps));
                let until = until.as_ref().map(|until| (self.elaborator.condition(until), until.span));
                ir::StepKind::Repeat { times, body, until }
            }
            StepKind::Each { item, list, at_most, body } => {
                let found = self.elaborator.list_of(list, "the list of an `each`");
                let (term, ty) = found.unwrap_or((Term::Unknown, Ty::UNKNOWN));
                let at_most = self.elaborator.count(at_most, "the length of an `each`", 1).unwrap_or(1);
                let mark = self.elaborator.scope.mark();
                let binding = self.bind(item.text.clone(), ty, item.span, None, None);
                self.name(&item.text, binding, ty, item.span);
                let outer = self.goes_on;
                let body = self.block(body, Some(id), BlockSlot::Steps);
                if outer && !std::mem::replace(&mut self.goes_on, outer) {
                    self.result.open_path = Some(Unbound::Loop);
                }
                self.leave(mark, &Unbound::Loop);
                ir::StepKind::Each { item: binding, list: term, at_most, body }
            }
            StepKind::Parallel { branches } => {
                let mut fork = self.fork(id);
                let beyond = branches.get(MAX_BRANCHES).map(|_| step.span);
                self.check_count(branches.len(), "parallel", beyond);
                let numbered = branches.iter().enumerate().take(MAX_BRANCHES);
                let branches = numbered.map(|(index, block)| {
                    let slot = BlockSlot::Branch(u16::try_from(index).unwrap_or(u16::MAX));
                    self.path(&mut fork, (block, slot), "a branch", &Unbound::Beside)
                });
                let branches = branches.collect();
                self.meet_all(fork);
                ir::StepKind::Parallel { branches }
            }
            StepKind::End(end) => {
                let why = self.why(end);
                self.note_done(end);
                self.goes_on = false;
                ir::StepKind::End { kind: end.kind, of: self.inline, why }
            }
        };
        self.before = results;
        self.fill(id, kind)
    }

    /// Resolves a name for a value. Where that is a constant or another name, it stands for it, and later
    /// stages know it.
    pub(super) fn let_value(&mut self, id: StepId, name: &Name, value: &Expr) -> ir::StepKind {
        let (value, ty) = self.elaborator.term(value, None);
        let described = match &value {
            Term::First(list) => match &**list {
                Term::Binding(list) => self.elaborator.bindings.get(list.index()),
                _ => None,
            },
            _ => None,
        };
        let described = described.and_then(|list| list.descriptions.clone());
        let binding = self.bind(name.text.clone(), ty, name.span, Some(id), None);
        if let Some(bound) = self.elaborator.bindings.get_mut(binding.index()) {
            bound.descriptions = described;
            // After an error its uses are not reported as well.
            bound.uses = u32::from(value == Term::Unknown);
        }
        self.name(&name.text, binding, ty, name.span);
        if stands_for_itself(&value) {
            self.elaborator.scope.stand_for(value.clone());
        }
        ir::StepKind::Let { binding, value }
    }

    /// Notes that an ending leads behind the inlined policy.
    fn note_done(&mut self, end: &End) {
        self.is_done |= end.kind == EndKind::Done && self.inline.is_some() && self.goes_on;
    }

    fn why(&mut self, end: &End) -> Option<Term> {
        let is_told = match end.kind {
            EndKind::Done | EndKind::Replan => true,
            EndKind::Fail | EndKind::Cannot => end.why.is_some() || self.inline.is_some(),
        };
        if !is_told {
            let kind = if end.kind == EndKind::Fail { "fail" } else { "cannot" };
            let is_text = self.elaborator.form == Syntax::Text;
            self.elaborator.report(NoReason { span: end.span, kind, is_text });
        }
        let wanted = Expected { ty: Ty::TEXT, place: ValueRole::Named("the reason of an ending") };
        end.why.as_ref().map(|why| self.elaborator.term_of(why, wanted))
    }

    fn seconds_or(&mut self, expr: Option<&Expr>, place: &'static str) -> f64 {
        expr.and_then(|expr| self.elaborator.deadline(expr, place)).unwrap_or(DEFAULT_WAIT_SECS)
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
            Reaction::Resume { at_most, body, .. } => {
                let at_most = self.elaborator.count(at_most, "the count of a `resume`", 1).unwrap_or(1);
                let (mark, outer) = (self.elaborator.scope.mark(), self.goes_on);
                let body = self.block(body, Some(monitor), slot);
                self.goes_on = outer;
                self.leave(mark, &Unbound::Reaction);
                ir::Reaction::Resume { at_most, body }
            }
            Reaction::End(end) => {
                self.note_done(end);
                ir::Reaction::End { kind: end.kind, of: self.inline, why: self.why(end) }
            }
        };
        ir::When { condition, span: when.condition.span, hold_secs, reaction }
    }

    /// Resolves the rules of a `keep` to the conditions of a monitor, which pauses where a rule is broken.
    fn keeps(&mut self, keeps: &[Keep]) -> Vec<ir::When> {
        self.check_count(keeps.len(), "keep", keeps.get(MAX_BRANCHES).map(|keep| keep.span));
        keeps.iter().take(MAX_BRANCHES).map(|keep| self.kept(keep)).collect()
    }

    /// Reports more branches, or watched conditions, than a step may have; `beyond` is the span of the first.
    fn check_count(&mut self, found: usize, what: &'static str, beyond: Option<Span>) {
        if let Some(span) = beyond {
            let branches = Some((found, what));
            self.elaborator.report(TooManySteps { span, limit: MAX_BRANCHES, branches });
        }
    }

    fn kept(&mut self, keep: &Keep) -> ir::When {
        let items = self.elaborator.library.lang_items;
        let entity = |kind: Option<ir::Kind>, place: &'static str| Expected {
            ty: kind.map_or(Ty::UNKNOWN, |kind| Ty::plain(ir::Base::Entity(kind))),
            place: ValueRole::Named(place),
        };
        let (to, op, limit) = match &keep.kind {
            KeepKind::OutOf(zone) => {
                let zone = self.elaborator.term_of(zone, entity(items.zone, "the area that is kept out of"));
                (zone, CompareOp::AtMost, Term::Number(0.0))
            }
            KeepKind::Distance { to, at_least } => {
                let wanted = entity(Some(ir::Kind::ROOT), "the entity of a distance");
                let to = self.elaborator.term_of(to, wanted);
                (to, CompareOp::Less, self.elaborator.distance(at_least))
            }
        };
        let condition = match items.distance {
            Some(measure) if to != Term::Unknown && limit != Term::Unknown => {
                Condition::Compare(op, Term::Measure(measure, vec![to]), limit)
            }
            Some(_) | None => Condition::Unknown,
        };
        let reaction = ir::Reaction::Pause { within_secs: DEFAULT_WAIT_SECS };
        ir::When { condition, span: keep.span, hold_secs: 0.0, reaction }
    }

    fn catch(&mut self, catch: &Catch, fork: &mut Fork, index: usize) -> ir::Catch {
        let on = match &catch.on {
            CatchOn::Any(_) => None,
            CatchOn::Kinds(names) => {
                let library = self.elaborator.library;
                let mut kinds = Vec::with_capacity(names.len());
                for name in names {
                    match library.names.failures.get(&name.text) {
                        Some(kind) => kinds.push((*kind, name.span)),
                        None => {
                            let known = || library.failures.iter().map(|def| &def.name);
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
        let kinds: Vec<&str> = match &catch.on {
            CatchOn::Any(_) => vec!["any"],
            CatchOn::Kinds(names) => names.iter().map(|name| name.text.as_str()).collect(),
        };
        let name = format_smolstr!("`catch {}`", kinds.join(", "));
        let (binds, body) = self.handler(fork, (catch, slot), &name);
        ir::Catch { on, span, binds, body }
    }

    /// Resolves the steps of a handler, which alone see the name of its failure.
    fn handler(
        &mut self,
        fork: &mut Fork,
        (catch, slot): (&Catch, BlockSlot),
        name: &str,
    ) -> (Option<ir::CaughtFailure>, ir::Block) {
        let Some(bind) = &catch.bind else {
            return (None, self.path(fork, (&catch.body, slot), name, &Unbound::OtherPath));
        };
        let inside = self.elaborator.scope.mark();
        let ty = Ty::plain(ir::Base::Failure);
        let term = self.named(bind, ty, Some(fork.step()));
        self.name_term(&bind.text, term.clone(), ty, bind.span);
        let caught = self.elaborator.scope.take_since(inside);
        let body = self.path_with(fork, (&catch.body, slot), name, &Unbound::OtherPath, caught);
        let binds = match term {
            Term::Caught(kind, text) => Some(ir::CaughtFailure { kind, text }),
            _ => None,
        };
        (binds, body)
    }

    /// Reports a condition in place of a step.
    pub(super) fn misplaced(&mut self, span: Span) {
        self.elaborator.report(NotACondition { span, found: "a condition", wanted: "a step" });
    }
}
