//! `motet grammar`: what a language model may write, for servers that hold it to that.

use clap::{Args, Subcommand, ValueEnum};

use super::{Form, KnownArgs};

/// `motet grammar`
#[derive(Args, Debug)]
#[command(
    args_conflicts_with_subcommands = true,
    after_help = "Examples:\n  \
    motet grammar --robot hsr --scene kitchen > policy.schema.json\n  \
    motet grammar --robot hsr --scene kitchen --format gbnf --surface text > policy.gbnf\n  \
    motet grammar --robot hsr --scene kitchen --request vllm --model NAME --ask \"Bring me the red mug.\" |\n    \
    curl -H 'Content-Type: application/json' -d @- http://localhost:8000/v1/chat/completions\n  \
    motet grammar probe http://localhost:8000 --dialect vllm --model NAME"
)]
pub(crate) struct GrammarArgs {
    /// Instead of printing a grammar
    #[command(subcommand)]
    pub(crate) command: Option<GrammarCommand>,
    /// For which robot and room.
    #[command(flatten)]
    pub(crate) known: KnownArgs,
    /// The notation; JSON Schema where not given, GBNF of the text form
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub(crate) format: Option<GrammarFormat>,
    /// The form that a model writes
    #[arg(long, value_enum, default_value = "json", value_name = "FORM")]
    pub(crate) surface: Form,
    /// Give deadlines and retries a place
    #[arg(long)]
    pub(crate) modifiers: bool,
    /// How many blocks may stand in one another below the policy's own
    #[arg(long, default_value_t = motet_decode::subset::DEFAULT_DEPTH, value_name = "N",
          value_parser = depth)]
    pub(crate) depth: usize,
    /// Begin Lark with the line by which llguidance knows its dialect
    #[arg(long)]
    pub(crate) llguidance: bool,
    /// Print the body of a chat request that holds a model to the grammar, in a server's dialect
    #[arg(long, value_enum, value_name = "SERVER", conflicts_with = "format")]
    pub(crate) request: Option<Server>,
    /// The model of the request
    #[arg(long, default_value = "MODEL", value_name = "NAME")]
    pub(crate) model: String,
    /// What the request asks for
    #[arg(long, default_value = "Bring me the red mug.", value_name = "TEXT")]
    pub(crate) ask: String,
}

/// What else there is to do.
#[derive(Subcommand, Debug)]
pub(crate) enum GrammarCommand {
    /// Ask a server for something that the grammar of the request forbids, and say whether it holds the model to it
    Probe(ProbeArgs),
}

/// `motet grammar probe`
#[derive(Args, Debug)]
#[command(
    after_help = "Exit codes: 0 the server holds the model to the grammar, 1 it does not, 2 it cannot be asked."
)]
pub(crate) struct ProbeArgs {
    /// The server, such as http://localhost:8000; the path is that of the dialect where none is given
    #[arg(value_name = "URL")]
    pub(crate) url: String,
    /// How it is asked
    #[arg(long, value_enum, default_value = "openai", value_name = "SERVER")]
    pub(crate) dialect: Server,
    /// The model
    #[arg(long, default_value = "default", value_name = "NAME")]
    pub(crate) model: String,
    /// Variable of the environment with the key of the server
    #[arg(long, value_name = "VARIABLE")]
    pub(crate) key_from: Option<String>,
    /// The longest to wait for an answer, in seconds
    #[arg(long, default_value_t = 120, value_name = "SECONDS")]
    pub(crate) timeout: u64,
}

/// A notation of grammars.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum GrammarFormat {
    /// In the subset that OpenAI, vLLM, llama.cpp, Ollama and SGLang take; only of the JSON form
    JsonSchema,
    /// Of llama.cpp, vLLM and xgrammar
    Gbnf,
    /// Of llguidance
    Lark,
    /// ISO/IEC 14977, without character classes
    RegexFreeEbnf,
}

/// A server's dialect.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum Server {
    /// vLLM 0.12 and later
    Vllm,
    /// The server of llama.cpp
    Llamacpp,
    /// Ollama
    Ollama,
    /// SGLang
    Sglang,
    /// OpenAI
    Openai,
}

/// A document of the language nests at most 64 deep, of which a block and its conditions take some.
fn depth(text: &str) -> Result<usize, String> {
    let depth: usize = text.parse().map_err(|_| "write a whole number".to_owned())?;
    if depth <= 8 {
        Ok(depth)
    } else {
        Err("at most 8: loops and monitors stand no deeper in one another".to_owned())
    }
}
