//! `motet compile`: the execution graph of a policy, a drawing of it, or the policy in either syntax.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use motet::document;
use motet_graph::draw;
use motet_stdlib::lang::{entities, kinds};
use motet_syntax::Syntax;
use smol_str::SmolStr;

use crate::documents::one_document;
use crate::error::{CliError, Exit};
use crate::flags::{FormatArgs, SessionArgs, folder_of};
use crate::output::{Colors, note};
use crate::report::Report;

/// Flags of `motet compile`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet compile fetch_mug.motet --robot hsr -o fetch_mug.graph.json\n  \
    motet compile fetch_mug.json --emit text\n  \
    motet compile fetch_mug.motet --robot hsr --emit python -o fetch_mug.py\n  \
    motet compile fetch_mug.motet --emit dot | dot -Tsvg > fetch_mug.svg")]
pub(crate) struct CompileArgs {
    /// Policy file, or `-` for stdin
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Output to write
    #[arg(long, value_enum, default_value_t, value_name = "WHAT")]
    emit: Emit,
    /// File to write [default: stdout]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Policy to compile; required if the file has several
    #[arg(long, value_name = "NAME")]
    policy: Option<String>,
    #[command(flatten)]
    session: SessionArgs,
    #[command(flatten)]
    format: FormatArgs,
}

/// Output of `motet compile`.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
enum Emit {
    /// Execution graph in its versioned JSON encoding
    #[default]
    Graph,
    /// Policy as JSON
    Json,
    /// Policy as text
    Text,
    /// Graph as an indented tree with guards, effects and durations
    Tree,
    /// Graph as a Mermaid flowchart
    Mermaid,
    /// Graph for Graphviz
    Dot,
    /// Python script against the class `motet.Driver`
    Python,
}

/// Runs the command.
pub(crate) fn run(args: &CompileArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(args.format.format, colors, |report| {
        if args.output.is_none() {
            report.hold();
        }
        compile(args, report)
    })
}

fn compile(args: &CompileArgs, report: &mut Report) -> Result<Exit, CliError> {
    let (source, parsed) = one_document(&args.file)?.parse();
    let mut project = args.session.project_in(folder_of(&args.file))?.open_with(report)?;
    let opened = project.session_for(&parsed.file, report)?;
    let policy = args.policy.as_deref();
    let compiled = opened.session.compile(&parsed, policy);
    report.print(&compiled.diagnostics, &opened.sources(source));
    let Some(graph) = compiled.graph else {
        return Ok(Exit::Findings);
    };
    let library = opened.session.library();
    let written = match args.emit {
        Emit::Graph => Ok(motet_graph::encode(&graph)),
        Emit::Tree => Ok(draw::text(&graph)),
        Emit::Mermaid => Ok(draw::mermaid(&graph)),
        Emit::Dot => Ok(draw::dot(&graph)),
        Emit::Python => {
            let always = [
                (entities::ROBOT, kinds::ENTITY),
                (entities::USER, kinds::PERSON),
                (entities::START, kinds::PLACE),
            ];
            let always = always.map(|(id, kind)| (SmolStr::new_static(id), SmolStr::new_static(kind)));
            let of_scene = motet::run::start_state(opened.session.scene()).entities;
            let entities: Vec<(SmolStr, SmolStr)> = always.into_iter().chain(of_scene).collect();
            motet_graph::python::script(&graph, &entities).map_err(|why| why.to_string())
        }
        Emit::Json => document::write(&parsed, policy, library, Syntax::Json),
        Emit::Text => document::write(&parsed, policy, library, Syntax::Text),
    };
    let mut text = match written {
        Ok(text) => text,
        Err(why) => {
            note(&format!("error: {}: {why}", args.file.display()));
            return Ok(Exit::Findings);
        }
    };
    if !text.ends_with('\n') {
        text.push('\n');
    }
    let is_json = matches!(args.emit, Emit::Graph | Emit::Json);
    report.out.file(args.output.as_deref(), &text, is_json)?;
    Ok(Exit::Success)
}
