//! What is due, one after the other: the earliest first, of what is due at the same instant watches before
//! steps, and what comes earlier in the document first.

use super::state::{After, At, Flow, Naive, Nanos, Phase, Wish};
use motet_graph::{NodeId, NodeKind};
use motet_runtime::{Fault, RunEnd, Time};

pub(super) const CANCEL_WITHIN: Nanos = 5_000_000_000;
pub(super) const SAFE_STOP_WITHIN: Nanos = 5_000_000_000;

pub(super) fn nanos(secs: f64) -> Nanos {
    Time::from_secs(secs).nanos()
}

/// What can be due.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Due {
    /// An orphan by its place.
    Orphan(usize),
    Watch(NodeId, usize),
    Node(NodeId),
}

impl Naive {
    /// A step takes too long after a time from now.
    pub(super) fn set(&mut self, node: NodeId, span: Nanos) {
        self.live(node).timer = Some(self.now + span);
    }

    /// The time of a step stands still.
    pub(super) fn keep_time(&mut self, node: NodeId) {
        let now = self.now;
        let live = self.live(node);
        live.left = live.timer.take().map_or(live.left, |at| at - now);
    }

    fn dues(&self) -> Vec<(Nanos, Due)> {
        let orphans = self.orphans.iter().enumerate().map(|(place, orphan)| (orphan.due, Due::Orphan(place)));
        let mut dues: Vec<_> = orphans.filter(|(at, _)| *at != Nanos::MAX).collect();
        for (node, live) in &self.nodes {
            dues.extend(live.timer.map(|at| (at, Due::Node(*node))));
            let NodeKind::Monitor { watches, .. } = self.kind(*node) else { continue };
            for (index, (watch, of)) in live.watches.iter().zip(&watches).enumerate() {
                let fires = watch.holds_since.map(|since| since + nanos(of.hold_secs));
                let fires = fires.filter(|at| watch.paused_at.is_none() && *at > self.now);
                dues.extend(fires.or(watch.until).map(|at| (at, Due::Watch(*node, index))));
            }
        }
        dues
    }

    /// When something is due next.
    pub(super) fn wake_at(&self) -> Option<Nanos> {
        if self.over { None } else { self.dues().into_iter().min().map(|(at, _)| at) }
    }

    /// Does what is due by now.
    pub(super) fn catch_up(&mut self) {
        while !self.over
            && let Some((_, due)) = self.dues().into_iter().filter(|(at, _)| *at <= self.now).min()
        {
            match due {
                Due::Orphan(place) => self.orphan_due(place),
                Due::Node(node) => self.node_due(node),
                Due::Watch(node, index) => {
                    self.live(node).watches[index].until = None;
                    if !self.is_stopping(self.region_of(node)) {
                        self.stop_within(node, After::Exit(Flow::Fail("timeout".into(), node)));
                    }
                }
            }
            self.settle();
        }
    }

    fn node_due(&mut self, node: NodeId) {
        self.live(node).timer = None;
        match self.nodes[&node].at.clone() {
            At::Waiting if matches!(self.kind(node), NodeKind::Delay { .. }) => {
                self.live(node).at = At::Ended(Flow::Ok);
            }
            At::Waiting => self.live(node).at = At::Ended(Flow::Fail("timeout".into(), node)),
            At::Goal(_, Phase::SafeStopping, _) => self.fault(node, self.revision),
            At::Goal(number, Phase::Cancelling, wish) => self.stop_safely(number, node, wish),
            At::Goal(number, Phase::Starting, wish) if wish > Wish::Hold => {
                self.stop_safely(number, node, wish);
            }
            At::Goal(..) => self.cancel(node, Wish::Expire),
            at => panic!("nothing is due of {at:?}"),
        }
    }

    pub(super) fn stop_safely(&mut self, number: usize, node: NodeId, wish: Wish) {
        self.live(node).at = At::Goal(number, Phase::SafeStopping, wish);
        self.set(node, SAFE_STOP_WITHIN);
        self.out.push(format!("safe_stop {number}"));
    }

    /// A safe stop was not acknowledged.
    pub(super) fn fault(&mut self, node: NodeId, revision: u32) {
        for (number, node) in &self.goals {
            if !matches!(self.nodes[node].at, At::Goal(_, Phase::SafeStopping, _)) {
                self.out.push(format!("safe_stop {number}"));
            }
        }
        for orphan in self.orphans.iter().filter(|orphan| orphan.phase != Phase::SafeStopping) {
            self.out.push(format!("safe_stop {}", orphan.number));
        }
        self.finish(&RunEnd::Fault(Fault::NotStopped { node, revision }));
    }
}
