//! The flags of `motet prompt`.

use clap::Args;

use super::input::WorldArgs;

/// `motet prompt`
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  motet prompt 'bring me the coke' --robot hsr --scene kitchen")]
pub(crate) struct PromptArgs {
    /// What to do, in words
    #[arg(value_name = "REQUEST")]
    pub(crate) request: String,
    /// In which world.
    #[command(flatten)]
    pub(crate) world: WorldArgs,
    /// The most tokens, as four bytes each
    #[arg(long, default_value_t = motet_planner::prompt::TOKENS, value_name = "NUMBER")]
    pub(crate) tokens: usize,
}
