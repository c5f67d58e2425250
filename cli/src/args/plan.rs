//! The flags of `motet plan`.

use clap::{Args, ValueEnum};

use super::input::WorldArgs;

/// `motet plan`
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet plan --goal 'on(mug_1, shelf)' --robot hsr --scene kitchen\n  \
    motet plan 'bring me the coke and close the fridge' --robot hsr --scene kitchen")]
pub(crate) struct PlanArgs {
    /// What to do, in words
    #[arg(value_name = "REQUEST", required_unless_present = "goal")]
    pub(crate) request: Option<String>,
    /// A condition that shall hold at the end; several are reached one after the other
    #[arg(long, value_name = "CONDITION", conflicts_with = "request")]
    pub(crate) goal: Vec<String>,
    /// In which world.
    #[command(flatten)]
    pub(crate) world: WorldArgs,
    /// In which form to print the policy
    #[arg(long, value_enum, default_value_t, value_name = "FORM")]
    pub(crate) to: PlanForm,
}

/// The form of a plan.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum PlanForm {
    /// The text form
    #[default]
    Text,
    /// The JSON form
    Json,
}
