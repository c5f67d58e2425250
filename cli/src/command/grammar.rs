//! `motet grammar`: the grammar of policies for constrained decoding, or a chat request that uses it.

use std::path::Path;
use std::time::Duration;

use clap::{Args, Subcommand, ValueEnum};
use motet_client::dialect::{self, Dialect, Prompt, probe_body, request_body};
use motet_client::{Client, ClientSettings, ServerUrl, content};
use motet_decode::export::{self, Format as Notation, Header};
use motet_decode::{Grammar, Modifiers, Subset};
use serde_json::Value;

use crate::error::{CliError, Exit};
use crate::flags::{
    CarrierArg, DiagnosticFormat, EnvironmentArgs, KeyArgs, ServerDialect, SyntaxArg, refuse_carrier,
    tell_proxy,
};
use crate::output::{Colors, Output, note};
use crate::report::Report;

/// Flags of `motet grammar`.
#[derive(Args, Debug)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_help_heading = "Subcommands",
    after_help = "Examples:\n  \
    motet grammar --robot hsr --scene kitchen > policy.schema.json\n  \
    motet grammar --robot hsr --scene kitchen --format gbnf --syntax text > policy.gbnf\n  \
    motet grammar --robot hsr --scene kitchen --request vllm --model NAME |\n    \
    curl -H 'Content-Type: application/json' -d @- http://localhost:8000/v1/chat/completions\n  \
    motet grammar probe http://localhost:8000 --dialect vllm --model NAME"
)]
pub(crate) struct GrammarArgs {
    #[command(subcommand)]
    command: Option<GrammarCommand>,
    #[command(flatten)]
    environment: EnvironmentArgs,
    /// Notation of the grammar [default: json-schema, or gbnf for the text syntax]
    #[arg(long, value_enum, value_name = "FORMAT")]
    format: Option<GrammarFormat>,
    /// Syntax that the model writes
    #[arg(long, alias = "surface", value_enum, default_value = "json", value_name = "SYNTAX")]
    syntax: SyntaxArg,
    /// Allow manners, deadlines and retries
    #[arg(long)]
    modifiers: bool,
    /// Maximum nesting of blocks inside the policy's own block
    #[arg(long, default_value_t = motet_decode::subset::DEFAULT_DEPTH, value_name = "N",
          value_parser = depth)]
    depth: usize,
    /// Start a Lark grammar with the header line of llguidance
    #[arg(long)]
    llguidance: bool,
    /// Print the body of a chat request with the grammar, in the dialect of a server
    #[arg(long, value_enum, value_name = "SERVER", conflicts_with = "format")]
    request: Option<ServerDialect>,
    /// Part of the request that carries the grammar
    #[arg(long, value_enum, default_value_t, value_name = "CARRIER", requires = "request")]
    carrier: CarrierArg,
    /// Model of the request
    #[arg(long, default_value = "MODEL", value_name = "NAME")]
    model: String,
    /// Instruction of the request
    #[arg(long, default_value = "Bring me the red mug.", value_name = "TEXT")]
    ask: String,
}

/// Subcommands of `motet grammar`.
#[derive(Subcommand, Debug)]
enum GrammarCommand {
    /// Ask a server for a reply that its grammar forbids, and report whether the server enforces the grammar
    Probe(ProbeArgs),
}

/// Flags of `motet grammar probe`.
#[derive(Args, Debug)]
#[command(
    after_help = "Exit codes: 0 the server enforces the grammar, 1 it does not, 2 the server cannot be asked."
)]
struct ProbeArgs {
    /// Address of the server, such as http://localhost:8000; the dialect adds the path if there is none
    #[arg(value_name = "URL")]
    url: String,
    /// Dialect of the server
    #[arg(long, value_enum, default_value = "openai", value_name = "SERVER")]
    dialect: ServerDialect,
    /// Model to ask
    #[arg(long, default_value = "default", value_name = "NAME")]
    model: String,
    #[command(flatten)]
    key: KeyArgs,
    /// Maximum time to wait for an answer, in seconds
    #[arg(long, default_value_t = 120, value_name = "SECONDS")]
    timeout: u64,
}

/// Notation of a grammar.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum GrammarFormat {
    /// JSON Schema in the subset of OpenAI, vLLM, llama.cpp, Ollama and SGLang; for the JSON syntax only
    JsonSchema,
    /// GBNF of llama.cpp, vLLM and xgrammar
    Gbnf,
    /// Lark of llguidance
    Lark,
    /// EBNF of ISO/IEC 14977, without character classes
    RegexFreeEbnf,
}

/// Reads a nesting depth. A document nests at most 64 deep, and each block with its conditions takes several
/// levels.
fn depth(text: &str) -> Result<usize, String> {
    let depth: usize = text.parse().map_err(|_| "write a whole number".to_owned())?;
    if depth <= 8 { Ok(depth) } else { Err("write a number from 0 to 8".to_owned()) }
}

/// System message of a printed request.
const SYSTEM: &str = "You write a policy for a robot: the steps that do what you are asked. \
                      Write the policy and nothing else.";

/// Runs the command.
pub(crate) fn run(args: &GrammarArgs, colors: Colors) -> Result<Exit, CliError> {
    if let Some(GrammarCommand::Probe(probe)) = &args.command {
        return probe_server(probe);
    }
    Report::run_held(DiagnosticFormat::Human, colors, |report| print(args, report))
}

