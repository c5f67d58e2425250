//! Feeding a memory with the events that go into an engine and the effects that come out.

use super::store::{Memory, MemoryEvent, OpenStep, StepEnd};
use crate::cleanup::{PendingCleanup, strike};
use crate::effect::{Command, Effect, RunEnd};
use crate::event::{DriverEvent, Event, Outcome};
use crate::ids::GoalId;
use crate::time::Time;
use crate::trace::{EndCause, NodeEnding, TraceEvent, TraceEventKind};
use motet_graph::{BindingId, FailureId, Graph, NodeId, NodeKind, Value};
use motet_stdlib::lang::{builtin_failures, failures};
use std::sync::Arc;

impl Memory {
    /// A policy is about to run as this revision. Call it before the first event, and before the effects of a
    /// swap. A revision above 0 is remembered as a swap.
    pub fn policy(&mut self, at: Time, revision: u32, graph: Arc<Graph>) {
        self.revision = revision;
        if revision > 0 {
            let entry = self.entry(at, MemoryEvent::Swap { policy: self.cut(&graph.policy) });
            self.push(entry);
        }
        self.has_cleanup = graph.nodes.iter().any(|node| matches!(node.kind, NodeKind::Finally { .. }));
        self.graph = Some(graph);
    }

    /// An event that goes into the engine.
    pub fn event(&mut self, _at: Time, event: &Event) {
        let Event::Driver(event) = event else { return };
        match event {
            DriverEvent::Ended { goal, outcome: Outcome::Success(value) } => {
                if let Some(open) = self.running.get_mut(&goal.number()) {
                    open.result.clone_from(value);
                }
            }
            DriverEvent::Ended { goal, outcome: Outcome::Failure(failure) }
            | DriverEvent::Refused { goal, failure } => {
                if let Some(open) = self.running.get_mut(&goal.number()) {
                    open.kind = Some(failure.kind.to_string());
                }
            }
            DriverEvent::Ended { outcome: Outcome::Interrupted, .. }
            | DriverEvent::Acknowledged { .. }
            | DriverEvent::NotHeld { .. } => {}
            DriverEvent::Stopped { .. } | DriverEvent::Lost { .. } | DriverEvent::DriverLost => {}
            DriverEvent::DriverGone | DriverEvent::Feedback { .. } | DriverEvent::Observed { .. } => {}
        }
    }

    /// An effect that comes out of the engine.
    pub fn effect(&mut self, at: Time, effect: &Effect) {
        match effect {
            Effect::Start { goal, node, command, .. } => self.started(at, *goal, *node, command),
            Effect::Update { goal, node, command, .. } => {
                let (call, brief) = (self.cut(&command.to_string()), self.brief(command));
                let (path, revision) = (self.path(*node), self.revision);
                if let Some(open) = self.running.get_mut(&goal.number()) {
                    (open.call, open.path, open.node, open.revision) = (call, path, *node, revision);
                    open.brief = brief;
                }
            }
            Effect::Report(record) => self.record(record),
            Effect::Finished(end) => self.finished(at, end),
            Effect::Cancel { .. } | Effect::Hold { .. } | Effect::Proceed { .. } => {}
            Effect::SafeStop { .. } | Effect::Verify { .. } => {}
            Effect::Observe { .. } | Effect::Watch { .. } | Effect::Unwatch { .. } => {}
        }
    }

    fn started(&mut self, at: Time, goal: GoalId, node: NodeId, command: &Command) {
        let asks = self.limits.questions.contains(&command.primitive);
        let question = command.arg("question").filter(|_| asks).map(|question| self.cut(&plain(question)));
        let open = OpenStep {
            revision: self.revision,
            node,
            call: self.cut(&command.to_string()),
            brief: self.brief(command),
            path: self.path(node),
            since: at,
            question,
            result: None,
            kind: None,
        };
        self.running.insert(goal.number(), open);
        while self.running.len() > self.limits.running {
            self.running.pop_first();
        }
    }

