//! Effects and records in words, with the paths and names of the graph.

use crate::effect::{Effect, RunEnd};
use crate::engine::Engine;
use crate::record::{Cause, Happening, NodeEnding};
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
            Effect::Report(record) => self.describe_happening(&record.what),
            Effect::Finished(end) => match &**end {
                RunEnd::Failed { node, .. } => format!("finished: {end}, in {}", self.path(*node)),
                RunEnd::Done { .. } | RunEnd::Replan { .. } | RunEnd::Interrupted | RunEnd::Fault(_) => {
                    format!("finished: {end}")
                }
            },
        }
    }

    fn describe_happening(&self, what: &Happening) -> String {
        match what {
            Happening::Entered { node } => format!("entered {}", self.path(*node)),
            Happening::Ended { node, ending, cause } => {
                format!("ended {}: {}", self.path(*node), self.ending(*ending, *cause))
            }
            Happening::Started { node, goal, attempt } => {
                format!("started {} as {goal}, attempt {attempt}", self.path(*node))
            }
            Happening::GoalEnded { node, goal, ending, cause } => {
                format!("{goal} of {} ended: {}", self.path(*node), self.ending(*ending, *cause))
            }
            Happening::Guard { node, need, truth } => {
                format!("guard {need} of {}: {truth}", self.path(*node))
            }
            Happening::Tested { node, truth } => format!("tested {}: {truth}", self.path(*node)),
            Happening::Fired { node, watch, truth } => {
                format!("watch {watch} of {} fired: {truth}", self.path(*node))
            }
            Happening::WentOn { node, watch } => format!("{} went on after watch {watch}", self.path(*node)),
            Happening::Swapped { policy } => format!("swapped to {policy}"),
            Happening::Kept { node, goal } => format!("{goal} goes on for {}", self.path(*node)),
            Happening::Updated { node, goal } => format!("{goal} updated for {}", self.path(*node)),
            Happening::Bound { binding, value } => format!("bound {} = {value}", self.name(*binding)),
        }
    }

    fn ending(&self, ending: NodeEnding, cause: Cause) -> String {
        match ending {
            NodeEnding::Success => "success".to_owned(),
            NodeEnding::Failure(failure) => {
                let kind = self.failure(failure).map_or("?", |kind| kind);
                format!("failure {kind} ({cause})")
            }
            NodeEnding::Interrupted => format!("interrupted ({cause})"),
        }
    }

    fn path(&self, node: NodeId) -> &str {
        self.graph().nodes.get(node.index()).map_or("?", |node| &node.path)
    }

    fn name(&self, binding: BindingId) -> &str {
        self.graph().bindings.get(binding.index()).map_or("?", |binding| &binding.name)
    }
}

impl std::fmt::Display for Cause {
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
