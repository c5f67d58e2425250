//! Suspended proofs: the state of a proof between two steps, for [`crate::incremental`].

use std::hash::Hasher;

use motet_syntax::{Code, Diagnostic, Severity, Span};

use super::evaluation::CallFrame;
use super::symbols::Symbols;
use super::test_outcomes::TestTable;
use super::{AbstractState, Mode, Prover};
use crate::analysis::Domain;
use crate::declare::{Library, PrimitiveDef};
use crate::environment::Environment;
use crate::facts::{ANY, FactKey, PathPartition};
use crate::ir::{Condition, Fluent, Program, StepId, StepKind, Term};

/// A proof between two steps of a policy's body.
#[derive(Clone, Debug)]
pub(crate) struct SuspendedProof {
    state: AbstractState<'static>,
    pub(crate) symbols: Symbols,
    fresh: Fluent,
    tested: TestTable,
    aliased: Vec<bool>,
    pub(crate) live: bool,
}

/// Checkpoint of a suspended proof.
#[derive(Clone, Debug)]
pub(crate) struct Checkpoint {
    trail: usize,
    partitions: Vec<PathPartition>,
    symbols: (usize, usize),
    steps: usize,
    live: bool,
}

impl Checkpoint {
    /// Returns whether the steps since the checkpoint may have written a fact of a condition.
    pub(crate) fn touches(&self, state: &AbstractState<'static>, condition: &Condition) -> bool {
        let fact = match condition {
            Condition::Fact(fact) => fact,
            Condition::Not(inner) => return self.touches(state, inner),
            _ => return true,
        };
        let mut key = FactKey(0);
        for (index, term) in fact.args.iter().enumerate() {
            let arg = match term {
                None => ANY,
                Some(Term::Entity(entity)) => entity.0,
                Some(Term::Case(_, case)) => *case,
                // A name may be one of several.
                Some(_) => return true,
            };
            key = key.with(index, arg);
        }
        let is_same = |other: FactKey| key.covers(other) || other.covers(key);
        let mut writes = state.facts.writes(self.trail);
        writes.any(|(fluent, other, _)| fluent == fact.fluent && is_same(other))
            || state.partitions.iter().any(|partition| partition.differs(|fluent| fluent == fact.fluent))
    }
}

/// Special roles in a step that is proved.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ProofTarget {
    /// Step before which the state is recorded.
    pub(crate) point: Option<StepId>,
    /// Sequence that stands for any one of its steps.
    pub(crate) choice: Option<StepId>,
    /// True if later rounds of a loop refute all that an earlier one does: there are no parallel branches,
    /// each of which makes unknown what others may change.
    pub(crate) grows: bool,
}

/// Result of proving a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct StepOutcome {
    /// True if a need is refuted.
    pub(crate) refuted: bool,
    /// States in which control reached the program point.
    pub(crate) states_at_point: Vec<AbstractState<'static>>,
}

/// Program, library and environment of a proof.
pub(crate) type ProofInput<'p> = (&'p Program, &'p Library, &'p Environment);

impl SuspendedProof {
    /// The proof before the first step.
    pub(crate) fn new(program: &Program, library: &Library, environment: &Environment) -> Self {
        let (state, fresh, tested) = AbstractState::at_start(environment);
        let symbols = Symbols::new(program, library, environment);
        let aliased = vec![false; library.fluents.len()];
        Self { state: state.lift(), symbols, fresh, tested, aliased, live: true }
    }

    /// Lets the conditions of a monitor around all steps be watched. Its reactions need no proof.
    pub(crate) fn watch(&mut self, monitor: StepId, given: ProofInput<'_>) {
        let (program, ..) = given;
        let Some(StepKind::Monitor { whens, .. }) = program.step(monitor).map(|step| &step.kind) else {
            return;
        };
        self.with(given, |prover| {
            let watched = prover.watched_by(monitor, whens);
            prover.state.watched.push(watched);
        });
    }

