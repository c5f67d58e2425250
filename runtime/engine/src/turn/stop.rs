//! Stopping a region: every goal in it is cancelled, and it is over once all of them have ended.

use super::Turn;
use crate::state::{GoalIntent, NodeExit, Phase};
use crate::trace::{EndCause, NodeEnding};
use motet_graph::{NodeId, RegionId};

impl Turn<'_> {
    /// Stops a region and everything in it, in document order. Its end comes through the work list, at once
    /// where nothing in it has a live goal.
    pub(super) fn stop(&mut self, region: RegionId, cause: EndCause) {
        let mut walk = std::mem::take(&mut self.run.walk);
        walk.clear();
        walk.push(region);
        while let Some(region) = walk.pop() {
            let state = self.run.regions.at_mut(region.index());
            if !state.active {
                continue;
            }
            state.stopping = state.stopping.or(Some(cause));
            if let Some(node) = state.current {
                self.stop_node(node, region, cause, &mut walk);
            }
        }
        self.run.walk = walk;
    }

    fn stop_node(&mut self, node: NodeId, region: RegionId, cause: EndCause, walk: &mut Vec<RegionId>) {
        let interrupted = NodeExit { ending: NodeEnding::Interrupted, cause, origin: node };
        match self.run.nodes.at(node.index()).phase {
            // The work list has it.
            Phase::Idle | Phase::Entering | Phase::Ending => {}
            Phase::Parked => {
                self.run.nodes.at_mut(node.index()).phase = Phase::Idle;
                self.leave_region(region, interrupted);
            }
            Phase::Deciding | Phase::Waiting | Phase::Queued | Phase::Checking | Phase::Suspended => {
                self.let_go(node);
                self.exit(node, interrupted);
            }
            Phase::Starting | Phase::Running | Phase::Held | Phase::Cancelling | Phase::SafeStopping => {
                self.cancel(node, GoalIntent::Stop);
            }
            Phase::Inside => walk.extend(self.plan.owned(node).iter().rev()),
        }
    }

    /// True if a goal is live in a region.
    pub(super) fn has_goals(&mut self, region: RegionId) -> bool {
        let mut walk = std::mem::take(&mut self.run.walk);
        walk.clear();
        walk.push(region);
        let mut found = false;
        while let Some(region) = walk.pop() {
            let state = self.run.regions.at(region.index());
            let Some(node) = state.current.filter(|_| state.active) else { continue };
            let phase = self.run.nodes.at(node.index()).phase;
            found |= phase.has_goal();
            if phase == Phase::Inside {
                walk.extend(self.plan.owned(node));
            }
        }
        self.run.walk = walk;
        found
    }
}
