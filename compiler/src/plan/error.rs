//! Why there is no plan.

use motet_syntax::Diagnostic;
use smol_str::SmolStr;
use thiserror::Error;

/// Why there is no plan.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum NoPlan {
    /// A goal that is no condition.
    #[error("`{text}` is no condition: {why}")]
    NoCondition {
        /// As written.
        text: String,
        /// What is wrong with it.
        why: String,
    },
    /// A goal that speaks of what does not exist, or in the wrong types.
    #[error("{}", diagnostics.first().map_or("the goal is wrong", |said| said.message.as_str()))]
    Wrong {
        /// What is wrong.
        diagnostics: Vec<Diagnostic>,
    },
    /// No call can bring about what is missing.
    #[error("nothing that the robot can do brings about {goal}{}", because(blocker.as_ref()))]
    Unreachable {
        /// The goal, in back-quotes.
        goal: String,
        /// The need that cannot be met, in back-quotes.
        blocker: Option<String>,
    },
    /// More states than the budget allows, or more calls than a plan may have.
    #[error("no plan for {goal} was found within the budget")]
    Budget {
        /// The goal, in back-quotes.
        goal: String,
    },
    /// A call with an argument that cannot be written in a policy.
    #[error("a call of `{primitive}` cannot be written as a step")]
    Unwritable {
        /// The primitive.
        primitive: SmolStr,
    },
}

fn because(blocker: Option<&String>) -> String {
    blocker.map_or_else(String::new, |blocker| format!(": {blocker} cannot be met"))
}
