//! A proof that goes on step by step: what it holds between two steps, and the states in which a place of a policy is
//! reached. Fed by [`crate::incremental`].

use std::hash::Hasher;

use motet_syntax::{Code, Diagnostic, Severity, Span};
use rustc_hash::FxHashMap;

use super::effects::PerceptionLifetime;
use super::evaluation::CallFrame;
use super::symbols::Symbols;
use super::{Mode, Proof, Prover, Volatile, Watched};
use crate::declare::{Library, PrimitiveDef};
use crate::environment::Environment;
use crate::facts::TruthSet;
use crate::facts::{ANY, FactKey, FactStore, PathPartition};
use crate::ir::{Condition, Fluent, Program, StepId, Term};

/// What is known in one state.
#[derive(Clone, Debug)]
pub(crate) struct AbstractState {
    facts: FactStore<'static>,
    lasting: FxHashMap<StepId, PerceptionLifetime>,
    watched: Vec<Watched>,
    volatile: Vec<Volatile>,
    partitions: Vec<PathPartition>,
    /// Where the round began of the innermost loop around, as a mark of the facts.
    head: Option<usize>,
    /// The facts before what reactions may have done just now.
    before_reactions: usize,
}

/// A proof between two steps of a policy's body.
#[derive(Clone, Debug)]
pub(crate) struct SuspendedProof {
    state: AbstractState,
    pub(crate) symbols: Symbols,
    fresh: Fluent,
    aliased: Vec<bool>,
    pub(crate) live: bool,
}

/// A place in a proof to go back to.
#[derive(Clone, Debug)]
pub(crate) struct Checkpoint {
    trail: usize,
    partitions: Vec<PathPartition>,
    symbols: (usize, usize),
    steps: usize,
    live: bool,
}

impl Checkpoint {
    /// Whether the steps since then have written anything that a fact may speak of.
    pub(crate) fn touches(&self, state: &AbstractState, condition: &Condition) -> bool {
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

/// What is special in a step that is proved.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ProofTarget {
    /// The state is remembered before this step.
    pub(crate) point: Option<StepId>,
    /// This sequence states_at_point for any one of its steps.
    pub(crate) choice: Option<StepId>,
    /// Whether nothing is known of it that is not known in every later round: no branches run at once, of which one takes as
    /// unknown what another may change.
    pub(crate) grows: bool,
}

/// What proving a step gave.
#[derive(Clone, Debug, Default)]
pub(crate) struct StepOutcome {
    /// Whether something is refuted.
    pub(crate) refuted: bool,
    /// The states in which control reached the point.
    pub(crate) states_at_point: Vec<AbstractState>,
}

/// The program, and what it is proved from.
pub(crate) type ProofInput<'p> = (&'p Program, &'p Library, &'p Environment);

impl SuspendedProof {
    /// The proof before the first step.
    pub(crate) fn new(program: &Program, library: &Library, environment: &Environment) -> Self {
        let mut facts = FactStore::above(&environment.facts);
        let fresh = facts.add_table(TruthSet::yes(crate::facts::Cause::NOTHING));
        let state = AbstractState {
            facts: facts.lift(),
            lasting: FxHashMap::default(),
            watched: Vec::new(),
            volatile: Vec::new(),
            partitions: Vec::new(),
            head: None,
            before_reactions: 0,
        };
        let symbols = Symbols::new(program, library, environment);
        Self { state, symbols, fresh, aliased: vec![false; library.fluents.len()], live: true }
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

    /// Proves one step of the body, and looks on the way at the point in it.
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

    /// Asks something of the state as it is; the answer changes nothing.
    pub(crate) fn here<T>(&mut self, given: ProofInput<'_>, ask: impl FnOnce(&mut Prover<'_>) -> T) -> T {
        self.with(given, ask)
    }

