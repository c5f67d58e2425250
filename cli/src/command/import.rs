//! `motet import`: files of other planning languages as Motet.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use motet_pddl::PddlSource;
use motet_project::files::{add_source, read_small};
use motet_syntax::{Diagnostic, FileId, Source, Sources};

use crate::error::{CliError, Exit};
use crate::flags::FormatArgs;
use crate::output::{Colors, replace_file};
use crate::report::Report;

/// Flags of `motet import`.
#[derive(Args, Debug)]
pub(crate) struct ImportArgs {
    #[command(subcommand)]
    command: ImportCommand,
}

/// Languages that can be imported.
#[derive(Subcommand, Debug)]
enum ImportCommand {
    /// Import a PDDL domain and problem as declarations, or a plan for them as a policy
    Pddl(PddlArgs),
}

/// Flags of `motet import pddl`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet import pddl domain.pddl problem.pddl -o blocks.motet\n  \
    motet import pddl domain.pddl problem.pddl --plan plan.txt -o plan.motet\n  \
    motet check plan.motet --domain blocks.motet")]
struct PddlArgs {
    /// PDDL domain file
    #[arg(value_name = "DOMAIN")]
    domain: PathBuf,
    /// PDDL problem file
    #[arg(value_name = "PROBLEM")]
    problem: PathBuf,
    /// Plan with one `(action argument …)` per line. It becomes a policy with the goal of the problem; check
    /// it with the declarations as `--domain`
    #[arg(long, value_name = "FILE")]
    plan: Option<PathBuf>,
    /// File to write [default: stdout]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    format: FormatArgs,
}

/// Runs the command.
pub(crate) fn run(args: &ImportArgs, colors: Colors) -> Result<Exit, CliError> {
    let ImportCommand::Pddl(args) = &args.command;
    Report::run(args.format.format, colors, |report| {
        if args.output.is_none() {
            report.hold();
        }
        pddl(args, report)
    })
}

fn pddl(args: &PddlArgs, report: &mut Report) -> Result<Exit, CliError> {
    let (mut sources, mut diagnostics) = (Sources::default(), Vec::new());
    let (domain, first) = read(&args.domain, &mut sources, &mut diagnostics)?;
    let (problem, second) = read(&args.problem, &mut sources, &mut diagnostics)?;
    let plan = args.plan.as_ref().map(|path| read(path, &mut sources, &mut diagnostics)).transpose()?;
    let mut imported = None;
    if diagnostics.is_empty() {
        let domain = PddlSource { source: &domain, file: first };
        let problem = PddlSource { source: &problem, file: second };
        let plan = plan.as_ref().map(|(source, file)| PddlSource { source, file: *file });
        (imported, diagnostics) = motet_pddl::import(domain, problem, plan);
    }
    report.print(&diagnostics, &sources);
    let Some(imported) = imported else { return Ok(Exit::Findings) };
    let text = if args.plan.is_some() { imported.policy_text() } else { imported.declarations_text() };
    match &args.output {
        Some(path) if path.as_os_str() != "-" => replace_file(path, text.as_bytes())?,
        Some(_) | None => report.out.text(&text),
    }
    Ok(Exit::Success)
}

fn read(
    path: &Path,
    sources: &mut Sources,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<(Source, FileId), CliError> {
    let bytes = read_small(path)?;
    let (source, file, more) = add_source(&path.display().to_string(), &bytes, sources);
    diagnostics.extend(more);
    Ok((source, file))
}
