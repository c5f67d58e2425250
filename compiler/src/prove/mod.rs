//! Stage 3: the prover. It runs a policy abstractly over sets of {true, false, unobserved}, joins where ways meet, runs
//! loops to a fixed point, and says of each need whether it is proven, refuted or left to observation.
//!
//! It costs what the policy changes, not what the world holds: facts are written on a trail and taken back at forks.

pub(crate) mod apply;
mod assume;
mod call;
mod collect;
pub(crate) mod draft;
pub(crate) mod errors;
pub(crate) mod eval;
pub(crate) mod facts;
mod flow;
mod intent;
mod looped;
pub(crate) mod mend;
mod monitor;
mod parallel;
mod show;
mod story;
pub(crate) mod symbols;
pub(crate) mod value;
mod walk;

use motet_syntax::{Diagnostic, Span};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

pub(crate) use self::assume::mentions;

use self::apply::{Change, Lasting};
use self::collect::Enclosing;
use self::draft::{Place, Stand};
use self::facts::{Facts, Key, Split};
use self::mend::{End, Offer};
use self::symbols::Symbols;
use self::value::Value;
use crate::ir::{Entity, Fluent, Measure, Program, StepId};
use crate::library::Library;
use crate::world::World;

/// How deep loops and parallel branches may nest: each level is proved at least twice.
pub const MAX_FIXPOINTS: usize = 8;

/// What the prover found of one need of a step.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Verdict {
    /// Holds on every path.
    Proven,
    /// Only observation can tell.
    Deferred,
    /// Fails on some path.
    Refuted,
}

/// What the prover found of each need of a step.
pub(crate) type Verdicts = SmallVec<[Verdict; 16]>;

/// What the prover found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Proof {
    /// By step: a verdict for each need of its primitive; empty for other steps and for steps that are never reached.
    pub(crate) needs: Vec<Verdicts>,
    /// By step: whether it can be reached.
    pub(crate) reached: Vec<bool>,
    /// What is certain just before a step with a motion, for geometry.
    pub(crate) certain: FxHashMap<StepId, Vec<Certain>>,
}

/// A fact that is certain at some step: one of the few that change where things are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Certain {
    pub(crate) fluent: Fluent,
    pub(crate) entity: Entity,
    pub(crate) value: bool,
}

/// The state of a proof.
pub(crate) struct Prover<'a> {
    pub(crate) library: &'a Library,
    pub(crate) world: &'a World,
    pub(crate) program: &'a Program,
    pub(crate) symbols: Symbols,
    pub(crate) facts: Facts<'a>,
    /// The table of bindings whose value is still right, by binding.
    pub(crate) fresh: Fluent,
    pub(crate) lasting: FxHashMap<StepId, Lasting>,
    pub(crate) watched: Vec<Watched>,
    /// Facts that something beside the step being proved may change at any moment, and to what.
    pub(crate) volatile: Vec<Volatile>,
    pub(crate) enclosing: Vec<Enclosing>,
    /// The call that is being proved.
    pub(crate) here: Option<StepId>,
    /// The ways that met on the way here, the latest last.
    pub(crate) splits: Vec<Split>,
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
    pub(crate) buffers: (Vec<Change>, Vec<Change>),
    pub(crate) diagnostics: Vec<Diagnostic>,
    pub(crate) proof: Proof,
    /// What would mend the findings.
    pub(crate) offers: Vec<Offer>,
    pub(crate) mood: Mood,
    /// What a draft looks for.
    pub(crate) place: Place,
    /// The states in which control gets to the hole in it.
    pub(crate) stands: Vec<Stand>,
}

/// What a proof is for.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) enum Mood {
    /// To tell people what is wrong, why, and what would mend it.
    #[default]
    Tell,
    /// To know whether anything is refuted, and nothing else.
    Judge,
}

/// A fact that a monitor's reaction may change at any moment of the body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Volatile {
    pub(crate) fluent: Fluent,
    pub(crate) key: Key,
    /// What it may be then.
    pub(crate) value: Value,
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

/// Proves a program from the facts that the world gives at the start.
pub(crate) fn prove(
    program: &Program,
    library: &Library,
    world: &World,
) -> (Proof, Vec<Diagnostic>, Vec<Offer>) {
    let mut prover = Prover::new(program, library, world);
    prover.block(&program.body);
    if prover.live {
        let last = program.body.last().copied();
        let end = last.map(End::After);
        prover.check_goal(end);
        let last = last.and_then(|id| program.step(id));
        prover.check_end(end, last.map_or(program.span, |step| step.span));
    }
    prover.report_unreached();
    (prover.proof, prover.diagnostics, prover.offers)
}

impl<'a> Prover<'a> {
    /// The state before the first step.
    pub(crate) fn new(program: &'a Program, library: &'a Library, world: &'a World) -> Self {
        let mut facts = Facts::above(&world.facts);
        let fresh = facts.add_table(Value::yes(value::Cause::NOTHING));
        let steps = program.steps.len();
        Self {
            library,
            world,
            program,
            symbols: Symbols::new(program, library, world),
            facts,
            fresh,
            lasting: FxHashMap::default(),
            watched: Vec::new(),
            volatile: Vec::new(),
            enclosing: Vec::new(),
            here: None,
            splits: Vec::new(),
            live: true,
            fixpoints: 0,
            rehearsals: 0,
            head: None,
            aliased: vec![false; library.fluents.len()],
            buffers: Default::default(),
            diagnostics: Vec::new(),
            proof: Proof {
                needs: vec![Verdicts::new(); steps],
                reached: vec![false; steps],
                certain: FxHashMap::default(),
            },
            offers: Vec::new(),
            mood: Mood::Tell,
            place: Place::default(),
            stands: Vec::new(),
        }
    }
}
