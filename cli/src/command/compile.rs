//! `motet compile`: a policy's execution graph, a drawing of it, or the policy in either form.

use std::path::Path;

use motet_graph::draw;
use motet_syntax::Syntax;

use crate::args::{CompileArgs, Emit};
use crate::document;
use crate::exit::{Exit, Trouble};
use crate::form;
use crate::input::one_document;
use crate::out::{Colors, note};
use crate::report::Report;
use crate::workbench::Workbench;

/// Runs the command.
///
/// # Errors
///
/// The file cannot be read, or what it is compiled against cannot be used.
pub(crate) fn run(args: &CompileArgs, colors: Colors) -> Result<Exit, Trouble> {
    let mut report = Report::new(args.format.format, colors);
    if args.output.is_none() {
        report.hold();
    }
    let result = compile(args, &mut report);
    report.close(result)
}

fn compile(args: &CompileArgs, report: &mut Report) -> Result<Exit, Trouble> {
    let (source, parsed) = document::read(&one_document(&args.file)?);
    let mut bench = Workbench::open(&args.world, report)?;
    let setting = bench.setting(&parsed.file, report)?;
    let policy = args.policy.as_deref();
    let compiled = setting.session.compile(&parsed, policy);
    report.say(&compiled.diagnostics, &setting.sources(source));
    let Some(graph) = compiled.graph else {
        return Ok(Exit::Findings);
    };
    let library = setting.session.library();
    let written = match args.emit {
        Emit::Graph => Ok(motet_graph::encode(&graph)),
        Emit::Tree => Ok(draw::text(&graph)),
        Emit::Mermaid => Ok(draw::mermaid(&graph)),
        Emit::Dot => Ok(draw::dot(&graph)),
        Emit::Json => form::write(&parsed, policy, library, Syntax::Json),
        Emit::Text => form::write(&parsed, policy, library, Syntax::Text),
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
    match &args.output {
        Some(path) if path.as_os_str() != "-" => write(path, &text)?,
        Some(_) | None => report.out.text(&text),
    }
    Ok(Exit::Clean)
}

fn write(path: &Path, text: &str) -> Result<(), Trouble> {
    std::fs::write(path, text).map_err(|source| Trouble::Write { path: path.to_owned(), source })
}
