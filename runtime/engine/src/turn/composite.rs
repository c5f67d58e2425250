//! Steps that own regions, but for monitors: what they do when a region of theirs ends; and the resources of
//! waiting steps: subscriptions, queue entries, reservations.

use super::Turn;
use crate::belief::Freshness;
use crate::effect::{Effect, RunEnd};
use crate::prepared_graph::PreparedNode;
use crate::schedule::{NodeExit, Transition};
use crate::state::{AfterStop, Phase};
use crate::time::Time;
use crate::trace::{EndCause, NodeEnding, TraceEventKind};
use motet_graph::{
    BindingId, CaughtFailure, Condition, Ending, FailureId, Handler, NodeId, NodeKind, ROOT, RegionId,
    TIMEOUT, Term, Value,
};
use motet_stdlib::lang;
use smol_str::SmolStr;

impl Turn<'_> {
    /// A region ended that nobody stopped.
    pub(super) fn child_ended(&mut self, owner: NodeId, region: RegionId, exit: NodeExit) {
        match &self.plan.node(owner).kind {
            NodeKind::Sequence { .. } | NodeKind::Inline { .. } | NodeKind::If { .. } => {
                self.exit_at_once(owner, exit)
            }
            NodeKind::Try { body, handlers } if *body == region => self.handle_failure(owner, handlers, exit),
            NodeKind::Try { .. } => self.exit(owner, exit),
            NodeKind::Repeat { times, body, until } => match exit.ending {
                NodeEnding::Success if until.is_some() => self.decide(owner),
                NodeEnding::Success => self.again(owner, *times, *body),
                NodeEnding::Failure(_) | NodeEnding::Interrupted => self.exit(owner, exit),
            },
            NodeKind::Each { item, body, .. } => match exit.ending {
                NodeEnding::Success => self.next_item(owner, *item, *body),
                NodeEnding::Failure(_) | NodeEnding::Interrupted => self.exit(owner, exit),
            },
            NodeKind::Parallel { branches } => self.branch_ended(owner, branches, exit),
            NodeKind::Monitor { body, .. } if *body == region => self.body_ended(owner, exit),
            NodeKind::Monitor { .. } => self.block_ended(owner, exit),
            // It does not come here.
            NodeKind::Finally { .. } => {}
            // These own no region.
            NodeKind::Call(_)
            | NodeKind::Let { .. }
            | NodeKind::Wait { .. }
            | NodeKind::Delay { .. }
            | NodeKind::End { .. } => {}
        }
    }

    fn handle_failure(&mut self, node: NodeId, handlers: &[Handler], exit: NodeExit) {
        let NodeEnding::Failure(failure) = exit.ending else {
            self.exit(node, exit);
            return;
        };
        let fits = |handler: &&Handler| handler.on.as_ref().is_none_or(|on| on.contains(&failure));
        match handlers.iter().find(fits) {
            Some(handler) => {
                if let Some(caught) = handler.binds {
                    self.bind_failure(caught, failure, exit.origin);
                }
                self.enter_region(handler.body);
            }
            None => self.exit(node, exit),
        }
    }

    /// Binds a failure that a handler caught, which arose in a step.
    fn bind_failure(&mut self, caught: CaughtFailure, failure: FailureId, origin: NodeId) {
        let kind = self.run.failures.get(failure.index()).cloned().unwrap_or_default();
        let text = self.run.reasons.get(&origin).cloned().unwrap_or_else(|| {
            let known = self.plan.graph.sentences.iter().find(|known| known.failure == failure);
            known.map_or_else(|| kind.replace('_', " ").into(), |known| known.text.clone())
        });
        self.bind(caught.kind, Value::Case(kind));
        self.bind(caught.text, Value::Text(text));
    }

    /// The body of a loop once more, if the bound allows it.
    pub(super) fn again(&mut self, node: NodeId, times: u32, body: RegionId) {
        let state = self.run.nodes.at_mut(node.index());
        if state.count >= times {
            self.succeed(node);
        } else {
            state.count += 1;
            self.enter_region(body);
        }
    }

    pub(super) fn enter_each(
        &mut self,
        node: NodeId,
        item: BindingId,
        list: &Term,
        at_most: u32,
        body: RegionId,
    ) {
        let now = self.run.now;
        match self.judge(crate::belief::Freshness::Readings(now)).term(list) {
            Some(Value::List(items)) if items.len() > at_most as usize => {
                self.fail(node, self.plan.exhausted, EndCause::Exhausted);
            }
            Some(Value::List(items)) => {
                self.run.lists.push((node, items.into()));
                self.run.nodes.at_mut(node.index()).count = 0;
                self.next_item(node, item, body);
            }
            Some(_) => self.fail(node, self.plan.failed, EndCause::BadValue),
            None => self.fail(node, TIMEOUT, EndCause::BadValue),
        }
    }

    fn next_item(&mut self, node: NodeId, item: BindingId, body: RegionId) {
        let index = self.run.nodes.at(node.index()).count as usize;
        let list = self.run.lists.iter().rev().find(|(loop_node, _)| *loop_node == node);
        match list.and_then(|(_, items)| items.get(index)).cloned() {
            Some(value) => {
                self.bind(item, value);
                self.run.nodes.at_mut(node.index()).count += 1;
                self.enter_region(body);
            }
            None => self.succeed(node),
        }
    }

    /// Binds a name. Behind a value that the proofs do not assume, nothing counts as proven any more.
    pub(super) fn bind(&mut self, binding: BindingId, value: Value) {
        let graph = &self.plan.graph;
        let declared = graph.bindings.get(binding.index());
        self.run.is_unproven |= declared.is_some_and(|it| !it.is_assumed(&value));
        self.run.beliefs.entities.hear_value(graph, &value, declared.map(|binding| &binding.ty));
        let bound = Box::new(value.clone());
        self.report(move || TraceEventKind::Bound { binding, value: bound });
        if let Some(slot) = self.run.bindings.get_mut(binding.index()) {
            *slot = Some(value);
        }
    }

    fn branch_ended(&mut self, node: NodeId, branches: &[RegionId], exit: NodeExit) {
        if exit.ending != NodeEnding::Success {
            self.run.composites.at_mut(node.index()).after = AfterStop::Exit(exit);
            branches.iter().for_each(|branch| self.stop(*branch, EndCause::SiblingFailed));
        }
        if self.is_down(node) {
            self.exit(node, exit);
        }
    }

    /// Ends the policy, or the inlined policy `of`.
    pub(super) fn end_policy(
        &mut self,
        node: NodeId,
        how: Ending,
        of: Option<NodeId>,
        why: Option<&Term>,
        cause: EndCause,
    ) {
        let is_whole = matches!(how, Ending::Cannot | Ending::Replan);
        let inline = of.filter(|_| !is_whole).and_then(|of| match &self.plan.node(of).kind {
            NodeKind::Inline { body, .. } => Some((of, *body)),
            NodeKind::Call(_) | NodeKind::Sequence { .. } | NodeKind::If { .. } | NodeKind::Wait { .. } => {
                None
            }
            NodeKind::Monitor { .. } | NodeKind::Try { .. } | NodeKind::Repeat { .. } => None,
            NodeKind::Each { .. } | NodeKind::Parallel { .. } | NodeKind::End { .. } => None,
            NodeKind::Let { .. } | NodeKind::Delay { .. } | NodeKind::Finally { .. } => None,
        });
        if let Some((of, body)) = inline {
            let ending = match how {
                Ending::Done | Ending::Cannot | Ending::Replan => NodeEnding::Success,
                Ending::Fail => NodeEnding::Failure(self.plan.failed),
            };
            let own = if ending == NodeEnding::Success { EndCause::Completed } else { EndCause::Failed };
            let state = self.run.composites.at_mut(of.index());
            if state.after == AfterStop::Nothing {
                state.after = AfterStop::Exit(NodeExit { ending, cause: own, origin: node });
                if how == Ending::Fail {
                    let why = why.and_then(|why| self.say(why)).map(SmolStr::from);
                    self.give_reason(node, why);
                }
                self.stop(body, cause);
            }
        } else if self.run.ending.is_none() {
            let why = why.and_then(|why| self.say(why));
            self.run.ending = Some(match how {
                Ending::Done => RunEnd::Done { why, result: None },
                Ending::Fail => {
                    RunEnd::Failed { kind: SmolStr::new_static(lang::failures::FAILED), why, node }
                }
                Ending::Cannot => RunEnd::Declined { why },
                Ending::Replan => RunEnd::Replan { why },
            });
            self.stop(ROOT, cause);
        }
    }

    /// A reason in words, with what was last known; none where it is not known.
    fn say(&mut self, why: &Term) -> Option<String> {
        let mut judge = self.judge(crate::belief::Freshness::Readings(Time::ZERO));
        judge.vague = true;
        judge.term(why).map(|value| match value {
            Value::Text(text) => text.to_string(),
            Value::Bool(_) | Value::Int(_) | Value::Number(_) | Value::Entity(_) => value.to_string(),
            Value::Case(_) | Value::Pose(_) | Value::List(_) => value.to_string(),
        })
    }
}

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
                    cell.due += 1;
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
