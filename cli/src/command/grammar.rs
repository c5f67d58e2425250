//! `motet grammar`: a grammar of what a model may write, or a request that holds it to one.

mod probe;

pub(super) use probe::key;

use motet_decode::export::{self, Dialect, Format as Notation, Header, Offer, Prompt, request_body};
use motet_decode::{Modifiers, Subset};
use motet_syntax::ast::File;

use crate::args::{Form, Format, GrammarArgs, GrammarCommand, GrammarFormat, Server, WorldArgs};
use crate::exit::{Exit, Trouble};
use crate::out::{Colors, note};
use crate::report::Report;
use crate::workbench::Workbench;

/// What a model is told where a request is printed.
const SYSTEM: &str = "You write a policy for a robot: the steps that do what you are asked. Write the policy and nothing else.";

/// Runs the command.
///
/// # Errors
///
/// The robot, the scene, the state or a domain cannot be read; the server cannot be asked.
pub(crate) fn run(args: &GrammarArgs, colors: Colors) -> Result<Exit, Trouble> {
    if let Some(GrammarCommand::Probe(probe)) = &args.command {
        return probe::run(probe);
    }
    let mut report = Report::new(Format::Human, colors);
    report.hold();
    let result = print(args, &mut report);
    report.close(result)
}

fn print(args: &GrammarArgs, report: &mut Report) -> Result<Exit, Trouble> {
    let world = WorldArgs::from(args.known.clone());
    let mut bench = Workbench::open(&world, report)?;
    let signatures = bench.setting(&File::default(), report)?.session.signatures();
    let surface = Subset {
        syntax: match args.surface {
            Form::Text => motet_syntax::Syntax::Text,
            Form::Json => motet_syntax::Syntax::Json,
        },
        modifiers: if args.modifiers { Modifiers::Written } else { Modifiers::Default },
        depth: args.depth,
    };
    let offer = Offer::new(&signatures, surface);
    if args.llguidance && (args.request.is_some() || notation(args) != Notation::Lark) {
        return Err(Trouble::Other("`--llguidance` is of Lark alone: give `--format lark` too".to_owned()));
    }
    for warning in export::warnings(&offer).iter().filter(|warning| concerns(args, warning.server)) {
        note(&format!("warning: {}", warning.text));
    }
    let text = match args.request {
        Some(server) => {
            let prompt = Prompt { model: &args.model, system: SYSTEM, user: &args.ask };
            let body = request_body(dialect(server), &offer, prompt)
                .ok_or_else(|| text_form("this server takes"))?;
            format!("{body}\n")
        }
        None => {
            let header = if args.llguidance { Header::Llguidance } else { Header::None };
            export::export(&signatures, surface, notation(args), header)
                .ok_or_else(|| text_form("`--format json-schema` is"))?
        }
    };
    report.out.text(&text);
    Ok(Exit::Clean)
}

/// Whether who reads what is printed may be a server.
fn concerns(args: &GrammarArgs, server: Option<Dialect>) -> bool {
    let Some(server) = server else { return true };
    match (args.request, notation(args)) {
        (Some(asked), _) => dialect(asked) == server,
        (None, Notation::JsonSchema) => true,
        (None, Notation::Gbnf) => server == Dialect::LlamaCpp,
        (None, Notation::Lark | Notation::RegexFreeEbnf) => false,
    }
}

fn text_form(who: &str) -> Trouble {
    Trouble::Other(format!(
        "{who} a JSON Schema, which describes the JSON form only: leave out `--surface text`"
    ))
}

fn notation(args: &GrammarArgs) -> Notation {
    match (args.format, args.surface) {
        (Some(GrammarFormat::JsonSchema), _) | (None, Form::Json) => Notation::JsonSchema,
        (Some(GrammarFormat::Gbnf), _) | (None, Form::Text) => Notation::Gbnf,
        (Some(GrammarFormat::Lark), _) => Notation::Lark,
        (Some(GrammarFormat::RegexFreeEbnf), _) => Notation::RegexFreeEbnf,
    }
}

fn dialect(server: Server) -> Dialect {
    match server {
        Server::Vllm => Dialect::Vllm,
        Server::Llamacpp => Dialect::LlamaCpp,
        Server::Ollama => Dialect::Ollama,
        Server::Sglang => Dialect::Sglang,
        Server::Openai => Dialect::OpenAi,
    }
}
