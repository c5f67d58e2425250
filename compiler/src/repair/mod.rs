//! Repairs of refuted policies: calls that bring about what a step needs, steps to leave out, monitors to
//! add.
//!
//! A [`RepairFinder`] observes the prover and searches while the facts before the refuted step are at hand.
//! The search is that of the planner ([`crate::plan::search`]) with a small budget. What it finds is a
//! candidate: [`crate::fix`] verifies it by checking the edited document again.

mod write;

use motet_syntax::{Code, Diagnostic, Fix, Parsed, Severity, Span};

use crate::declare::{Library, NeedDef, PrimitiveDef};
use crate::environment::Environment;
use crate::facts::effort;
use crate::ir::{BindingId, Condition, Entity, Fact, Fluent, Program, StepId, StepKind, Term};
use crate::plan::achievers::{CandidateCall, MAX_CANDIDATES, Subgoal};
use crate::plan::estimate::{Estimate, Purpose, Target};
use crate::plan::search::{Bounds, search};
use crate::prove::evaluation::CallFrame;
use crate::prove::{Observer, PolicyEnd, Problem, Prover};

/// Maximal number of findings of a policy for which repairs are searched.
const MAX_FINDINGS: usize = 32;
/// Maximal distance, in steps, to an earlier step before which a call may be inserted.
const MAX_EARLIER: usize = 6;
/// Bounds of the search for one finding.
const BOUNDS: Bounds = Bounds { states: 40, estimates: 200, calls: 6, plans: MAX_CANDIDATES };

/// Repairs of one diagnostic, the best first.
#[derive(Clone, Debug)]
pub(crate) struct RepairCandidates {
    code: Code,
    span: Span,
    message: String,
    repairs: Vec<Repair>,
}

/// A change of the program that may remove a diagnostic.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Repair {
    /// Inserts calls before a step.
    Before(StepId, Vec<CandidateCall>),
    /// Inserts calls before a step in front of the refused one, where nothing was tried: whoever applies it
    /// checks it, and it is no advice.
    Earlier(StepId, Vec<CandidateCall>),
    /// Inserts calls behind a step.
    After(StepId, Vec<CandidateCall>),
    /// Repeats the step that bound a value before another step, whose argument then is the new value.
    Again { found: StepId, before: StepId, used: Span },
    /// Leaves the step out.
    Drop(StepId),
    /// Puts a test of conditions around the step.
    Test(StepId, String),
    /// Puts a monitor of a fluent without parameters around the step.
    Watch(StepId, Fluent),
}

/// Degree to which a fix may be applied without asking.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Applicability {
    /// Only shown: it names a thing that the document does not name.
    Shown,
    /// Applied on request: it takes a step away, or undoes what the policy has done.
    Unsafe,
    /// Applied: it corrects the spelling, or adds what a step or the goal lacks.
    Safe,
}

/// A diagnostic with the fixes that are known for it beside its own, the best first.
#[derive(Clone, Debug)]
pub(crate) struct Finding {
    pub(crate) diagnostic: Diagnostic,
    /// Of the fix in the diagnostic.
    pub(crate) applicability: Applicability,
    pub(crate) alternatives: Vec<(Fix, Applicability)>,
}

impl Finding {
    /// All fixes, the best first.
    pub(crate) fn fixes(&self) -> impl Iterator<Item = (&Fix, Applicability)> {
        let own = self.diagnostic.fix.iter().map(|fix| (fix, self.applicability));
        own.chain(self.alternatives.iter().map(|(fix, applicability)| (fix, *applicability)))
    }
}

impl From<Diagnostic> for Finding {
    fn from(diagnostic: Diagnostic) -> Self {
        Self { diagnostic, applicability: Applicability::Safe, alternatives: Vec::new() }
    }
}

/// Repairs that a check searches.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum RepairSearch {
    /// None: diagnostics keep the fixes that a stage gives them.
    Skip,
    /// The best one for each finding.
    Best,
    /// All that are known for each finding.
    All,
}

/// Searches repairs of what the prover refutes.
#[derive(Debug)]
pub(crate) struct RepairFinder {
    search: RepairSearch,
    candidates: Vec<RepairCandidates>,
}

