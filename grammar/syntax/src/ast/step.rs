//! Steps of a policy, with monitors, handlers and endings.

use derive_where::derive_where;

use super::{Call, Expr, Name};
use crate::source::Span;

/// A list of steps that run one after the other.
#[derive(Clone, Debug, Default)]
#[derive_where(PartialEq)]
pub struct Block {
    pub steps: Vec<Step>,
    /// Positions of what could not be read as a step, ascending, in the list as it is written.
    #[derive_where(skip)]
    pub gaps: Vec<u32>,
    /// Range with the braces or brackets.
    #[derive_where(skip)]
    pub span: Span,
}

impl Block {
    /// A block of which every step could be read.
    #[must_use]
    pub fn new(steps: Vec<Step>, span: Span) -> Self {
        Self { steps, gaps: Vec::new(), span }
    }

    /// The steps as they are written; `None` stands for what could not be read.
    pub fn written(&self) -> impl Iterator<Item = Option<&Step>> {
        let (mut steps, mut gaps) = (self.steps.iter(), self.gaps.iter().peekable());
        (0_u32..).map_while(move |index| match gaps.next_if(|gap| **gap == index) {
            Some(_) => Some(None),
            None => steps.next().map(Some),
        })
    }
}

/// One step of a block.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct Step {
    pub kind: StepKind,
    #[derive_where(skip)]
    pub span: Span,
}

/// Kind of a step, with its parts.
#[derive(Clone, Debug, PartialEq)]
pub enum StepKind {
    /// `let m = detect("mug") within 2 s retry 1`
    Do(Do),
    /// `let limit = 0.5 m`: a name for a value. A lone call is a [`StepKind::Do`] with a binding.
    Let { name: Name, value: Expr },
    /// A named group: `sequence tidy { … }`.
    Sequence { name: Name, body: Block },
    /// `if c { … } else { … }`
    If { condition: Expr, then: Block, otherwise: Option<Block> },
    /// `wait until c within 60 s`
    Wait {
        condition: Expr,
        /// The deadline; 60 s where nothing is said.
        within: Option<Expr>,
    },
    /// `monitor { when … } during { … }`
    Monitor {
        /// Watched conditions in order; at least one.
        whens: Vec<When>,
        body: Block,
    },
    /// `try { … } catch slipped { … }`
    Try {
        body: Block,
        /// The handlers, first match wins; none only where the step has a cleanup.
        catches: Vec<Catch>,
    },
    /// `repeat 3 { … } until c`
    Repeat {
        /// Greatest number of runs: a whole number.
        times: Expr,
        body: Block,
        /// Condition tested after each run.
        until: Option<Expr>,
    },
    /// `each cup in cups at most 5 { … }`
    Each {
        /// Binding of the current element.
        item: Name,
        list: Expr,
        /// Greatest length of the list: a whole number.
        at_most: Expr,
        body: Block,
    },
    /// `parallel { { … } { … } }`
    Parallel {
        /// The branches; at least one.
        branches: Vec<Block>,
    },
    /// `keep out of stairs, distance(baby) >= 1 m { … }`
    Keep {
        /// The rules; at least one.
        keeps: Vec<Keep>,
        body: Block,
    },
    /// `wait 5 s`
    Delay {
        /// Time to wait: a duration.
        time: Expr,
    },
    /// `within 30 s { … }`
    Within {
        /// Time that the block has: a duration.
        time: Expr,
        body: Block,
    },
    /// A step with blocks and its cleanup: `sequence tidy { … } finally { … }`.
    Finally {
        step: Box<Step>,
        /// Steps that run once, however the step is left.
        cleanup: Block,
    },
    /// `done`, `done mug`, `fail "why"`, `cannot "why"`, `replan "why"`
    End(End),
}

/// A call of a primitive or of a sub-policy, as a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Do {
    pub call: Call,
    /// Binding of the result.
    pub bind: Option<Name>,
    /// Manner of its motion.
    pub manner: Option<Manner>,
    /// Deadline of the call: a duration.
    pub within: Option<Expr>,
    /// Number of retries after a failure: a whole number.
    pub retry: Option<Expr>,
}

/// Manner in which a call moves: a part of the robot's speed and acceleration.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub enum Manner {
    /// The word `slowly`.
    Slowly(#[derive_where(skip)] Span),
    /// The word `gently`.
    Gently(#[derive_where(skip)] Span),
    /// `at 30 %`: a ratio, and the range with the `at`.
    At(Expr, #[derive_where(skip)] Span),
}

impl Manner {
    /// Range of the manner in the document.
    #[must_use]
    pub fn span(&self) -> Span {
        match self {
            Self::Slowly(span) | Self::Gently(span) | Self::At(_, span) => *span,
        }
    }
}

/// A rule of where the robot may not go.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct Keep {
    pub kind: KeepKind,
    #[derive_where(skip)]
    pub span: Span,
}

/// Kind of a rule of where the robot may not go.
#[derive(Clone, Debug, PartialEq)]
pub enum KeepKind {
    /// A zone that nothing of the robot enters: `out of stairs`.
    OutOf(Expr),
    /// `distance(baby) >= 1 m`
    Distance {
        to: Expr,
        /// Least distance: a length.
        at_least: Expr,
    },
}

/// A watched condition with its reaction: `when c for 200 ms then R`.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct When {
    pub condition: Expr,
    /// Duration for which the condition must hold before the reaction starts.
    pub hold: Option<Expr>,
    pub reaction: Reaction,
    #[derive_where(skip)]
    pub span: Span,
}

/// Reaction of a monitor whose condition holds.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub enum Reaction {
    /// `pause within 60 s`
    Pause {
        /// The longest pause: a duration; 60 s where nothing is said.
        within: Option<Expr>,
        #[derive_where(skip)]
        span: Span,
    },
    /// `restart at most 3`
    Restart {
        /// Greatest number of times: a whole number.
        at_most: Expr,
        #[derive_where(skip)]
        span: Span,
    },
    /// `resume at most 3 { … }`
    Resume {
        /// Greatest number of times: a whole number.
        at_most: Expr,
        body: Block,
        #[derive_where(skip)]
        span: Span,
    },
    /// `done`, `done mug`, `fail "…"`, `cannot "…"`, `replan "…"`
    End(End),
}

/// A handler of failures: `catch slipped, blocked as e { … }`.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct Catch {
    pub on: CatchOn,
    /// Binding of the failure, which the body alone sees.
    pub bind: Option<Name>,
    pub body: Block,
    #[derive_where(skip)]
    pub span: Span,
}

/// Failures that a `catch` handles.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub enum CatchOn {
    /// Every failure: `any`.
    Any(#[derive_where(skip)] Span),
    /// The named kinds; at least one.
    Kinds(Vec<Name>),
}

/// A step that ends the policy.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct End {
    pub kind: EndKind,
    /// The result of the policy; only on `done`.
    pub result: Option<Expr>,
    /// The reason: a text; never on `done`.
    pub why: Option<Expr>,
    #[derive_where(skip)]
    pub span: Span,
}

/// Endings that a policy can choose.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum EndKind {
    /// The policy reached its goal.
    Done,
    /// The policy gives up.
    Fail,
    /// The policy declines what was asked.
    Cannot,
    /// The policy asks for a new one.
    Replan,
}
