//! A policy takes over from another: goals of its own go on, or are cancelled.

use super::clock::{CANCEL_WITHIN, SAFE_STOP_WITHIN};
use super::state::{At, Naive, Nanos, Orphan, Phase, Wish};
use motet_arbitrary::graph::vocabulary as v;
use motet_graph::{Graph, NodeId, ROOT};
use motet_runtime::RunEnd;

impl Orphan {
    /// Whether it may go on for a step of the new policy.
    fn may_go_on(&self) -> bool {
        self.wish <= Wish::Hold && matches!(self.phase, Phase::Starting | Phase::Running | Phase::Held)
    }
}

impl Naive {
    /// Replaces the policy. False where the run is over or a person stops it.
    pub(super) fn swap(&mut self, graph: Graph) -> bool {
        let stopped = |end: &Option<RunEnd>| *end == Some(RunEnd::Interrupted);
        if self.over || stopped(&self.ending) || stopped(&self.closing) {
            return false;
        }
        for (number, node) in std::mem::take(&mut self.goals) {
            let live = &self.nodes[&node];
            let At::Goal(_, phase, wish) = live.at else { panic!("no goal") };
            let due = live.timer.unwrap_or(Nanos::MAX);
            let (call, revision) = (self.call(node), self.revision);
            self.orphans.push(Orphan { number, call, phase, wish, due, revision, node });
        }
        self.orphans.sort_by_key(|orphan| orphan.number);
        (self.ending, self.closing) = (None, None);
        (self.graph, self.revision) = (graph, self.revision + 1);
        self.regions.clear();
        self.nodes.clear();
        self.lost.clear();
        self.enter_region(ROOT);
        self.settle();
        if !self.over {
            let due = self.now + CANCEL_WITHIN;
            for orphan in self.orphans.iter_mut().filter(|orphan| orphan.may_go_on()) {
                (orphan.wish, orphan.due) = (Wish::Stop, due);
                if orphan.phase != Phase::Starting {
                    orphan.phase = Phase::Cancelling;
                    self.out.push(format!("cancel {}", orphan.number));
                }
            }
        }
        true
    }

    /// A goal of the policy before goes on for a step, if one fits.
    pub(super) fn claim(&mut self, node: NodeId) -> bool {
        let call = self.call(node);
        let same = |orphan: &Orphan| orphan.may_go_on() && orphan.call == call;
        let alike = |orphan: &Orphan| {
            orphan.may_go_on()
                && orphan.phase != Phase::Starting
                && call.primitive == v::GO
                && orphan.call.primitive == v::GO
                && self.is_free(node, Some(orphan.number))
        };
        let kept = self.orphans.iter().position(same);
        let Some(place) = kept.or_else(|| self.orphans.iter().position(alike)) else { return false };
        let Orphan { number, phase, .. } = self.orphans.remove(place);
        self.take(number, node, if phase == Phase::Starting { phase } else { Phase::Running });
        self.out.push(format!("{} {number} {node:?}", if kept.is_some() { "keep" } else { "update" }));
        if phase == Phase::Held {
            self.out.push(format!("proceed {number}"));
        }
        true
    }

    /// A goal without a step is acknowledged.
    pub(super) fn orphan_acknowledged(&mut self, place: usize) {
        let orphan = &mut self.orphans[place];
        if orphan.phase == Phase::Starting {
            orphan.phase = Phase::Cancelling;
            self.out.push(format!("cancel {}", orphan.number));
        }
    }

    pub(super) fn orphan_ended(&mut self, place: usize) {
        self.orphans.remove(place);
        if self.orphans.is_empty()
            && let Some(end) = self.closing.take()
        {
            self.finish(&end);
        }
    }

    fn orphan_lost(&mut self, place: usize) {
        let orphan = &mut self.orphans[place];
        if orphan.wish < Wish::Lose {
            orphan.wish = Wish::Lose;
        }
        if orphan.phase != Phase::SafeStopping {
            self.stop_orphan_safely(place);
        }
    }

    pub(super) fn orphan_due(&mut self, place: usize) {
        let Orphan { phase, node, revision, .. } = self.orphans[place];
        if phase == Phase::SafeStopping {
            self.fault(node, revision);
        } else {
            self.stop_orphan_safely(place);
        }
    }

    fn stop_orphan_safely(&mut self, place: usize) {
        let due = self.now + SAFE_STOP_WITHIN;
        let orphan = &mut self.orphans[place];
        (orphan.phase, orphan.due) = (Phase::SafeStopping, due);
        self.out.push(format!("safe_stop {}", orphan.number));
    }

    /// Nobody knows what a goal does.
    pub(super) fn lost(&mut self, number: usize) {
        if let Some(place) = self.orphans.iter().position(|orphan| orphan.number == number) {
            self.orphan_lost(place);
            return;
        }
        let node = self.goals[&number];
        let At::Goal(_, phase, wish) = self.nodes[&node].at else { panic!("no goal") };
        let wish = if wish < Wish::Lose { Wish::Lose } else { wish };
        if phase == Phase::SafeStopping {
            self.live(node).at = At::Goal(number, phase, wish);
        } else {
            self.stop_safely(number, node, wish);
        }
    }
}
