//! Reasons why there is no plan.

use motet_syntax::Diagnostic;
use smol_str::SmolStr;
use thiserror::Error;

/// Error of the planner.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum NoPlan {
    /// The goal is no condition.
    #[error("`{text}` is not a condition: {why}")]
    NoCondition {
        text: String,
        /// Error of the parser.
        why: String,
    },
    /// The goal uses unknown names or wrong types.
    #[error("{}", diagnostics.first().map_or("the goal is wrong", |said| said.message.as_str()))]
    Wrong { diagnostics: Vec<Diagnostic> },
    /// No call achieves a missing fact.
    #[error("no action of the robot achieves {goal}{}", because(blocker.as_ref()))]
    Unreachable {
        /// The goal, in back-quotes.
        goal: String,
        /// The need that cannot be met, in back-quotes.
        blocker: Option<String>,
    },
    /// The budget of states or the length limit of plans is exhausted.
    #[error("no plan for {goal} was found within the budget")]
    Budget {
        /// The goal, in back-quotes.
        goal: String,
    },
    /// A call has an argument that a policy cannot express.
    #[error("a call of `{primitive}` cannot be written as a step")]
    Unwritable { primitive: SmolStr },
}

fn because(blocker: Option<&String>) -> String {
    blocker.map_or_else(String::new, |blocker| format!(": {blocker} cannot be met"))
}
