//! Numbers that a host may choose.

use crate::time::Time;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Time limits and budgets of the engine.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EngineSettings {
    /// Time limit for the answer to a cancel; after it the engine asks for a safe stop.
    pub cancel_within: Time,
    /// Time limit for the answer to a safe stop; after it the run ends with [`crate::Fault::NotStopped`].
    pub safe_stop_within: Time,
    /// The least time for which a watched condition may be unknown before its monitor fires.
    pub unknown_for: Time,
    /// Time limit for the verdict on a deferred motion; after it the step starts without one. `None` without
    /// a verifier: the driver then decides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub verify_within: Option<Time>,
    /// The most transitions at one instant.
    pub step_budget: u32,
}

impl Default for EngineSettings {
    /// 5 s for a cancel, 5 s for a safe stop, 0.5 s unknown, nobody who verifies, 10,000,000 transitions.
    fn default() -> Self {
        Self {
            cancel_within: Time::from_nanos(5_000_000_000),
            safe_stop_within: Time::from_nanos(5_000_000_000),
            unknown_for: Time::from_nanos(500_000_000),
            verify_within: None,
            step_budget: 10_000_000,
        }
    }
}