fn print(args: &GrammarArgs, report: &mut Report) -> Result<Exit, CliError> {
    let mut project = args.environment.without_motions_in(Path::new("."))?.open_with(report)?;
    let signatures = project.session(report)?.session.signatures();
    let subset = Subset {
        syntax: args.syntax.into(),
        modifiers: if args.modifiers { Modifiers::Written } else { Modifiers::Default },
        depth: args.depth,
    };
    let grammar = Grammar::new(&signatures, subset);
    if args.llguidance && (args.request.is_some() || notation(args) != Notation::Lark) {
        return Err(CliError::Message("`--llguidance` needs `--format lark`".to_owned()));
    }
    for warning in dialect::warnings(&grammar).iter().filter(|warning| concerns(args, warning.server)) {
        note(&format!("warning: {}", warning.text));
    }
    let text = match args.request {
        Some(server) => {
            let prompt = Prompt { model: &args.model, system: SYSTEM, user: &args.ask };
            let dialect = Dialect::from(server);
            refuse_carrier(Some(dialect), args.carrier)?;
            let carrier = args.carrier.carrier().ok_or_else(|| {
                CliError::Message("a request that shows the grammar has a carrier of it".to_owned())
            })?;
            let body = request_body(dialect, carrier, &grammar, prompt)
                .ok_or_else(|| needs_json("this server takes"))?;
            format!("{body}\n")
        }
        None => {
            let header = if args.llguidance { Header::Llguidance } else { Header::None };
            export::export(&grammar, notation(args), header)
                .ok_or_else(|| needs_json("`--format json-schema` is"))?
        }
    };
    let is_json = args.request.is_some() || notation(args) == Notation::JsonSchema;
    report.out.document(&text, is_json);
    Ok(Exit::Success)
}

/// Is `true` if the output may be meant for a server.
fn concerns(args: &GrammarArgs, server: Option<Dialect>) -> bool {
    let Some(server) = server else { return true };
    match (args.request, notation(args)) {
        (Some(asked), _) => Dialect::from(asked) == server,
        // Hardly a grammar is within the limits of Anthropic; both protocols of OpenAI have the same ones.
        (None, Notation::JsonSchema) => !matches!(server, Dialect::Anthropic | Dialect::OpenAiResponses),
        (None, Notation::Gbnf) => server == Dialect::LlamaCpp,
        (None, Notation::Lark | Notation::RegexFreeEbnf) => false,
    }
}

fn needs_json(who: &str) -> CliError {
    CliError::Message(format!(
        "{who} a JSON Schema, which describes the JSON syntax only: leave out `--syntax text`"
    ))
}

fn notation(args: &GrammarArgs) -> Notation {
    match (args.format, args.syntax) {
        (Some(GrammarFormat::JsonSchema), _) | (None, SyntaxArg::Json) => Notation::JsonSchema,
        (Some(GrammarFormat::Gbnf), _) | (None, SyntaxArg::Text) => Notation::Gbnf,
        (Some(GrammarFormat::Lark), _) => Notation::Lark,
        (Some(GrammarFormat::RegexFreeEbnf), _) => Notation::RegexFreeEbnf,
    }
}

/// Number of characters of an answer that are shown.
const SHOWN_CHARS: usize = 80;

/// Runs the command.
fn probe_server(args: &ProbeArgs) -> Result<Exit, CliError> {
    let dialect = Dialect::from(args.dialect);
    let url = ServerUrl::new(&args.url, Some(dialect)).map_err(CliError::Message)?;
    let (body, demanded) = probe_body(dialect, &args.model);
    let answer = ask(args, url.clone(), &body)?;
    let said = content(Some(dialect), &answer)
        .ok_or_else(|| CliError::Message(format!("`{url}` did not answer with a chat message")))?;
    let is_held = serde_json::from_str::<Value>(said.trim()).is_ok_and(|answer| answer == demanded);
    if !is_held && is_cut(&said, &demanded) {
        return Err(CliError::Message(format!(
            "`{url}` cut its answer off at `{}`, so the test is inconclusive",
            said.trim()
        )));
    }
    let mut out = Output::default();
    let exit = if is_held {
        out.line(&format!("{url}: the server enforces the grammar"));
        Exit::Success
    } else {
        let shown: String = said.trim().chars().take(SHOWN_CHARS).collect();
        out.line(&format!(
            "{url}: the server ignores the grammar: restricted to {demanded}, it answered `{shown}`"
        ));
        Exit::Findings
    };
    crate::report::close(&mut out, Ok(exit))
}

/// Is `true` if an answer is a proper prefix of the one that the grammar demands.
fn is_cut(said: &str, demanded: &Value) -> bool {
    let bare = |text: &str| text.chars().filter(|letter| !letter.is_whitespace()).collect::<String>();
    bare(&demanded.to_string()).starts_with(&bare(said))
}

fn ask(args: &ProbeArgs, address: ServerUrl, body: &Value) -> Result<Value, CliError> {
    let failed = |why: String| CliError::Message(format!("cannot ask `{address}`: {why}"));
    let timeout = Duration::from_secs(args.timeout);
    let key = args.key.key(&address)?;
    tell_proxy(&address);
    let settings = ClientSettings {
        dialect: Some(args.dialect.into()),
        key,
        timeout,
        idle_timeout: timeout,
        ..ClientSettings::new(address.clone(), &args.model)
    };
    let answer = Client::new(settings).and_then(|client| client.once(body));
    answer.map_err(|why| failed(why.to_string()))
}
