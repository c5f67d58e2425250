//! `motet plan`: a policy for a request or a goal, by the built-in planner.

use clap::Args;
use motet_compiler::plan::NoPlan;
use motet_planner::builtin::PlanError;
use motet_syntax::Source;

use crate::error::{CliError, Exit};
use crate::flags::{DiagnosticFormat, SessionArgs, SyntaxArg};
use crate::output::{Colors, note};
use crate::report::Report;

/// Flags of `motet plan`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet plan --goal 'on(mug_1, shelf)' --robot hsr --scene kitchen\n  \
    motet plan 'bring me the coke and close the fridge' --robot hsr --scene kitchen")]
pub(crate) struct PlanArgs {
    /// Request in English
    #[arg(value_name = "REQUEST", required_unless_present = "goal")]
    request: Option<String>,
    /// Condition that holds at the end; repeatable, for goals that are reached one after the other
    #[arg(long, value_name = "CONDITION", conflicts_with = "request")]
    goal: Vec<String>,
    #[command(flatten)]
    session: SessionArgs,
    /// Syntax of the printed policy
    #[arg(long, value_enum, default_value = "text", value_name = "SYNTAX")]
    to: SyntaxArg,
}

/// Runs the command.
pub(crate) fn run(args: &PlanArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run_held(DiagnosticFormat::Human, colors, |report| plan(args, report))
}

fn plan(args: &PlanArgs, report: &mut Report) -> Result<Exit, CliError> {
    let mut project = args.session.project_here()?.open_with(report)?;
    let opened = project.session(report)?;
    let planned = match &args.request {
        Some(request) => motet::plan::for_request(opened, request).map(|answered| {
            answered.understood.notes.iter().for_each(|text| note(text));
            answered.planned
        }),
        None => motet::plan::for_goals(opened, &args.goal),
    };
    match planned {
        Ok(planned) => {
            let sources = opened.sources(Source::new("plan.motet", planned.text.as_str()));
            report.print(&planned.compiled.diagnostics, &sources);
            match motet::document::write(&planned.parsed, None, opened.session.library(), args.to.into()) {
                Ok(text) => {
                    report.out.document(&format!("{}\n", text.trim_end()), args.to == SyntaxArg::Json)
                }
                Err(why) => return Ok(refuse(&why.to_string())),
            }
            Ok(Exit::Success)
        }
        Err(PlanError::NoPlan(NoPlan::Wrong { diagnostics })) => {
            for found in &diagnostics {
                note(&format!("{}: {}", found.code, found.message));
            }
            Ok(Exit::Findings)
        }
        Err(why) => Ok(refuse(&why.to_string())),
    }
}

fn refuse(why: &str) -> Exit {
    note(&format!("no plan: {why}"));
    Exit::Findings
}
