//! A swap between two macro steps: the old policy lets go, the new one takes over.

use super::Turn;
use crate::belief::Entities;
use crate::effect::Effect;
use crate::orphan::OrphanGoal;
use crate::prepared_graph::PreparedGraph;
use crate::state::Phase;
use crate::time::Time;
use crate::trace::{EndCause, NodeEnding, TraceEventKind};
use motet_graph::{NodeId, NodeKind, ROOT, Value};
use std::sync::Arc;

impl Turn<'_> {
    /// Ends every step of the policy that is replaced, inner before outer. Goals that run become orphans;
    /// what was watched stays so until the new policy has said what it watches.
    pub(crate) fn retire(&mut self, plan: &Arc<PreparedGraph>) -> Arc<Vec<Option<Value>>> {
        self.run.swapping = true;
        let bindings = Arc::new(std::mem::take(&mut self.run.bindings));
        for node in self.open_nodes().into_iter().rev() {
            let phase = self.run.nodes.at(node.index()).phase;
            match phase {
                // These were not entered, or the work list has them, which is empty between two macro steps.
                Phase::Idle | Phase::Entering | Phase::Parked | Phase::Ending => continue,
                Phase::Inside => {
                    if let NodeKind::Monitor { watches, .. } = &plan.node(node).kind {
                        self.leave_monitor(node, watches.len() as u32);
                    }
                }
                Phase::Deciding | Phase::Waiting | Phase::Queued | Phase::Checking | Phase::Suspended => {
                    self.let_go(node);
                }
                Phase::Starting | Phase::Running | Phase::Held | Phase::Cancelling | Phase::SafeStopping => {
                    self.orphan_goal(node, plan, &bindings);
                }
            }
            self.report(move || TraceEventKind::Ended {
                node,
                ending: NodeEnding::Interrupted,
                cause: EndCause::Swap,
            });
        }
        // Goals by start, so that the earliest is taken first.
        self.run.orphans.sort_by_key(|orphan| orphan.goal);
        bindings
    }

    fn orphan_goal(&mut self, node: NodeId, plan: &Arc<PreparedGraph>, bindings: &Arc<Vec<Option<Value>>>) {
        let state = self.run.nodes.at(node.index());
        let (Some(goal), Some(command)) = (state.goal, self.run.command(plan, node)) else { return };
        self.run.orphans.push(OrphanGoal {
            goal,
            command,
            phase: state.phase,
            wish: state.wish,
            due: self.run.timers.get(plan.node_key(node)).unwrap_or(Time::NEVER),
            uses: 0,
            revision: self.run.revision,
            node,
            plan: plan.clone(),
            bindings: bindings.clone(),
        });
        self.run.goals.disown(goal);
    }

    /// Steps that a region stands at, in document order.
    fn open_nodes(&self) -> Vec<NodeId> {
        let (mut open, mut walk) = (Vec::new(), vec![ROOT]);
        while let Some(region) = walk.pop() {
            let state = self.run.regions.at(region.index());
            let Some(node) = state.current.filter(|_| state.active) else { continue };
            open.push(node);
            if self.run.nodes.at(node.index()).phase == Phase::Inside {
                walk.extend(self.plan.owned(node).iter().rev());
            }
        }
        open
    }

    /// The new policy begins in the state that the old one left: its first steps are entered and its monitors
    /// judged, goals that fit go on, all others are cancelled.
    pub(crate) fn take_over(&mut self, heard: &Entities) {
        let graph = &self.plan.graph;
        for (id, kind) in heard.all() {
            self.run.beliefs.entities.hear(graph, id, kind);
        }
        for orphan in &mut self.run.orphans {
            orphan.uses = orphan.uses_in(graph);
        }
        // What the old policy alone depended on concerns nobody any more.
        self.run.beliefs.changed.clear();
        self.report(move || TraceEventKind::Swapped { policy: graph.policy.as_str().into() });
        if self.run.begun {
            self.enter_region(ROOT);
            self.settle();
            if !self.run.over {
                self.cancel_orphans();
            }
        }
        self.unwatch_idle();
        self.run.swapping = false;
        let now = self.run.now;
        self.catch_up(|at| at <= now);
    }

    /// Ends the watches that only the old policy needed.
    pub(super) fn unwatch_idle(&mut self) {
        for id in std::mem::take(&mut self.run.idle) {
            if let Some(cell) = self.run.beliefs.cell_mut(id)
                && std::mem::take(&mut cell.idle)
            {
                cell.live = false;
                self.out.push(Effect::Unwatch { query: cell.query.clone() });
            }
        }
    }
}
