//! Steps: what a policy is made of.

use derive_where::derive_where;

use super::{Call, Expr, Name};
use crate::source::Span;

/// A list of steps that run one after the other.
#[derive(Clone, Debug, Default)]
#[derive_where(PartialEq)]
pub struct Block {
    /// The steps.
    pub steps: Vec<Step>,
    /// The braces or brackets, with what is between them.
    #[derive_where(skip)]
    pub span: Span,
}

/// One step.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct Step {
    /// What it does.
    pub kind: StepKind,
    /// The whole step.
    #[derive_where(skip)]
    pub span: Span,
}

/// What a step does.
#[derive(Clone, Debug, PartialEq)]
pub enum StepKind {
    /// `let m = detect("mug") within 2 s retry 1`
    Do(Do),
    /// `sequence tidy { … }`
    Sequence {
        /// The group's name.
        name: Name,
        /// Its steps.
        body: Block,
    },
    /// `if c { … } else { … }`
    If {
        /// The condition.
        condition: Expr,
        /// Steps where it holds.
        then: Block,
        /// Steps where it does not.
        otherwise: Option<Block>,
    },
    /// `wait until c within 60 s`
    Wait {
        /// What is waited for.
        condition: Expr,
        /// The deadline; 60 s where nothing is said.
        within: Option<Expr>,
    },
    /// `monitor { when … } during { … }`
    Monitor {
        /// What is watched, in order; at least one.
        whens: Vec<When>,
        /// What runs meanwhile.
        body: Block,
    },
    /// `try { … } catch slipped { … }`
    Try {
        /// What may fail.
        body: Block,
        /// The handlers, first match wins; at least one.
        catches: Vec<Catch>,
    },
    /// `repeat 3 { … } until c`
    Repeat {
        /// How often at most: a whole number.
        times: Expr,
        /// The body.
        body: Block,
        /// The test after each run.
        until: Option<Expr>,
    },
    /// `each cup in cups at most 5 { … }`
    Each {
        /// The loop's binding.
        item: Name,
        /// The list.
        list: Expr,
        /// The longest list that is taken: a whole number.
        at_most: Expr,
        /// The body.
        body: Block,
    },
    /// `parallel { { … } { … } }`
    Parallel {
        /// The branches; at least one.
        branches: Vec<Block>,
    },
    /// `done`, `fail "why"`, `replan "why"`
    End(End),
}

/// A call of a primitive or of a sub-policy, as a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Do {
    /// The call.
    pub call: Call,
    /// The binding of its result.
    pub bind: Option<Name>,
    /// Its deadline: a duration.
    pub within: Option<Expr>,
    /// How often it is tried again after a failure: a whole number.
    pub retry: Option<Expr>,
}

/// `when c for 200 ms then R`
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct When {
    /// What is watched for.
    pub condition: Expr,
    /// How long it must hold: a duration.
    pub hold: Option<Expr>,
    /// What then happens.
    pub reaction: Reaction,
    /// All of it.
    #[derive_where(skip)]
    pub span: Span,
}

/// What a monitor does when it fires.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub enum Reaction {
    /// `pause within 60 s`
    Pause {
        /// The longest pause: a duration; 60 s where nothing is said.
        within: Option<Expr>,
        /// The reaction as written.
        #[derive_where(skip)]
        span: Span,
    },
    /// `restart at most 3`
    Restart {
        /// How often: a whole number.
        at_most: Expr,
        /// The reaction as written.
        #[derive_where(skip)]
        span: Span,
    },
    /// `resume at most 3 { … }`
    Resume {
        /// How often: a whole number.
        at_most: Expr,
        /// What runs in between.
        body: Block,
        /// The reaction as written.
        #[derive_where(skip)]
        span: Span,
    },
    /// `done`, `fail "…"`, `replan "…"`
    End(End),
}

/// `catch slipped, blocked { … }`
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct Catch {
    /// Which failures.
    pub on: CatchOn,
    /// What then runs.
    pub body: Block,
    /// All of it.
    #[derive_where(skip)]
    pub span: Span,
}

/// Which failures a `catch` takes.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub enum CatchOn {
    /// `any`
    Any(#[derive_where(skip)] Span),
    /// The named kinds; at least one.
    Kinds(Vec<Name>),
}

/// An ending of the policy.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct End {
    /// Which ending.
    pub kind: EndKind,
    /// The reason: a text; never on `done`.
    pub why: Option<Expr>,
    /// All of it.
    #[derive_where(skip)]
    pub span: Span,
}

/// The ways a policy can end by its own word.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum EndKind {
    /// It reached what it was for.
    Done,
    /// It gives up.
    Fail,
    /// It asks for a new policy.
    Replan,
}
