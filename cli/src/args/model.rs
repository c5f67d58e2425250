//! Flags of commands that ask a model.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

/// Which model is asked, and how.
#[derive(Args, Debug)]
#[command(next_help_heading = "Asking a model")]
pub(crate) struct ModelArgs {
    /// Who plans: `builtin`, which needs no model, or the address of a server such as http://localhost:8000
    #[arg(long, default_value = "builtin", value_name = "builtin|URL")]
    pub(crate) planner: String,
    /// The model
    #[arg(long, default_value = "default", value_name = "NAME")]
    pub(crate) model: String,
    /// How the server takes the grammar that the model is held to; what comes back is checked in any case
    #[arg(long, value_enum, default_value = "none", value_name = "SERVER")]
    pub(crate) dialect: Held,
    /// Send the grammar as Lark, for a vLLM, SGLang or llama.cpp that runs grammars with llguidance
    #[arg(long)]
    pub(crate) lark: bool,
    /// Image of the room that the model is shown, as PNG, JPEG, WebP or GIF; may be repeated
    #[arg(long, value_name = "FILE")]
    pub(crate) image: Vec<PathBuf>,
    /// Show the model what the robot's camera sees, a fresh picture with every plan, and ask it for the points that `ground` looks for
    #[arg(long)]
    pub(crate) camera: bool,
    /// Variable of the environment with the key of the server
    #[arg(long, value_name = "VARIABLE")]
    pub(crate) key_from: Option<String>,
    /// The longest to wait for a reply, in seconds
    #[arg(long, default_value_t = 120, value_name = "SECONDS", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) timeout: u64,
    /// How often a reply that is wrong goes back to the model with the reason
    #[arg(long, default_value_t = 3, value_name = "N", value_parser = clap::value_parser!(u32).range(..=9))]
    pub(crate) repair: u32,
    /// Begin with the first step as soon as it is complete and nothing later can refute it
    #[arg(long)]
    pub(crate) eager: bool,
    /// Plan without a model where it cannot be asked, or finds no policy
    #[arg(long)]
    pub(crate) fallback: bool,
}

/// How a server is told of a grammar.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum Held {
    /// Not at all
    None,
    /// As vLLM 0.12 and later take it
    Vllm,
    /// As the server of llama.cpp takes it
    Llamacpp,
    /// As Ollama takes it, at its own address for chats
    Ollama,
    /// As SGLang takes it
    Sglang,
    /// As OpenAI takes it
    Openai,
}
