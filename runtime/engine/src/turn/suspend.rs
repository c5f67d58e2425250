//! Stopping a region, which is over once all its goals have ended; and suspending it so that it can go on
//! later, with its structure, counters and bindings.

use super::Turn;
use crate::effect::Effect;
use crate::schedule::{NodeExit, Transition};
use crate::state::{GoalIntent, Phase};
use crate::trace::{EndCause, NodeEnding};
use motet_graph::{NodeId, NodeKind, RegionId};

impl Turn<'_> {
    /// Suspends a region once more. Its goals hold, or with [`GoalIntent::Suspend`] end early to start again
    /// later.
    pub(super) fn suspend(&mut self, region: RegionId, wish: GoalIntent) {
        self.walk_down(region, |turn, node, count| {
            *count += 1;
            turn.suspend_node(node, wish);
        });
    }

    /// Undoes one [`Turn::suspend`].
    pub(super) fn go_on(&mut self, region: RegionId) {
        self.walk_down(region, |turn, node, count| {
            let held = *count > 0;
            *count = count.saturating_sub(1);
            if held && *count == 0 {
                turn.go_on_node(node);
            }
        });
    }

    /// Calls `visit` with each step that runs and its region's count of suspensions, in document order.
    fn walk_down(&mut self, region: RegionId, visit: impl Fn(&mut Self, Option<NodeId>, &mut u32)) {
        let mut walk = std::mem::take(&mut self.run.walk);
        walk.clear();
        walk.push(region);
        while let Some(region) = walk.pop() {
            let state = self.run.regions.at(region.index());
            if !state.active {
                continue;
            }
            let (node, mut count) = (state.current, state.suspended);
            let inside = node.filter(|node| self.run.nodes.at(node.index()).phase == Phase::Inside);
            visit(self, node, &mut count);
            self.run.regions.at_mut(region.index()).suspended = count;
            if let Some(node) = inside {
                walk.extend(self.plan.owned(node).iter().rev());
            }
        }
        self.run.walk = walk;
    }

    fn suspend_node(&mut self, node: Option<NodeId>, wish: GoalIntent) {
        let Some(node) = node else { return };
        let wish = if wish == GoalIntent::Hold && !self.can_hold(node) { GoalIntent::Suspend } else { wish };
        let key = self.plan.node_key(node);
        let now = self.run.now;
        let state = self.run.nodes.at_mut(node.index());
        match state.phase {
            Phase::Starting if wish == GoalIntent::Hold => {
                if state.wish == GoalIntent::None {
                    state.wish = GoalIntent::Hold;
                    state.left = self.run.timers.get(key).map_or(state.left, |at| at.since(now));
                    self.run.timers.clear(key);
                }
            }
            Phase::Running if wish == GoalIntent::Hold => {
                state.left = self.run.timers.get(key).map_or(state.left, |at| at.since(now));
                state.phase = Phase::Held;
                self.run.timers.clear(key);
                if let Some(goal) = state.goal {
                    self.out.push(Effect::Hold { goal });
                }
            }
            Phase::Held if wish == GoalIntent::Hold => {}
            Phase::Starting | Phase::Running | Phase::Held => self.cancel(node, wish),
            Phase::Waiting => {
                // One that is suspended already has no instant.
                if let Some(at) = self.run.timers.get(key) {
                    state.left = at.since(now);
                    self.run.timers.clear(key);
                }
            }
            Phase::Queued | Phase::Checking => {
                self.let_go(node);
                self.run.nodes.at_mut(node.index()).phase = Phase::Suspended;
            }
            // A test may come out meanwhile: the steps behind it are not entered.
            Phase::Deciding | Phase::Idle | Phase::Entering | Phase::Parked | Phase::Ending => {}
            Phase::Inside | Phase::Cancelling | Phase::SafeStopping | Phase::Suspended => {}
        }
    }

    /// True if the driver can hold the goal of a call.
    fn can_hold(&self, node: NodeId) -> bool {
        let primitive =
            self.plan.call(node).and_then(|call| self.plan.graph.primitives.get(call.primitive.index()));
        primitive.is_none_or(|primitive| self.capabilities.hold.contains(&primitive.name))
    }

    fn go_on_node(&mut self, node: Option<NodeId>) {
        let Some(node) = node else { return };
        let key = self.plan.node_key(node);
        let now = self.run.now;
        let state = self.run.nodes.at_mut(node.index());
        match state.phase {
            Phase::Parked => self.plan_entry(node),
            Phase::Suspended => {
                state.phase = Phase::Entering;
                self.push(Transition::Acquire(node));
            }
            Phase::Starting if state.wish == GoalIntent::Hold => {
                state.wish = GoalIntent::None;
                self.run.timers.set(key, now.after(state.left));
            }
            Phase::Held => {
                state.phase = Phase::Running;
                self.run.timers.set(key, now.after(state.left));
                if let Some(goal) = state.goal {
                    self.out.push(Effect::Proceed { goal });
                }
            }
            Phase::Waiting => {
                self.run.timers.set(key, now.after(state.left));
                self.push_judge(node);
            }
            Phase::Inside => {
                if let NodeKind::Monitor { watches, .. } = &self.plan.node(node).kind {
                    self.mark_all(node, watches.len() as u32);
                }
            }
            // What is being cancelled starts again once it has ended.
            Phase::Starting | Phase::Cancelling | Phase::SafeStopping => {}
            Phase::Idle | Phase::Entering | Phase::Ending | Phase::Deciding => {}
            Phase::Queued | Phase::Checking | Phase::Running => {}
        }
    }
}

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
            Phase::Inside => match &self.plan.node(node).kind {
                // A cleanup that has begun comes to its end.
                NodeKind::Finally { body, cleanup } if cause != EndCause::Person => {
                    walk.push(*body);
                    self.release_cleanup(node, *cleanup);
                }
                NodeKind::Monitor { watches, .. } => {
                    self.let_go_of_pauses(node, watches.len() as u32);
                    walk.extend(self.plan.owned(node).iter().rev());
                }
                NodeKind::Finally { .. } | NodeKind::Sequence { .. } | NodeKind::Inline { .. } => {
                    walk.extend(self.plan.owned(node).iter().rev());
                }
                NodeKind::If { .. } | NodeKind::Try { .. } | NodeKind::Repeat { .. } => {
                    walk.extend(self.plan.owned(node).iter().rev());
                }
                NodeKind::Each { .. } | NodeKind::Parallel { .. } => {
                    walk.extend(self.plan.owned(node).iter().rev());
                }
                NodeKind::Call(_) | NodeKind::Let { .. } | NodeKind::Wait { .. } => {}
                NodeKind::Delay { .. } | NodeKind::End { .. } => {}
            },
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
