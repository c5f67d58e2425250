//! Stopping and suspending, and the goals.

use super::state::{At, Flow, Naive, Phase, Wish};
use motet_graph::arbitrary::vocabulary as v;
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
            At::Waiting | At::Queued | At::Suspended => self.live(node).at = At::Ended(Flow::Interrupted),
            At::Goal(..) => self.cancel(node, Wish::Stop),
            At::Inside => self.owned(node).into_iter().for_each(|region| self.stop(region)),
        }
    }

    pub(super) fn cancel(&mut self, node: NodeId, wish: Wish) {
        let At::Goal(number, phase, before) = self.nodes[&node].at else { return };
        let stronger = if wish > before { wish } else { before };
        self.live(node).at = match phase {
            Phase::Starting | Phase::Cancelling => At::Goal(number, phase, stronger),
            Phase::Running | Phase::Held => {
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
                    _ if wish == Wish::Suspend || !can_hold => self.cancel(node, Wish::Suspend),
                    Phase::Starting if before == Wish::None => {
                        self.live(node).at = At::Goal(number, phase, Wish::Hold);
                    }
                    Phase::Running => {
                        self.out.push(format!("hold {number}"));
                        self.live(node).at = At::Goal(number, Phase::Held, before);
                    }
                    Phase::Starting | Phase::Held | Phase::Cancelling => {}
                }
            }
            At::Enter | At::Parked | At::Acquire | At::Suspended | At::Waiting | At::Ended(_) => {}
        }
    }

    pub(super) fn go_on(&mut self, region: RegionId) {
        let Some(state) = self.regions.get_mut(&region) else { return };
        state.suspended = state.suspended.saturating_sub(1);
        let (on, Some(node)) = (state.suspended == 0, state.current) else { return };
        match self.nodes[&node].at.clone() {
            At::Inside => self.owned(node).into_iter().for_each(|region| self.go_on(region)),
            At::Parked if on => self.live(node).at = At::Enter,
            At::Suspended if on => self.live(node).at = At::Acquire,
            At::Goal(number, Phase::Starting, Wish::Hold) if on => {
                self.live(node).at = At::Goal(number, Phase::Starting, Wish::None);
            }
            At::Goal(number, Phase::Held, wish) if on => {
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
            Wish::Suspend | Wish::Stop => {
                self.out.push(format!("cancel {number}"));
                Phase::Cancelling
            }
        };
        self.live(node).at = At::Goal(number, phase, wish);
    }

    pub(super) fn ended(&mut self, number: usize, outcome: &Outcome) {
        let node = self.goals.remove(&number).unwrap();
        let At::Goal(_, _, wish) = self.nodes[&node].at else { panic!("no goal") };
        let stopping = self.is_stopping(self.region_of(node));
        let NodeKind::Call(call) = self.kind(node) else { panic!("no call") };
        self.live(node).at = match outcome {
            Outcome::Success(_) => At::Ended(Flow::Ok),
            Outcome::Failure(_) if self.nodes[&node].count <= call.retries && !stopping => {
                self.live(node).count += 1;
                At::Acquire
            }
            Outcome::Failure(kind) => At::Ended(Flow::Fail(kind.to_string(), node)),
            Outcome::Interrupted if !stopping && wish == Wish::Suspend => At::Acquire,
            Outcome::Interrupted => At::Ended(Flow::Interrupted),
        };
        self.check_clearing();
    }
}
