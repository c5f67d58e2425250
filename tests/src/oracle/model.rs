//! Domains and policies as the oracle sees them.

/// An argument of an atom.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Arg {
    /// The parameter of the action.
    Param,
    /// An entity.
    Entity(usize),
    /// Every entity, in an effect; some entity, in a condition.
    Any,
}

/// A fluent with its arguments.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Atom {
    /// Which fluent.
    pub fluent: usize,
    /// As many as the fluent has parameters.
    pub args: Vec<Arg>,
}

/// An atom or its negation.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Literal {
    /// The atom.
    pub atom: Atom,
    /// Whether it is meant to hold.
    pub truth: bool,
}

/// An effect, under a condition where there is one.
#[derive(Clone, Debug)]
pub struct Effect {
    /// What is so afterwards.
    pub literal: Literal,
    /// Where it happens.
    pub when: Option<Literal>,
}

/// How a step can fail.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Kind {
    /// `slipped`
    Slipped,
    /// `blocked`
    Blocked,
    /// `timeout`
    Timeout,
    /// `exhausted`
    Exhausted,
}

/// An action with its contract.
#[derive(Clone, Debug)]
pub struct Action {
    /// Whether it has a parameter.
    pub has_param: bool,
    /// Its preconditions.
    pub needs: Vec<Literal>,
    /// Its effects.
    pub makes: Vec<Effect>,
    /// What is not known after it.
    pub unsettles: Vec<Atom>,
    /// How it can fail, besides in time.
    pub fails: Vec<Kind>,
}

/// Fluents, entities, actions and a start.
#[derive(Clone, Debug)]
pub struct Domain {
    /// How many entities there are.
    pub entities: usize,
    /// By fluent: how many parameters it has, at most two.
    pub arities: Vec<usize>,
    /// The actions.
    pub actions: Vec<Action>,
    /// What is known at the start.
    pub start: Vec<(Atom, bool)>,
    /// Whether everything else is false.
    pub is_closed: bool,
}

/// A step.
#[derive(Clone, Debug)]
pub enum Step {
    /// Runs an action.
    Call {
        /// Which.
        action: usize,
        /// On which entity.
        entity: usize,
        /// How often it is tried again.
        retry: usize,
    },
    /// A named group.
    Sequence(Vec<Step>),
    /// A branch.
    If(Literal, Vec<Step>, Vec<Step>),
    /// Handlers by kind; none for any.
    Try(Vec<Step>, Vec<(Option<Vec<Kind>>, Vec<Step>)>),
    /// A bounded loop.
    Repeat(usize, Vec<Step>, Option<Literal>),
    /// A body, and a block that may run before any of its steps, at most so often.
    Resume(Vec<Step>, usize, Vec<Step>),
    /// Calls at once, as pairs of action and entity.
    Parallel(Vec<Vec<(usize, usize)>>),
    /// Ends the policy: done, or failed.
    End(bool),
}

/// A policy.
pub type Policy = Vec<Step>;

impl Step {
    /// Whether branches run at once somewhere in it.
    #[must_use]
    pub fn is_parallel(&self) -> bool {
        let any = |steps: &[Self]| steps.iter().any(Self::is_parallel);
        match self {
            Self::Parallel(_) => true,
            Self::Call { .. } | Self::End(_) => false,
            Self::Sequence(body) | Self::Repeat(_, body, _) => any(body),
            Self::If(_, then, otherwise) => any(then) || any(otherwise),
            Self::Try(body, handlers) => any(body) || handlers.iter().any(|(_, handler)| any(handler)),
            Self::Resume(body, _, reaction) => any(body) || any(reaction),
        }
    }
}
