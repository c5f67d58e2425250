//! Stopping and suspending, and the goals.

use super::clock::CANCEL_WITHIN;
use super::state::{At, Flow, Naive, Phase, Wish};
use motet_arbitrary::graph::vocabulary as v;
use motet_graph::{NodeId, NodeKind, RegionId};
use motet_runtime::Outcome;

impl Naive {
    pub(super) fn stop(&mut self, region: RegionId) {
        let Some(state) = self.regions.get_mut(&region) else { return };
        state.stopping = true;
        let Some(node) = state.current else { return };
        match self.nodes[&node].at.clone() {
            At::Enter | At::Acquire | At::Ended(_) => {}
            At::Parked => self.leave_region(node, Flow::Interrupted),
            At::Waiting | At::Queued | At::Suspended => {
                let live = self.live(node);
                (live.at, live.timer) = (At::Ended(Flow::Interrupted), None);
            }
            At::Goal(..) => self.cancel(node, Wish::Stop),
            At::Inside => match self.kind(node) {
                NodeKind::Finally { body, cleanup } if !self.halted => {
                    self.stop(body);
                    if let Some(held) = self.regions.get(&cleanup).map(|region| region.suspended) {
                        (self.suspensions(cleanup)..held).for_each(|_| self.go_on(cleanup));
                    }
                }
                _ => {
                    for index in 0..self.nodes[&node].watches.len() {
                        self.stop_pausing(node, index);
                    }
                    self.owned(node).into_iter().for_each(|region| self.stop(region));
                }
            },
        }
    }

    pub(super) fn cancel(&mut self, node: NodeId, wish: Wish) {
        let At::Goal(number, phase, before) = self.nodes[&node].at else { return };
        let stronger = if wish > before { wish } else { before };
        self.live(node).at = match phase {
            Phase::Starting if matches!(before, Wish::None | Wish::Hold) => {
                self.set(node, CANCEL_WITHIN);
                At::Goal(number, phase, stronger)
            }
            Phase::Starting | Phase::Cancelling | Phase::SafeStopping => At::Goal(number, phase, stronger),
            Phase::Running | Phase::Held => {
                self.set(node, CANCEL_WITHIN);
                self.out.push(format!("cancel {number}"));
                At::Goal(number, Phase::Cancelling, wish)
            }
        };
    }

    pub(super) fn suspend(&mut self, region: RegionId, wish: Wish) {
        let Some(state) = self.regions.get_mut(&region) else { return };
        state.suspended += 1;
        let Some(node) = state.current else { return };
        match self.nodes[&node].at.clone() {
            At::Queued => self.live(node).at = At::Suspended,
            At::Inside => self.owned(node).into_iter().for_each(|region| self.suspend(region, wish)),
            At::Goal(number, phase, before) => {
                let NodeKind::Call(call) = self.kind(node) else { panic!("no call") };
                let can_hold = call.primitive != v::PLACE;
                match phase {
                    Phase::Cancelling | Phase::SafeStopping => {}
                    _ if wish == Wish::Suspend || !can_hold => self.cancel(node, Wish::Suspend),
                    Phase::Starting if before == Wish::None => {
                        self.keep_time(node);
                        self.live(node).at = At::Goal(number, phase, Wish::Hold);
                    }
                    Phase::Running => {
                        self.keep_time(node);
                        self.out.push(format!("hold {number}"));
                        self.live(node).at = At::Goal(number, Phase::Held, before);
                    }
                    Phase::Starting | Phase::Held => {}
                }
            }
            At::Waiting if self.nodes[&node].timer.is_some() => self.keep_time(node),
            At::Enter | At::Parked | At::Acquire | At::Suspended | At::Waiting | At::Ended(_) => {}
        }
    }

    pub(super) fn go_on(&mut self, region: RegionId) {
        let Some(state) = self.regions.get_mut(&region) else { return };
        let held = state.suspended > 0;
        state.suspended = state.suspended.saturating_sub(1);
        let (on, Some(node)) = (held && state.suspended == 0, state.current) else { return };
        match self.nodes[&node].at.clone() {
            At::Inside => self.owned(node).into_iter().for_each(|region| self.go_on(region)),
            At::Parked if on => self.live(node).at = At::Enter,
            At::Suspended if on => self.live(node).at = At::Acquire,
            At::Goal(number, Phase::Starting, Wish::Hold) if on => {
                self.set(node, self.nodes[&node].left);
                self.live(node).at = At::Goal(number, Phase::Starting, Wish::None);
            }
            At::Waiting if on => self.set(node, self.nodes[&node].left),
            At::Goal(number, Phase::Held, wish) if on => {
                self.set(node, self.nodes[&node].left);
                self.out.push(format!("proceed {number}"));
                self.live(node).at = At::Goal(number, Phase::Running, wish);
            }
            _ => {}
        }
    }

    pub(super) fn acknowledged(&mut self, number: usize) {
        let node = self.goals[&number];
        let At::Goal(_, Phase::Starting, wish) = self.nodes[&node].at else { return };
        let phase = match wish {
            Wish::None => Phase::Running,
            Wish::Hold => {
                self.out.push(format!("hold {number}"));
                Phase::Held
            }
            Wish::Lose | Wish::Suspend | Wish::Expire | Wish::Stop => {
                self.out.push(format!("cancel {number}"));
                Phase::Cancelling
            }
        };
        self.live(node).at = At::Goal(number, phase, wish);
    }

    pub(super) fn ended(&mut self, number: usize, outcome: &Outcome) {
        let node = self.goals.remove(&number).unwrap();
        let At::Goal(_, _, wish) = self.nodes[&node].at else { panic!("no goal") };
        self.live(node).timer = None;
        let stopping = self.is_stopping(self.region_of(node));
        let NodeKind::Call(call) = self.kind(node) else { panic!("no call") };
        let failure = match (outcome, wish) {
            (Outcome::Failure(kind), _) => Some(kind.to_string()),
            (Outcome::Interrupted, Wish::Expire | Wish::Lose) => Some("timeout".to_owned()),
            (Outcome::Success(_) | Outcome::Interrupted, _) => None,
        };
        self.lost.remove(&node);
        if *outcome == Outcome::Interrupted && wish == Wish::Lose {
            self.lost.insert(node);
        }
        self.live(node).at = match outcome {
            Outcome::Success(_) => At::Ended(Flow::Ok),
            Outcome::Failure(_) | Outcome::Interrupted
                if failure.is_some() && self.nodes[&node].count <= call.retries && !stopping =>
            {
                self.live(node).count += 1;
                At::Acquire
            }
            Outcome::Failure(_) | Outcome::Interrupted if failure.is_some() => {
                At::Ended(Flow::Fail(failure.unwrap_or_default(), node))
            }
            Outcome::Failure(_) => panic!("a failure without a kind"),
            Outcome::Interrupted if !stopping && wish == Wish::Suspend => At::Acquire,
            Outcome::Interrupted => At::Ended(Flow::Interrupted),
        };
        self.check_clearing();
    }
}