    fn record(&mut self, record: &TraceEvent) {
        match &record.what {
            TraceEventKind::GoalEnded { goal, ending, cause, .. } => {
                if let Some(open) = self.running.remove(&goal.number()) {
                    self.ended(record.at, open, *ending, *cause);
                }
            }
            // The goal of a step that ended because another policy took over goes on, for a step of that or
            // until it has been stopped.
            TraceEventKind::Ended { node, cause: EndCause::Swap, .. } => {
                if let Some(due) = self.due.remove(&(record.revision, *node)) {
                    self.uncleaned(record.at, due);
                }
            }
            TraceEventKind::Ended { node, ending, cause } => {
                self.due.remove(&(record.revision, *node));
                let is_its = |open: &OpenStep| open.node == *node && open.revision == record.revision;
                let live = self.running.iter().find(|(_, open)| is_its(open)).map(|(goal, _)| *goal);
                if let Some(open) = live.and_then(|goal| self.running.remove(&goal)) {
                    self.ended(record.at, open, *ending, *cause);
                } else if let NodeEnding::Failure(kind) = ending {
                    self.stuck(record.at, *node, *kind, *cause);
                }
            }
            TraceEventKind::Kept { node, goal } => {
                let path = self.path(*node);
                if let Some(open) = self.running.get_mut(&goal.number()) {
                    (open.node, open.path, open.revision) = (*node, path, record.revision);
                }
            }
            TraceEventKind::Entered { node } => self.entered(record.revision, *node),
            TraceEventKind::CleanupSkipped { node } => {
                if let Some(due) = self.due.remove(&(record.revision, *node)) {
                    self.uncleaned(record.at, due);
                }
            }
            TraceEventKind::Started { .. } | TraceEventKind::Guard { .. } => {}
            // The step that failed in it has its own record.
            TraceEventKind::Verified { .. } | TraceEventKind::CleanupFailed { .. } => {}
            TraceEventKind::GoalObserved { .. } => {}
            TraceEventKind::Tested { .. } | TraceEventKind::Fired { .. } | TraceEventKind::WentOn { .. } => {}
            TraceEventKind::Bound { binding, value } => self.bound(record.revision, *binding, value),
            TraceEventKind::Swapped { .. } | TraceEventKind::Updated { .. } => {}
        }
    }

    /// A name has a value, which a cleanup that speaks of it is remembered with.
    fn bound(&mut self, revision: u32, binding: BindingId, value: &Value) {
        if revision != self.revision || !self.has_cleanup {
            return;
        }
        let text = self.cut(&value.to_string());
        let bindings = self.graph.as_mut().map(|graph| &mut Arc::make_mut(graph).bindings);
        if let Some(bound) = bindings.and_then(|bindings| bindings.get_mut(binding.index())) {
            bound.name = text.into();
        }
    }

    fn entered(&mut self, revision: u32, node: NodeId) {
        let Some(graph) = self.graph.as_ref().filter(|_| revision == self.revision) else { return };
        let Some(mut due) = PendingCleanup::of(graph, node) else { return };
        due.path = self.cut(&due.path).into();
        due.steps = due.steps.iter().map(|step| self.cut(step)).collect();
        self.due.insert((revision, node), due);
        while self.due.len() > self.limits.running {
            self.due.pop_first();
        }
    }

    fn uncleaned(&mut self, at: Time, due: PendingCleanup) {
        self.left.push(due.clone());
        while self.left.len() > self.limits.running {
            self.left.remove(0);
        }
        let PendingCleanup { path, steps } = due;
        let entry = self.entry(at, MemoryEvent::Uncleaned { path: path.to_string(), steps });
        self.push(entry);
    }

    fn ended(&mut self, at: Time, open: OpenStep, ending: NodeEnding, cause: EndCause) {
        if ending == NodeEnding::Success {
            strike(&mut self.left, &open.brief);
        }
        if let Some(question) = open.question {
            let answer = open.result.clone().filter(|_| ending == NodeEnding::Success);
            let answer = answer.map(|answer| self.cut(&plain(&answer)));
            let entry = self.entry(at, MemoryEvent::Question { question, answer });
            self.push(entry);
            if ending == NodeEnding::Success {
                return;
            }
        }
        let ended = match ending {
            NodeEnding::Success => StepEnd::Success(open.result.as_ref().map(|value| self.small(value))),
            NodeEnding::Failure(kind) => {
                let kind = if open.revision == self.revision {
                    self.kind(kind, open.kind, cause)
                } else {
                    // Its number means a failure of the policy before.
                    self.cut(&open.kind.unwrap_or_else(|| own_kind(cause).to_owned()))
                };
                StepEnd::Failure { kind, cause }
            }
            NodeEnding::Interrupted => StepEnd::Interrupted(cause),
        };
        let took_secs = at.since(open.since).secs();
        let step = MemoryEvent::Step { call: open.call, path: open.path, took_secs, ended };
        let entry = self.entry(at, step);
        self.push(entry);
    }

