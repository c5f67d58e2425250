//! Calls up to their start: resources, then guards, then the goal goes out.

use super::Turn;
use super::change::changes_need;
use crate::belief::Freshness;
use crate::effect::{Command, DeferredMotion, Effect};
use crate::prepared_graph::PreparedNode;
use crate::query::Truth;
use crate::schedule::{NodeExit, Transition};
use crate::state::{GoalIntent, Phase};
use crate::trace::{EndCause, NodeEnding, TraceEventKind};
use motet_graph::{CallNode, FailureId, Need, NodeId, Term, Value, Verdict};
use smol_str::SmolStr;
use std::sync::Arc;

/// Result of evaluating a call's guards.
pub(super) enum GuardCheck {
    /// All hold, and the arguments are known.
    Go(Arc<Command>),
    /// All but the motion are known to hold: somebody is to be asked for that.
    Ask(DeferredMotion),
    Wait(Arc<DeferredMotion>),
    /// Something would have to be observed.
    Unknown(StartRefusal),
    /// A guard does not hold.
    Refused(StartRefusal),
}

/// Reason for which a call does not start.
#[derive(Clone, Copy)]
pub(super) enum StartRefusal {
    /// A need by its place, with its failure.
    Need(u32, FailureId, Truth),
    /// The motion has no solution.
    Motion(FailureId),
    /// An argument is not known.
    Argument,
}

