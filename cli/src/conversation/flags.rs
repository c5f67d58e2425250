//! Flags of a conversation: those of `motet do` and of `motet talk`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use motet_planner::dialogue::OnInstruction;

use super::words::WordArgs;
use crate::flags::{DriverArgs, OutputFormat, PageArgs, ServerArgs, SessionArgs};

/// Flags of a conversation.
#[derive(Args, Debug)]
pub(crate) struct ConversationArgs {
    #[command(flatten)]
    pub(super) session: SessionArgs,
    #[command(flatten)]
    pub(super) driver: DriverArgs,
    /// Source of a person's lines: `terminal` for stdin, `never`, or `script FILE` with one line each
    #[arg(long, num_args = 1..=2, value_names = ["terminal|script|never", "FILE"])]
    pub(super) ask: Vec<String>,
    #[command(flatten)]
    pub(super) words: WordArgs,
    /// Behaviour of a moving robot while a new instruction is planned
    #[arg(long, value_enum, default_value_t, value_name = "WHAT")]
    pub(super) on_instruction: InstructionArg,
    /// Write requests, policies, questions, outcomes and the journal of each run into this new folder
    #[arg(long, value_name = "FOLDER")]
    pub(super) record: Option<PathBuf>,
    #[command(flatten)]
    pub(super) page: PageArgs,
    /// View of the run: a tree of steps, or JSON events
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub(super) format: OutputFormat,
    // Last, since its heading holds for all flags after it.
    #[command(flatten)]
    pub(super) model: ModelArgs,
}

/// Behaviour of a moving robot while a new instruction is planned.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(super) enum InstructionArg {
    /// It goes on with what it does
    #[default]
    GoOn,
    /// It keeps still until the new policy takes over
    Pause,
}

impl From<InstructionArg> for OnInstruction {
    fn from(flag: InstructionArg) -> Self {
        match flag {
            InstructionArg::GoOn => Self::GoOn,
            InstructionArg::Pause => Self::Pause,
        }
    }
}

/// Model that plans.
#[derive(Args, Debug)]
#[command(next_help_heading = "Planning with a model")]
pub(super) struct ModelArgs {
    /// Planner: `builtin`, which needs no model, or the address of a server such as http://localhost:8000
    #[arg(long, default_value = "builtin", value_name = "builtin|URL")]
    pub(super) planner: String,
    #[command(flatten)]
    pub(super) server: ServerArgs,
    /// Image of the scene for the model, as PNG, JPEG, WebP or GIF; repeatable
    #[arg(long, value_name = "FILE")]
    pub(super) image: Vec<PathBuf>,
    /// Show the model a camera image with each request, and ask it for the points of `ground`
    #[arg(long)]
    pub(super) camera: bool,
    /// Start the first step as soon as it is complete and no later step can refute it
    #[arg(long)]
    pub(super) eager: bool,
    /// Use the built-in planner if the model cannot be asked or finds no policy
    #[arg(long)]
    pub(super) fallback: bool,
}
