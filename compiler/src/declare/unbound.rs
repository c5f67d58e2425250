//! Unbound names of a scope: names that were bound before, but have no value here, because not every path
//! that leads here binds them.
//!
//! The resolver of steps records unbound names where paths meet; the resolution of names reports them at a
//! use.

use motet_syntax::{Diagnostic, Span};
use smallvec::SmallVec;
use smol_str::SmolStr;

use super::diagnostics::{PartlyBound, TwoTypes};
use crate::ir::BindingId;

/// A name without a value.
#[derive(Clone, Debug)]
pub(crate) struct UnboundName {
    pub(crate) cause: UnboundCause,
    /// Bindings with this name.
    pub(crate) ids: SmallVec<[BindingId; 1]>,
}

/// Cause of a unbound.
#[derive(Clone, Debug)]
pub(crate) enum UnboundCause {
    /// Not every path binds the name.
    Unbound(Unbound),
    /// Two paths bind values of different types.
    Types { types: [SmolStr; 2], second: Span },
}

/// Reason for which a name that was bound before is not bound here.
#[derive(Clone, Debug)]
pub(crate) enum Unbound {
    /// A path, which ends at a span, goes on without it.
    Path { name: SmolStr, end: Span },
    /// The condition of an `if` without `else` may not hold.
    NoElse(Span),
    /// The handlers of a `try` do not see its body.
    Handler,
    /// It is bound on another path through the step.
    OtherPath,
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

impl UnboundName {
    /// Diagnostic of a use at `span` of a name that is bound at `bound`.
    pub(super) fn report(&self, name: &SmolStr, span: Span, bound: Span) -> Diagnostic {
        let name = name.clone();
        match &self.cause {
            UnboundCause::Unbound(reason) => PartlyBound { span, name, bound, reason: reason.clone() }.into(),
            UnboundCause::Types { types, second } => {
                TwoTypes { span, name, types: types.clone(), first: bound, second: *second }.into()
            }
        }
    }
}
