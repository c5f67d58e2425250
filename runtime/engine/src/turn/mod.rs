//! Turn: the engine's work on one event. It takes the event in, then makes transitions until none is left:
//! watches first, outer before inner and earlier before later, then steps in document order. A budget bounds
//! it. The files of this folder are the transitions, by kind of node.

mod call;
mod change;
mod cleanup;
mod composite;
mod decide;
mod goal;
mod monitor;
mod orphan;
mod region;
mod suspend;

use crate::belief::{Evaluator, Freshness};
use crate::driver::Capabilities;
use crate::effect::{Effect, Fault, RunEnd};
use crate::event::Event;
use crate::prepared_graph::{Dependent, PreparedGraph};
use crate::schedule::{NodeExit, Transition};
use crate::start::EngineSettings;
use crate::state::{GoalIntent, Phase, Run};
use crate::time::Time;
use crate::trace::{EndCause, NodeEnding, TraceEvent, TraceEventKind};
use motet_graph::{NodeId, ROOT, RegionId};
use std::cmp::Reverse;

/// The engine while it handles one event.
pub(crate) struct Turn<'a> {
    pub(crate) plan: &'a PreparedGraph,
    pub(crate) run: &'a mut Run,
    pub(crate) settings: &'a EngineSettings,
    pub(crate) capabilities: &'a Capabilities,
    pub(crate) out: &'a mut Vec<Effect>,
}

