//! Random valid graphs over a small vocabulary, for property tests here and in the crates that run or write
//! graphs.
//!
//! [`vocabulary`] declares kinds, fluents, measures and primitives; a [`StepSketch`] is a step as a tree;
//! [`graph`] lays such trees out as a graph that always validates; [`graphs`] draws them at random. Tests
//! that need a certain graph write the tree down themselves.

mod caught;
mod layout;
mod strategy;
pub mod vocabulary;

pub use caught::with_named_failures;
pub use layout::graph;
pub use strategy::{conditions, graphs, steps};

use self::vocabulary as v;
use motet_graph::{BindingId, Condition, Ending, FailureId, Manner, PrimitiveId, Term, Verdict};

/// Sketch of a step.
#[derive(Clone, Debug)]
pub enum StepSketch {
    Call(CallSketch),
    /// A name for an object.
    Let(Term),
    /// A named group.
    Sequence(Vec<StepSketch>),
    Inline(Vec<StepSketch>),
    If(Condition, Vec<StepSketch>, Option<Vec<StepSketch>>),
    /// A wait, with its deadline in seconds.
    Wait(Condition, f64),
    /// A wait for so many seconds.
    Delay(f64),
    /// A body and its cleanup.
    Finally(Vec<StepSketch>, Vec<StepSketch>),
    Monitor(Vec<WatchSketch>, Vec<StepSketch>),
    /// A body and its handlers.
    Try(Vec<StepSketch>, Vec<(Option<Vec<FailureId>>, Vec<StepSketch>)>),
    /// A loop with its bound and its test.
    Repeat(u32, Vec<StepSketch>, Option<Condition>),
    /// A loop over a list of objects, with its bound.
    Each(Term, u32, Vec<StepSketch>),
    Parallel(Vec<Vec<StepSketch>>),
    /// Ends the sub-policy around it, or the policy where there is none, or where it says `replan` or
    /// `cannot`. Nothing where it would leave a cleanup.
    End(Ending),
}

/// A call of a primitive of the vocabulary.
#[derive(Clone, Debug)]
pub struct CallSketch {
    pub primitive: PrimitiveId,
    /// Its arguments; [`CallSketch::NEAREST`] stands for the object that was bound last, or `mug` where none
    /// was.
    pub args: Vec<Term>,
    /// The manner of the motion.
    pub manner: Option<Manner>,
    /// The deadline in seconds.
    pub deadline_secs: f64,
    pub retries: u32,
    /// The verdict on its needs.
    pub verdict: Verdict,
}

/// A watched condition.
#[derive(Clone, Debug)]
pub struct WatchSketch {
    pub condition: Condition,
    /// Seconds for which it must hold.
    pub hold_secs: f64,
    pub react: ReactionSketch,
}

/// Sketch of a monitor's reaction.
#[derive(Clone, Debug)]
pub enum ReactionSketch {
    /// Hold for at most so many seconds.
    Pause(f64),
    /// Start again at most so often.
    Restart(u32),
    /// Interrupt, run steps, go on, at most so often.
    Resume(u32, Vec<StepSketch>),
    /// End, as [`StepSketch::End`] does.
    End(Ending),
}

impl CallSketch {
    /// The object that was bound last.
    pub const NEAREST: Term = Term::Binding(BindingId(u32::MAX));

    /// A call with a deadline of 10 s, no retries and its needs deferred.
    #[must_use]
    pub fn new(primitive: PrimitiveId, args: Vec<Term>) -> Self {
        Self { primitive, args, manner: None, deadline_secs: 10.0, retries: 0, verdict: Verdict::Deferred }
    }

    /// Sets the number of retries.
    #[must_use]
    pub fn retry(self, retries: u32) -> Self {
        Self { retries, ..self }
    }

    /// With its needs proven.
    #[must_use]
    pub fn proven(self) -> Self {
        Self { verdict: Verdict::Proven, ..self }
    }
}

impl StepSketch {
    /// Call of `go(to)`.
    #[must_use]
    pub fn go(to: &str) -> Self {
        Self::Call(CallSketch::new(v::GO, vec![v::entity(to)]))
    }

    /// Call of `say(text)`.
    #[must_use]
    pub fn say(text: &str) -> Self {
        Self::Call(CallSketch::new(v::SAY, vec![v::text(text)]))
    }

    /// Call of `pick(object)`.
    #[must_use]
    pub fn pick(object: &str) -> Self {
        Self::Call(CallSketch::new(v::PICK, vec![v::entity(object)]))
    }

    /// `let it = detect(what)`
    #[must_use]
    pub fn detect(what: &str) -> Self {
        Self::Call(CallSketch::new(v::DETECT, vec![v::text(what)]))
    }
}

impl WatchSketch {
    /// A watch without a debounce.
    #[must_use]
    pub fn new(condition: Condition, react: ReactionSketch) -> Self {
        Self { condition, hold_secs: 0.0, react }
    }
}
