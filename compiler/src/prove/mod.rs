//! Stage 3, the prover: an abstract interpretation on sets of {true, false, unobserved}, with joins where
//! paths meet and fixed points of loops. Each need is proven, refuted or deferred to an observation at run
//! time.
//!
//! Its cost depends on the facts that a policy changes, and not on the size of the environment: facts are
//! written on a trail and rolled back at forks.
//!
//! Guarded by `tests/spec/prover.md`, the oracle in `tests/tests/it/oracle.rs` and
//! `tests/tests/it/promises.rs`.

mod assume;
mod call;
pub(crate) mod candidates;
mod collector;
pub(crate) mod diagnostics;
mod domain;
pub(crate) mod effects;
pub(crate) mod evaluation;
mod explanation;
mod lints;
mod monitor;
pub(crate) mod suspended;
pub(crate) mod symbols;
pub(crate) mod test_outcomes;
mod volatile;

use motet_syntax::effort::ErrorCount;
use motet_syntax::{Diagnostic, Span};
use rustc_hash::{FxHashMap, FxHashSet};
use smallvec::SmallVec;

pub(crate) use self::assume::mentions;

use self::collector::Collector;
use self::diagnostics::TooDeep;
use self::effects::FactChange;
use self::evaluation::CallFrame;
use self::suspended::{ProofInput, ProofTarget};
use self::symbols::Symbols;
use self::test_outcomes::TestTable;
use self::volatile::Volatile;
use crate::analysis::{Domain, Enclosing};
use crate::declare::{Library, PerceptionLifetime, PrimitiveDef};
use crate::environment::Environment;
use crate::facts::{Atom, FactKey, FactStore, PathPartition, TruthSet, effort};
use crate::ir::{Condition, Entity, Fluent, Measure, Program, StepId, Term};

/// Maximal nesting of loops and parallel branches: each level is proved at least twice.
pub const MAX_FIXPOINTS: usize = 8;
/// Work of a proof after which it is given up, in visits of steps: nested loops and reactions multiply them.
const MAX_WORK: usize = 1_000_000;
/// The same for each step of a policy with very many.
const MAX_WORK_OF_STEP: usize = 30;

/// Verdict on one need of a step.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum NeedVerdict {
    /// Holds on every path.
    Proven,
    /// Left to an observation.
    Deferred,
    /// False, whatever was done before, and a handler catches that.
    Caught,
    /// Fails on some path.
    Refuted,
}

/// Verdicts on the needs of a step.
pub(crate) type NeedVerdicts = SmallVec<[NeedVerdict; 16]>;

/// Result of a proof.
#[derive(Clone, Debug, Default)]
pub(crate) struct Proof {
    /// By step, a verdict for each need of its primitive; empty for other steps and for unreachable steps.
    pub(crate) needs: Vec<NeedVerdicts>,
    /// Entity for which a need about all of a kind is unknown, by step and index of the need.
    pub(crate) unknown_of: FxHashMap<(StepId, usize), Entity>,
    /// Steps and indices of the needs that hold at the first attempt, and that a retry asks again.
    pub(crate) retried: FxHashSet<(StepId, usize)>,
    /// By step, whether it is reachable.
    pub(crate) reached: Vec<bool>,
    /// Steps whose test may stay unknown in the run, so that their `else` says nothing.
    pub(crate) unknown_tests: FxHashSet<StepId>,
    /// Outcomes of tests that a drop may have brought about.
    pub(crate) drops: FxHashSet<(StepId, bool)>,
    /// Certain facts just before a step with a motion.
    pub(crate) certain: FxHashMap<StepId, Vec<CertainFact>>,
    /// Verdict on the goal; `None` without a goal or an end.
    pub(crate) goal: Option<GoalVerdict>,
}

/// Verdict on the goal over all ends at which the policy is done.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GoalVerdict {
    /// True if the goal may hold at one of the ends.
    pub may_hold: bool,
    /// True if the goal holds at every end.
    pub is_proven: bool,
}

/// A fact about poses that is certain at some step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct CertainFact {
    pub(crate) fluent: Fluent,
    pub(crate) entity: Entity,
    pub(crate) value: bool,
}

/// State of a proof.
pub(crate) struct Prover<'a> {
    pub(crate) library: &'a Library,
    pub(crate) environment: &'a Environment,
    pub(crate) program: &'a Program,
    pub(crate) symbols: Symbols,
    /// Table of poses that are not stale, by binding and step.
    fresh: Fluent,
    tested: TestTable,
    /// By fluent, whether a symbol has an entry.
    aliased: Vec<bool>,
    pub(crate) state: AbstractState<'a>,
    pub(crate) control: Control,
    mode: Mode,
    /// Step of interest of an incremental check.
    target: ProofTarget,
    /// Listener to all problems; `None` if no repairs are wanted.
    observer: Option<&'a mut dyn Observer>,
    diagnostics: Vec<Diagnostic>,
    proof: Proof,
    /// States in which control reaches the program point of the target.
    states_at_point: Vec<AbstractState<'static>>,
    /// Calls that may fill a hand, once they were looked for.
    grips: Option<std::rc::Rc<[StepId]>>,
    /// Buffers for the changes of a step, reused between steps.
    buffers: (Vec<FactChange>, Vec<FactChange>),
}