impl Turn<'_> {
    /// Takes an event in.
    pub(crate) fn handle(&mut self, now: Time, event: Event) {
        if self.run.over {
            return;
        }
        let now = now.max(self.run.now);
        self.run.now = now;
        // What was due earlier happened earlier: this event does not change it. But its effects go out only
        // now.
        self.catch_up(|at| at < now);
        match event {
            Event::Begin if self.run.begun => {}
            Event::Begin => {
                self.run.begun = true;
                self.enter_region(ROOT);
            }
            Event::Tick => {}
            Event::Driver(event) if self.run.begun => self.driver(event),
            Event::Driver(_) => {}
            Event::Verified { check, verdict } => self.verified(check, verdict),
            Event::Noticed { query, answer } if self.run.begun => self.observed(query, answer),
            Event::Noticed { .. } => {}
            Event::Hold => self.hold_run(),
            Event::Proceed => self.proceed_run(),
            Event::Stop => self.stop_run(),
        }
        self.settle();
        self.catch_up(|at| at <= now);
    }

    /// Does what is due.
    #[inline]
    fn catch_up(&mut self, is_due: impl Fn(Time) -> bool + Copy) {
        while let Some(key) = self.due(is_due) {
            self.wake(key);
            self.settle();
        }
    }

    /// Ends the run because it cannot go on: all that still runs is told to stop safely.
    pub(crate) fn fault(&mut self, fault: Fault) {
        if self.run.over {
            return;
        }
        let run = &*self.run;
        let told = |node: NodeId| run.nodes.at(node.index()).phase == Phase::SafeStopping;
        let untold = run.goals.live().into_iter().filter(|(_, node)| !told(*node));
        self.out.extend(untold.map(|(goal, _)| Effect::SafeStop { goal }));
        let untold = run.orphans.iter().filter(|orphan| orphan.phase != Phase::SafeStopping);
        self.out.extend(untold.map(|orphan| Effect::SafeStop { goal: orphan.goal }));
        self.finish(RunEnd::Fault(fault));
    }

    /// The next key that is due.
    #[inline]
    fn due(&mut self, is_due: impl Fn(Time) -> bool) -> Option<Dependent> {
        let own = self.run.timers.next();
        if self.run.orphans.is_empty() && own.is_none_or(|(at, _)| !is_due(at)) {
            return None;
        }
        self.first_due(own, is_due)
    }

    #[cold]
    fn first_due(&mut self, own: Option<(Time, u32)>, is_due: impl Fn(Time) -> bool) -> Option<Dependent> {
        if self.run.over {
            return None;
        }
        if let Some(orphan) = self.run.orphans.iter().min_by_key(|orphan| orphan.due)
            && own.is_none_or(|(at, _)| orphan.due <= at)
        {
            return Some(Dependent::Orphan(orphan.goal))
                .filter(|_| is_due(orphan.due) && orphan.due != Time::NEVER);
        }
        let (_, key) = own.filter(|(at, _)| is_due(*at))?;
        self.run.timers.clear(key);
        Some(self.plan.of_key(key))
    }

    fn wake(&mut self, key: Dependent) {
        match key {
            Dependent::Watch(watch) => self.watch_due(watch),
            Dependent::Node(node) => self.node_due(node),
            Dependent::Orphan(goal) => self.orphan_due(goal),
        }
    }

    /// Makes transitions until none is left.
    #[inline]
    fn settle(&mut self) {
        if !self.is_quiet() || self.run.freed {
            self.make_transitions();
        }
    }

    fn make_transitions(&mut self) {
        let mut steps = 0;
        while !self.run.over {
            if !self.run.beliefs.changed.is_empty() {
                self.spread();
            }
            if let Some(Reverse(watch)) = self.run.dirty.pop() {
                self.judge_watch(watch);
            } else if let Some(micro) = self.run.work.pop() {
                self.step(micro);
            } else if self.run.freed {
                self.grant();
            } else {
                return;
            }
            steps += 1;
            if steps > self.settings.step_budget {
                self.fault(Fault::StepBudget { steps: self.settings.step_budget });
            }
        }
    }

    fn step(&mut self, micro: Transition) {
        match micro {
            Transition::Enter(node) => self.enter(node),
            Transition::Acquire(node) => self.acquire(node),
            Transition::Judge(node) => self.judge_node(node),
            Transition::NodeEnded(node, exit) => self.node_ended(node, exit),
            Transition::RegionEnded(region, exit) => self.region_ended(region, exit),
        }
    }

    /// True if nothing else is to be done first: no watch is to be judged, and no other step has work.
    #[inline]
    fn is_quiet(&self) -> bool {
        self.run.beliefs.changed.is_empty() && self.run.dirty.is_empty() && self.run.work.is_empty()
    }

    /// Tells all who depend on beliefs that have changed.
    fn spread(&mut self) {
        let mut changed = std::mem::take(&mut self.run.beliefs.changed);
        for key in changed.drain(..) {
            match self.plan.of_key(key) {
                Dependent::Watch(watch) => self.mark(watch),
                Dependent::Node(node) => self.push_judge(node),
                Dependent::Orphan(_) => {}
            }
        }
        self.run.beliefs.changed = changed;
    }

    /// Judges a watch again before the next step.
    fn mark(&mut self, watch: u32) {
        let state = self.run.watches.at_mut(watch as usize);
        if !state.dirty {
            state.dirty = true;
            self.run.dirty.push(Reverse(watch));
        }
    }

    fn push_judge(&mut self, node: NodeId) {
        let state = self.run.nodes.at_mut(node.index());
        if !state.judging {
            state.judging = true;
            self.push(Transition::Judge(node));
        }
    }

    fn push(&mut self, micro: Transition) {
        let place = match micro {
            Transition::Enter(node)
            | Transition::Acquire(node)
            | Transition::Judge(node)
            | Transition::NodeEnded(node, _) => node.0,
            Transition::RegionEnded(region, _) => self.plan.region(region).owner.map_or(0, |owner| owner.0),
        };
        self.run.work.push(place, micro);
    }

    /// Writes down what happened.
    #[inline(always)]
    fn report(&mut self, what: impl FnOnce() -> TraceEventKind) {
        let (at, revision) = (self.run.now, self.run.revision);
        self.emit(move || Effect::Report(TraceEvent { at, revision, what: what() }));
    }

    /// Gives out an effect. It is built in its place: built apart and copied, it costs several times as much.
    #[inline(always)]
    fn emit(&mut self, effect: impl FnOnce() -> Effect) {
        self.out.extend(std::iter::once_with(effect));
    }

    fn finish(&mut self, end: RunEnd) {
        self.unwatch_idle();
        self.run.over = true;
        self.out.push(Effect::Finished(Box::new(end)));
    }

    /// A person holds the run.
    fn hold_run(&mut self) {
        if self.run.begun && !self.run.is_held_by_person {
            self.run.is_held_by_person = true;
            self.suspend(ROOT, GoalIntent::Hold);
        }
    }

    /// A person lets a held run go on.
    fn proceed_run(&mut self) {
        if std::mem::take(&mut self.run.is_held_by_person) {
            self.go_on(ROOT);
        }
    }

    /// A person stops the run.
    fn stop_run(&mut self) {
        if !self.run.begun {
            self.finish(RunEnd::Interrupted);
            return;
        }
        if self.run.reached.take().is_some() {
            self.forget_asked(self.plan.goal());
            self.leave(RunEnd::Interrupted);
            return;
        }
        let cleans_up = || crate::snapshot::pending(self.plan, self.run).next().is_some();
        if self.run.halted || self.run.ending.is_some() && !cleans_up() {
            return;
        }
        self.run.halted = true;
        self.run.ending = Some(RunEnd::Interrupted);
        self.stop(ROOT, EndCause::Person);
        // What is being cancelled does not go on, but what comes behind it is entered.
        self.proceed_run();
    }

    /// The body of the policy is over.
    fn root_ended(&mut self, exit: NodeExit) {
        let end = self.run.ending.take().unwrap_or_else(|| match exit.ending {
            NodeEnding::Success => RunEnd::Done { why: None, result: None },
            NodeEnding::Failure(failure) => {
                let kind = self.run.failures.get(failure.index()).cloned().unwrap_or_default();
                RunEnd::Failed { kind, why: None, node: exit.origin }
            }
            NodeEnding::Interrupted => RunEnd::Interrupted,
        });
        match end {
            RunEnd::Done { why, .. } => {
                let result = self.plan.graph.result.and_then(|id| self.run.bindings.get(id.index()));
                let end = RunEnd::Done { why, result: result.cloned().flatten() };
                self.reached_goal(end, exit.origin);
            }
            RunEnd::Failed { .. } | RunEnd::Declined { .. } | RunEnd::Replan { .. } => self.leave(end),
            RunEnd::Interrupted | RunEnd::Fault(_) => self.leave(end),
        }
    }

    /// The policy is over: so is the run, once the goals of replaced policies have ended.
    fn leave(&mut self, end: RunEnd) {
        if self.run.orphans.is_empty() {
            self.finish(end);
        } else {
            self.run.closing = Some(end);
        }
    }

    /// A judge of conditions in the world as it is believed to be.
    fn judge(&mut self, fresh: Freshness) -> Evaluator<'_> {
        Evaluator { missing: None, ..self.judge_missing(fresh) }
    }

    /// The same, which notes in `run.missing` what would have to be observed.
    fn judge_missing(&mut self, fresh: Freshness) -> Evaluator<'_> {
        let (beliefs, bindings) = (&mut self.run.beliefs, &self.run.bindings);
        let missing = Some(&mut self.run.missing);
        Evaluator {
            graph: &self.plan.graph,
            beliefs,
            bindings,
            each: None,
            fresh,
            busy: &[],
            vague: false,
            missing,
        }
    }

    #[inline]
    fn stopping(&self, region: RegionId) -> Option<EndCause> {
        self.run.regions.at(region.index()).stopping
    }

    fn suspended(&self, region: RegionId) -> bool {
        self.run.regions.at(region.index()).suspended > 0
    }

    #[inline]
    fn region_of(&self, node: NodeId) -> RegionId {
        self.plan.step(node).region
    }
}
