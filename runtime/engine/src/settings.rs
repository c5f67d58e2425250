//! Numbers that a host may choose.

use crate::time::Time;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How patient the engine is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EngineSettings {
    /// How long a cancel may go unanswered before the engine asks for a safe stop.
    pub cancel_within: Time,
    /// How long a safe stop may go unanswered before the run ends with [`crate::Fault::NotStopped`].
    pub safe_stop_within: Time,
    /// The least time for which a watched condition may be unknown before its monitor fires.
    pub unknown_for: Time,
    /// How long a motion that the compiler deferred may go without a verdict before its step starts all the same. Nothing
    /// where nobody is there to ask: such motions are left to the driver.
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
