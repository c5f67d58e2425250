//! Monitors and their watches: how they are judged, their life, and what becomes of the body when a reaction
//! has run its course.

use super::Turn;
use crate::belief::Freshness;
use crate::query::Truth;
use crate::schedule::NodeExit;
use crate::state::{AfterStop, GoalIntent, Phase};
use crate::time::Time;
use crate::trace::{EndCause, NodeEnding, TraceEventKind};
use motet_graph::{NodeId, NodeKind, Reaction, RegionId, TIMEOUT, Watch};

impl Turn<'_> {
    /// Judges a watch, and fires it if it is due.
    pub(super) fn judge_watch(&mut self, number: u32) {
        self.run.watches.at_mut(number as usize).dirty = false;
        let Some((node, index, watch)) = self.plan.watch(number) else { return };
        if self.run.nodes.at(node.index()).phase != Phase::Inside {
            return;
        }
        let since = self.run.watches.at(number as usize).since;
        let truth = self.judge(Freshness::Readings(since)).condition(&watch.condition);
        let due = self.clock(number, truth, watch);
        if self.run.watches.at(number as usize).paused_at.is_some() {
            if truth == Truth::False {
                self.end_pause(node, number, index);
            }
            return;
        }
        let now = self.run.now;
        match due {
            None => self.run.timers.clear(number),
            Some(at) if at > now => self.run.timers.set(number, at),
            Some(_) => {
                self.run.timers.clear(number);
                if self.may_fire(node, number, watch) {
                    self.report(move || TraceEventKind::Fired { node, watch: index, truth });
                    self.fire(node, number, watch);
                }
            }
        }
    }

    /// Keeps a watch's times. Returns when it is due, if its condition stays as it is.
    fn clock(&mut self, number: u32, truth: Truth, watch: &Watch) -> Option<Time> {
        let now = self.run.now;
        let hold = Time::from_secs(watch.hold_secs);
        let grace = hold.max(self.settings.unknown_for);
        let state = self.run.watches.at_mut(number as usize);
        state.truth = truth;
        match truth {
            Truth::True => {
                let held = state.true_since.get_or_insert(now).after(hold);
                // It may have been true all the time in which it was unknown.
                let open = state.open_since.get_or_insert(now).after(grace);
                Some(held.min(open))
            }
            Truth::Unknown => {
                state.true_since = None;
                Some(state.open_since.get_or_insert(now).after(grace))
            }
            Truth::False => {
                state.true_since = None;
                state.open_since = None;
                None
            }
        }
    }

    /// True if nothing that goes before keeps a watch from firing. What blocks it judges it again when it is
    /// over.
    fn may_fire(&self, node: NodeId, number: u32, watch: &Watch) -> bool {
        let region = self.region_of(node);
        let state = self.run.composites.at(node.index());
        if self.stopping(region).is_some() || self.suspended(region) || state.after != AfterStop::Nothing {
            return false;
        }
        match &watch.reaction {
            Reaction::Resume { .. } => state.resuming.is_none() && state.pauses == 0,
            Reaction::Pause { .. } | Reaction::Restart { .. } | Reaction::End { .. } => {
                state.resuming != Some(number)
            }
        }
    }

    fn fire(&mut self, node: NodeId, number: u32, watch: &Watch) {
        let now = self.run.now;
        match &watch.reaction {
            Reaction::End { how, of, why } => {
                self.end_policy(node, *how, *of, why.as_ref(), EndCause::Monitor)
            }
            Reaction::Restart { at_most } => {
                if self.fires_again(number, *at_most) {
                    self.stop_within(node, AfterStop::Restart);
                } else {
                    self.monitor_fails(node, self.plan.exhausted, EndCause::Exhausted);
                }
            }
            Reaction::Resume { at_most, .. } => {
                if self.fires_again(number, *at_most) {
                    self.begin_block(node, number);
                } else {
                    self.monitor_fails(node, self.plan.exhausted, EndCause::Exhausted);
                }
            }
            Reaction::Pause { within_secs } => {
                let state = self.run.watches.at_mut(number as usize);
                let left = Time::from_secs(*within_secs).since(state.spent);
                if left == Time::ZERO {
                    self.monitor_fails(node, TIMEOUT, EndCause::Deadline);
                    return;
                }
                state.paused_at = Some(now);
                self.run.timers.set(number, now.after(left));
                self.run.composites.at_mut(node.index()).pauses += 1;
                if let Some(part) = self.running_part(node) {
                    self.suspend(part, GoalIntent::Hold);
                }
            }
        }
    }

    fn fires_again(&mut self, number: u32, at_most: u32) -> bool {
        let state = self.run.watches.at_mut(number as usize);
        state.fired = state.fired.saturating_add(1);
        state.fired <= at_most
    }

    /// A watch's instant has come.
    pub(super) fn watch_due(&mut self, number: u32) {
        let Some((node, ..)) = self.plan.watch(number) else { return };
        if self.run.watches.at(number as usize).paused_at.is_none() {
            self.mark(number);
        } else if self.stopping(self.region_of(node)).is_none() {
            self.monitor_fails(node, TIMEOUT, EndCause::Deadline);
        }
    }

    /// Resumes the body after a pause.
    fn end_pause(&mut self, node: NodeId, number: u32, index: u32) {
        self.stop_pausing(number);
        self.report(move || TraceEventKind::WentOn { node, watch: index });
        let state = self.run.composites.at_mut(node.index());
        state.pauses = state.pauses.saturating_sub(1);
        if let Some(part) = self.running_part(node) {
            self.go_on(part);
        }
        if let motet_graph::NodeKind::Monitor { watches, .. } = &self.plan.node(node).kind {
            self.mark_all(node, watches.len() as u32);
        }
    }

    /// A monitor that is stopped no longer pauses anything.
    pub(super) fn let_go_of_pauses(&mut self, node: NodeId, watches: u32) {
        (0..watches).for_each(|index| self.stop_pausing(self.plan.watch_number(node, index)));
        self.run.composites.at_mut(node.index()).pauses = 0;
    }

    /// Adds a pause in force to the time that the watch has paused in all.
    pub(super) fn stop_pausing(&mut self, number: u32) {
        let now = self.run.now;
        let state = self.run.watches.at_mut(number as usize);
        if let Some(began) = state.paused_at.take() {
            state.spent = state.spent.after(now.since(began));
            self.run.timers.clear(number);
        }
    }
}