/// Abstract state at a program point.
#[derive(Clone, Debug, Default)]
pub(crate) struct AbstractState<'w> {
    pub(crate) facts: FactStore<'w>,
    pub(crate) lasting: FxHashMap<StepId, PerceptionLifetime>,
    watched: Vec<Watched>,
    /// Facts that a reaction may change at any moment, with their values.
    volatile: Vec<Volatile>,
    /// Paths of earlier joins, the latest last.
    partitions: Vec<PathPartition>,
    /// Position in the trail at which the round of the innermost loop began.
    head: Option<usize>,
    /// Position in the trail before the effects of reactions at this point.
    before_reactions: usize,
}

impl<'w> AbstractState<'w> {
    /// State before the first step, the table of poses that are not stale, and that of tests.
    fn at_start(environment: &'w Environment) -> (Self, Fluent, TestTable) {
        let mut facts = FactStore::above(&environment.facts, Symbols::first(environment));
        // A pose that no step has bound here is neither fresh nor stale.
        let fresh = facts.add_table(TruthSet::default());
        let tested = TestTable::new(facts.add_table(TruthSet::NOTHING_KNOWN));
        (Self { facts, ..Self::default() }, fresh, tested)
    }

    /// Lays the state above the facts of an environment, which must be those that it was lifted from.
    fn over(self, environment: &Environment) -> AbstractState<'_> {
        self.with_facts(|facts| facts.over(&environment.facts))
    }

    /// Takes the state without the facts of its environment.
    fn lift(self) -> AbstractState<'static> {
        self.with_facts(FactStore::lift)
    }

    fn with_facts<'a>(self, change: impl FnOnce(FactStore<'w>) -> FactStore<'a>) -> AbstractState<'a> {
        AbstractState {
            facts: change(self.facts),
            lasting: self.lasting,
            watched: self.watched,
            volatile: self.volatile,
            partitions: self.partitions,
            head: self.head,
            before_reactions: self.before_reactions,
        }
    }
}

/// Control flow around the step that is being proved.
#[derive(Clone, Debug, Default)]
pub(crate) struct Control {
    enclosing: Vec<Enclosing<Collector>>,
    /// What is watched around each enclosing cleanup, and not in it.
    unwatched: Vec<Vec<Watched>>,
    /// Facts that a branch beside the present one may change at any moment.
    disturbed: Vec<Atom>,
    /// Facts that steps have written, also on paths that were rolled back, while branches are proved alone.
    written: Option<Vec<Atom>>,
    /// By enclosing branch, the numbers of disturbed and volatile facts around it.
    branches: Vec<(usize, usize)>,
    /// The call that is being proved.
    pub(crate) here: Option<StepId>,
    /// False if no path leads here.
    pub(crate) live: bool,
    /// Number of enclosing fixed points.
    fixpoints: usize,
    /// Number of enclosing runs that only find the effects of a reaction.
    rehearsals: usize,
    /// Visits of steps so far. Each counts once, and once more for each fact that a reaction may change.
    work: usize,
    /// Index of the first finding that later rounds of a loop have too.
    settled: Option<usize>,
    /// The step at which the proof was given up.
    given_up: Option<StepId>,
    errors: ErrorCount,
}

/// Purpose of a proof.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) enum Mode {
    /// Explain every problem.
    #[default]
    Explain,
    /// Only decide whether any need is refuted.
    Decide,
}

/// Fluents and measures that an enclosing monitor watches.
#[derive(Clone, Debug)]
pub(crate) struct Watched {
    /// Step of the monitor.
    by: StepId,
    pub(crate) measures: Vec<Measure>,
    pub(crate) fluents: Vec<Fluent>,
    /// Entities whose distance is watched.
    pub(crate) near: Vec<Entity>,
}

/// Callback that finds the entity of a term.
type Lookup<'l> = &'l mut dyn FnMut(&Term) -> Option<u16>;

impl Watched {
    /// Adds those of a condition.
    fn add(&mut self, condition: &Condition, lookup: Lookup<'_>) {
        match condition {
            Condition::Fact(fact) => self.fluents.push(fact.fluent),
            Condition::Compare(_, left, right) => {
                self.add_term(left, lookup);
                self.add_term(right, lookup);
            }
            Condition::Not(inner) => self.add(inner, lookup),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                parts.iter().for_each(|part| self.add(part, lookup));
            }
            Condition::Literal(_)
            | Condition::MonitoredMeasure(_)
            | Condition::MonitoredFluent(_)
            | Condition::Unknown => {}
        }
    }

    fn add_term(&mut self, term: &Term, lookup: Lookup<'_>) {
        match term {
            Term::Measure(id, args) => {
                self.measures.push(*id);
                self.near.extend(args.iter().filter_map(lookup).map(Entity));
            }
            Term::Count(of) | Term::First(of) => self.add_term(of, lookup),
            Term::Template(parts) => parts.iter().for_each(|(part, _)| self.add_term(part, lookup)),
            Term::Arith(_, left, right) => {
                self.add_term(left, lookup);
                self.add_term(right, lookup);
            }
            _ => {}
        }
    }
}

