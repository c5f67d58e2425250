//! The driver: what moves the robot, or pretends to.

use crate::effect::Command;
use crate::event::{DriverEvent, GoalId};
use crate::query::Query;
use crate::time::Time;

/// What moves the robot. The host loop ([`crate::run`]) passes it the engine's effects and feeds the engine with what it
/// reports.
///
/// # Laws
///
/// 1. Every goal that was started is answered by [`DriverEvent::Acknowledged`] or [`DriverEvent::Refused`], and an
///    acknowledged one ends exactly once, by [`DriverEvent::Ended`] or [`DriverEvent::Stopped`]. After that the driver
///    says nothing of it and uses none of its resources.
/// 2. A cancelled goal ends soon, by its own end or as interrupted. A cancel of a goal that has ended is ignored.
/// 3. A safe stop is always answered by [`DriverEvent::Stopped`], for a goal that has ended too.
/// 4. While it is held a goal does not move the robot and does not end by itself, unless the world makes it fail.
///    A driver that cannot hold it answers [`DriverEvent::NotHeld`] and goes on until it is cancelled.
/// 5. Every observation is answered by one [`DriverEvent::Observed`], within the card's `observe_within`. A watch is
///    answered at once and then whenever the answer differs from the last; watching twice is watching once.
/// 6. Time never runs backwards, and with the same calls at the same times it reports the same events at the same times.
/// 7. It never reports from within a call: everything goes out through [`Driver::advance`].
pub trait Driver {
    /// Starts a primitive.
    fn start(&mut self, now: Time, goal: GoalId, command: &Command);
    /// Ends a goal early.
    fn cancel(&mut self, now: Time, goal: GoalId);
    /// Keeps a goal still until [`Driver::proceed`].
    fn hold(&mut self, now: Time, goal: GoalId);
    /// Lets a held goal go on.
    fn proceed(&mut self, now: Time, goal: GoalId);
    /// Brings everything that a goal uses to a safe stop.
    fn safe_stop(&mut self, now: Time, goal: GoalId);
    /// Answers a query once.
    fn observe(&mut self, now: Time, query: &Query);
    /// Answers a query now and whenever the answer changes.
    fn watch(&mut self, now: Time, query: &Query);
    /// No longer watches a query.
    fn unwatch(&mut self, now: Time, query: &Query);
    /// Lets the world go on to the next thing that it has to report, but no further than `until`. Returns that event
    /// with its time, at most `until`, or nothing where `until` was reached without one. With [`Time::NEVER`], nothing
    /// means that nothing will ever happen. A driver of a real robot blocks here.
    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)>;
}
