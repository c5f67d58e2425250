//! The engine: a graph, the state of its run, and one way in.

use crate::driver::Capabilities;
use crate::effect::{DeferredMotion, Effect, RunEnd};
use crate::event::Event;
use crate::ids::CheckId;
use crate::prepared_graph::PreparedGraph;
use crate::query::{Pattern, Truth};
use crate::snapshot::Snapshot;
use crate::start::{self, EngineSettings, StartState};
use crate::state::Run;
use crate::time::Time;
use crate::trace::{EndCause, NodeEnding, TraceEventKind};
use crate::turn::Turn;
use motet_graph::{BindingId, FailureId, Graph, InvalidGraph, InvalidReason, NodeId, Value};
use smol_str::SmolStr;
use std::sync::Arc;

/// Runs one graph. It reads no clock and does no input or output: the same graph and the same events give the
/// same effects.
#[derive(Clone, Debug)]
pub struct Engine {
    pub(crate) plan: Arc<PreparedGraph>,
    /// Boxed, so that a swap exchanges it by its address.
    pub(crate) run: Box<Run>,
    /// Graphs that were replaced, with their numbers.
    pub(crate) older: Vec<(u32, Arc<PreparedGraph>)>,
    settings: EngineSettings,
    pub(crate) capabilities: Capabilities,
}

impl Engine {
    /// Makes a graph ready to run from a state. Costs the size of the graph.
    ///
    /// # Errors
    ///
    /// What is wrong with the graph, or which name it is to be given and is not.
    pub fn new(graph: Graph, start: &StartState) -> Result<Self, Vec<InvalidGraph>> {
        motet_graph::validate(&graph)?;
        let plan = PreparedGraph::new(Arc::new(graph));
        let beliefs = start::believe(&plan.graph, start);
        let mut run = Run::new(&plan, beliefs);
        run.left.clone_from(&start.pending);
        for (index, binding) in plan.graph.bindings.iter().enumerate().filter(|(_, binding)| binding.given) {
            let given = start.bindings.iter().find(|(name, _)| *name == binding.name);
            let Some((_, value)) = given.filter(|(_, value)| value.fits(&binding.ty)) else {
                let reason = InvalidReason::NotGiven(binding.name.clone());
                return Err(vec![InvalidGraph { at: SmolStr::from(format!("binding {index}")), reason }]);
            };
            if let Some(slot) = run.bindings.get_mut(index) {
                *slot = Some(value.clone());
            }
        }
        Ok(Self {
            plan: Arc::new(plan),
            run: Box::new(run),
            older: Vec::new(),
            settings: EngineSettings::default(),
            capabilities: Capabilities::default(),
        })
    }

    /// With other settings.
    #[must_use]
    pub fn with_settings(self, settings: EngineSettings) -> Self {
        Self { settings, ..self }
    }

    /// The settings with which the engine runs.
    #[must_use]
    pub const fn settings(&self) -> &EngineSettings {
        &self.settings
    }

    /// With what the driver can do. They are part of what the effects follow from, so a replay needs the
    /// same.
    #[must_use]
    pub fn with_capabilities(self, capabilities: Capabilities) -> Self {
        Self { capabilities, ..self }
    }

    /// Abilities of the driver, as the host stated them.
    #[must_use]
    pub const fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    /// Takes in one event that happened at `now` and appends what is to be done about it to `out`. All
    /// transitions that the event enables are made in document order, monitors first. What was due before
    /// `now` is done before it. A time before that of the last event counts as that. After
    /// [`Effect::Finished`] nothing happens any more.
    pub fn handle(&mut self, now: Time, event: Event, out: &mut Vec<Effect>) {
        self.turn(out).handle(now, event);
    }

