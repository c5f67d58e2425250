//! The program and its steps.

use motet_syntax::Span;
use motet_syntax::ast::EndKind;
use motet_syntax::unit::Unit;
use smallvec::SmallVec;
use smol_str::SmolStr;

use super::{BindingId, Condition, Failure, Primitive, StepId, Term, Ty};

/// A policy, resolved.
#[derive(Clone, Debug, Default)]
pub(crate) struct Program {
    /// Its name.
    pub(crate) name: SmolStr,
    /// The robot's name; empty without one.
    pub(crate) robot: SmolStr,
    /// Where it stands.
    pub(crate) span: Span,
    /// All steps, parents before children, in document order.
    pub(crate) steps: Vec<Step>,
    /// The body.
    pub(crate) body: Block,
    /// The bindings.
    pub(crate) bindings: Vec<Binding>,
    /// Its goal.
    pub(crate) achieves: Option<(Condition, Span)>,
}

impl Program {
    /// The step with an id.
    pub(crate) fn step(&self, id: StepId) -> Option<&Step> {
        self.steps.get(id.index())
    }

    /// The steps in which a step lies, innermost first.
    pub(crate) fn around(&self, id: StepId) -> impl Iterator<Item = (StepId, &Step)> {
        let outer = |id: StepId| {
            let id = self.step(id)?.position.parent?;
            Some((id, self.step(id)?))
        };
        std::iter::successors(outer(id), move |(id, _)| outer(*id))
    }
}

/// Steps that run one after the other.
pub(crate) type Block = Vec<StepId>;

/// A binding.
#[derive(Clone, Debug)]
pub(crate) struct Binding {
    /// Its name; `_` for a result that is not named.
    pub(crate) name: SmolStr,
    /// Its type.
    pub(crate) ty: Ty,
    /// Where it is bound.
    pub(crate) span: Span,
    /// The description that it was found by, where it is a literal.
    pub(crate) description: Option<SmolStr>,
    /// Whether it stands for the parameter of a sub-policy that is checked by itself.
    pub(crate) is_param: bool,
    /// How often it is used.
    pub(crate) uses: u32,
}

/// A step, resolved.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    /// What it does.
    pub(crate) kind: StepKind,
    /// Where it is written.
    pub(crate) span: Span,
    /// The step that it lies in, and in which of its blocks.
    pub(crate) position: StepPosition,
    /// Least and greatest duration in seconds; filled in by `check`.
    pub(crate) bounds: (f64, f64),
}

/// Where a step lies.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct StepPosition {
    /// The step around it; none for the policy's own body.
    pub(crate) parent: Option<StepId>,
    /// Which block of it.
    pub(crate) slot: BlockSlot,
    /// The position in that block, from 0.
    pub(crate) index: u32,
}

/// The blocks that a step can have.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum BlockSlot {
    /// `steps`: of a policy, a sequence, a loop.
    Steps,
    /// `then`
    Then,
    /// `else`
    Else,
    /// `try`
    Try,
    /// `catch/N/steps`
    Catch(u16),
    /// `during`
    During,
    /// `monitor/N/then/steps`
    Reaction(u16),
    /// `parallel/N`
    Branch(u16),
    /// The body of an inlined policy.
    Inlined,
}

