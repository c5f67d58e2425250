//! Effects and records in words, with the paths and names of the graph.

use crate::effect::{Effect, RunEnd};
use crate::engine::Engine;
use crate::trace::{EndCause, NodeEnding, TraceEventKind};
use motet_graph::{BindingId, NodeId};

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
                RunEnd::Done { .. } | RunEnd::Replan { .. } | RunEnd::Interrupted | RunEnd::Fault(_) => {
                    format!("finished: {end}")
                }
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
            TraceEventKind::Tested { node, truth } => format!("tested {}: {truth}", path(*node)),
            TraceEventKind::Fired { node, watch, truth } => {
                format!("watch {watch} of {} fired: {truth}", path(*node))
            }
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

impl std::fmt::Display for EndCause {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Completed => "completed",
            Self::Failed => "failed",
            Self::Refused => "refused by the driver",
            Self::GuardRefuted => "guard refuted",
            Self::Deadline => "deadline",
            Self::Exhausted => "bound reached",
            Self::BadValue => "bad or missing value",
            Self::Monitor => "monitor",
            Self::SiblingFailed => "another branch failed",
            Self::ParentEnded => "the policy ended",
            Self::Person => "a person",
            Self::Driver => "the driver",
            Self::Swap => "a new policy",
            Self::Lost => "lost by the driver",
        })
    }
}