impl Observer for RepairFinder {
    fn observe(&mut self, prover: &mut Prover<'_>, problem: Problem<'_>, diagnostic: &Diagnostic) {
        if self.search == RepairSearch::Skip {
            return;
        }
        match problem {
            Problem::RefutedNeed { step, def, frame } => self.before(prover, step, def, frame, diagnostic),
            Problem::StaleBinding { step, bound } => self.perceive_again(prover, step, bound, diagnostic),
            Problem::RefutedGoal { goal, end } => self.at_end(prover, goal.clone(), end, diagnostic),
            Problem::UnintendedFact { fact, end } => self.undo(prover, fact, end, diagnostic),
            Problem::RedundantStep => self.leave_out(prover, diagnostic),
        }
    }
}

impl RepairFinder {
    pub(crate) fn new(search: RepairSearch) -> Self {
        Self { search, candidates: Vec::new() }
    }

    /// Joins diagnostics with the repairs that were found for them, as edits of the document.
    pub(crate) fn findings(
        &self,
        diagnostics: Vec<Diagnostic>,
        parsed: &Parsed,
        program: &Program,
        library: &Library,
        environment: &Environment,
    ) -> Vec<Finding> {
        let writer = write::Writer { parsed, program, library, environment, spans: Default::default() };
        let wrong = diagnostics.iter().chain(&parsed.diagnostics);
        let wrong = wrong.filter(|said| said.severity == Severity::Error).map(|said| said.span);
        let wrong: Vec<Span> = wrong.collect();
        let mut findings: Vec<_> = diagnostics.into_iter().map(Finding::from).collect();
        for found in &mut findings {
            let diagnostic = &mut found.diagnostic;
            let (code, fix) = (diagnostic.code, diagnostic.fix.take());
            diagnostic.fix = fix.and_then(|fix| writer.in_form(code, fix));
            let known = self.candidates.iter().find(|known| {
                known.code == diagnostic.code
                    && known.span == diagnostic.span
                    && known.message == diagnostic.message
            });
            let repairs = known.map(|known| known.repairs.as_slice()).unwrap_or_default();
            let untried = repairs.iter().position(|repair| matches!(repair, Repair::Earlier(..)));
            let (tried, untried) = repairs.split_at(untried.unwrap_or(repairs.len()));
            let written = |repair: &Repair| Some((writer.fix(repair)?, writer.applicability(repair, code)));
            let mut fixes = tried.iter().filter_map(written);
            if diagnostic.fix.is_none() {
                let unreachable = || Some((writer.leaving_out(diagnostic, &wrong)?, Applicability::Unsafe));
                let only_one = || Some((writer.only_one(diagnostic)?, Applicability::Shown));
                let own = fixes.next().or_else(unreachable).or_else(only_one);
                (diagnostic.fix, found.applicability) = match own {
                    Some((fix, applicability)) => (Some(fix), applicability),
                    None => (None, found.applicability),
                };
            }
            if self.search == RepairSearch::All {
                found.alternatives = fixes.chain(untried.iter().filter_map(written)).collect();
            }
        }
        findings
    }

