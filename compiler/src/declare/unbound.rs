//! Gaps of a scope: names that were bound before, but have no value here, because not every way that leads
//! here binds them.
//!
//! The resolver of steps records gaps where ways meet; the resolution of names reports them at a use.

use motet_syntax::{Diagnostic, Span};
use smallvec::SmallVec;
use smol_str::SmolStr;

use super::errors::{PartlyBound, TwoTypes};
use crate::ir::BindingId;

/// A name without a value.
#[derive(Clone, Debug)]
pub(crate) struct Gap {
    pub(crate) cause: GapCause,
    /// Bindings with this name.
    pub(crate) ids: SmallVec<[BindingId; 1]>,
}

/// Cause of a gap.
#[derive(Clone, Debug)]
pub(crate) enum GapCause {
    /// Not every way binds the name.
    Unbound(Unbound),
    /// Two ways bind values of different types.
    Types { types: [SmolStr; 2], second: Span },
}

/// Reason for which a name that was bound before is not bound here.
#[derive(Clone, Debug)]
pub(crate) enum Unbound {
    /// A way, which ends at a span, goes on without it.
    Way { name: SmolStr, end: Span },
    /// The condition of an `if` without `else` may not hold.
    NoElse(Span),
    /// The handlers of a `try` do not see its body.
    Handler,
    /// It is bound on another way through the step.
    OtherWay,
    /// A cleanup sees only what was bound before the step that it cleans up.
    Cleanup,
    /// An `each` may have no round.
    Loop,
    /// A reaction of a monitor may never run.
    Reaction,
    /// It is bound in another branch, which runs at the same time.
    Beside,
    /// It is the failure of a handler, for the steps of the handler alone.
    Caught,
    /// Two branches that run at the same time bind it.
    TwoBranches { second: Span },
}

impl Gap {
    /// Diagnostic of a use at `span` of a name that is bound at `bound`.
    pub(super) fn report(&self, name: &SmolStr, span: Span, bound: Span) -> Diagnostic {
        let name = name.clone();
        match &self.cause {
            GapCause::Unbound(reason) => PartlyBound { span, name, bound, reason: reason.clone() }.into(),
            GapCause::Types { types, second } => {
                TwoTypes { span, name, types: types.clone(), first: bound, second: *second }.into()
            }
        }
    }
}
