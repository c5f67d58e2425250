//! Goals that a driver carries out, to notice reports about others and failures that are not declared.

use super::super::protocol::CalledPrimitive;
use motet_runtime::{FailureReport, GoalId};
use smol_str::SmolStr;
use std::collections::{BTreeMap, BTreeSet};

/// Goals that were started and have not ended, with their primitives. Bounded by what an engine runs at once.
#[derive(Debug, Default)]
pub(super) struct GoalLedger {
    live: BTreeMap<GoalId, SmolStr>,
    /// Declared failures of each primitive of the greeting.
    fails: BTreeMap<SmolStr, Vec<SmolStr>>,
    /// Goals whose safe stop was asked for and is not acknowledged.
    pub(super) stopping: BTreeSet<GoalId>,
}

impl GoalLedger {
    pub(super) fn new(primitives: &[CalledPrimitive]) -> Self {
        let fails = primitives.iter().filter(|called| !called.fails.is_empty());
        let fails = fails.map(|called| (called.name.as_str().into(), called.fails.clone())).collect();
        Self { fails, ..Self::default() }
    }

    pub(super) fn started(&mut self, goal: GoalId, primitive: &SmolStr) {
        self.live.insert(goal, primitive.clone());
    }

    /// True for a goal of which a driver may report something.
    pub(super) fn is_live(&self, goal: GoalId) -> bool {
        self.live.contains_key(&goal) || self.stopping.contains(&goal)
    }

    /// True if nothing moves, as far as it was told.
    pub(super) fn is_idle(&self) -> bool {
        self.live.is_empty() && self.stopping.is_empty()
    }

    /// Takes the end of a goal in. The primitive of a goal that ran.
    pub(super) fn ended(&mut self, goal: GoalId) -> Option<SmolStr> {
        self.live.remove(&goal)
    }

    /// Takes the acknowledgement of a safe stop in. False if nobody asked for it.
    pub(super) fn stopped(&mut self, goal: GoalId) -> bool {
        let was_asked = self.stopping.remove(&goal);
        if was_asked {
            self.live.remove(&goal);
        }
        was_asked
    }

    /// Breach of the contract of a primitive by the failure in which it ended, in words.
    pub(super) fn undeclared(&self, primitive: &SmolStr, failure: &FailureReport) -> Option<String> {
        let FailureReport { kind, .. } = failure;
        let declared = self.fails.get(primitive)?;
        (kind != "timeout" && !declared.contains(kind)).then(|| {
            let list = declared.join(", ");
            format!("`{primitive}` failed with `{kind}`, which it does not declare; it declares {list}")
        })
    }
}