    /// Searches calls that make the needs of a step hold, unless repairs are known for its span.
    fn before(
        &mut self,
        prover: &mut Prover<'_>,
        id: StepId,
        def: &PrimitiveDef,
        frame: CallFrame<'_>,
        diagnostic: &Diagnostic,
    ) {
        let span = diagnostic.span;
        let is_known = self.candidates.iter().any(|known| known.span == span);
        // Arguments that are wrong leave open which steps would help.
        let step = prover.program.step(id).map(|step| &step.kind);
        let is_faulty = matches!(step, Some(StepKind::Call(call)) if call.is_faulty);
        if self.is_full() || prover.is_inlined(id) || is_known || is_faulty {
            return;
        }
        if let Some(test) = prover.test_of(id, def, frame) {
            return self.add(diagnostic, vec![Repair::Test(id, test)]);
        }
        let mut repairs = Vec::new();
        if prover.is_done(def, frame) {
            repairs.push(Repair::Drop(id));
        }
        repairs.extend(prover.unwatched(def, frame).map(|fluent| Repair::Watch(id, fluent)));
        let plans = self.plans(prover, &def.needs, frame);
        repairs.extend(plans.into_iter().map(|calls| Repair::Before(id, prover.by_binding(calls, span))));
        if self.search != RepairSearch::All {
            return self.add(diagnostic, repairs);
        }
        // A call that is impossible here, for instance because the hand is full, may go before an earlier
        // step.
        let target = Target { needs: &def.needs, frame, purpose: Purpose::Repair };
        let direct = Estimate::new(prover, target, &mut { BOUNDS.estimates }).last_calls();
        for earlier in prover.siblings_before(id) {
            let place = prover.program.step(earlier).map_or(span, |step| step.span);
            for call in direct.iter().take(MAX_CANDIDATES) {
                let calls = prover.by_binding(vec![call.clone()], place);
                repairs.push(Repair::Earlier(earlier, calls));
            }
        }
        self.add(diagnostic, repairs);
    }

    /// Sequences of calls after which no need is refuted, the best first: as many as are shown or tried.
    fn plans(
        &self,
        prover: &mut Prover<'_>,
        needs: &[NeedDef],
        frame: CallFrame<'_>,
    ) -> Vec<Vec<CandidateCall>> {
        let plans = if self.search == RepairSearch::All { MAX_CANDIDATES } else { 1 };
        let target = Target { needs, frame, purpose: Purpose::Repair };
        let mut found = search(prover, target, &mut Bounds { plans, ..BOUNDS }).unwrap_or_default();
        // Without effort every need is unknown.
        found.retain(|calls| !calls.is_empty() && !effort::is_used_up());
        found
    }

    /// Searches calls that undo a fact in which a policy ends: an object in the hand, a container left open.
    fn undo(&mut self, prover: &mut Prover<'_>, fact: Subgoal, end: PolicyEnd, diagnostic: &Diagnostic) {
        let (fluent, key, truth) = fact;
        let count = prover.library.fluent(fluent).map_or(0, |def| def.params.len());
        let args = (0..count).map(|index| Some(Term::Entity(Entity(key.arg(index))))).collect();
        let fact = Condition::Fact(Fact { fluent, args });
        let goal = if truth { fact } else { Condition::Not(Box::new(fact)) };
        self.at_end(prover, goal, end, diagnostic);
    }

    /// Searches calls that reach a goal where the policy is done.
    fn at_end(&mut self, prover: &mut Prover<'_>, goal: Condition, end: PolicyEnd, diagnostic: &Diagnostic) {
        let (PolicyEnd::Before(id) | PolicyEnd::After(id)) = end;
        let Some(span) = prover.program.step(id).map(|step| step.span) else { return };
        if self.is_full() || prover.is_inlined(id) {
            return;
        }
        let need = NeedDef { condition: goal, each: None, when: None, span };
        let plans = self.plans(prover, &[need], CallFrame::default());
        let repairs = plans.into_iter().map(|calls| match end {
            PolicyEnd::Before(_) => Repair::Before(id, prover.by_binding(calls, span)),
            PolicyEnd::After(_) => {
                Repair::After(id, prover.by_binding(calls, Span { start: span.end, ..span }))
            }
        });
        let repairs = repairs.collect();
        self.add(diagnostic, repairs);
    }

    /// Offers to leave out the step that is being proved.
    fn leave_out(&mut self, prover: &Prover<'_>, diagnostic: &Diagnostic) {
        let own = prover.control.here.filter(|id| !prover.is_inlined(*id));
        self.add(diagnostic, own.map(Repair::Drop).into_iter().collect());
    }

    /// Offers to perceive a stale value again.
    fn perceive_again(&mut self, prover: &Prover<'_>, id: StepId, bound: Span, diagnostic: &Diagnostic) {
        let found = prover.program.steps.iter().position(|step| {
            let StepKind::Call(call) = &step.kind else { return false };
            let binding = call.binds.and_then(|id| prover.program.bindings.get(id.index()));
            // What several paths bind, no step of one path finds again.
            binding.is_some_and(|binding| binding.span == bound && binding.binders.len() == 1)
        });
        let Some(found) = found.and_then(|index| u32::try_from(index).ok()) else { return };
        if !prover.is_inlined(id) {
            let again = Repair::Again { found: StepId(found), before: id, used: diagnostic.span };
            self.add(diagnostic, vec![again]);
        }
    }

