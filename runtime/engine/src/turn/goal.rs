//! Goals: what drivers report of them, and how they are ended early.

use super::Turn;
use crate::belief::{Cell, CellId, Freshness, hand};
use crate::cleanup::strike;
use crate::effect::{Effect, Fault, PlannedMotion};
use crate::event::{DriverEvent, FailureReport, Outcome};
use crate::ids::GoalId;
use crate::query::{Answer, Query, Truth};
use crate::schedule::{NodeExit, Transition};
use crate::state::{GoalIntent, Phase};
use crate::trace::{EndCause, NodeEnding, TraceEventKind};
use motet_graph::draw::Names;
use motet_graph::{CallNode, FailureId, NodeId, NodeKind, TIMEOUT, Value};
use motet_stdlib::lang;
use smol_str::SmolStr;
use std::sync::Arc;

impl Turn<'_> {
    /// A driver reports.
    #[inline]
    pub(super) fn driver(&mut self, event: DriverEvent) {
        if !self.run.orphans.is_empty()
            && let Some(index) = event.goal().and_then(|goal| self.orphan(goal))
        {
            self.orphan_reports(index, event);
            return;
        }
        match event {
            DriverEvent::Acknowledged { goal } => {
                if let Some(node) = self.run.goals.node(goal) {
                    self.acknowledged(node, goal);
                }
            }
            DriverEvent::Ended { goal, outcome } => {
                if let (Outcome::Success(_), Some(node)) = (&outcome, self.run.goals.node(goal)) {
                    self.grasped(node);
                }
                if let Some((node, wish)) = self.close(goal) {
                    self.goal_ended(node, goal, wish, outcome);
                }
            }
            DriverEvent::Stopped { goal } => {
                if let Some((node, wish)) = self.close(goal) {
                    self.goal_ended(node, goal, wish, Outcome::Interrupted);
                }
            }
            DriverEvent::Refused { goal, failure } => {
                if let Some((node, _)) = self.close(goal) {
                    self.goal_failed_as(node, goal, failure, EndCause::Refused);
                    self.check_clearing();
                }
            }
            DriverEvent::Lost { goal } => self.lost(goal),
            DriverEvent::DriverLost => {
                (0..self.run.orphans.len()).for_each(|index| self.orphan_lost(index));
                self.run.goals.live().into_iter().for_each(|(goal, _)| self.lost(goal));
            }
            DriverEvent::DriverGone => self.gone(),
            DriverEvent::NotHeld { goal } => {
                if let Some(node) = self.run.goals.node(goal)
                    && self.run.nodes.at(node.index()).phase == Phase::Held
                {
                    self.cancel(node, GoalIntent::Suspend);
                }
            }
            DriverEvent::Feedback { .. } => {}
            DriverEvent::Observed { query, answer } => self.observed(query, answer),
        }
    }

    fn acknowledged(&mut self, node: NodeId, goal: GoalId) {
        let state = self.run.nodes.at_mut(node.index());
        if state.phase != Phase::Starting {
            return;
        }
        match state.wish {
            GoalIntent::None => state.phase = Phase::Running,
            GoalIntent::Hold => {
                state.phase = Phase::Held;
                self.out.push(Effect::Hold { goal });
            }
            GoalIntent::Lose | GoalIntent::Suspend | GoalIntent::Expire | GoalIntent::Stop => {
                state.phase = Phase::Cancelling;
                self.out.push(Effect::Cancel { goal });
            }
        }
    }

    /// Ends a goal early; while it is not acknowledged, as soon as it is. The strongest wish counts.
    pub(super) fn cancel(&mut self, node: NodeId, wish: GoalIntent) {
        let deadline = self.run.now.after(self.settings.cancel_within);
        let key = self.plan.node_key(node);
        let state = self.run.nodes.at_mut(node.index());
        let Some(goal) = state.goal else { return };
        match state.phase {
            Phase::Starting => {
                if matches!(state.wish, GoalIntent::None | GoalIntent::Hold) {
                    self.run.timers.set(key, deadline);
                }
                state.wish = stronger(state.wish, wish);
            }
            Phase::Running | Phase::Held => {
                state.wish = wish;
                state.phase = Phase::Cancelling;
                self.run.timers.set(key, deadline);
                self.out.push(Effect::Cancel { goal });
            }
            Phase::Cancelling | Phase::SafeStopping => state.wish = stronger(state.wish, wish),
            Phase::Idle | Phase::Entering | Phase::Parked | Phase::Ending | Phase::Inside => {}
            Phase::Deciding | Phase::Waiting | Phase::Queued | Phase::Checking | Phase::Suspended => {}
        }
    }

    /// A goal's instant has come: its deadline, or that of its cancel or its safe stop.
    pub(super) fn goal_due(&mut self, node: NodeId) {
        let state = self.run.nodes.at_mut(node.index());
        let Some(goal) = state.goal else { return };
        match (state.phase, state.wish) {
            (Phase::SafeStopping, _) => {
                let revision = self.run.revision;
                self.fault(Fault::NotStopped { node, revision });
            }
            (Phase::Cancelling, _)
            | (
                Phase::Starting,
                GoalIntent::Lose | GoalIntent::Suspend | GoalIntent::Expire | GoalIntent::Stop,
            ) => {
                self.stop_safely(node, goal);
            }
            (_, _) => self.cancel(node, GoalIntent::Expire),
        }
    }

    /// Nobody knows what a goal does: everything that it may use is stopped safely before anybody else gets
    /// it.
    fn lost(&mut self, goal: GoalId) {
        let Some(node) = self.run.goals.node(goal) else { return };
        let state = self.run.nodes.at_mut(node.index());
        state.wish = stronger(state.wish, GoalIntent::Lose);
        if state.phase != Phase::SafeStopping {
            self.stop_safely(node, goal);
        }
    }

    /// Nobody will ever say that what is live stands still. Where nothing is, nobody will ever tell what
    /// steps wait for.
    fn gone(&mut self) {
        let (live, revision) = (self.run.goals.live(), self.run.revision);
        let own = live.first().map(|(_, node)| (*node, revision));
        let orphan = self.run.orphans.first().map(|orphan| (orphan.node, orphan.revision));
        if let Some((node, revision)) = own.or(orphan) {
            return self.fault(Fault::NotStopped { node, revision });
        }
        for index in 0..self.plan.graph.nodes.len() {
            let node = NodeId(index as u32);
            let is_wait = matches!(self.plan.node(node).kind, NodeKind::Wait { .. });
            if is_wait && self.run.nodes.at(index).phase == Phase::Waiting {
                self.leave_wait(node);
                self.fail(node, TIMEOUT, EndCause::Lost);
            }
        }
    }

    fn stop_safely(&mut self, node: NodeId, goal: GoalId) {
        self.run.nodes.at_mut(node.index()).phase = Phase::SafeStopping;
        let key = self.plan.node_key(node);
        self.run.timers.set(key, self.run.now.after(self.settings.safe_stop_within));
        self.out.push(Effect::SafeStop { goal });
    }

    /// A goal is no longer live: what it kept is free. Gives its step, and why it was to end early.
    #[inline(always)]
    fn close(&mut self, goal: GoalId) -> Option<(NodeId, GoalIntent)> {
        let node = self.run.goals.close(goal)?;
        let step = self.plan.step(node);
        self.run.timers.clear(self.plan.node_key(node));
        self.release(step);
        if step.command.is_none() {
            self.run.commands.retain(|(of, _)| *of != node);
        }
        let state = self.run.nodes.at_mut(node.index());
        state.goal = None;
        Some((node, std::mem::replace(&mut state.wish, GoalIntent::None)))
    }

    /// Notes how the hand holds what it has grasped, unless the driver has told it meanwhile: as the witness
    /// says, and without one nobody knows.
    fn grasped(&mut self, node: NodeId) {
        let is_grasp = |motion: &&Arc<PlannedMotion>| motion.query.starts_with(lang::REACH);
        let command = self.run.command(self.plan, node);
        let Some(motion) = command.iter().flat_map(|command| &command.motions).find(is_grasp) else { return };
        let Some(Value::Entity(of)) = motion.args.first() else { return };
        let since = self.run.nodes.at(node.index()).seen;
        let id = self.run.beliefs.intern(Query::Field { entity: of.clone(), field: lang::GRIP.into() });
        let is_told = |cell: &Cell| cell.seen > since && matches!(cell.answer, Answer::Value(_));
        if self.run.beliefs.cell(id).is_some_and(is_told) {
            return;
        }
        let grasp = motion.witness.as_ref().and_then(|witness| witness.grasp.as_ref());
        let pose = grasp.and_then(|grasp| grasp.object).map(Value::Pose);
        self.run.beliefs.observe(id, pose.map_or(Answer::Unknown, Answer::Value), self.run.now);
    }

    #[inline(always)]
    fn goal_ended(&mut self, node: NodeId, goal: GoalId, wish: GoalIntent, outcome: Outcome) {
        match (outcome, wish) {
            (Outcome::Success(value), _) => self.goal_succeeded(node, goal, value),
            (Outcome::Failure(failure), _) => self.goal_failed_as(node, goal, failure, EndCause::Failed),
            (Outcome::Interrupted, GoalIntent::Expire) => {
                self.goal_failed(node, goal, TIMEOUT, EndCause::Deadline)
            }
            (Outcome::Interrupted, GoalIntent::Lose) => self.goal_failed(node, goal, TIMEOUT, EndCause::Lost),
            (
                Outcome::Interrupted,
                GoalIntent::None | GoalIntent::Hold | GoalIntent::Suspend | GoalIntent::Stop,
            ) => {
                self.goal_interrupted(node, goal, wish);
            }
        }
        self.check_clearing();
    }

    #[inline(always)]
    fn goal_succeeded(&mut self, node: NodeId, goal: GoalId, value: Option<Value>) {
        let plan = self.plan;
        let is_silent =
            plan.step(node).is_silent && self.run.left.is_empty() && self.run.beliefs.lasting.is_empty();
        if is_silent && self.is_quiet() && self.run.clearing.is_empty() {
            // The common case, without a detour over the work list. What waits for this goal to end has its
            // own place there.
            let exit = NodeExit { ending: NodeEnding::Success, cause: EndCause::Completed, origin: node };
            self.node_ended(node, exit);
        } else {
            self.goal_made(node, goal, value);
        }
    }

    /// A goal's value is bound, and its effects are believed.
    fn goal_made(&mut self, node: NodeId, goal: GoalId, value: Option<Value>) {
        let plan = self.plan;
        let Some(call) = plan.call(node) else { return };
        if let Some(binding) = call.binds {
            let declared = plan.graph.bindings.get(binding.index());
            let entities = &self.run.beliefs.entities;
            let value =
                value.filter(|value| declared.is_some_and(|it| entities.fits(&plan.graph, value, &it.ty)));
            match value.filter(|value| self.is_offered(call, value)) {
                Some(value) => self.bind(binding, value),
                None => {
                    self.goal_failed(node, goal, plan.failed, EndCause::BadValue);
                    return;
                }
            }
        }
        self.make(node);
        self.strike(node);
        self.succeed(node);
    }

    /// Returns whether a result is one of those that the call offers, where it offers some: a person who is
    /// to choose among things can choose nothing else.
    fn is_offered(&mut self, call: &CallNode, value: &Value) -> bool {
        let params =
            self.plan.graph.primitives.get(call.primitive.index()).map(|primitive| &primitive.params);
        let among = params.and_then(|params| params.iter().position(|param| param.name == lang::AMONG));
        let Some(among) = among.and_then(|index| call.args.get(index)) else { return true };
        match self.judge(Freshness::Readings(self.run.now)).term(among) {
            Some(Value::List(offered)) => offered.contains(value),
            Some(_) | None => true,
        }
    }

    /// A goal failed as its driver reports.
    fn goal_failed_as(&mut self, node: NodeId, goal: GoalId, failure: FailureReport, cause: EndCause) {
        let FailureReport { kind, text } = failure;
        let failure = self.failure_id(&kind);
        self.goal_failed_with(node, goal, (failure, text), cause);
    }

    /// A call that was carried out is no longer to be cleaned up, if an earlier policy left it.
    fn strike(&mut self, node: NodeId) {
        let plan = self.plan;
        let Some(call) = plan.call(node).filter(|_| !self.run.left.is_empty()) else { return };
        let now = self.run.now;
        let args = self.values(&call.args, Freshness::Readings(now), true);
        self.run.missing.clear();
        let primitive = plan.graph.primitives.get(call.primitive.index());
        if let Some((primitive, args)) = primitive.zip(args) {
            let done = Names(&plan.graph).command(&primitive.name, &args, call.manner);
            strike(&mut self.run.left, &done);
        }
    }

    fn goal_failed(&mut self, node: NodeId, goal: GoalId, failure: FailureId, cause: EndCause) {
        self.goal_failed_with(node, goal, (failure, None), cause);
    }

    fn goal_failed_with(
        &mut self,
        node: NodeId,
        goal: GoalId,
        (failure, text): (FailureId, Option<SmolStr>),
        cause: EndCause,
    ) {
        self.doubt(node);
        self.report(move || TraceEventKind::GoalEnded {
            node,
            goal,
            ending: NodeEnding::Failure(failure),
            cause,
        });
        self.attempt_failed(node, (failure, text), cause);
    }

    fn goal_interrupted(&mut self, node: NodeId, goal: GoalId, wish: GoalIntent) {
        self.doubt(node);
        let stopped = self.stopping(self.region_of(node));
        let cause = match (stopped, wish) {
            (Some(cause), _) => cause,
            (None, GoalIntent::Suspend) => EndCause::Monitor,
            (
                None,
                GoalIntent::None
                | GoalIntent::Hold
                | GoalIntent::Lose
                | GoalIntent::Expire
                | GoalIntent::Stop,
            ) => EndCause::Driver,
        };
        let ending = NodeEnding::Interrupted;
        self.report(move || TraceEventKind::GoalEnded { node, goal, ending, cause });
        if stopped.is_none() && wish == GoalIntent::Suspend {
            // It starts again: at once where what suspended it has gone on already.
            let state = self.run.nodes.at_mut(node.index());
            state.phase = Phase::Entering;
            state.begins_again = true;
            self.push(Transition::Acquire(node));
        } else {
            self.exit(node, NodeExit { ending, cause, origin: node });
        }
    }

    pub(super) fn observed(&mut self, query: Query, answer: Answer) {
        let mut known = self.run.beliefs.find_query(&query);
        let is_kept = |query: &Query| match query {
            Query::Fact { fluent, .. } => self.run.beliefs.fluents.contains_key(fluent),
            Query::Field { field, .. } => field == lang::GRIP,
            Query::Measure { .. } => false,
        };
        if known.is_none() && is_kept(&query) && self.run.beliefs.has_room() {
            self.hear(&query);
            known = Some(self.run.beliefs.intern(query));
        }
        let Some(id) = known else { return };
        let before = self.tested_hand(id);
        if self.run.beliefs.observe(id, answer, self.run.now) && self.ask_again(id) {
            return;
        }
        // A step may have filled a hand of which nothing is known.
        self.run.is_undone |= match (before, self.tested_hand(id)) {
            // Of several things that are held, one may have dropped.
            (Some(Truth::True), held) => held != Some(Truth::True) || self.is_vague_hand(id),
            (Some(Truth::Unknown), held) => held == Some(Truth::False),
            (Some(Truth::False) | None, _) => false,
        };
        self.run.hands_asked.retain(|asked| *asked != id);
        // A reading that was taken afresh counts from now on, also where it reads the same.
        self.run.beliefs.note(id);
        let mut asked = std::mem::take(&mut self.run.asked);
        asked.retain(|(cell, node)| {
            if *cell == id {
                self.push_judge(*node);
            }
            *cell != id
        });
        self.run.asked = asked;
    }

    /// Believed state of a hand by a fact that a test has asked for: true if it holds something.
    fn tested_hand(&self, id: CellId) -> Option<Truth> {
        let is_tested = self.run.hands_asked.contains(&id);
        match self.run.beliefs.cell(id).filter(|_| is_tested).map(|cell| &*cell.query) {
            Some(Query::Fact { fluent, args }) => hand(fluent, self.run.beliefs.fact(fluent, args).0),
            Some(Query::Measure { .. } | Query::Field { .. }) | None => None,
        }
    }

    /// True if a fact about a hand leaves open which thing it holds.
    fn is_vague_hand(&self, id: CellId) -> bool {
        match self.run.beliefs.cell(id).map(|cell| &*cell.query) {
            Some(Query::Fact { fluent, args }) => {
                fluent == lang::fluents::HOLDING && self.run.beliefs.is_vague(fluent, args)
            }
            _ => false,
        }
    }

    /// Asks once more for what a late answer did not settle. Returns false if nobody waits for it.
    fn ask_again(&mut self, id: CellId) -> bool {
        let is_awaited = self.run.asked.iter().any(|(cell, _)| *cell == id);
        if let Some(cell) = self.run.beliefs.cell_mut(id).filter(|_| is_awaited) {
            cell.due += 1;
            self.out.push(Effect::Observe { query: cell.query.clone() });
        }
        is_awaited
    }

    /// The entities in an observed fact were heard of.
    fn hear(&mut self, query: &Query) {
        let Query::Fact { fluent, args } = query else { return };
        let graph = &self.plan.graph;
        let declared = self.run.beliefs.fluents.get(fluent).and_then(|facts| facts.fluent);
        let declared = declared.and_then(|id| graph.fluents.get(id.index()));
        let params = declared.map_or(&[][..], |fluent| &fluent.params);
        for (arg, ty) in args.iter().zip(params) {
            if let crate::query::Pattern::Is(value) = arg {
                self.run.beliefs.entities.hear_value(graph, value, Some(ty));
            }
        }
    }
}

pub(super) fn stronger(a: GoalIntent, b: GoalIntent) -> GoalIntent {
    let strength = |wish: GoalIntent| match wish {
        GoalIntent::None => 0,
        GoalIntent::Hold => 1,
        GoalIntent::Lose => 2,
        GoalIntent::Suspend => 3,
        GoalIntent::Expire => 4,
        GoalIntent::Stop => 5,
    };
    if strength(b) > strength(a) { b } else { a }
}
