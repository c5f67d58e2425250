//! Stage 3: the prover. It runs a policy abstractly over sets of {true, false, unobserved}, joins where ways meet, runs
//! loops to a fixed point, and says of each need whether it is proven, refuted or left to observation.
//!
//! It costs what the policy changes, not what the environment holds: facts are written on a trail and taken back at forks.

mod assume;
mod call;
mod collector;
mod display;
pub(crate) mod effects;
pub(crate) mod errors;
pub(crate) mod evaluation;
mod explanation;
mod failure;
mod lints;
mod loops;
mod monitor;
mod parallel;
pub(crate) mod suspended;
pub(crate) mod symbols;
mod walk;

use motet_syntax::{Diagnostic, Span};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

pub(crate) use self::assume::mentions;

use self::collector::Enclosing;
use self::effects::{FactChange, PerceptionLifetime};
use self::evaluation::CallFrame;
use self::suspended::{AbstractState, ProofTarget};
use self::symbols::Symbols;
use crate::declare::{Library, PrimitiveDef};
use crate::environment::Environment;
use crate::facts::{Cause, TruthSet};
use crate::facts::{FactKey, FactStore, PathPartition};
use crate::ir::{Condition, Entity, Fluent, Measure, Program, StepId};

/// How deep loops and parallel branches may nest: each level is proved at least twice.
pub const MAX_FIXPOINTS: usize = 8;

/// What the prover found of one need of a step.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum NeedVerdict {
    /// Holds on every path.
    Proven,
    /// Only observation can tell.
    Deferred,
    /// Fails on some path.
    Refuted,
}

/// What the prover found of each need of a step.
pub(crate) type NeedVerdicts = SmallVec<[NeedVerdict; 16]>;

/// What the prover found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Proof {
    /// By step: a verdict for each need of its primitive; empty for other steps and for steps that are never reached.
    pub(crate) needs: Vec<NeedVerdicts>,
    /// By step: whether it can be reached.
    pub(crate) reached: Vec<bool>,
    /// What is certain just before a step with a motion, for geometry.
    pub(crate) certain: FxHashMap<StepId, Vec<CertainFact>>,
}

/// A fact that is certain at some step: one of the few that change where things are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct CertainFact {
    pub(crate) fluent: Fluent,
    pub(crate) entity: Entity,
    pub(crate) value: bool,
}

/// The state of a proof.
pub(crate) struct Prover<'a> {
    pub(crate) library: &'a Library,
    pub(crate) environment: &'a Environment,
    pub(crate) program: &'a Program,
    pub(crate) symbols: Symbols,
    pub(crate) facts: FactStore<'a>,
    /// The table of bindings whose value is still right, by binding.
    pub(crate) fresh: Fluent,
    pub(crate) lasting: FxHashMap<StepId, PerceptionLifetime>,
    pub(crate) watched: Vec<Watched>,
    /// FactStore that something beside the step being proved may change at any moment, and to what.
    pub(crate) volatile: Vec<Volatile>,
    pub(crate) enclosing: Vec<Enclosing>,
    /// The call that is being proved.
    pub(crate) here: Option<StepId>,
    /// The ways that met on the way here, the latest last.
    pub(crate) partitions: Vec<PathPartition>,
    /// Whether control gets here at all.
    pub(crate) live: bool,
    pub(crate) fixpoints: usize,
    /// How many runs around this one only look at what a reaction may do.
    pub(crate) rehearsals: usize,
    /// Where the round began of the innermost loop around, as a mark of the facts.
    pub(crate) head: Option<usize>,
    /// By fluent: whether a symbol has an entry.
    pub(crate) aliased: Vec<bool>,
    /// Room for the changes of a step, kept so that no step asks for new.
    pub(crate) buffers: (Vec<FactChange>, Vec<FactChange>),
    pub(crate) diagnostics: Vec<Diagnostic>,
    pub(crate) proof: Proof,
    /// Hears of every problem; none where nobody asks for repairs.
    observer: Option<&'a mut dyn Observer>,
    pub(crate) mode: Mode,
    /// What a draft looks for.
    pub(crate) target: ProofTarget,
    /// The states in which control gets to the point in it.
    pub(crate) states_at_point: Vec<AbstractState>,
}

/// What a proof is for.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) enum Mode {
    /// To tell people what is wrong, why, and what would mend it.
    #[default]
    Explain,
    /// To know whether anything is refuted, and nothing else.
    Decide,
}

/// A fact that a monitor's reaction may change at any moment of the body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Volatile {
    pub(crate) fluent: Fluent,
    pub(crate) key: FactKey,
    /// What it may be then.
    pub(crate) value: TruthSet,
    /// The monitor's condition.
    pub(crate) when: Span,
}

/// What an enclosing monitor watches.
#[derive(Clone, Debug, Default)]
pub(crate) struct Watched {
    pub(crate) measures: Vec<Measure>,
    pub(crate) fluents: Vec<Fluent>,
    /// What the distance to is watched.
    pub(crate) near: Vec<Entity>,
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
    if prover.live {
        let last = program.body.last().copied();
        let end = last.map(PolicyEnd::After);
        prover.check_goal(end);
        let last = last.and_then(|id| program.step(id));
        prover.check_end(end, last.map_or(program.span, |step| step.span));
    }
    prover.report_unreached();
    (prover.proof, prover.diagnostics)
}

impl<'a> Prover<'a> {
    /// The state before the first step.
    pub(crate) fn new(program: &'a Program, library: &'a Library, environment: &'a Environment) -> Self {
        let mut facts = FactStore::above(&environment.facts);
        let fresh = facts.add_table(TruthSet::yes(Cause::NOTHING));
        let steps = program.steps.len();
        Self {
            library,
            environment,
            program,
            symbols: Symbols::new(program, library, environment),
            facts,
            fresh,
            lasting: FxHashMap::default(),
            watched: Vec::new(),
            volatile: Vec::new(),
            enclosing: Vec::new(),
            here: None,
            partitions: Vec::new(),
            live: true,
            fixpoints: 0,
            rehearsals: 0,
            head: None,
            aliased: vec![false; library.fluents.len()],
            buffers: Default::default(),
            diagnostics: Vec::new(),
            proof: Proof {
                needs: vec![NeedVerdicts::new(); steps],
                reached: vec![false; steps],
                certain: FxHashMap::default(),
            },
            observer: None,
            mode: Mode::Explain,
            target: ProofTarget::default(),
            states_at_point: Vec::new(),
        }
    }

    /// Tells the observer of a problem.
    pub(crate) fn notify(&mut self, problem: Problem<'_>, diagnostic: &Diagnostic) {
        if let Some(observer) = self.observer.take() {
            observer.observe(self, problem, diagnostic);
            self.observer = Some(observer);
        }
    }
}
