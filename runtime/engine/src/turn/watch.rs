//! Watches: when they fire, and what they then do.

use super::Turn;
use crate::belief::Freshness;
use crate::state::{AfterStop, GoalIntent, Phase};
use crate::time::Time;
use crate::trace::{EndCause, TraceEventKind};
use crate::truth::Truth;
use motet_graph::{NodeId, Reaction, TIMEOUT, Watch};

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
