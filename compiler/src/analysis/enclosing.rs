//! Constructs around the present step of an analysis, which catch control that leaves the step.

use motet_syntax::Span;
use motet_syntax::ast::EndKind;

use crate::ir::{Failure, StepId};

/// A construct around the present step, which catches control that leaves the step.
#[derive(Clone, Debug)]
pub(crate) enum Enclosing<C> {
    /// A `try` with its handlers.
    Try { handlers: Vec<Handler<C>> },
    /// An inlined policy, with the states in which it is done.
    Inline { step: StepId, exits: C },
    /// A monitor, with all states of its body.
    Monitor { states: C },
    /// A block with a cleanup, which catches all control that leaves the block.
    Finally(Box<Leaving<C>>),
    /// A cleanup, behind which its failures lead.
    Cleanup(Handler<C>),
}

/// Control that leaves a block with a cleanup otherwise than by its end.
#[derive(Clone, Debug)]
pub(crate) struct Leaving<C> {
    /// States after failures.
    pub(super) failed: C,
    pub(super) kinds: Vec<Failure>,
    /// States at endings, with the ending for each kind and inlined policy.
    pub(super) ended: Vec<(Ended, C)>,
    /// All states of the block, if something around it can interrupt it.
    pub(crate) interrupted: Option<C>,
}

/// Ending of the policy, or of an inlined policy.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ended {
    /// The step; `None` for the reaction of a monitor.
    pub(super) id: Option<StepId>,
    pub(super) kind: EndKind,
    pub(super) of: Option<StepId>,
    pub(super) span: Span,
}

/// A handler of an enclosing `try`.
#[derive(Clone, Debug)]
pub(crate) struct Handler<C> {
    /// Failures that it catches; `None` for any.
    pub(super) on: Option<Vec<Failure>>,
    /// States in which it starts.
    pub(super) states: C,
    /// Failures that reach it.
    pub(super) kinds: Vec<Failure>,
}

impl<C> Enclosing<C> {
    /// The collectors of states.
    pub(crate) fn collectors(&mut self) -> impl Iterator<Item = &mut C> {
        let (handlers, ended, one, other): (&mut [Handler<C>], &mut [(Ended, C)], _, _) = match self {
            Self::Try { handlers } => (handlers, &mut [], None, None),
            Self::Inline { exits: states, .. } | Self::Monitor { states } => {
                (&mut [], &mut [], Some(states), None)
            }
            Self::Cleanup(handler) => (&mut [], &mut [], Some(&mut handler.states), None),
            Self::Finally(leaving) => {
                (&mut [], &mut leaving.ended, Some(&mut leaving.failed), leaving.interrupted.as_mut())
            }
        };
        let many = handlers.iter_mut().map(|handler| &mut handler.states);
        many.chain(ended.iter_mut().map(|(_, states)| states)).chain(one).chain(other)
    }

    /// Collector of the states in which a failure is caught, with the failures that reach it.
    pub(crate) fn catcher(&mut self, kind: Failure) -> Option<(&mut C, &mut Vec<Failure>)> {
        match self {
            Self::Try { handlers } => {
                let fits =
                    |handler: &&mut Handler<C>| handler.on.as_ref().is_none_or(|on| on.contains(&kind));
                handlers.iter_mut().find(fits).map(|handler| (&mut handler.states, &mut handler.kinds))
            }
            Self::Finally(leaving) => Some((&mut leaving.failed, &mut leaving.kinds)),
            Self::Cleanup(handler) => Some((&mut handler.states, &mut handler.kinds)),
            Self::Inline { .. } | Self::Monitor { .. } => None,
        }
    }

    /// Returns whether it is a `try` with a handler for a failure.
    pub(crate) fn handles(&self, kind: Failure) -> bool {
        match self {
            Self::Try { handlers } => {
                handlers.iter().any(|handler| handler.on.as_ref().is_none_or(|on| on.contains(&kind)))
            }
            Self::Inline { .. } | Self::Monitor { .. } | Self::Finally(_) | Self::Cleanup(_) => false,
        }
    }
}
