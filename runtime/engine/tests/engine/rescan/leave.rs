//! What follows when a region is over.

use super::state::{After, At, Flow, Naive, Wish};
use motet_graph::{Ending, NodeId, NodeKind, ROOT, RegionId};
use motet_runtime::RunEnd;

impl Naive {
    pub(super) fn region_ended(&mut self, owner: NodeId, region: RegionId, flow: Flow) {
        if let NodeKind::Finally { body, cleanup } = self.kind(owner) {
            let stopping = self.is_stopping(self.region_of(owner));
            let flow = if stopping { Flow::Interrupted } else { flow };
            let by_driver = match &flow {
                Flow::Ok => false,
                Flow::Fail(_, origin) => self.lost.contains(origin),
                Flow::Interrupted => !stopping,
            };
            if body == region && !self.halted && !by_driver {
                self.live(owner).body_ended = Some(flow);
                self.enter_region(cleanup);
                return;
            }
            let before = self.live(owner).body_ended.take().filter(|_| flow != Flow::Interrupted);
            self.live(owner).at = At::Ended(before.unwrap_or(flow));
            return;
        }
        if self.is_stopping(self.region_of(owner)) {
            if self.is_down(owner) {
                self.live(owner).at = At::Ended(Flow::Interrupted);
            }
            return;
        }
        let after = self.nodes[&owner].after.clone();
        if after != After::Nothing {
            if self.is_down(owner) {
                self.all_down(owner, after);
            }
            return;
        }
        let exit = match self.kind(owner) {
            NodeKind::Sequence { .. } | NodeKind::Inline { .. } | NodeKind::If { .. } => Some(flow),
            NodeKind::Try { body, handlers } if body == region => match &flow {
                Flow::Fail(kind, _) => {
                    let named =
                        |id: &motet_graph::FailureId| self.graph.failures[id.index()] == kind.as_str();
                    let fits = |on: &Option<Vec<_>>| on.as_ref().is_none_or(|on| on.iter().any(named));
                    match handlers.iter().find(|handler| fits(&handler.on)).map(|handler| handler.body) {
                        Some(handler) => {
                            self.enter_region(handler);
                            None
                        }
                        None => Some(flow),
                    }
                }
                Flow::Ok | Flow::Interrupted => Some(flow),
            },
            NodeKind::Try { .. } => Some(flow),
            NodeKind::Repeat { times, body, until } if flow == Flow::Ok => {
                if until.as_ref().is_some_and(|until| self.holds(until)) {
                    Some(Flow::Ok)
                } else if self.nodes[&owner].count < times {
                    self.live(owner).count += 1;
                    self.enter_region(body);
                    None
                } else if until.is_some() {
                    Some(Flow::Fail("exhausted".into(), owner))
                } else {
                    Some(Flow::Ok)
                }
            }
            NodeKind::Repeat { .. } => Some(flow),
            NodeKind::Parallel { branches } => {
                if flow != Flow::Ok {
                    self.live(owner).after = After::Exit(flow.clone());
                    branches.iter().for_each(|branch| self.stop(*branch));
                }
                self.is_down(owner).then_some(flow)
            }
            NodeKind::Monitor { body, .. } if body == region => {
                if self.nodes[&owner].resuming.is_some() {
                    self.live(owner).body_ended = Some(flow);
                    self.check_clearing();
                    None
                } else {
                    Some(flow)
                }
            }
            NodeKind::Monitor { body, .. } => self.block_ended(owner, body, flow),
            kind => panic!("owns no region: {kind:?}"),
        };
        if let Some(flow) = exit {
            self.live(owner).at = At::Ended(flow);
        }
    }

    pub(super) fn block_ended(&mut self, node: NodeId, body: RegionId, flow: Flow) -> Option<Flow> {
        let resumed = self.live(node).resuming.take();
        if let Some(of_body) = self.live(node).body_ended.take() {
            return Some(if flow == Flow::Ok { of_body } else { flow });
        }
        if flow != Flow::Ok {
            self.stop_within(node, After::Exit(flow));
            return None;
        }
        for _ in 0..self.nodes[&node].watches.iter().filter(|watch| watch.paused_at.is_some()).count() {
            self.suspend(body, Wish::Hold);
        }
        self.go_on(body);
        if let Some(index) = resumed {
            self.live(node).watches[index].holds_since = None;
        }
        None
    }

    pub(super) fn end_policy(&mut self, node: NodeId, how: Ending, of: Option<NodeId>) {
        if let (Some(of), Ending::Done | Ending::Fail) = (of, how) {
            let NodeKind::Inline { body, .. } = self.kind(of) else { panic!("no policy") };
            if self.nodes[&of].after == After::Nothing {
                let flow = if how == Ending::Fail { Flow::Fail("failed".into(), node) } else { Flow::Ok };
                self.live(of).after = After::Exit(flow);
                self.stop(body);
            }
        } else if self.ending.is_none() {
            self.ending = Some(match how {
                Ending::Done => RunEnd::Done { why: None, result: None },
                Ending::Fail => RunEnd::Failed { kind: "failed".into(), why: None, node },
                Ending::Cannot => RunEnd::Declined { why: None },
                Ending::Replan => RunEnd::Replan { why: None },
            });
            self.stop(ROOT);
        }
    }

    pub(super) fn root_ended(&mut self, flow: Flow) {
        let end = self.ending.take().unwrap_or(match flow {
            Flow::Ok => RunEnd::Done { why: None, result: None },
            Flow::Fail(kind, node) => RunEnd::Failed { kind: kind.into(), why: None, node },
            Flow::Interrupted => RunEnd::Interrupted,
        });
        if self.orphans.is_empty() {
            self.finish(&end);
        } else {
            self.closing = Some(end);
        }
    }

    pub(super) fn finish(&mut self, end: &RunEnd) {
        self.out.push(format!("finished {end:?}"));
        self.over = true;
    }
}
