//! Tests and waits, which look at the world and ask it where beliefs do not tell; and motions that a verifier
//! is asked for.

use super::Turn;
use super::call::{GuardCheck, StartRefusal};
use crate::belief::{CellId, Freshness, hand};
use crate::effect::{Command, DeferredMotion, Effect, MotionVerdict, PlannedMotion, RunEnd};
use crate::event::Verification;
use crate::ids::CheckId;
use crate::query::{Query, Truth};
use crate::state::{MotionCheck, Phase};
use crate::time::Time;
use crate::trace::{EndCause, TraceEventKind};
use motet_graph::draw::Names;
use motet_graph::{CallNode, Condition, NodeId, NodeKind, TIMEOUT, Value};
use motet_stdlib::lang;
use smol_str::SmolStr;
use std::sync::Arc;

impl Turn<'_> {
    /// Evaluates a call's motion after all other guards hold.
    pub(super) fn look_at_motion(
        &mut self,
        node: NodeId,
        call: &CallNode,
        command: Arc<Command>,
    ) -> GuardCheck {
        let Some(compiled) = &call.motion else { return GuardCheck::Go(command) };
        let is_checked = self.is_open(compiled.verdict) && self.settings.verify_within.is_some();
        if !is_checked && !command.motions.is_empty() {
            return GuardCheck::Go(command);
        }
        let now = self.run.now;
        let Some(args) = self.values(&compiled.args, Freshness::Readings(now), false) else {
            return GuardCheck::Go(command);
        };
        if !is_checked {
            let motion = PlannedMotion::compiled(compiled, args);
            let command = Command::clone(&command).with_motion(motion, compiled.leaves.as_deref());
            return GuardCheck::Go(Arc::new(command));
        }
        let motion = DeferredMotion { query: compiled.query.clone(), args, command };
        let known = self.run.checks.iter().find(|check| check.node == node && *check.motion == motion);
        match known.map(|check| (&check.verdict, &check.motion)) {
            None => GuardCheck::Ask(motion),
            Some((None, asked)) => GuardCheck::Wait(asked.clone()),
            Some((Some(Verification::Feasible { witness, leaves }), _)) => {
                let found = (witness.clone(), leaves.as_deref());
                GuardCheck::Go(motion.answered(MotionVerdict::Verified, found, None))
            }
            Some((Some(Verification::Unknown { why }), _)) => {
                GuardCheck::Go(motion.answered(MotionVerdict::Open, (None, None), Some(why.clone())))
            }
            Some((Some(Verification::Infeasible { failure, .. }), _)) => {
                let failure = failure.clone();
                GuardCheck::Refused(StartRefusal::Motion(self.failure_id(&failure)))
            }
        }
    }

    /// The call waits for a verdict on its motion. Its resources are its own meanwhile.
    pub(super) fn ask_for_motion(&mut self, node: NodeId, motion: DeferredMotion) {
        self.stop_checking(node);
        self.run.checked += 1;
        let (id, motion) = (CheckId(self.run.checked), Arc::new(motion));
        self.run.checks.push(MotionCheck { id, node, motion: motion.clone(), verdict: None });
        self.run.nodes.at_mut(node.index()).phase = Phase::Checking;
        if let Some(within) = self.settings.verify_within {
            self.run.timers.set(self.plan.node_key(node), self.run.now.after(within));
        }
        self.out.push(Effect::Verify { check: id, node, motion });
    }

    /// A verdict came. The guards are looked at once more, because the world went on meanwhile.
    pub(super) fn verified(&mut self, id: CheckId, verdict: Verification) {
        let Some(check) = self.run.checks.iter_mut().find(|check| check.id == id) else { return };
        if check.verdict.is_some() {
            return;
        }
        let (node, told) = (check.node, Box::new(verdict.without_witness()));
        check.verdict = Some(verdict);
        self.report(move || TraceEventKind::Verified { node, verdict: told });
        self.push_judge(node);
    }

    /// Reason for which a verifier found that the motion of a call has no solution.
    pub(super) fn infeasible(&self, node: NodeId) -> Option<SmolStr> {
        let verdict = self.run.checks.iter().rfind(|check| check.node == node)?.verdict.as_ref()?;
        match verdict {
            Verification::Infeasible { why, .. } => Some(why.clone()),
            Verification::Feasible { .. } | Verification::Unknown { .. } => None,
        }
    }

    /// True if a call has asked for its motion.
    pub(super) fn is_verifying(&self, node: NodeId) -> bool {
        self.run.checks.iter().any(|check| check.node == node)
    }

    /// A call that was about to start no longer waits for observations or a verdict.
    pub(super) fn stop_checking(&mut self, node: NodeId) {
        self.forget_asked(node);
        if self.is_verifying(node) {
            self.run.timers.clear(self.plan.node_key(node));
            self.run.checks.retain(|check| check.node != node);
        }
    }
}