impl Turn<'_> {
    /// Gets a call's resources, checks its guards, and starts it.
    pub(super) fn acquire(&mut self, node: NodeId) {
        let step = self.plan.step(node);
        let region = self.run.regions.at(step.region.index());
        if let Some(cause) = region.stopping {
            self.exit(node, NodeExit { ending: NodeEnding::Interrupted, cause, origin: node });
        } else if region.suspended > 0 {
            self.run.nodes.at_mut(node.index()).phase = Phase::Suspended;
        } else {
            self.begin(node, step);
        }
    }

    /// The same where the step's region runs.
    #[inline]
    pub(super) fn begin(&mut self, node: NodeId, step: &PreparedNode) {
        if !self.run.orphans.is_empty() && self.claim(node) {
            // A goal of the policy before goes on for it.
        } else if !self.reserve(step) {
            self.enqueue(node);
        } else if let Some(command) = step.command.as_ref().filter(|_| {
            step.is_ready
                && !self.run.is_unproven
                && !self.run.nodes.at(node.index()).begins_again
                && self.run.beliefs.lasting.is_empty()
        }) {
            self.launch(node, step, command.clone());
        } else {
            self.check(node);
        }
    }

    fn check(&mut self, node: NodeId) {
        match self.first_look(node) {
            GuardCheck::Unknown(_) => {
                if self.ask(node) {
                    self.run.nodes.at_mut(node.index()).phase = Phase::Checking;
                } else {
                    self.go_without(node);
                }
            }
            GuardCheck::Ask(motion) => self.ask_for_motion(node, motion),
            GuardCheck::Wait(_) => {}
            GuardCheck::Refused(refusal) => self.refuse(node, refusal),
            GuardCheck::Go(command) => self.start(node, command),
        }
    }

    fn first_look(&mut self, node: NodeId) -> GuardCheck {
        let (now, seen) = (self.run.now, self.run.beliefs.observations);
        let state = self.run.nodes.at_mut(node.index());
        state.since = now;
        state.seen = seen;
        self.run.missing.clear();
        self.look(node)
    }

    /// The command of a call whose guards are known to hold at once.
    pub(super) fn may_start(&mut self, node: NodeId) -> Option<Arc<Command>> {
        match self.first_look(node) {
            GuardCheck::Go(command) => Some(command),
            GuardCheck::Unknown(_) | GuardCheck::Ask(_) | GuardCheck::Wait(_) | GuardCheck::Refused(_) => {
                None
            }
        }
    }

    /// Something was learned that a guard may depend on.
    pub(super) fn check_again(&mut self, node: NodeId) {
        self.run.missing.clear();
        match self.look(node) {
            GuardCheck::Unknown(_) if self.awaits(node) => {}
            // What an answer has left open may depend on something else.
            GuardCheck::Unknown(_) if self.ask_more(node) => {}
            // What was known when the motion was asked for may have become unknown since.
            GuardCheck::Unknown(_) if self.is_verifying(node) && self.ask(node) => {}
            GuardCheck::Unknown(_) => self.go_without(node),
            GuardCheck::Refused(refusal) => self.refuse(node, refusal),
            GuardCheck::Ask(motion) => self.ask_for_motion(node, motion),
            GuardCheck::Wait(_) => {}
            GuardCheck::Go(command) => self.start(node, command),
        }
    }

    /// No time is left to observe, or to wait for a verdict.
    pub(super) fn check_last(&mut self, node: NodeId) {
        self.run.missing.clear();
        let is_verifying = self.is_verifying(node);
        match self.look(node) {
            GuardCheck::Unknown(_) => self.go_without(node),
            GuardCheck::Refused(refusal) => self.refuse(node, refusal),
            GuardCheck::Ask(motion) if is_verifying => self.start(node, motion.command),
            GuardCheck::Ask(motion) => self.ask_for_motion(node, motion),
            GuardCheck::Wait(motion) => self.start(node, motion.command.clone()),
            GuardCheck::Go(command) => self.start(node, command),
        }
    }

    /// Nothing more will be known: a text says so, and behind a `wait` what was believed stands. Anything
    /// else that is unknown refuses the step.
    fn go_without(&mut self, node: NodeId) {
        self.run.missing.clear();
        let is_verifying = self.is_verifying(node);
        match self.look_at_all(node, true) {
            GuardCheck::Unknown(refusal) | GuardCheck::Refused(refusal) => self.refuse(node, refusal),
            GuardCheck::Ask(motion) if is_verifying => self.start(node, motion.command),
            GuardCheck::Ask(motion) => self.ask_for_motion(node, motion),
            GuardCheck::Wait(motion) => self.start(node, motion.command.clone()),
            GuardCheck::Go(command) => self.start(node, command),
        }
    }

    fn look(&mut self, node: NodeId) -> GuardCheck {
        self.look_at_all(node, false)
    }

    /// Evaluates a call's guards and arguments; `is_last` where nothing more will be known.
    fn look_at_all(&mut self, node: NodeId, is_last: bool) -> GuardCheck {
        let plan = self.plan;
        let Some(call) = plan.call(node) else { return GuardCheck::Unknown(StartRefusal::Argument) };
        let (since, seen, attempt) = {
            let state = self.run.nodes.at(node.index());
            (state.since, state.seen, state.count)
        };
        let fresh = Freshness::Readings(since);
        let mut unknown = None;
        for (index, need) in call.needs.iter().enumerate() {
            if !self.is_asked(node, call, need) {
                continue;
            }
            let afresh = Freshness::Facts(since, seen);
            let mut truth = self.need(need, if self.run.is_undone { afresh } else { fresh });
            let looks_afresh = match truth {
                // A retry looks afresh: what refused it before may have changed. A reaction does so too.
                Truth::False => attempt > 1 || self.run.looks_afresh || plan.is_in_reaction(node),
                // Behind a wait the world may have undone what a step made. Where nobody can tell, it stands.
                Truth::True => self.run.looks_afresh && !is_last,
                Truth::Unknown => false,
            };
            if looks_afresh {
                truth = self.need(need, afresh);
            }
            let refusal = StartRefusal::Need(index as u32, need.failure, truth);
            match truth {
                Truth::True => {}
                Truth::False => return GuardCheck::Refused(refusal),
                Truth::Unknown => unknown = unknown.or(Some(refusal)),
            }
        }
        if let Some(command) = &plan.step(node).command {
            return unknown
                .map_or_else(|| self.look_at_motion(node, call, command.clone()), GuardCheck::Unknown);
        }
        let args: Option<Vec<Value>> = self.values(&call.args, fresh, is_last);
        match (unknown, args.and_then(|args| plan.command(call, args.into_iter().map(Some)))) {
            (Some(refusal), _) => GuardCheck::Unknown(refusal),
            (None, None) => GuardCheck::Unknown(StartRefusal::Argument),
            (None, Some(command)) => self.look_at_motion(node, call, Arc::new(command)),
        }
    }

    /// Returns whether a need is to be checked before its step: also if it is proven, once the step was
    /// interrupted and may have changed it.
    fn is_asked(&self, node: NodeId, call: &CallNode, need: &Need) -> bool {
        self.is_open(need.verdict) || self.run.nodes.at(node.index()).begins_again && changes_need(call, need)
    }

    /// Returns whether a need or a motion with this verdict is to be checked before its step.
    pub(super) fn is_open(&self, verdict: Verdict) -> bool {
        verdict == Verdict::Deferred || self.run.is_unproven
    }

    pub(super) fn values(&mut self, terms: &[Term], fresh: Freshness, vague: bool) -> Option<Vec<Value>> {
        let mut judge = self.judge_missing(fresh);
        judge.vague = vague;
        let mut known = Some(Vec::with_capacity(terms.len()));
        // All are looked at, so that everything that is missing is asked for together.
        for term in terms {
            match (judge.term(term), &mut known) {
                (Some(value), Some(values)) => values.push(value),
                (Some(_) | None, _) => known = None,
            }
        }
        known
    }

    fn refuse(&mut self, node: NodeId, refusal: StartRefusal) {
        let why = self.infeasible(node).filter(|_| matches!(refusal, StartRefusal::Motion(_)));
        self.stop_checking(node);
        self.release(self.plan.step(node));
        match refusal {
            StartRefusal::Need(need, failure, truth) => {
                self.report(move || TraceEventKind::Guard { node, need, truth });
                self.attempt_failed(node, (failure, None), EndCause::GuardRefuted);
            }
            StartRefusal::Motion(failure) => {
                self.attempt_failed(node, (failure, why), EndCause::GuardRefuted);
            }
            StartRefusal::Argument => {
                self.attempt_failed(node, (motet_graph::TIMEOUT, None), EndCause::BadValue);
            }
        }
    }

    /// An attempt failed, perhaps with a cause in words: the next one, if one is left.
    pub(super) fn attempt_failed(
        &mut self,
        node: NodeId,
        (failure, text): (FailureId, Option<SmolStr>),
        cause: EndCause,
    ) {
        let retries = self.plan.call(node).map_or(0, |call| call.retries);
        let state = self.run.nodes.at_mut(node.index());
        if state.count <= retries && self.stopping(self.region_of(node)).is_none() {
            let state = self.run.nodes.at_mut(node.index());
            state.count += 1;
            state.phase = Phase::Entering;
            self.push(Transition::Acquire(node));
        } else {
            self.fail(node, failure, cause);
            self.give_reason(node, text);
        }
    }

    fn start(&mut self, node: NodeId, command: Arc<Command>) {
        if self.run.nodes.at(node.index()).phase == Phase::Checking {
            self.stop_checking(node);
        }
        self.guards_hold(node);
        self.launch(node, self.plan.step(node), command);
    }

    /// All that is asked of a call holds: nothing is known any more of what its start unsettles.
    pub(super) fn guards_hold(&mut self, node: NodeId) {
        let plan = self.plan;
        let Some(call) = plan.call(node) else { return };
        for (index, need) in call.needs.iter().enumerate() {
            if self.is_asked(node, call, need) {
                self.report(move || TraceEventKind::Guard { node, need: index as u32, truth: Truth::True });
            }
        }
        if !call.unsettles.is_empty() || !self.run.beliefs.lasting.is_empty() {
            self.unsettle(call);
        }
    }

    /// The goal goes out.
    #[inline(always)]
    fn launch(&mut self, node: NodeId, step: &PreparedNode, command: Arc<Command>) {
        let goal = self.run.goals.open(node);
        let deadline = self.run.now.after(step.deadline);
        self.run.timers.set(self.plan.node_key(node), deadline);
        let seen = self.run.beliefs.observations;
        let state = self.run.nodes.at_mut(node.index());
        state.seen = seen;
        state.phase = Phase::Starting;
        state.wish = GoalIntent::None;
        state.goal = Some(goal);
        let attempt = state.count;
        if step.command.is_none() {
            self.run.commands.push((node, command.clone()));
        }
        self.report(move || TraceEventKind::Started { node, goal, attempt });
        self.emit(move || Effect::Start { goal, node, command, deadline });
    }

    /// The id of a failure; a kind that the graph does not name gets one of its own.
    pub(super) fn failure_id(&mut self, name: &SmolStr) -> FailureId {
        let known = self.run.failures.iter().position(|known| known == name);
        let index = known.unwrap_or_else(|| {
            // A driver that makes up names without end does not fill the memory.
            if self.run.failures.len() >= self.plan.failures.len() + MAX_MADE_UP {
                return self.plan.failed.index();
            }
            self.run.failures.push(name.clone());
            self.run.failures.len() - 1
        });
        FailureId(index as u32)
    }
}

/// Limit of distinct failure kinds that the graph does not name.
const MAX_MADE_UP: usize = 64;