    pub(crate) fn mark(&self, steps: usize) -> Checkpoint {
        let AbstractState { facts, partitions, .. } = &self.state;
        let symbols = self.symbols.len();
        Checkpoint { trail: facts.mark(), partitions: partitions.clone(), symbols, steps, live: self.live }
    }

    pub(crate) fn back_to(&mut self, mark: &Checkpoint) {
        self.state.facts.back_to(mark.trail);
        self.state.partitions.clone_from(&mark.partitions);
        self.state.lasting.retain(|step, _| step.index() < mark.steps);
        self.symbols.truncate(mark.symbols);
        self.live = mark.live;
    }

    /// Proves one step of the body, and records the states at the program point in it.
    pub(crate) fn step(&mut self, step: StepId, target: ProofTarget, given: ProofInput<'_>) -> StepOutcome {
        let (program, library, environment) = given;
        self.symbols.extend(program, library, environment);
        if !self.live {
            return StepOutcome::default();
        }
        self.with(given, |prover| {
            prover.target = target;
            prover.step(step);
            StepOutcome {
                refuted: prover.is_refuted(),
                states_at_point: std::mem::take(&mut prover.states_at_point),
            }
        })
    }

    /// Proves all steps of a program, and returns the states in which control reaches one of them.
    pub(crate) fn states_at(&mut self, point: StepId, given: ProofInput<'_>) -> Vec<AbstractState<'static>> {
        self.with(given, |prover| {
            prover.target = ProofTarget { point: Some(point), choice: None, grows: false };
            let program = prover.program;
            prover.block(&program.body);
            std::mem::take(&mut prover.states_at_point)
        })
    }

    /// Evaluates a question in the present state, which stays as it is.
    pub(crate) fn here<T>(&mut self, given: ProofInput<'_>, ask: impl FnOnce(&mut Prover<'_>) -> T) -> T {
        self.with(given, ask)
    }

    /// Returns whether no need is refuted when the loop around the program point, at the end of its body, is
    /// repeated from this state.
    pub(crate) fn comes_round(
        &mut self,
        state: &AbstractState<'static>,
        (point, until): (StepId, Option<&Condition>),
        given: ProofInput<'_>,
        seen: &mut impl Hasher,
    ) -> bool {
        let Some(head) = state.head else { return true };
        let (mut state, before_reactions) = (state.clone(), state.before_reactions);
        self.at(&mut state, given, |prover| {
            prover.back_to(before_reactions);
            prover.comes_round(point, head, until, seen)
        })
    }

    /// Evaluates a question in another state.
    pub(crate) fn at<T>(
        &mut self,
        state: &mut AbstractState<'static>,
        given: ProofInput<'_>,
        ask: impl FnOnce(&mut Prover<'_>) -> T,
    ) -> T {
        let live = std::mem::replace(&mut self.live, true);
        std::mem::swap(&mut self.state, state);
        let answer = self.with(given, ask);
        std::mem::swap(&mut self.state, state);
        self.live = live;
        answer
    }

    fn with<T>(&mut self, input: ProofInput<'_>, run: impl FnOnce(&mut Prover<'_>) -> T) -> T {
        let (_, _, environment) = input;
        let head = self.state.head;
        let state = std::mem::take(&mut self.state).over(environment);
        let tables = (self.fresh, self.tested.clone());
        let names = (std::mem::take(&mut self.symbols), tables, std::mem::take(&mut self.aliased));
        let mut prover = Prover::resume(input, state, names);
        prover.control.live = self.live;
        prover.mode = Mode::Decide;
        let answer = run(&mut prover);
        let Prover { symbols, tested, state, aliased, control, .. } = prover;
        self.state = AbstractState { head, ..state.lift() };
        self.symbols = symbols;
        self.tested = tested;
        self.aliased = aliased;
        self.live = control.live;
        answer
    }
}