/// The end of a policy, where steps may still be added.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum PolicyEnd {
    /// Before a `done`.
    Before(StepId),
    /// Behind the last step.
    After(StepId),
}

/// A problem in the state in which the prover finds it.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Problem<'p> {
    /// A call with a need that some path refutes.
    RefutedNeed { step: StepId, def: &'p PrimitiveDef, frame: CallFrame<'p> },
    /// A step that uses a stale pose, which was bound at a span.
    StaleBinding { step: StepId, bound: Span },
    /// A goal that is refuted where the policy is done.
    RefutedGoal { goal: &'p Condition, end: PolicyEnd },
    /// A fact in which the policy ends, with the truth value that is probably meant.
    UnintendedFact { fact: (Fluent, FactKey, bool), end: PolicyEnd },
    /// The step that is being proved changes nothing.
    RedundantStep,
}

/// A listener to the diagnostics of the prover, called while the facts before the step are still at hand.
///
/// It may try calls on the facts, and must take them back.
pub(crate) trait Observer: std::fmt::Debug {
    /// Takes in a problem and the diagnostic about it.
    fn observe(&mut self, prover: &mut Prover<'_>, problem: Problem<'_>, diagnostic: &Diagnostic);
}

/// Proves a program from the facts that hold at the start.
pub(crate) fn prove(
    program: &Program,
    library: &Library,
    environment: &Environment,
    observer: &mut dyn Observer,
) -> (Proof, Vec<Diagnostic>) {
    let mut prover = Prover::new(program, library, environment);
    prover.observer = Some(observer);
    prover.block(&program.body);
    if prover.control.live {
        let last = program.body.last().copied();
        let end = last.map(PolicyEnd::After);
        prover.check_goal(end);
        let last = last.and_then(|id| program.step(id));
        prover.check_end(end, last.map_or(program.span, |step| step.span));
    }
    if prover.is_exhausted() {
        // What was not visited may be reachable.
        let step = prover.control.given_up.and_then(|id| program.step(id));
        let span = step.map_or(program.span, |step| step.span);
        prover.diagnostics.push(TooDeep { span, limit: None }.into());
    } else if prover.control.given_up.is_none() {
        prover.report_unreached();
    }
    (prover.proof, prover.diagnostics)
}

impl<'a> Prover<'a> {
    /// The state before the first step.
    pub(crate) fn new(program: &'a Program, library: &'a Library, environment: &'a Environment) -> Self {
        let (state, fresh, tested) = AbstractState::at_start(environment);
        let symbols = Symbols::new(program, library, environment);
        let steps = program.steps.len();
        let proof = Proof {
            needs: vec![NeedVerdicts::new(); steps],
            reached: vec![false; steps],
            ..Proof::default()
        };
        let names = (symbols, (fresh, tested), vec![false; library.fluents.len()]);
        Self { proof, ..Self::resume((program, library, environment), state, names) }
    }

    /// A proof that continues from a state.
    fn resume(
        (program, library, environment): ProofInput<'a>,
        state: AbstractState<'a>,
        (symbols, (fresh, tested), aliased): (Symbols, (Fluent, TestTable), Vec<bool>),
    ) -> Self {
        Self {
            library,
            environment,
            program,
            symbols,
            fresh,
            tested,
            aliased,
            state,
            control: Control { live: true, ..Control::default() },
            mode: Mode::Explain,
            target: ProofTarget::default(),
            observer: None,
            diagnostics: Vec::new(),
            proof: Proof::default(),
            states_at_point: Vec::new(),
            grips: None,
            buffers: Default::default(),
        }
    }

    /// Returns whether the proof has taken too long, and was given up.
    pub(crate) fn is_exhausted(&self) -> bool {
        self.control.work > MAX_WORK.max(MAX_WORK_OF_STEP * self.program.steps.len()) || effort::is_used_up()
    }

    /// Returns whether there are more errors than are told.
    fn has_too_many_errors(&mut self) -> bool {
        self.control.errors.is_too_many(self.diagnostics.iter())
    }

    /// Adds a diagnostic that a path before this one may have found.
    fn tell_once(&mut self, said: Diagnostic) {
        if !self.diagnostics.iter().any(|told| told.span == said.span && *told == said) {
            self.diagnostics.push(said);
        }
    }

    /// Notifies the observer of a problem.
    pub(crate) fn notify(&mut self, problem: Problem<'_>, diagnostic: &Diagnostic) {
        if let Some(observer) = self.observer.take() {
            observer.observe(self, problem, diagnostic);
            self.observer = Some(observer);
        }
    }
}