    fn is_full(&self) -> bool {
        self.candidates.len() >= MAX_FINDINGS
    }

    fn add(&mut self, diagnostic: &Diagnostic, repairs: Vec<Repair>) {
        if !self.is_full() {
            let Diagnostic { code, span, message, .. } = diagnostic;
            self.candidates.push(RepairCandidates {
                code: *code,
                span: *span,
                message: message.clone(),
                repairs,
            });
        }
    }
}

impl Prover<'_> {
    /// The steps before one in its block, the nearest first.
    fn siblings_before(&self, id: StepId) -> Vec<StepId> {
        let Some(place) = self.program.step(id).map(|step| step.position) else {
            return Vec::new();
        };
        let before = self.program.steps.iter().enumerate().take(id.index()).rev();
        let siblings = before
            .filter(|(_, step)| step.position.parent == place.parent && step.position.slot == place.slot);
        siblings.filter_map(|(index, _)| u32::try_from(index).ok().map(StepId)).take(MAX_EARLIER).collect()
    }

    /// The fluent that an enclosing monitor has to watch, but none does. Only one without parameters, since
    /// others leave open which fact to watch.
    fn unwatched(&self, def: &PrimitiveDef, frame: CallFrame<'_>) -> Option<Fluent> {
        let refuted = def.needs.iter().find(|need| self.need(need, frame).0.no.is_some())?;
        let Condition::MonitoredFluent(fluent) = &refuted.condition else { return None };
        self.library.fluent(*fluent).filter(|def| def.params.is_empty()).map(|_| *fluent)
    }

    /// The needs of a step in a cleanup that hold only on some of the paths there, as a condition.
    fn test_of(&self, id: StepId, def: &PrimitiveDef, frame: CallFrame<'_>) -> Option<String> {
        let refuted = def.needs.iter().filter(|need| self.need(need, frame).0.no.is_some());
        let tests = refuted.map(|need| {
            let test = self.explain_in_cleanup(id, need, frame)?.wanted;
            let test = test.trim_matches('`');
            Some(if test.contains(" or ") { format!("({test})") } else { test.to_owned() })
        });
        let tests = tests.collect::<Option<Vec<String>>>()?;
        (!tests.is_empty()).then(|| tests.join(" and "))
    }

    /// Returns whether a step belongs to a sub-policy, in which the names of its caller have no meaning.
    fn is_inlined(&self, id: StepId) -> bool {
        self.program.around(id).any(|(_, step)| matches!(step.kind, StepKind::Inline { .. }))
    }

    /// Returns whether all effects of a step hold already.
    fn is_done(&self, def: &PrimitiveDef, frame: CallFrame<'_>) -> bool {
        let mut plain =
            def.makes.iter().filter(|effect| effect.each.is_none() && effect.when.is_none()).peekable();
        plain.peek().is_some()
            && plain.all(|effect| {
                let fact = Condition::Fact(effect.fact.clone());
                let value = self.evaluate(&fact, frame);
                if effect.value { value.is_true() } else { value.is_false() }
            })
    }

    /// Entities by the bindings through which the document speaks of them, where there is one before `place`.
    fn by_binding(&self, mut calls: Vec<CandidateCall>, place: Span) -> Vec<CandidateCall> {
        for term in calls.iter_mut().flat_map(|call| &mut call.args) {
            let Term::Entity(entity) = term else { continue };
            let bound = self.program.bindings.iter().enumerate().rev().find(|(index, binding)| {
                let is_before = binding.span.file == place.file && binding.span.start < place.start;
                is_before && binding.name != "_" && self.symbols.of_binding(*index) == Some(*entity)
            });
            if let Some(id) = bound.and_then(|(index, _)| u32::try_from(index).ok()) {
                *term = Term::Binding(BindingId(id));
            }
        }
        calls
    }
}
