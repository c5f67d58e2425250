//! Verifiers: they decide deferred motions just before their steps start.
//!
//! The engine itself asks and goes on ([`crate::Effect::Verify`]); the verdict comes back as an event
//! ([`crate::Event::Verified`]). So it stands in the journal, a replay needs no geometry, and a search that
//! takes its time keeps no monitor waiting.

use crate::effect::{DeferredMotion, Effect};
use crate::event::{Event, Verification};
use crate::ids::CheckId;
use crate::query::{Query, Truth};
use crate::telemetry::Moved;
use crate::time::Time;
use std::sync::Arc;

use motet_stdlib::lang;

/// Checks motions that the compiler deferred, in the world as a run has made it. [`crate::run`] shows the one
/// that its observer has ([`crate::Observer::verifier`]) all events and effects, asks it, and takes its
/// verdicts as they come.
///
/// # Laws
///
/// 1. A motion is called infeasible only where that is proven for the world as it was known when it was
///    asked; what is not known is unknown.
/// 2. A failure is one that the primitive lists.
/// 3. Asking changes nothing.
/// 4. None of its calls keeps a robot waiting: who has to search for long does it on a thread of its own.
///    Where time is virtual it may search at once, so that a run is the same each time.
pub trait Verifier {
    /// An event is about to be handled at a time: what follows from it for the world.
    fn event(&mut self, now: Time, event: &Event);

    /// The driver told where the robot is. Not all drivers do.
    fn moved(&mut self, _moved: &Moved) {}

    /// An effect is about to be carried out.
    fn effect(&mut self, effect: &Effect);

    /// Asks whether a motion has a solution in the world as it is.
    fn ask(&mut self, check: CheckId, motion: &Arc<DeferredMotion>);

    /// A verdict that was not given yet, if there is one.
    fn verdict(&mut self) -> Option<(CheckId, Verification)>;

    /// True if a verdict is still to come.
    fn is_busy(&self) -> bool;
}

/// Truth value of a derived fact, which no robot observes and about which nothing is believed. `reachable` is
/// the verdict of a motion, and the guard of that motion is checked beside it, so it is accepted.
pub(crate) fn derived(query: &Query) -> Truth {
    match query {
        Query::Fact { fluent, .. } if fluent == lang::fluents::REACHABLE => Truth::True,
        Query::Fact { .. } | Query::Measure { .. } | Query::Field { .. } => Truth::Unknown,
    }
}