    /// Time at which the engine wants to be woken by [`Event::Tick`], if nothing happens before.
    #[must_use]
    pub fn wake_at(&self) -> Option<Time> {
        if self.run.over {
            return None;
        }
        let orphan = self.run.orphans.iter().map(|orphan| orphan.due).min();
        let own = self.run.timers.next().map(|(at, _)| at);
        own.into_iter().chain(orphan).min().filter(|at| *at != Time::NEVER)
    }

    /// The run cannot go on, because nothing is left to wait for: ends it with [`crate::Fault::Stalled`].
    pub fn give_up(&mut self, out: &mut Vec<Effect>) {
        let fault = crate::effect::Fault::Stalled;
        self.turn(out).fault(fault);
    }

    /// True between [`Event::Hold`] and the event or the swap that ends it.
    #[must_use]
    pub fn is_held(&self) -> bool {
        self.run.is_held_by_person && !self.run.over
    }

    /// True if [`Effect::Finished`] went out.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.run.over
    }

    /// Motions that were asked for and have no verdict yet, by question: who goes on with a run asks for them
    /// again.
    pub fn unverified(&self) -> impl Iterator<Item = (CheckId, &Arc<DeferredMotion>)> {
        let open = self.run.checks.iter().filter(|check| check.verdict.is_none());
        open.map(|check| (check.id, &check.motion))
    }

    /// The graph that runs.
    #[must_use]
    pub fn graph(&self) -> &Graph {
        &self.plan.graph
    }

    /// A binding's value; none before it is bound.
    #[must_use]
    pub fn binding(&self, binding: BindingId) -> Option<&Value> {
        self.run.bindings.get(binding.index())?.as_ref()
    }

    /// A failure kind's name. Beside the graph's own there are those that a driver made up.
    #[must_use]
    pub fn failure(&self, failure: FailureId) -> Option<&SmolStr> {
        self.run.failures.get(failure.index())
    }

    /// The same of a graph by its number; those that a driver made up are known only of the graph that runs.
    #[must_use]
    pub fn failure_at(&self, revision: u32, failure: FailureId) -> Option<&SmolStr> {
        if revision == self.run.revision {
            return self.failure(failure);
        }
        let (_, plan) = self.older.iter().find(|(of, _)| *of == revision)?;
        plan.failures.get(failure.index())
    }

    /// Truth value of a fact in the engine's beliefs; with [`Pattern::Any`], of its existential closure.
    #[must_use]
    pub fn believes(&self, fluent: &str, args: &[Pattern]) -> Truth {
        self.run.beliefs.fact(fluent, args).0
    }

    /// The state as it is now, for a compiler to prove a new policy from, for a journal, and for people.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot {
        Snapshot::of(&self.plan, &self.run)
    }

    /// The state as it would be if all that runs were interrupted now: nothing is known of what running calls
    /// make or unsettle. A policy that is to take over is proved from this, since what it does not go on with
    /// is cancelled. O(state).
    #[must_use]
    pub fn interrupted(&self) -> Snapshot {
        let mut stopped = self.clone();
        stopped.turn(&mut Vec::new()).doubt_running();
        stopped.snapshot()
    }

    pub(crate) fn turn<'a>(&'a mut self, out: &'a mut Vec<Effect>) -> Turn<'a> {
        Turn {
            plan: &self.plan,
            run: &mut self.run,
            settings: &self.settings,
            capabilities: &self.capabilities,
            out,
        }
    }
}