    /// A step failed that has no goal: a guard that did not hold, or a step that is no call and failed by
    /// itself.
    fn stuck(&mut self, at: Time, node: NodeId, kind: FailureId, cause: EndCause) {
        let own = match cause {
            EndCause::GuardRefuted | EndCause::Deadline | EndCause::Exhausted | EndCause::BadValue => true,
            // What failed was told of already.
            EndCause::Completed
            | EndCause::Failed
            | EndCause::Refused
            | EndCause::Monitor
            | EndCause::SiblingFailed => false,
            EndCause::ParentEnded | EndCause::Person | EndCause::Driver | EndCause::Swap | EndCause::Lost => {
                false
            }
        };
        let told = self.entries.back().is_some_and(|last| match &last.what {
            MemoryEvent::Step { path, .. } => last.is_failure() && *path == self.path(node),
            MemoryEvent::Instruction { .. } | MemoryEvent::Stuck { .. } | MemoryEvent::Question { .. } => {
                false
            }
            MemoryEvent::Uncleaned { .. } => false,
            MemoryEvent::Swap { .. } | MemoryEvent::Ended { .. } => false,
        });
        if !own || told {
            return;
        }
        let (path, kind) = (self.path(node), self.kind(kind, None, cause));
        let call = self.graph.as_ref().and_then(|graph| called(graph, node));
        let what = match call {
            Some(call) => {
                MemoryEvent::Step { call, path, took_secs: 0.0, ended: StepEnd::Failure { kind, cause } }
            }
            None => MemoryEvent::Stuck { path, kind, cause },
        };
        let entry = self.entry(at, what);
        self.push(entry);
    }

    fn finished(&mut self, at: Time, end: &RunEnd) {
        for due in std::mem::take(&mut self.due).into_values() {
            self.uncleaned(at, due);
        }
        let how = self.cut(&end.to_string());
        let done = matches!(end, RunEnd::Done { .. });
        // A failure that nothing caught was told of with its step.
        let told = matches!(end, RunEnd::Failed { why: None, .. });
        let latest = self.latest_failure.clone().filter(|_| told);
        let entry = self.entry(at, MemoryEvent::Ended { how, done });
        self.push(entry);
        if latest.is_some() {
            self.latest_failure = latest;
        }
        self.running.clear();
    }

    /// A call as a person would write it.
    fn brief(&self, command: &Command) -> String {
        self.graph.as_ref().map_or_else(String::new, |graph| self.cut(&command.brief(graph)))
    }

    fn path(&self, node: NodeId) -> String {
        let graph = self.graph.as_ref();
        let node = graph.and_then(|graph| graph.nodes.get(node.index()));
        node.map_or_else(String::new, |node| self.cut(&node.path))
    }

    /// A failure's name: the graph's, else what the driver said, else the engine's own.
    fn kind(&self, kind: FailureId, said: Option<String>, cause: EndCause) -> String {
        let graph = self.graph.as_ref();
        let named = graph.and_then(|graph| graph.failures.get(kind.index())).map(ToString::to_string);
        self.cut(&named.or(said).unwrap_or_else(|| own_kind(cause).to_owned()))
    }

    /// A value whose text is within the limit; another one as a text that is cut.
    fn small(&self, value: &Value) -> Value {
        if crate::json::to_json(value).len() <= self.limits.text_bytes {
            return value.clone();
        }
        Value::Text(self.cut(&value.to_string()).into())
    }
}

/// The failure that the engine itself gives a step.
const fn own_kind(cause: EndCause) -> &'static str {
    match cause {
        EndCause::Exhausted => failures::EXHAUSTED,
        EndCause::Deadline | EndCause::Lost => builtin_failures::TIMEOUT,
        EndCause::Completed
        | EndCause::Failed
        | EndCause::Refused
        | EndCause::Monitor
        | EndCause::SiblingFailed => failures::FAILED,
        EndCause::ParentEnded | EndCause::Person | EndCause::Driver | EndCause::Swap => failures::FAILED,
        EndCause::GuardRefuted | EndCause::BadValue => failures::FAILED,
    }
}

/// The name of the primitive that a step calls, as a call of which the arguments are not known.
fn called(graph: &Graph, node: NodeId) -> Option<String> {
    let NodeKind::Call(call) = &graph.nodes.get(node.index())?.kind else { return None };
    graph.primitives.get(call.primitive.index()).map(|primitive| format!("{}(…)", primitive.name))
}

/// A value as a person would say it: a text without its quotes.
fn plain(value: &Value) -> String {
    if let Value::Text(text) = value { text.to_string() } else { value.to_string() }
}