/// Outcome of what a step depends on.
enum Decision {
    Truth(Truth),
    /// A value; none where it is not known.
    Value(Option<Value>),
}

impl Decision {
    fn is_open(&self) -> bool {
        matches!(self, Self::Truth(Truth::Unknown) | Self::Value(None))
    }
}

impl Turn<'_> {
    /// Tests the condition of an `if` or the `until` of a loop, or finds the value of a `let`.
    pub(super) fn decide(&mut self, node: NodeId) {
        let (now, seen) = (self.run.now, self.run.beliefs.observations);
        let state = self.run.nodes.at_mut(node.index());
        state.phase = Phase::Deciding;
        state.since = now;
        state.seen = seen;
        let decision = self.decision(node, false);
        if decision.is_open() && self.ask(node) {
            return;
        }
        self.decided(node, decision);
    }

    /// Something was learned that a test may depend on.
    pub(super) fn decide_again(&mut self, node: NodeId) {
        let decision = self.decision(node, false);
        // A thing may drop while a test asks for it, also where something else decides the test.
        let is_open = decision.is_open() || self.awaits_hand(node);
        if !is_open || !self.awaits(node) {
            self.decided(node, decision);
        }
    }

    fn decided(&mut self, node: NodeId, decision: Decision) {
        match decision {
            Decision::Truth(truth) if node == self.plan.goal() => self.goal_observed(truth),
            Decision::Truth(Truth::Unknown) => {
                // Where nobody can tell what is in a hand, what was believed stands.
                let truth = self.believed(node);
                self.tested(node, truth);
            }
            Decision::Truth(truth) => self.tested(node, truth),
            Decision::Value(Some(value)) => self.found(node, Some(value)),
            // Nothing more will be known: a text says so.
            Decision::Value(None) => match self.decision(node, true) {
                Decision::Value(value) => self.found(node, value),
                Decision::Truth(_) => {}
            },
        }
    }

    /// Evaluates what a step depends on; `vague` as in [`crate::belief::Evaluator`].
    fn decision(&mut self, node: NodeId, vague: bool) -> Decision {
        let since = self.run.nodes.at(node.index()).since;
        self.run.missing.clear();
        let plan = self.plan;
        if node == plan.goal() {
            return Decision::Truth(self.goal());
        }
        match &plan.node(node).kind {
            NodeKind::If { condition, .. } => {
                let seen = self.run.nodes.at(node.index()).seen;
                // A goal that a policy takes over goes on only if that is decided at once.
                let looks = plan.graph.hands.contains(&node) && self.run.orphans.is_empty();
                let fresh = if looks { Freshness::Hands(since, seen) } else { Freshness::Readings(since) };
                Decision::Truth(self.judge_missing(fresh).condition(condition))
            }
            NodeKind::Repeat { until: Some(condition), .. } => {
                Decision::Truth(self.judge_missing(Freshness::Readings(since)).condition(condition))
            }
            NodeKind::Let { value, .. } => {
                let mut judge = self.judge_missing(Freshness::Readings(since));
                judge.vague = vague;
                Decision::Value(judge.term(value))
            }
            NodeKind::Repeat { until: None, .. } | NodeKind::Call(_) | NodeKind::Sequence { .. } => {
                Decision::Truth(Truth::Unknown)
            }
            NodeKind::Inline { .. } | NodeKind::Wait { .. } | NodeKind::Monitor { .. } => {
                Decision::Truth(Truth::Unknown)
            }
            NodeKind::Try { .. } | NodeKind::Each { .. } | NodeKind::Parallel { .. } => {
                Decision::Truth(Truth::Unknown)
            }
            NodeKind::Delay { .. } | NodeKind::Finally { .. } | NodeKind::End { .. } => {
                Decision::Truth(Truth::Unknown)
            }
        }
    }

    /// Truth of the condition of an `if` by what is believed.
    fn believed(&mut self, node: NodeId) -> Truth {
        let plan = self.plan;
        let NodeKind::If { condition, .. } = &plan.node(node).kind else { return Truth::Unknown };
        let since = self.run.nodes.at(node.index()).since;
        self.judge_missing(Freshness::Readings(since)).condition(condition)
    }

    /// The policy is done: its goal is observed before the run ends. What its effects say of the goal does
    /// not count, but what the robot sees of it afterwards.
    pub(super) fn reached_goal(&mut self, end: RunEnd, node: NodeId) {
        if self.plan.graph.goal.is_empty() {
            self.leave(end);
            return;
        }
        self.run.reached = Some((end, node));
        let goal = self.plan.goal();
        self.run.nodes.at_mut(goal.index()).seen = self.run.beliefs.observations;
        self.decide(goal);
    }

    /// Truth of the goal by what was observed since the policy was done.
    fn goal(&mut self) -> Truth {
        let plan = self.plan;
        let state = self.run.nodes.at(plan.goal().index());
        let fresh = Freshness::Facts(state.since, state.seen);
        let mut judge = self.judge_missing(fresh);
        plan.graph.goal.iter().fold(Truth::True, |truth, part| truth.and(judge.condition(part)))
    }

    /// The goal is known as far as it can be observed: a part that is false fails the run.
    fn goal_observed(&mut self, truth: Truth) {
        let plan = self.plan;
        self.forget_asked(plan.goal());
        self.run.nodes.at_mut(plan.goal().index()).phase = Phase::Idle;
        self.report(move || TraceEventKind::GoalObserved { truth });
        let Some((end, node)) = self.run.reached.take() else { return };
        if truth != Truth::False {
            self.leave(end);
            return;
        }
        let state = self.run.nodes.at(plan.goal().index());
        let mut judge = self.judge(Freshness::Facts(state.since, state.seen));
        let missed = plan.graph.goal.iter().find(|part| judge.condition(part) == Truth::False);
        let missed = missed.map(|part| Names(&plan.graph).condition(part)).unwrap_or_default();
        let why = Some(format!("the goal does not hold: `{missed}` was observed to be false"));
        self.leave(RunEnd::Failed { kind: SmolStr::new_static(lang::failures::FAILED), why, node });
    }

    /// The value of a `let` is known, or will not be.
    fn found(&mut self, node: NodeId, value: Option<Value>) {
        self.forget_asked(node);
        self.run.nodes.at_mut(node.index()).phase = Phase::Inside;
        let plan = self.plan;
        let NodeKind::Let { binding, .. } = &plan.node(node).kind else { return };
        let declared = plan.graph.bindings.get(binding.index());
        let entities = &self.run.beliefs.entities;
        match value {
            Some(value) if declared.is_some_and(|it| entities.fits(&plan.graph, &value, &it.ty)) => {
                self.bind(*binding, value);
                self.succeed(node);
            }
            Some(_) => self.fail(node, plan.failed, EndCause::BadValue),
            None => self.fail(node, TIMEOUT, EndCause::BadValue),
        }
    }

    /// A test came out; unknown counts as false.
    pub(super) fn tested(&mut self, node: NodeId, truth: Truth) {
        self.forget_asked(node);
        self.run.nodes.at_mut(node.index()).phase = Phase::Inside;
        self.report(move || TraceEventKind::Tested { node, truth });
        let holds = truth == Truth::True;
        match &self.plan.node(node).kind {
            NodeKind::If { then, .. } if holds => self.enter_region(*then),
            NodeKind::If { otherwise: Some(otherwise), .. } => self.enter_region(*otherwise),
            NodeKind::If { otherwise: None, .. } => self.succeed(node),
            NodeKind::Repeat { .. } if holds => self.succeed(node),
            NodeKind::Repeat { times, body, .. } => {
                if self.run.nodes.at(node.index()).count >= *times {
                    self.fail(node, self.plan.exhausted, EndCause::Exhausted);
                } else {
                    self.again(node, *times, *body);
                }
            }
            NodeKind::Call(_)
            | NodeKind::Let { .. }
            | NodeKind::Sequence { .. }
            | NodeKind::Inline { .. }
            | NodeKind::Wait { .. } => {}
            NodeKind::Monitor { .. } | NodeKind::Try { .. } | NodeKind::Each { .. } => {}
            NodeKind::Delay { .. } | NodeKind::Finally { .. } => {}
            NodeKind::Parallel { .. } | NodeKind::End { .. } => {}
        }
    }

    /// Asks for what `run.missing` holds. False where there is nothing to ask for.
    pub(super) fn ask(&mut self, node: NodeId) -> bool {
        if self.run.missing.is_empty() {
            return false;
        }
        let key = self.plan.node_key(node);
        self.run.subscriptions.at_mut(key as usize).clear();
        self.ask_for_missing(node);
        let within = Time::from_secs(self.plan.graph.observe_within_secs);
        self.run.timers.set(key, self.run.now.after(within));
        true
    }

    /// Asks for what `run.missing` holds beyond what was asked for before, within the same time. False where
    /// there is nothing to ask for.
    pub(super) fn ask_more(&mut self, node: NodeId) -> bool {
        let key = self.plan.node_key(node) as usize;
        let known = self.run.subscriptions.at(key).len();
        if known > 0 {
            self.ask_for_missing(node);
        }
        self.run.subscriptions.at(key).len() > known
    }

    fn ask_for_missing(&mut self, node: NodeId) {
        let key = self.plan.node_key(node);
        let is_test_of_hand = self.plan.graph.hands.contains(&node);
        let asks = self.run.subscriptions.at_mut(key as usize);
        let known = asks.len();
        for id in &self.run.missing {
            // `missing` has no duplicates.
            if asks.iter().take(known).any(|asked| asked == id) {
                continue;
            }
            asks.push(*id);
            self.run.asked.push((*id, node));
            let Some(cell) = self.run.beliefs.cell_mut(*id) else { continue };
            cell.dependents.push(key);
            cell.due += 1;
            self.out.push(Effect::Observe { query: cell.query.clone() });
            if is_test_of_hand
                && let Query::Fact { fluent, .. } = &*cell.query
                && hand(fluent, Truth::Unknown).is_some()
                && !self.run.hands_asked.contains(id)
            {
                self.run.hands_asked.push(*id);
            }
        }
    }

    /// True if an answer is outstanding.
    pub(super) fn awaits(&self, node: NodeId) -> bool {
        self.run.asked.iter().any(|(_, asker)| *asker == node)
    }

    /// True if an answer of a test is outstanding that tells of a hand.
    fn awaits_hand(&self, node: NodeId) -> bool {
        let is_awaited = |id: &CellId| self.run.asked.contains(&(*id, node));
        self.run.hands_asked.iter().any(is_awaited)
    }

    /// No longer waits for answers.
    pub(super) fn forget_asked(&mut self, node: NodeId) {
        let key = self.plan.node_key(node);
        if self.run.subscriptions.at(key as usize).is_empty() {
            return;
        }
        self.run.timers.clear(key);
        self.run.asked.retain(|(_, asker)| *asker != node);
        for id in self.run.subscriptions.at_mut(key as usize).drain(..) {
            if let Some(cell) = self.run.beliefs.cell_mut(id) {
                cell.dependents.retain(|dependent| *dependent != key);
            }
        }
    }

    /// Enters a `wait`.
    pub(super) fn wait(&mut self, node: NodeId, condition: &Condition, within_secs: f64) {
        let now = self.run.now;
        let state = self.run.nodes.at_mut(node.index());
        state.phase = Phase::Waiting;
        state.since = now;
        let key = self.plan.node_key(node);
        self.run.looks_afresh |= self.judge(Freshness::Readings(now)).condition(condition) == Truth::False;
        self.subscribe(key, condition, now);
        self.run.timers.set(key, now.after(Time::from_secs(within_secs)));
        self.wait_again(node);
    }

    /// Enters a wait for a time.
    pub(super) fn delay(&mut self, node: NodeId, secs: f64) {
        self.run.nodes.at_mut(node.index()).phase = Phase::Waiting;
        self.run.timers.set(self.plan.node_key(node), self.run.now.after(Time::from_secs(secs)));
    }

    /// Something was learned that a `wait` may depend on.
    pub(super) fn wait_again(&mut self, node: NodeId) {
        let NodeKind::Wait { condition, .. } = &self.plan.node(node).kind else { return };
        if self.suspended(self.region_of(node)) {
            return;
        }
        let since = self.run.nodes.at(node.index()).since;
        if self.judge(Freshness::Readings(since)).condition(condition) == Truth::True {
            self.leave_wait(node);
            self.succeed(node);
        }
    }

    pub(super) fn leave_wait(&mut self, node: NodeId) {
        let key = self.plan.node_key(node);
        self.run.timers.clear(key);
        self.unsubscribe(key);
    }

    /// A step's instant has come.
    pub(super) fn node_due(&mut self, node: NodeId) {
        match self.run.nodes.at(node.index()).phase {
            Phase::Deciding => {
                let decision = self.decision(node, false);
                self.decided(node, decision);
            }
            Phase::Waiting => {
                self.leave_wait(node);
                if matches!(self.plan.node(node).kind, NodeKind::Delay { .. }) {
                    self.succeed(node);
                } else {
                    self.fail(node, TIMEOUT, EndCause::Deadline);
                }
            }
            Phase::Checking => self.check_last(node),
            Phase::Starting | Phase::Running | Phase::Held | Phase::Cancelling | Phase::SafeStopping => {
                self.goal_due(node);
            }
            Phase::Idle | Phase::Entering | Phase::Parked | Phase::Ending | Phase::Inside => {}
            Phase::Queued | Phase::Suspended => {}
        }
    }

    /// Judges a step that awaits something.
    pub(super) fn judge_node(&mut self, node: NodeId) {
        let state = self.run.nodes.at_mut(node.index());
        state.judging = false;
        match state.phase {
            Phase::Deciding => self.decide_again(node),
            Phase::Waiting => self.wait_again(node),
            Phase::Checking => self.check_again(node),
            Phase::Idle | Phase::Entering | Phase::Parked | Phase::Ending | Phase::Inside => {}
            Phase::Queued | Phase::Suspended | Phase::Starting | Phase::Running => {}
            Phase::Held | Phase::Cancelling | Phase::SafeStopping => {}
        }
    }
}