impl Prover<'_> {
    /// Counts an error without its text, in mode [`Mode::Decide`].
    pub(crate) fn count(&mut self, code: Code) {
        self.diagnostics.push(Diagnostic {
            code,
            severity: Severity::Error,
            message: String::new(),
            help: None,
            span: Span::default(),
            path: String::new(),
            related: Vec::new(),
            fix: None,
            about: None,
        });
    }

    /// Returns whether the answer is final: a need is refuted outside of a rehearsal. Later rounds of a loop
    /// begin in all states of an earlier one, so they refute most of what it does.
    pub(crate) fn is_settled(&self) -> bool {
        let lasts = || self.target.grows && self.control.rehearsals == 0 && self.control.settled.is_some();
        let counts =
            || self.is_exhausted() || if self.control.fixpoints == 0 { self.is_refuted() } else { lasts() };
        self.mode == Mode::Decide && self.target.point.is_none() && counts()
    }

    pub(crate) fn is_refuted(&self) -> bool {
        self.is_exhausted() || self.diagnostics.iter().any(|said| said.severity == Severity::Error)
    }

    /// Records the state at the program point, weakened by the reactions around it.
    pub(crate) fn record_state(&mut self) {
        let before_reactions = self.state.facts.mark();
        self.erode();
        self.states_at_point.push(AbstractState { before_reactions, ..self.state.clone().lift() });
    }

    /// Joins the paths through each of several steps.
    pub(crate) fn choose(&mut self, steps: &[StepId]) {
        let mark = self.state.facts.mark();
        let mut paths = Vec::with_capacity(steps.len());
        for step in steps {
            self.step(*step);
            if self.control.live {
                paths.push(self.state.facts.delta(mark));
            }
            self.restore(&mark);
            if self.is_settled() {
                break;
            }
        }
        self.join(&mark, &paths);
    }

    /// Returns whether one of the first `count` needs of a call is refuted here, in their order.
    pub(crate) fn refutes(&mut self, def: &PrimitiveDef, args: &[Term], count: usize) -> bool {
        let stale = |arg: &Term| matches!(arg, Term::Binding(id) if self.is_stale(*id));
        if args.iter().any(stale) {
            return true;
        }
        let mark = self.state.facts.mark();
        // No step of the program has this number: the cause of what the call grants is the call itself.
        let id = StepId(u32::try_from(self.program.steps.len()).unwrap_or(u32::MAX));
        let frame = CallFrame { args, result: None, each: None };
        let needs = def.needs.get(..count).unwrap_or(&def.needs);
        let is_refuted = needs.iter().enumerate().any(|(index, need)| {
            let (value, _) = self.need(need, frame);
            // What nothing is asked behind need not be taken as given.
            if !value.no.is_some() && value.open.is_some() && index + 1 < needs.len() {
                self.grant(id, need, frame);
            }
            value.no.is_some()
        });
        self.state.facts.back_to(mark);
        is_refuted
    }

    /// Returns whether no need of a step is refuted here; restores the state.
    pub(crate) fn permits(&mut self, step: StepId) -> bool {
        let (mark, partitions, live) =
            (self.state.facts.mark(), self.state.partitions.clone(), self.control.live);
        self.step(step);
        let permits = !self.is_refuted();
        self.diagnostics.clear();
        self.control.settled = None;
        self.state.facts.back_to(mark);
        self.state.partitions = partitions;
        self.control.live = live;
        self.state.lasting.retain(|other, _| *other < step);
        permits
    }

    /// Returns whether a condition holds here on every path.
    pub(crate) fn proves(&self, condition: &Condition) -> bool {
        self.evaluate(condition, CallFrame::default()).is_true()
    }

    /// Returns whether a condition is refuted here.
    pub(crate) fn denies(&self, condition: &Condition) -> bool {
        self.evaluate(condition, CallFrame::default()).no.is_some()
    }
}
