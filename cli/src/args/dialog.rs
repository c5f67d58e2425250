//! The flags of `motet dialog`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::input::WorldArgs;

/// `motet dialog`
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet dialog exchange.txt --robot hsr --scene kitchen\n  \
    motet dialog --write 'bring me the coke' --robot hsr --scene kitchen")]
pub(crate) struct DialogArgs {
    /// A text with `<user>` and `<robot>`, or a bare list of actions
    #[arg(value_name = "FILE", required_unless_present = "write")]
    pub(crate) file: Option<PathBuf>,
    /// Write the exchange of a request instead, with the plan of the planner that needs no model
    #[arg(long, value_name = "REQUEST", conflicts_with = "file")]
    pub(crate) write: Option<String>,
    /// In which world.
    #[command(flatten)]
    pub(crate) world: WorldArgs,
    /// In which form to print the policy
    #[arg(long, value_enum, default_value_t, value_name = "FORM", conflicts_with = "write")]
    pub(crate) to: DialogForm,
}

/// The form of the policy of a dialogue.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum DialogForm {
    /// The text form
    #[default]
    Text,
    /// The JSON form
    Json,
}
