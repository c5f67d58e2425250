//! Entering steps and regions, and leaving steps.

use super::clock::nanos;
use super::state::{After, At, Flow, Live, Naive, Phase, Region, Watched, Wish};
use motet_graph::{Ending, NodeId, NodeKind, ROOT, RegionId};

impl Naive {
    /// The first step in the document with something to do.
    pub(super) fn transition(&mut self) -> bool {
        if let Some(flow) = self.regions.get_mut(&ROOT).and_then(|root| root.ended.take()) {
            self.root_ended(flow);
            return true;
        }
        for node in self.nodes.keys().copied().collect::<Vec<_>>() {
            for region in self.owned(node) {
                if let Some(flow) = self.regions.get_mut(&region).and_then(|region| region.ended.take()) {
                    self.regions.remove(&region);
                    self.region_ended(node, region, flow);
                    return true;
                }
            }
            match self.nodes[&node].at.clone() {
                At::Ended(flow) => self.node_ended(node, flow),
                At::Enter => self.enter(node),
                At::Acquire => self.acquire(node),
                At::Waiting if !self.is_suspended(self.region_of(node)) => {
                    let NodeKind::Wait { condition, .. } = self.kind(node) else { continue };
                    if !self.holds(&condition) {
                        continue;
                    }
                    let live = self.live(node);
                    (live.at, live.timer) = (At::Ended(Flow::Ok), None);
                }
                At::Waiting | At::Parked | At::Queued | At::Suspended | At::Goal(..) | At::Inside => continue,
            }
            return true;
        }
        false
    }

    /// The first step that waits for resources which are free.
    pub(super) fn grant(&mut self) -> bool {
        let queued = self.nodes.iter().filter(|(_, live)| live.at == At::Queued).map(|(node, _)| *node);
        let first = queued.collect::<Vec<_>>().into_iter().find(|node| self.is_free(*node, None));
        first.inspect(|node| self.acquire(*node)).is_some()
    }

    pub(super) fn enter_region(&mut self, region: RegionId) {
        let entry = self.graph.regions[region.index()].entry;
        let suspended = self.suspensions(region);
        let ended = entry.is_none().then_some(Flow::Ok);
        self.regions.insert(region, Region { current: entry, stopping: false, suspended, ended });
        if let Some(entry) = entry {
            self.begin(entry);
        }
    }

    /// By how many suspensions a region is held. What is stopped holds the cleanups in it no longer.
    pub(super) fn suspensions(&self, region: RegionId) -> u32 {
        let (mut region_in, mut owner) = (region, self.graph.regions[region.index()].owner);
        while let Some(stopped) = owner.map(|owner| self.region_of(owner)).filter(|of| self.is_stopping(*of))
        {
            (region_in, owner) = (stopped, self.graph.regions[stopped.index()].owner);
        }
        owner.map_or(0, |owner| {
            let around = self.regions.get(&self.region_of(owner)).map_or(0, |region| region.suspended);
            let NodeKind::Monitor { body, .. } = self.kind(owner) else { return around };
            let live = &self.nodes[&owner];
            let pauses = live.watches.iter().filter(|watch| watch.paused_at.is_some()).count() as u32;
            around + pauses + u32::from(live.resuming.is_some() && body == region_in)
        })
    }

    /// A step is to be entered.
    pub(super) fn begin(&mut self, node: NodeId) {
        let watches = match self.kind(node) {
            NodeKind::Monitor { watches, .. } => vec![Watched::default(); watches.len()],
            _ => Vec::new(),
        };
        let live = Live {
            at: At::Enter,
            timer: None,
            left: 0,
            count: 1,
            after: After::Nothing,
            watches,
            resuming: None,
            clearing: false,
            body_ended: None,
        };
        self.nodes.insert(node, live);
    }

    pub(super) fn enter(&mut self, node: NodeId) {
        let region = self.region_of(node);
        if self.is_stopping(region) {
            self.leave_region(node, Flow::Interrupted);
            return;
        }
        if self.is_suspended(region) {
            self.live(node).at = At::Parked;
            return;
        }
        self.live(node).at = At::Inside;
        match self.kind(node) {
            NodeKind::Call(_) => self.acquire(node),
            NodeKind::Wait { within_secs, .. } => {
                self.live(node).at = At::Waiting;
                self.set(node, nanos(within_secs));
            }
            NodeKind::Delay { secs } => {
                self.live(node).at = At::Waiting;
                self.set(node, nanos(secs));
            }
            NodeKind::If { condition, then, otherwise } => {
                match if self.holds(&condition) { Some(then) } else { otherwise } {
                    Some(region) => self.enter_region(region),
                    None => self.live(node).at = At::Ended(Flow::Ok),
                }
            }
            NodeKind::Let { .. } => panic!("left out"),
            NodeKind::End { how, of, .. } => {
                let flow = if how == Ending::Fail { Flow::Fail("failed".into(), node) } else { Flow::Ok };
                self.live(node).at = At::Ended(flow);
                self.end_policy(node, how, of);
            }
            NodeKind::Sequence { body, .. }
            | NodeKind::Inline { body, .. }
            | NodeKind::Finally { body, .. }
            | NodeKind::Try { body, .. }
            | NodeKind::Repeat { body, .. }
            | NodeKind::Monitor { body, .. } => self.enter_region(body),
            NodeKind::Parallel { branches } if branches.is_empty() => {
                self.live(node).at = At::Ended(Flow::Ok);
            }
            NodeKind::Parallel { branches } => branches.iter().for_each(|branch| self.enter_region(*branch)),
            NodeKind::Each { .. } => panic!("no loops over lists"),
        }
    }

    pub(super) fn acquire(&mut self, node: NodeId) {
        let region = self.region_of(node);
        if self.is_stopping(region) {
            self.live(node).at = At::Ended(Flow::Interrupted);
        } else if self.is_suspended(region) {
            self.live(node).at = At::Suspended;
        } else if self.claim(node) {
            // A goal of the policy before goes on.
        } else if !self.is_free(node, None) {
            self.live(node).at = At::Queued;
        } else {
            self.started += 1;
            self.take(self.started, node, Phase::Starting);
            self.out.push(format!("start {} {node:?}", self.started));
        }
    }

    /// A step has a goal from now on, for which its deadline counts.
    pub(super) fn take(&mut self, number: usize, node: NodeId, phase: Phase) {
        let NodeKind::Call(call) = self.kind(node) else { panic!("no call") };
        self.goals.insert(number, node);
        self.live(node).at = At::Goal(number, phase, Wish::None);
        self.set(node, nanos(call.deadline_secs));
    }

    pub(super) fn node_ended(&mut self, node: NodeId, flow: Flow) {
        let region = self.region_of(node);
        if self.is_stopping(region) {
            self.leave_region(node, Flow::Interrupted);
            return;
        }
        match (flow, self.graph.nodes[node.index()].next) {
            (Flow::Ok, Some(next)) => {
                self.nodes.remove(&node);
                self.regions.get_mut(&region).unwrap().current = Some(next);
                self.begin(next);
                self.enter(next);
            }
            (flow, _) => self.leave_region(node, flow),
        }
    }

    pub(super) fn leave_region(&mut self, node: NodeId, flow: Flow) {
        self.nodes.remove(&node);
        let region = self.region_of(node);
        let state = self.regions.get_mut(&region).unwrap();
        (state.current, state.ended) = (None, Some(flow));
    }
}
