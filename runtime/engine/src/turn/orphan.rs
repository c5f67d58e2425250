//! Goals of replaced policies: how they end, or go on for a step of the present one.

use super::Turn;
use super::change::Contracts;
use super::goal::stronger;
use crate::belief::Entities;
use crate::effect::{Effect, Fault};
use crate::event::{DriverEvent, Outcome};
use crate::ids::GoalId;
use crate::prepared_graph::PreparedGraph;
use crate::state::{GoalIntent, OrphanGoal, Phase};
use crate::time::Time;
use crate::trace::{EndCause, NodeEnding, TraceEvent, TraceEventKind};
use motet_graph::{FailureId, NodeId, NodeKind, ROOT, TIMEOUT, Value};
use smol_str::SmolStr;
use std::sync::Arc;

impl Turn<'_> {
    /// A goal of a replaced policy goes on for a call that was just reached, if there is one that fits. False
    /// where the call has to start a goal of its own.
    pub(super) fn claim(&mut self, node: NodeId) -> bool {
        let plan = self.plan;
        let Some(call) = plan.call(node) else { return false };
        let Some(primitive) = plan.graph.primitives.get(call.primitive.index()) else { return false };
        if !self
            .run
            .orphans
            .iter()
            .any(|orphan| orphan.is_free() && orphan.command.primitive == primitive.name)
        {
            return false;
        }
        let literal = plan.step(node).command.clone();
        let now = self.run.now;
        let command = literal.or_else(|| {
            self.run.missing.clear();
            let args = self.values(&call.args, crate::belief::Freshness::Readings(now), false)?;
            plan.command(call, args.into_iter().map(Some)).map(std::sync::Arc::new)
        });
        let Some(command) = command else { return false };
        let same = self.run.orphans.iter().position(|orphan| {
            let own = &orphan.command;
            orphan.is_free()
                && own.primitive == command.primitive
                && own.args == command.args
                && own.manner == command.manner
                && own.uses == command.uses
        });
        if let Some(index) = same {
            let orphan = self.run.orphans.remove(index);
            self.keep(node, &orphan);
            return true;
        }
        if !self.capabilities.update.contains(&primitive.name) {
            return false;
        }
        let conflicts = plan.step(node).mask.conflicts;
        let fits = |index: usize, orphan: &OrphanGoal| {
            let others = self.run.orphans.iter().enumerate().filter(|(other, _)| *other != index);
            let held = others.fold(self.run.held, |bits, (_, other)| bits | other.uses);
            orphan.is_free()
                && orphan.phase != Phase::Starting
                && orphan.command.primitive == command.primitive
                && orphan.command.uses == command.uses
                && held & conflicts == 0
        };
        let Some(index) = self.run.orphans.iter().enumerate().position(|(index, orphan)| fits(index, orphan))
        else {
            return false;
        };
        let Some(command) = self.may_start(node) else { return false };
        let orphan = self.run.orphans.remove(index);
        self.update(node, &orphan, command);
        true
    }

    fn keep(&mut self, node: NodeId, orphan: &OrphanGoal) {
        let phase = if orphan.phase == Phase::Starting { Phase::Starting } else { Phase::Running };
        self.take_goal(node, orphan.goal, phase);
        if self.plan.step(node).command.is_none() {
            self.run.commands.push((node, orphan.command.clone()));
        }
        self.report(move || TraceEventKind::Kept { node, goal: orphan.goal });
        self.go_on_if_held(orphan);
    }

    fn update(&mut self, node: NodeId, orphan: &OrphanGoal, command: std::sync::Arc<crate::effect::Command>) {
        let goal = orphan.goal;
        // What it did before was interrupted.
        self.contracts_of(orphan).doubt_node(orphan);
        self.guards_hold(node);
        let deadline = self.take_goal(node, goal, Phase::Running);
        if self.plan.step(node).command.is_none() {
            self.run.commands.push((node, command.clone()));
        }
        self.report(move || TraceEventKind::Updated { node, goal });
        self.out.push(Effect::Update { goal, node, command, deadline });
        self.go_on_if_held(orphan);
    }

    fn go_on_if_held(&mut self, orphan: &OrphanGoal) {
        if orphan.phase == Phase::Held {
            self.out.push(Effect::Proceed { goal: orphan.goal });
        }
    }

    /// A call has a goal that runs already. Its deadline counts from now.
    fn take_goal(&mut self, node: NodeId, goal: GoalId, phase: Phase) -> Time {
        let step = self.plan.step(node);
        let deadline = self.run.now.after(step.deadline);
        self.run.held |= step.mask.uses;
        self.run.goals.assign(goal, node);
        self.run.timers.set(self.plan.node_key(node), deadline);
        let state = self.run.nodes.at_mut(node.index());
        state.phase = phase;
        state.wish = GoalIntent::None;
        state.goal = Some(goal);
        deadline
    }

    /// Cancels every goal that no step of the new policy has taken.
    pub(super) fn cancel_orphans(&mut self) {
        let due = self.run.now.after(self.settings.cancel_within);
        for orphan in self.run.orphans.iter_mut().filter(|orphan| orphan.is_free()) {
            orphan.wish = GoalIntent::Stop;
            orphan.due = due;
            if orphan.phase != Phase::Starting {
                orphan.phase = Phase::Cancelling;
                self.out.push(Effect::Cancel { goal: orphan.goal });
            }
        }
    }

    /// Returns whether a goal may change a fact that the present policy was proven from: one of its start,
    /// of a test or of an effect.
    fn may_undo_proof(&self, orphan: &OrphanGoal) -> bool {
        let Some(call) = orphan.plan.call(orphan.node) else { return false };
        let made = call.effects.iter().map(|effect| &effect.fact);
        let changes = made.chain(call.unsettles.iter().map(|unsettled| &unsettled.fact));
        let before = &orphan.plan.graph.fluents;
        let mut changed = changes.filter_map(|fact| before.get(fact.fluent.index()));
        changed.any(|it| self.plan.graph.fluents.iter().any(|fluent| fluent.name == it.name))
    }

    /// Position where a goal stands among the orphans.
    pub(super) fn orphan(&self, goal: GoalId) -> Option<usize> {
        self.run.orphans.iter().position(|orphan| orphan.goal == goal)
    }

    /// A driver reports of an orphan.
    pub(super) fn orphan_reports(&mut self, index: usize, event: DriverEvent) {
        let failed = |kind: SmolStr, cause| Some((NodeEnding::Failure(self.failure_of(index, &kind)), cause));
        let end = match event {
            DriverEvent::Acknowledged { goal } => {
                if let Some(orphan) =
                    self.run.orphans.get_mut(index).filter(|orphan| orphan.phase == Phase::Starting)
                {
                    orphan.phase = Phase::Cancelling;
                    self.out.push(Effect::Cancel { goal });
                }
                None
            }
            DriverEvent::Refused { failure, .. } => failed(failure.kind, EndCause::Refused),
            DriverEvent::Ended { outcome: Outcome::Success(value), .. } => {
                self.bind_result(index, value);
                Some((NodeEnding::Success, EndCause::Completed))
            }
            DriverEvent::Ended { outcome: Outcome::Failure(failure), .. } => {
                failed(failure.kind, EndCause::Failed)
            }
            DriverEvent::Ended { outcome: Outcome::Interrupted, .. } | DriverEvent::Stopped { .. } => {
                Some(match self.run.orphans.get(index).map_or(GoalIntent::None, |orphan| orphan.wish) {
                    GoalIntent::Expire => (NodeEnding::Failure(TIMEOUT), EndCause::Deadline),
                    GoalIntent::Lose => (NodeEnding::Failure(TIMEOUT), EndCause::Lost),
                    GoalIntent::None | GoalIntent::Hold | GoalIntent::Suspend | GoalIntent::Stop => {
                        (NodeEnding::Interrupted, EndCause::Swap)
                    }
                })
            }
            DriverEvent::Lost { .. } | DriverEvent::DriverLost => {
                self.orphan_lost(index);
                None
            }
            DriverEvent::NotHeld { .. } | DriverEvent::Feedback { .. } => None,
            DriverEvent::DriverGone | DriverEvent::Observed { .. } => None,
        };
        if let Some((ending, cause)) = end {
            self.orphan_ended(index, ending, cause);
        }
    }

    /// The effects of an orphan may be about its result.
    fn bind_result(&mut self, index: usize, value: Option<Value>) {
        let Some(orphan) = self.run.orphans.get_mut(index) else { return };
        let (graph, call) = (&orphan.plan.graph, orphan.plan.call(orphan.node));
        let Some(binds) = call.and_then(|call| call.binds) else { return };
        let declared = graph.bindings.get(binds.index());
        let entities = &self.run.beliefs.entities;
        let fits = |value: &Value| declared.is_some_and(|it| entities.fits(graph, value, &it.ty));
        let value = value.filter(fits);
        if let Some(slot) = Arc::make_mut(&mut orphan.bindings).get_mut(binds.index()) {
            *slot = value;
        }
    }

    pub(super) fn orphan_lost(&mut self, index: usize) {
        let Some(orphan) = self.run.orphans.get_mut(index) else { return };
        orphan.wish = stronger(orphan.wish, GoalIntent::Lose);
        if orphan.phase != Phase::SafeStopping {
            self.stop_orphan_safely(index);
        }
    }

    /// An orphan's instant has come: its cancel or its safe stop took too long.
    pub(super) fn orphan_due(&mut self, goal: GoalId) {
        let Some(index) = self.orphan(goal) else { return };
        let Some(orphan) = self.run.orphans.get(index) else { return };
        if orphan.phase == Phase::SafeStopping {
            let (node, revision) = (orphan.node, orphan.revision);
            self.fault(Fault::NotStopped { node, revision });
        } else {
            self.stop_orphan_safely(index);
        }
    }

    fn stop_orphan_safely(&mut self, index: usize) {
        let due = self.run.now.after(self.settings.safe_stop_within);
        if let Some(orphan) = self.run.orphans.get_mut(index) {
            orphan.phase = Phase::SafeStopping;
            orphan.due = due;
            self.out.push(Effect::SafeStop { goal: orphan.goal });
        }
    }

    fn orphan_ended(&mut self, index: usize, ending: NodeEnding, cause: EndCause) {
        let orphan = self.run.orphans.remove(index);
        self.run.goals.close(orphan.goal);
        self.run.freed = !self.run.queue.is_empty();
        let call = orphan.plan.call(orphan.node);
        let (busy, ends) = call.map(|call| self.busy(None, call)).unwrap_or_default();
        let mut contracts = Contracts { busy, ends, ..self.contracts_of(&orphan) };
        match ending {
            NodeEnding::Success => {
                contracts.make_node(&orphan);
                let done = orphan.command.brief(&orphan.plan.graph);
                crate::cleanup::strike(&mut self.run.left, &done);
            }
            NodeEnding::Failure(_) | NodeEnding::Interrupted => contracts.doubt_node(&orphan),
        }
        let what = TraceEventKind::GoalEnded { node: orphan.node, goal: orphan.goal, ending, cause };
        let (at, revision) = (self.run.now, orphan.revision);
        self.out.push(Effect::Report(TraceEvent { at, revision, what }));
        if self.run.orphans.is_empty()
            && let Some(end) = self.run.closing.take()
        {
            self.finish(end);
        }
    }

    /// Nothing is known any more of what the calls of orphans make or unsettle.
    pub(super) fn doubt_orphans(&mut self) {
        for orphan in self.run.orphans.clone() {
            self.contracts_of(&orphan).doubt_node(&orphan);
        }
    }

    /// The id of a failure in the graph of an orphan.
    fn failure_of(&self, index: usize, kind: &str) -> FailureId {
        let Some(orphan) = self.run.orphans.get(index) else { return self.plan.failed };
        let known = orphan.plan.failures.iter().position(|known| known == kind);
        known.map_or(orphan.plan.failed, |index| FailureId(index as u32))
    }

    pub(super) fn contracts_of<'o>(&'o mut self, orphan: &'o OrphanGoal) -> Contracts<'o> {
        Contracts {
            graph: &orphan.plan.graph,
            bindings: &orphan.bindings,
            beliefs: &mut self.run.beliefs,
            busy: Vec::new(),
            ends: Vec::new(),
            now: self.run.now,
            begun: orphan.seen,
        }
    }
}

impl Contracts<'_> {
    fn make_node(&mut self, orphan: &OrphanGoal) {
        if let Some(call) = orphan.plan.call(orphan.node) {
            self.make(call);
        }
    }

    fn doubt_node(&mut self, orphan: &OrphanGoal) {
        if let Some(call) = orphan.plan.call(orphan.node) {
            self.doubt(call);
        }
    }
}

impl Turn<'_> {
    /// Ends every step of the policy that is replaced, inner before outer. Goals that run become orphans;
    /// what was watched stays so until the new policy has said what it watches.
    pub(crate) fn retire(&mut self, plan: &Arc<PreparedGraph>) -> Arc<Vec<Option<Value>>> {
        self.run.swapping = true;
        let due = crate::snapshot::due(plan, self.run);
        self.run.left.extend(due);
        let bindings = Arc::new(std::mem::take(&mut self.run.bindings));
        if self.run.reached.is_some() {
            self.forget_asked(plan.goal());
        }
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
            seen: state.seen,
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
        // What they will have changed is known only at their end: a proof from before does not count.
        self.run.is_unproven = self.run.orphans.iter().any(|orphan| self.may_undo_proof(orphan));
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