    /// Whether nothing is refuted where the loop around the point, which is at the end of its body, comes round from this state.
    pub(crate) fn comes_round(
        &mut self,
        state: &AbstractState,
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

    /// Asks something of another state than this proof's own.
    pub(crate) fn at<T>(
        &mut self,
        state: &mut AbstractState,
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

    fn with<T>(
        &mut self,
        (program, library, environment): ProofInput<'_>,
        run: impl FnOnce(&mut Prover<'_>) -> T,
    ) -> T {
        let AbstractState { facts, lasting, watched, volatile, partitions, head, before_reactions } =
            &mut self.state;
        let (head, before_reactions) = (*head, *before_reactions);
        let mut prover = Prover {
            library,
            environment,
            program,
            symbols: std::mem::take(&mut self.symbols),
            facts: std::mem::take(facts).over(&environment.facts),
            fresh: self.fresh,
            lasting: std::mem::take(lasting),
            watched: std::mem::take(watched),
            volatile: std::mem::take(volatile),
            enclosing: Vec::new(),
            here: None,
            partitions: std::mem::take(partitions),
            live: self.live,
            fixpoints: 0,
            rehearsals: 0,
            head,
            aliased: std::mem::take(&mut self.aliased),
            buffers: Default::default(),
            diagnostics: Vec::new(),
            proof: Proof::default(),
            observer: None,
            mode: Mode::Decide,
            target: ProofTarget::default(),
            states_at_point: Vec::new(),
        };
        let answer = run(&mut prover);
        let Prover { symbols, facts, lasting, watched, volatile, partitions, aliased, live, .. } = prover;
        self.state = AbstractState {
            facts: facts.lift(),
            lasting,
            watched,
            volatile,
            partitions,
            head,
            before_reactions,
        };
        self.symbols = symbols;
        self.aliased = aliased;
        self.live = live;
        answer
    }
}

impl Prover<'_> {
    /// Counts a mistake of which nobody reads more than that it is there.
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

    /// What was found so far, so that what a run finds that is only a rehearsal can be forgotten.
    pub(crate) fn said(&self) -> (usize, usize) {
        (self.diagnostics.len(), self.states_at_point.len())
    }

    /// Forgets what was found since: a run that counts follows.
    pub(crate) fn unsay(&mut self, (diagnostics, states_at_point): (usize, usize)) {
        if self.is_settled() {
            return;
        }
        self.diagnostics.truncate(diagnostics);
        self.states_at_point.truncate(states_at_point);
    }

    /// Whether nothing that follows changes the answer: something is refuted, and by no rehearsal. What a round of a loop refutes
    /// the rounds after it do too, since they begin in all states in which it does.
    pub(crate) fn is_settled(&self) -> bool {
        let counts = self.fixpoints == 0 || (self.target.grows && self.rehearsals == 0);
        self.mode == Mode::Decide && counts && self.target.point.is_none() && self.is_refuted()
    }

    pub(crate) fn is_refuted(&self) -> bool {
        self.diagnostics.iter().any(|said| said.severity == Severity::Error)
    }

    /// Remembers the state in which the point is reached, with what the reactions around it may have done just now.
    pub(crate) fn record_state(&mut self) {
        let before_reactions = self.facts.mark();
        self.erode();
        self.states_at_point.push(AbstractState {
            facts: self.facts.clone().lift(),
            lasting: self.lasting.clone(),
            watched: self.watched.clone(),
            volatile: self.volatile.clone(),
            partitions: self.partitions.clone(),
            head: self.head,
            before_reactions,
        });
    }

    /// Goes on where any of some steps leads.
    pub(crate) fn choose(&mut self, steps: &[StepId]) {
        let mark = self.facts.mark();
        let mut ways = Vec::with_capacity(steps.len());
        for step in steps {
            self.step(*step);
            if self.live {
                ways.push(self.facts.delta(mark));
            }
            self.back_to(mark);
            self.live = true;
            if self.is_settled() {
                break;
            }
        }
        self.meet(mark, &ways);
    }

    /// Whether a call is refuted here by the first `count` of its needs, taken in their order as a call takes them.
    pub(crate) fn refutes(&mut self, def: &PrimitiveDef, args: &[Term], count: usize) -> bool {
        let stale = |arg: &Term| matches!(arg, Term::Binding(id) if self.is_stale(*id));
        if args.iter().any(stale) {
            return true;
        }
        let mark = self.facts.mark();
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
        self.facts.back_to(mark);
        is_refuted
    }

    /// Whether nothing of a step is refuted here; it leaves no trace.
    pub(crate) fn permits(&mut self, step: StepId) -> bool {
        let (mark, partitions, live) = (self.facts.mark(), self.partitions.clone(), self.live);
        self.step(step);
        let permits = !self.is_refuted();
        self.diagnostics.clear();
        self.facts.back_to(mark);
        self.partitions = partitions;
        self.live = live;
        self.lasting.retain(|other, _| *other < step);
        permits
    }

    /// Whether a condition holds here, whatever way led here.
    pub(crate) fn proves(&self, condition: &Condition) -> bool {
        self.evaluate(condition, CallFrame::default()).is_true()
    }

    /// Whether a condition is refuted here.
    pub(crate) fn denies(&self, condition: &Condition) -> bool {
        self.evaluate(condition, CallFrame::default()).no.is_some()
    }
}
