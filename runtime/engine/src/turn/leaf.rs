//! Resources of waiting steps: subscriptions, queue entries, reservations.

use super::Turn;
use crate::belief::Freshness;
use crate::effect::Effect;
use crate::prepared_graph::PreparedNode;
use crate::state::Phase;
use crate::time::Time;
use crate::work_list::Transition;
use motet_graph::{Condition, NodeId};

impl Turn<'_> {
    /// Keeps everything that a condition depends on watched, on behalf of a key.
    pub(super) fn subscribe(&mut self, key: u32, condition: &Condition, since: Time) {
        let mut cells = std::mem::take(self.run.subscriptions.at_mut(key as usize));
        cells.clear();
        self.judge(Freshness::Readings(since)).queries(condition, &mut cells);
        cells.sort_unstable();
        cells.dedup();
        for id in &cells {
            let Some(cell) = self.run.beliefs.cell_mut(*id) else { continue };
            cell.dependents.push(key);
            if cell.observable {
                cell.watchers += 1;
                if cell.watchers == 1 && !std::mem::take(&mut cell.idle) {
                    self.out.push(Effect::Watch { query: cell.query.clone() });
                }
            }
        }
        *self.run.subscriptions.at_mut(key as usize) = cells;
    }

    /// Ends what [`Turn::subscribe`] began.
    pub(super) fn unsubscribe(&mut self, key: u32) {
        for id in self.run.subscriptions.at_mut(key as usize).drain(..) {
            let Some(cell) = self.run.beliefs.cell_mut(id) else { continue };
            cell.dependents.retain(|dependent| *dependent != key);
            if cell.observable {
                cell.watchers = cell.watchers.saturating_sub(1);
                if cell.watchers == 0 && self.run.swapping {
                    cell.idle = true;
                    self.run.idle.push(id);
                } else if cell.watchers == 0 {
                    cell.live = false;
                    self.out.push(Effect::Unwatch { query: cell.query.clone() });
                }
            }
        }
    }

    /// Lets go of what a step without a goal keeps.
    pub(super) fn let_go(&mut self, node: NodeId) {
        match self.run.nodes.at(node.index()).phase {
            Phase::Deciding => self.forget_asked(node),
            Phase::Waiting => self.leave_wait(node),
            Phase::Queued => self.run.queue.retain(|queued| *queued != node),
            Phase::Checking => {
                self.stop_checking(node);
                self.release(self.plan.step(node));
            }
            Phase::Idle | Phase::Entering | Phase::Parked | Phase::Ending | Phase::Inside => {}
            Phase::Suspended | Phase::Starting | Phase::Running | Phase::Held => {}
            Phase::Cancelling | Phase::SafeStopping => {}
        }
    }

    /// Takes a call's resources. False where somebody else holds what conflicts.
    #[inline]
    pub(super) fn reserve(&mut self, step: &PreparedNode) -> bool {
        let orphans = self.run.orphans.iter().fold(0, |bits, orphan| bits | orphan.uses);
        if (self.run.held | orphans) & step.mask.conflicts != 0 {
            return false;
        }
        self.run.held |= step.mask.uses;
        true
    }

    /// Gives a call's resources back.
    #[inline]
    pub(super) fn release(&mut self, step: &PreparedNode) {
        self.run.held &= !step.mask.uses;
        self.run.freed = !self.run.queue.is_empty();
    }

    /// Resources became free: those who wait try again, in document order.
    pub(super) fn grant(&mut self) {
        self.run.freed = false;
        let queue = std::mem::take(&mut self.run.queue);
        for node in queue {
            self.run.nodes.at_mut(node.index()).phase = Phase::Entering;
            self.push(Transition::Acquire(node));
        }
    }

    /// Waits for resources.
    pub(super) fn enqueue(&mut self, node: NodeId) {
        self.run.nodes.at_mut(node.index()).phase = Phase::Queued;
        let place = self.run.queue.partition_point(|queued| *queued < node);
        self.run.queue.insert(place, node);
    }
}