/// What a step does.
#[derive(Clone, Debug)]
pub(crate) enum StepKind {
    /// Runs a primitive.
    Call(Call),
    /// A named group.
    Sequence {
        /// Its name.
        name: SmolStr,
        /// Its steps.
        body: Block,
    },
    /// A sub-policy.
    Inline {
        /// Its name.
        policy: SmolStr,
        /// Its steps.
        body: Block,
    },
    /// A branch.
    If {
        /// The condition.
        condition: Condition,
        /// Where it stands.
        span: Span,
        /// Where it holds.
        then: Block,
        /// Where it does not.
        otherwise: Option<Block>,
    },
    /// Blocks until a condition holds.
    Wait {
        /// The condition.
        condition: Condition,
        /// The deadline.
        within_secs: f64,
    },
    /// Watches conditions.
    Monitor {
        /// What is watched.
        whens: Vec<When>,
        /// What runs.
        body: Block,
    },
    /// Handles failures.
    Try {
        /// What may fail.
        body: Block,
        /// The handlers.
        catches: Vec<Catch>,
    },
    /// A bounded loop.
    Repeat {
        /// How often at most.
        times: u32,
        /// The body.
        body: Block,
        /// The test.
        until: Option<(Condition, Span)>,
    },
    /// A loop over a list.
    Each {
        /// The loop's binding.
        item: BindingId,
        /// The list.
        list: Term,
        /// The longest list.
        at_most: u32,
        /// The body.
        body: Block,
    },
    /// Branches at once.
    Parallel {
        /// The branches.
        branches: Vec<Block>,
    },
    /// Ends the policy or the inlined policy `of`.
    End {
        /// How.
        kind: EndKind,
        /// Which inlined policy.
        of: Option<StepId>,
        /// The reason.
        why: Option<Term>,
    },
    /// After an error: it may do anything.
    Unknown,
}

impl StepKind {
    /// The conditions that stand in the step itself, in document order.
    pub(crate) fn conditions(&self) -> impl Iterator<Item = &Condition> {
        let (one, whens): (_, &[When]) = match self {
            Self::If { condition, .. } | Self::Wait { condition, .. } => (Some(condition), &[]),
            Self::Repeat { until, .. } => (until.as_ref().map(|(until, _)| until), &[]),
            Self::Monitor { whens, .. } => (None, whens),
            Self::Call(_)
            | Self::Sequence { .. }
            | Self::Inline { .. }
            | Self::Try { .. }
            | Self::Each { .. }
            | Self::Parallel { .. }
            | Self::End { .. }
            | Self::Unknown => (None, &[]),
        };
        one.into_iter().chain(whens.iter().map(|when| &when.condition))
    }
}

/// A call of a primitive.
#[derive(Clone, Debug)]
pub(crate) struct Call {
    /// Which.
    pub(crate) primitive: Primitive,
    /// An argument for each parameter.
    pub(crate) args: SmallVec<[Term; 2]>,
    /// Where each argument stands; of a default, the call.
    pub(crate) spans: SmallVec<[Span; 2]>,
    /// In which unit each argument is written, where it is a quantity.
    pub(crate) units: SmallVec<[Option<Unit>; 4]>,
    /// Where the result goes.
    pub(crate) binds: Option<BindingId>,
    /// The deadline where one is written.
    pub(crate) within_secs: Option<f64>,
    /// How often it is tried again.
    pub(crate) retries: u32,
}

/// A watched condition.
#[derive(Clone, Debug)]
pub(crate) struct When {
    /// The condition.
    pub(crate) condition: Condition,
    /// Where it stands.
    pub(crate) span: Span,
    /// Seconds for which it must hold.
    pub(crate) hold_secs: f64,
    /// What then happens.
    pub(crate) reaction: Reaction,
}

/// What a monitor does.
#[derive(Clone, Debug)]
pub(crate) enum Reaction {
    /// Holds the body.
    Pause {
        /// The longest pause.
        within_secs: f64,
    },
    /// Starts the body again.
    Restart {
        /// How often.
        at_most: u32,
    },
    /// Interrupts for a block.
    Resume {
        /// How often.
        at_most: u32,
        /// The block.
        body: Block,
    },
    /// Ends the policy or the inlined policy `of`.
    End {
        /// How.
        kind: EndKind,
        /// Which inlined policy.
        of: Option<StepId>,
        /// The reason.
        why: Option<Term>,
    },
}

/// A handler.
#[derive(Clone, Debug)]
pub(crate) struct Catch {
    /// The failures with their places; none for `any`.
    pub(crate) on: Option<Vec<(Failure, Span)>>,
    /// Where it says which failures it takes, or as a whole.
    pub(crate) span: Span,
    /// What then runs.
    pub(crate) body: Block,
}