impl Turn<'_> {
    /// Enters a monitor. Its watches are judged before the body's first step is entered.
    pub(super) fn enter_monitor(&mut self, node: NodeId, watches: &[Watch], body: RegionId) {
        let now = self.run.now;
        let state = self.run.composites.at_mut(node.index());
        state.pauses = 0;
        state.resuming = None;
        state.body_ended = None;
        for (index, watch) in watches.iter().enumerate() {
            let number = self.plan.watch_number(node, index as u32);
            let state = self.run.watches.at_mut(number as usize);
            state.since = now;
            state.true_since = None;
            state.open_since = None;
            state.paused_at = None;
            state.spent = Time::ZERO;
            state.fired = 0;
            self.subscribe(number, &watch.condition, now);
        }
        self.enter_region(body);
        self.mark_all(node, watches.len() as u32);
    }

    /// Forgets all watches of a monitor that is over.
    pub(super) fn leave_monitor(&mut self, node: NodeId, watches: u32) {
        for index in 0..watches {
            let number = self.plan.watch_number(node, index);
            self.run.timers.clear(number);
            self.unsubscribe(number);
            self.run.watches.at_mut(number as usize).paused_at = None;
        }
        self.run.clearing.retain(|clearing| *clearing != node);
        self.run.composites.at_mut(node.index()).resuming = None;
    }

    /// Judges all watches of a monitor before the next step.
    pub(super) fn mark_all(&mut self, node: NodeId, watches: u32) {
        (0..watches).for_each(|index| self.mark(self.plan.watch_number(node, index)));
    }

    /// By how many suspensions of its own a monitor holds a region that is about to be entered.
    pub(super) fn imposed(&self, owner: NodeId, region: RegionId) -> u32 {
        let NodeKind::Monitor { body, .. } = &self.plan.node(owner).kind else { return 0 };
        let state = self.run.composites.at(owner.index());
        state.pauses + u32::from(state.resuming.is_some() && *body == region)
    }

    /// The region of a monitor that a pause holds: the block of a reaction, or else the body.
    pub(super) fn running_part(&self, node: NodeId) -> Option<RegionId> {
        let NodeKind::Monitor { watches, body } = &self.plan.node(node).kind else { return None };
        let Some(number) = self.run.composites.at(node.index()).resuming else { return Some(*body) };
        let (_, index, _) = self.plan.watch(number)?;
        match watches.get(index as usize).map(|watch| &watch.reaction) {
            Some(Reaction::Resume { body, .. }) => Some(*body),
            Some(Reaction::Pause { .. } | Reaction::Restart { .. } | Reaction::End { .. }) | None => {
                Some(*body)
            }
        }
    }

    /// The body is down after a restart was asked for: it starts again.
    pub(super) fn restart(&mut self, node: NodeId) {
        let NodeKind::Monitor { watches, body } = &self.plan.node(node).kind else { return };
        let state = self.run.composites.at_mut(node.index());
        state.after = AfterStop::Nothing;
        state.body_ended = None;
        for index in 0..watches.len() as u32 {
            let number = self.plan.watch_number(node, index);
            self.rearm(number);
        }
        self.enter_region(*body);
        self.mark_all(node, watches.len() as u32);
    }

    /// A watch counts its condition's time from now on.
    pub(super) fn rearm(&mut self, number: u32) {
        let state = self.run.watches.at_mut(number as usize);
        state.true_since = None;
        state.open_since = None;
        self.run.timers.clear(number);
    }

    /// Ends everything in a monitor, and then the monitor in a failure.
    pub(super) fn monitor_fails(&mut self, node: NodeId, failure: motet_graph::FailureId, cause: EndCause) {
        self.give_reason(node, None);
        let exit = NodeExit { ending: NodeEnding::Failure(failure), cause, origin: node };
        self.stop_within(node, AfterStop::Exit(exit));
    }

    /// Stops everything in a monitor; what is to happen then follows once all is down.
    pub(super) fn stop_within(&mut self, node: NodeId, after: AfterStop) {
        let NodeKind::Monitor { watches, .. } = &self.plan.node(node).kind else { return };
        self.let_go_of_pauses(node, watches.len() as u32);
        let state = self.run.composites.at_mut(node.index());
        state.after = after;
        state.resuming = None;
        self.run.clearing.retain(|clearing| *clearing != node);
        for region in self.plan.owned(node) {
            self.stop(*region, EndCause::Monitor);
        }
        // Everything may be down already: the body ended while a block was about to run.
        if self.is_down(node) && self.run.nodes.at(node.index()).phase == Phase::Inside {
            match after {
                AfterStop::Exit(exit) => self.exit(node, exit),
                AfterStop::Restart => self.restart(node),
                AfterStop::Nothing => {}
            }
        }
    }

    /// The body ended by itself.
    pub(super) fn body_ended(&mut self, node: NodeId, exit: NodeExit) {
        let state = self.run.composites.at_mut(node.index());
        if state.resuming.is_some() {
            state.body_ended = Some(exit);
            self.check_clearing();
        } else {
            self.exit(node, exit);
        }
    }

    /// Interrupts the body to run a block.
    pub(super) fn begin_block(&mut self, node: NodeId, number: u32) {
        let NodeKind::Monitor { body, .. } = &self.plan.node(node).kind else { return };
        self.suspend(*body, GoalIntent::Suspend);
        self.run.composites.at_mut(node.index()).resuming = Some(number);
        self.run.clearing.push(node);
        self.check_clearing();
    }

    /// Runs the blocks of monitors whose bodies are down by now.
    #[inline]
    pub(super) fn check_clearing(&mut self) {
        if !self.run.clearing.is_empty() {
            self.run_cleared();
        }
    }

    fn run_cleared(&mut self) {
        for node in self.run.clearing.clone() {
            let NodeKind::Monitor { body, .. } = &self.plan.node(node).kind else { continue };
            // One that is being stopped runs no block any more.
            let stopped = self.stopping(self.region_of(node)).is_some();
            if !stopped && !self.has_goals(*body) {
                self.run.clearing.retain(|clearing| *clearing != node);
                if let Some(block) = self.running_part(node) {
                    self.enter_region(block);
                }
            }
        }
    }

    /// A block is over: the body goes on.
    pub(super) fn block_ended(&mut self, node: NodeId, exit: NodeExit) {
        let NodeKind::Monitor { watches, body } = &self.plan.node(node).kind else { return };
        let state = self.run.composites.at_mut(node.index());
        let number = state.resuming.take();
        if let Some(body_exit) = state.body_ended.take() {
            // A handler of the body's failure would go on with what the block has left undone.
            self.exit(node, if exit.ending == NodeEnding::Success { body_exit } else { exit });
            return;
        }
        if exit.ending != NodeEnding::Success {
            self.stop_within(node, AfterStop::Exit(exit));
            return;
        }
        let pauses = state.pauses;
        // Pauses that held the block hold the body now.
        (0..pauses).for_each(|_| self.suspend(*body, GoalIntent::Hold));
        self.go_on(*body);
        if let Some((_, watch, _)) = number.and_then(|number| self.plan.watch(number)) {
            self.report(move || TraceEventKind::WentOn { node, watch });
        }
        if let Some(number) = number {
            self.rearm(number);
        }
        self.mark_all(node, watches.len() as u32);
    }
}