impl Engine {
    /// An effect in one line, for logs and traces.
    #[must_use]
    pub fn describe(&self, effect: &Effect) -> String {
        match effect {
            Effect::Start { goal, node, command, deadline } => {
                format!("start {goal} {command} for {}, until {deadline}", self.path(*node))
            }
            Effect::Cancel { goal } => format!("cancel {goal}"),
            Effect::Update { goal, node, command, deadline } => {
                format!("update {goal} to {command} for {}, until {deadline}", self.path(*node))
            }
            Effect::Hold { goal } => format!("hold {goal}"),
            Effect::Proceed { goal } => format!("proceed {goal}"),
            Effect::SafeStop { goal } => format!("safe stop {goal}"),
            Effect::Observe { query } => format!("observe {query}"),
            Effect::Watch { query } => format!("watch {query}"),
            Effect::Unwatch { query } => format!("unwatch {query}"),
            Effect::Verify { check, node, motion } => {
                format!("verify {check} {motion} for {}", self.path(*node))
            }
            Effect::Report(record) => self.describe_happening(record.revision, &record.what),
            Effect::Finished(end) => match &**end {
                RunEnd::Failed { node, .. } => format!("finished: {end}, in {}", self.path(*node)),
                RunEnd::Done { .. } | RunEnd::Declined { .. } | RunEnd::Replan { .. } => {
                    format!("finished: {end}")
                }
                RunEnd::Interrupted | RunEnd::Fault(_) => format!("finished: {end}"),
            },
        }
    }

    fn describe_happening(&self, revision: u32, what: &TraceEventKind) -> String {
        let path = |node: NodeId| self.path_at(revision, node);
        match what {
            TraceEventKind::Entered { node } => format!("entered {}", path(*node)),
            TraceEventKind::Ended { node, ending, cause } => {
                format!("ended {}: {}", path(*node), self.ending(revision, *ending, *cause))
            }
            TraceEventKind::Started { node, goal, attempt } => {
                format!("started {} as {goal}, attempt {attempt}", path(*node))
            }
            TraceEventKind::GoalEnded { node, goal, ending, cause } => {
                format!("{goal} of {} ended: {}", path(*node), self.ending(revision, *ending, *cause))
            }
            TraceEventKind::Guard { node, need, truth } => {
                format!("guard {need} of {}: {truth}", path(*node))
            }
            TraceEventKind::Verified { node, verdict } => format!("verified {}: {verdict}", path(*node)),
            TraceEventKind::GoalObserved { truth } => format!("observed the goal: {truth}"),
            TraceEventKind::Tested { node, truth } => format!("tested {}: {truth}", path(*node)),
            TraceEventKind::Fired { node, watch, truth } => {
                format!("watch {watch} of {} fired: {truth}", path(*node))
            }
            TraceEventKind::CleanupFailed { node, failure } => {
                let kind = self.failure_at(revision, *failure).map_or("?", |kind| kind);
                format!("cleanup of {} failed: {kind}", path(*node))
            }
            TraceEventKind::CleanupSkipped { node } => format!("cleanup of {} skipped", path(*node)),
            TraceEventKind::WentOn { node, watch } => format!("{} went on after watch {watch}", path(*node)),
            TraceEventKind::Swapped { policy } => format!("swapped to {policy}"),
            TraceEventKind::Kept { node, goal } => format!("{goal} goes on for {}", path(*node)),
            TraceEventKind::Updated { node, goal } => format!("{goal} updated for {}", path(*node)),
            TraceEventKind::Bound { binding, value } => {
                format!("bound {} = {value}", self.name(revision, *binding))
            }
        }
    }

    fn ending(&self, revision: u32, ending: NodeEnding, cause: EndCause) -> String {
        match ending {
            NodeEnding::Success => "success".to_owned(),
            NodeEnding::Failure(failure) => {
                let kind = self.failure_at(revision, failure).map_or("?", |kind| kind);
                format!("failure {kind} ({cause})")
            }
            NodeEnding::Interrupted => format!("interrupted ({cause})"),
        }
    }

    fn path(&self, node: NodeId) -> &str {
        self.path_at(self.revision(), node)
    }

    fn path_at(&self, revision: u32, node: NodeId) -> &str {
        self.graph_at(revision).and_then(|graph| graph.nodes.get(node.index())).map_or("?", |node| &node.path)
    }

    fn name(&self, revision: u32, binding: BindingId) -> &str {
        let graph = self.graph_at(revision);
        graph.and_then(|graph| graph.bindings.get(binding.index())).map_or("?", |binding| &binding.name)
    }
}
