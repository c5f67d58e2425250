//! `motet import`: other planning languages as Motet.

use std::path::Path;

use motet_pddl::PddlSource;
use motet_syntax::{Diagnostic, FileId, Source, Sources};

use crate::args::{ImportArgs, ImportCommand, PddlArgs};
use crate::exit::{Exit, Trouble};
use crate::input::read_small;
use crate::out::Colors;
use crate::report::Report;
use crate::workbench::add;

/// Runs the command.
///
/// # Errors
///
/// A file cannot be read or written.
pub(crate) fn run(args: &ImportArgs, colors: Colors) -> Result<Exit, Trouble> {
    let ImportCommand::Pddl(args) = &args.command;
    let mut report = Report::new(args.format.format, colors);
    if args.output.is_none() {
        report.hold();
    }
    let result = pddl(args, &mut report);
    report.close(result)
}

fn pddl(args: &PddlArgs, report: &mut Report) -> Result<Exit, Trouble> {
    let (mut sources, mut said) = (Sources::default(), Vec::new());
    let (domain, first) = read(&args.domain, &mut sources, &mut said)?;
    let (problem, second) = read(&args.problem, &mut sources, &mut said)?;
    let plan = args.plan.as_ref().map(|path| read(path, &mut sources, &mut said)).transpose()?;
    let mut imported = None;
    if said.is_empty() {
        let domain = PddlSource { source: &domain, file: first };
        let problem = PddlSource { source: &problem, file: second };
        let plan = plan.as_ref().map(|(source, file)| PddlSource { source, file: *file });
        (imported, said) = motet_pddl::import(domain, problem, plan);
    }
    report.say(&said, &sources);
    let Some(imported) = imported else { return Ok(Exit::Findings) };
    let text = if args.plan.is_some() { imported.policy_text() } else { imported.declarations_text() };
    match &args.output {
        Some(path) if path.as_os_str() != "-" => {
            std::fs::write(path, &text).map_err(|source| Trouble::Write { path: path.clone(), source })?
        }
        Some(_) | None => report.out.text(&text),
    }
    Ok(Exit::Clean)
}

fn read(path: &Path, sources: &mut Sources, said: &mut Vec<Diagnostic>) -> Result<(Source, FileId), Trouble> {
    let bytes = read_small(path)?;
    let (source, file, more) = add(&path.display().to_string(), &bytes, sources);
    said.extend(more);
    Ok((source, file))
}
