//! Control: entering regions and steps, and what follows when they end.

use super::Turn;
use crate::schedule::{NodeExit, Transition};
use crate::state::{AfterStop, Phase};
use crate::trace::{EndCause, NodeEnding, TraceEventKind};
use motet_graph::{Ending, NodeId, NodeKind, RegionId};
use smol_str::SmolStr;

impl Turn<'_> {
    /// Starts a region from its first step.
    pub(super) fn enter_region(&mut self, region: RegionId) {
        let plan = self.plan;
        let suspended = plan.region(region).owner.map_or(0, |owner| self.suspensions(owner, region));
        let entry = plan.region(region).entry;
        let state = self.run.regions.at_mut(region.index());
        state.active = true;
        state.stopping = None;
        state.suspended = suspended;
        state.current = entry;
        match entry {
            Some(node) => self.plan_entry(node),
            None => {
                let origin = plan.region(region).owner.unwrap_or(NodeId(0));
                let exit = NodeExit { ending: NodeEnding::Success, cause: EndCause::Completed, origin };
                self.push(Transition::RegionEnded(region, exit));
            }
        }
    }

    /// The work list shall enter a step.
    pub(super) fn plan_entry(&mut self, node: NodeId) {
        self.run.nodes.at_mut(node.index()).phase = Phase::Entering;
        self.push(Transition::Enter(node));
    }

    /// Enters a step.
    #[inline(always)]
    pub(super) fn enter(&mut self, node: NodeId) {
        let step = self.plan.step(node);
        let region = self.run.regions.at(step.region.index());
        if let Some(cause) = region.stopping {
            // It was never entered, so it has no ending of its own.
            self.run.nodes.at_mut(node.index()).phase = Phase::Idle;
            self.leave_region(step.region, NodeExit { ending: NodeEnding::Interrupted, cause, origin: node });
        } else if region.suspended > 0 {
            self.run.nodes.at_mut(node.index()).phase = Phase::Parked;
        } else {
            self.report(move || TraceEventKind::Entered { node });
            if step.is_call {
                let state = self.run.nodes.at_mut(node.index());
                state.count = 1;
                state.begins_again = false;
                self.begin(node, step);
            } else {
                self.enter_other(node);
            }
        }
    }

    /// Enters a step that is no call.
    fn enter_other(&mut self, node: NodeId) {
        self.run.nodes.at_mut(node.index()).phase = Phase::Inside;
        match &self.plan.node(node).kind {
            NodeKind::Call(_) => {}
            NodeKind::Wait { condition, within_secs } => self.wait(node, condition, *within_secs),
            NodeKind::Delay { secs } => self.delay(node, *secs),
            NodeKind::Finally { body, .. } => {
                self.run.composites.at_mut(node.index()).body_ended = None;
                self.enter_region(*body);
            }
            NodeKind::If { .. } | NodeKind::Let { .. } => self.decide(node),
            NodeKind::End { how, of, why } => {
                match how {
                    Ending::Done | Ending::Cannot | Ending::Replan => self.succeed(node),
                    Ending::Fail => self.fail(node, self.plan.failed, EndCause::Failed),
                }
                self.end_policy(node, *how, *of, why.as_ref(), EndCause::ParentEnded);
            }
            NodeKind::Monitor { watches, body } => self.enter_monitor(node, watches, *body),
            NodeKind::Each { item, list, at_most, body } => {
                self.enter_each(node, *item, list, *at_most, *body)
            }
            NodeKind::Repeat { body, .. } => {
                self.run.nodes.at_mut(node.index()).count = 1;
                self.enter_region(*body);
            }
            NodeKind::Sequence { body, .. } | NodeKind::Inline { body, .. } | NodeKind::Try { body, .. } => {
                self.enter_region(*body);
            }
            NodeKind::Parallel { branches } if branches.is_empty() => self.succeed(node),
            NodeKind::Parallel { branches } => branches.iter().for_each(|branch| self.enter_region(*branch)),
        }
    }

    /// A step is over: the work list shall see to it.
    pub(super) fn exit(&mut self, node: NodeId, exit: NodeExit) {
        self.run.nodes.at_mut(node.index()).phase = Phase::Ending;
        self.push(Transition::NodeEnded(node, exit));
    }

    /// The same from a region's end, which only the work list calls: without a detour over it where nothing
    /// else is to be done first.
    pub(super) fn exit_at_once(&mut self, node: NodeId, exit: NodeExit) {
        if self.is_quiet() {
            self.node_ended(node, exit);
        } else {
            self.exit(node, exit);
        }
    }

    pub(super) fn succeed(&mut self, node: NodeId) {
        self.exit(node, NodeExit { ending: NodeEnding::Success, cause: EndCause::Completed, origin: node });
    }

    pub(super) fn fail(&mut self, node: NodeId, failure: motet_graph::FailureId, cause: EndCause) {
        self.give_reason(node, None);
        self.exit(node, NodeExit { ending: NodeEnding::Failure(failure), cause, origin: node });
    }

    /// Notes why a step failed, in words, in place of what was noted of it before.
    pub(super) fn give_reason(&mut self, node: NodeId, reason: Option<SmolStr>) {
        match reason {
            Some(reason) => {
                self.run.reasons.insert(node, reason);
            }
            None if self.run.reasons.is_empty() => {}
            None => {
                self.run.reasons.remove(&node);
            }
        }
    }

    /// A step is over: goes on to the next, or ends the region.
    pub(super) fn node_ended(&mut self, node: NodeId, exit: NodeExit) {
        let step = self.plan.step(node);
        if step.is_composite {
            self.leave_composite(node);
        }
        self.run.nodes.at_mut(node.index()).phase = Phase::Idle;
        self.report(move || TraceEventKind::Ended { node, ending: exit.ending, cause: exit.cause });
        let region = self.run.regions.at_mut(step.region.index());
        match (region.stopping, exit.ending, step.next) {
            (None, NodeEnding::Success, Some(next)) => {
                region.current = Some(next);
                self.enter(next);
            }
            (Some(cause), _, _) => {
                let exit = NodeExit { ending: NodeEnding::Interrupted, cause, origin: node };
                self.leave_region(step.region, exit);
            }
            (None, _, _) => self.leave_region(step.region, exit),
        }
    }

    /// The region has no step left that runs.
    pub(super) fn leave_region(&mut self, region: RegionId, exit: NodeExit) {
        self.run.regions.at_mut(region.index()).current = None;
        self.push(Transition::RegionEnded(region, exit));
    }

    /// A region is over: its owner goes on.
    pub(super) fn region_ended(&mut self, region: RegionId, exit: NodeExit) {
        let state = self.run.regions.at_mut(region.index());
        state.active = false;
        state.current = None;
        state.stopping = None;
        state.suspended = 0;
        let Some(owner) = self.plan.region(region).owner else {
            self.root_ended(exit);
            return;
        };
        if let NodeKind::Finally { body, cleanup } = &self.plan.node(owner).kind {
            if *body == region {
                self.clean_up(owner, *cleanup, exit);
            } else {
                self.cleaned_up(owner, exit);
            }
            return;
        }
        if let Some(cause) = self.stopping(self.region_of(owner)) {
            if self.is_down(owner) {
                self.exit(owner, NodeExit { ending: NodeEnding::Interrupted, cause, origin: owner });
            }
            return;
        }
        match self.run.composites.at(owner.index()).after {
            AfterStop::Nothing => self.child_ended(owner, region, exit),
            AfterStop::Exit(_) | AfterStop::Restart if !self.is_down(owner) => {}
            AfterStop::Exit(exit) => self.exit(owner, exit),
            AfterStop::Restart => self.restart(owner),
        }
    }

    /// True if none of a node's regions runs.
    pub(super) fn is_down(&self, node: NodeId) -> bool {
        self.plan.owned(node).iter().all(|region| !self.run.regions.at(region.index()).active)
    }

    /// Forgets what a composite step kept while it ran.
    fn leave_composite(&mut self, node: NodeId) {
        match &self.plan.node(node).kind {
            NodeKind::Monitor { watches, .. } => self.leave_monitor(node, watches.len() as u32),
            NodeKind::Each { .. } => {
                if let Some(place) = self.run.lists.iter().rposition(|(loop_node, _)| *loop_node == node) {
                    self.run.lists.remove(place);
                }
            }
            NodeKind::Call(_) | NodeKind::Sequence { .. } | NodeKind::Inline { .. } | NodeKind::If { .. } => {
            }
            NodeKind::Wait { .. } | NodeKind::Try { .. } | NodeKind::Repeat { .. } => {}
            NodeKind::Let { .. } | NodeKind::Delay { .. } | NodeKind::Finally { .. } => {}
            NodeKind::Parallel { .. } | NodeKind::End { .. } => {}
        }
        self.run.composites.at_mut(node.index()).after = AfterStop::Nothing;
    }
}
