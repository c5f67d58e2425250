//! Stage 4: geometry. It answers each motion of a policy in the world after the steps before it.
//!
//! No motion query is built in: every motion is left to the robot, so its verdict is `deferred`, and nothing here
//! claims otherwise.

use motet_graph::Verdict;

/// The verdict on a motion.
pub(crate) fn verdict() -> Verdict {
    Verdict::Deferred
}
