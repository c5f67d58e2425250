//! Flags for a model server: the model, the dialect, the grammar, the key and the time.

use std::iter;
use std::sync::LazyLock;
use std::time::Duration;

use clap::builder::PossibleValue;
use clap::{Args, ValueEnum, value_parser};
use motet_client::dialect::{Dialect, GrammarCarrier};
use motet_client::{ClientSettings, ServerUrl};

use super::key::KeyArgs;
use crate::error::CliError;
use crate::output::note;

/// Server of the model, and its dialect.
#[derive(Args, Debug)]
pub(crate) struct ServerArgs {
    /// Model to ask
    #[arg(long, default_value = "default", value_name = "NAME")]
    pub(crate) model: String,
    /// Dialect in which the server takes chats and grammars; every reply is checked, with or without a
    /// grammar
    #[arg(long, value_enum, default_value = "none", value_name = "SERVER")]
    pub(crate) dialect: GrammarDialect,
    /// Part of the request that carries the grammar
    #[arg(long, value_enum, default_value_t, value_name = "CARRIER")]
    pub(crate) carrier: CarrierArg,
    #[command(flatten)]
    pub(crate) key: KeyArgs,
    /// Maximum time to wait for a reply, in seconds
    #[arg(long, default_value_t = 120, value_name = "SECONDS", value_parser = value_parser!(u64).range(1..))]
    pub(crate) timeout: u64,
    /// Number of times a refused reply goes back to the model with the diagnostics
    #[arg(long, default_value_t = 3, value_name = "N", value_parser = value_parser!(u32).range(..=9))]
    pub(crate) repair: u32,
}

impl ServerArgs {
    /// Settings of a client for the server at an address, with the key of the flags.
    pub(crate) fn settings(&self, server: &str) -> Result<ClientSettings, CliError> {
        let dialect = self.dialect.0.map(Dialect::from);
        refuse_carrier(dialect, self.carrier)?;
        let address = ServerUrl::new(server, dialect).map_err(CliError::Message)?;
        let key = self.key.key(&address)?;
        tell_proxy(&address);
        let timeout = Duration::from_secs(self.timeout);
        let new = ClientSettings::new(address, &self.model);
        Ok(ClientSettings {
            dialect,
            carrier: self.carrier.carrier(),
            key,
            timeout,
            // A model may think as long as the person waits.
            idle_timeout: timeout,
            ..new
        })
    }
}

/// Says through which proxy requests to a server go, if the environment names one.
pub(crate) fn tell_proxy(address: &ServerUrl) {
    if let Some(proxy) = address.proxy() {
        note(&format!("requests to {address} go through the proxy {proxy}"));
    }
}

/// Dialect of a model server. A new one is a case of [`Dialect`] first.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum ServerDialect {
    /// vLLM 0.12 and later
    Vllm,
    /// The `llama-server` of llama.cpp
    Llamacpp,
    /// Ollama, through its native chat endpoint
    Ollama,
    /// SGLang, through its OpenAI endpoint
    Sglang,
    /// OpenAI and compatible servers, through chat completions
    Openai,
    /// OpenAI, through the Responses API
    OpenaiResponses,
    /// Anthropic, through the Messages API
    Anthropic,
    /// Gemini, through generateContent
    Gemini,
    /// mistral.rs, through chat completions
    Mistralrs,
}

impl From<ServerDialect> for Dialect {
    fn from(server: ServerDialect) -> Self {
        match server {
            ServerDialect::Vllm => Self::Vllm,
            ServerDialect::Llamacpp => Self::LlamaCpp,
            ServerDialect::Ollama => Self::Ollama,
            ServerDialect::Sglang => Self::Sglang,
            ServerDialect::Openai => Self::OpenAi,
            ServerDialect::OpenaiResponses => Self::OpenAiResponses,
            ServerDialect::Anthropic => Self::Anthropic,
            ServerDialect::Gemini => Self::Gemini,
            ServerDialect::Mistralrs => Self::MistralRs,
        }
    }
}

/// Dialect of a server, if it is told one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct GrammarDialect(pub(crate) Option<ServerDialect>);

impl ValueEnum for GrammarDialect {
    fn value_variants<'a>() -> &'a [Self] {
        static ALL: LazyLock<Vec<GrammarDialect>> = LazyLock::new(|| {
            let servers = ServerDialect::value_variants().iter().copied().map(Some);
            iter::once(None).chain(servers).map(GrammarDialect).collect()
        });
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        match self.0 {
            None => Some(PossibleValue::new("none").help("Chat completions, and no grammar")),
            Some(server) => server.to_possible_value(),
        }
    }
}

/// Part of a request that carries the grammar.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum CarrierArg {
    /// The field that every server of the dialect takes
    #[default]
    Usual,
    /// Lark, for servers with llguidance and for the custom tools of `openai-responses`
    Lark,
    /// A strict tool that the model has to call, of `anthropic`
    Tool,
    /// None: the dialect without a grammar
    None,
}

impl CarrierArg {
    /// Carrier of the flag; `None` if no grammar is sent.
    pub(crate) const fn carrier(self) -> Option<GrammarCarrier> {
        match self {
            Self::Usual => Some(GrammarCarrier::Usual),
            Self::Lark => Some(GrammarCarrier::Lark),
            Self::Tool => Some(GrammarCarrier::Tool),
            Self::None => None,
        }
    }
}

/// Refuses a carrier that the servers of a dialect do not know.
pub(crate) fn refuse_carrier(dialect: Option<Dialect>, carrier: CarrierArg) -> Result<(), CliError> {
    use Dialect::{Anthropic, LlamaCpp, MistralRs, OpenAiResponses, Sglang, Vllm};
    let takes_lark = matches!(dialect, Some(Vllm | Sglang | LlamaCpp | MistralRs | OpenAiResponses));
    let why = match carrier {
        CarrierArg::Lark if !takes_lark => {
            "`--carrier lark` is for servers with llguidance and for custom tools: give --dialect vllm, \
             sglang, llamacpp, mistralrs or openai-responses"
        }
        CarrierArg::Tool if dialect != Some(Anthropic) => {
            "`--carrier tool` is for strict tools: give --dialect anthropic"
        }
        CarrierArg::Lark | CarrierArg::Tool | CarrierArg::Usual | CarrierArg::None => return Ok(()),
    };
    Err(CliError::Message(why.to_owned()))
}
