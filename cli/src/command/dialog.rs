//! `motet dialog`: converts plans in the dialect of InteLiPlan to policies, and writes exchanges in it.

use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use motet_compiler::fix::{self, FixLimits};
use motet_planner::builtin;
use motet_planner::dialogue::{Knowledge, Problem};
use motet_planner::inteliplan::actions;
use motet_planner::inteliplan::exchange::{self, Exchange};
use motet_planner::prompt;
use motet_project::files::read_small;
use motet_project::{DOCUMENT, ProjectSession};
use motet_robots::scene::Scene;
use motet_syntax::{Severity, Source};

use crate::error::{CliError, Exit};
use crate::flags::{DiagnosticFormat, SessionArgs, SyntaxArg};
use crate::output::{Colors, note};
use crate::report::Report;

/// Maximum number of fixes to one plan.
const MOST_FIXES: usize = 32;

/// Flags of `motet dialog`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet dialog exchange.txt --robot hsr --scene kitchen\n  \
    motet dialog --write 'bring me the coke' --robot hsr --scene kitchen")]
pub(crate) struct DialogArgs {
    /// Text with `<user>` and `<robot>` tags, or a bare list of actions
    #[arg(value_name = "FILE", required_unless_present = "write")]
    file: Option<PathBuf>,
    /// Write the exchange for a request instead, with the plan of the built-in planner
    #[arg(long, value_name = "REQUEST", conflicts_with = "file")]
    write: Option<String>,
    #[command(flatten)]
    session: SessionArgs,
    /// Complete each plan with the steps that its actions need, as `motet check --fix --unsafe-fixes` does
    #[arg(long, conflicts_with = "write")]
    fix: bool,
    /// Syntax of the printed policy
    #[arg(long, value_enum, default_value = "text", value_name = "SYNTAX", conflicts_with = "write")]
    to: SyntaxArg,
}

/// Runs the command.
pub(crate) fn run(args: &DialogArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run_held(DiagnosticFormat::Human, colors, |report| converse(args, report))
}

fn converse(args: &DialogArgs, report: &mut Report) -> Result<Exit, CliError> {
    let mut project = args.session.project_here()?.open_with(report)?;
    let opened = project.session(report)?;
    match (&args.write, &args.file) {
        (Some(request), _) => write(request, opened, report),
        (None, Some(path)) => read(path, args, opened, report),
        (None, None) => Err(CliError::Message("give a file or --write REQUEST".to_owned())),
    }
}

/// Converts each plan of a dialogue to a policy and checks it. Questions of the robot are printed as notes.
fn read(
    path: &Path,
    args: &DialogArgs,
    opened: &ProjectSession,
    report: &mut Report,
) -> Result<Exit, CliError> {
    let bytes = read_small(path)?;
    let text = String::from_utf8_lossy(&bytes);
    let exchanges = if text.contains('<') {
        match exchange::read(&text) {
            Ok(exchanges) => exchanges,
            Err(why) => return Ok(refuse("", &why)),
        }
    } else {
        Vec::new()
    };
    if exchanges.is_empty() {
        return Ok(plan(&text, ("plan", ""), true, args, opened, report));
    }
    let is_only = exchanges.len() == 1;
    let mut exit = Exit::Success;
    for (index, exchange) in exchanges.iter().enumerate() {
        let (name, place) = (format!("exchange_{}", index + 1), format!("exchange {}", index + 1));
        if exchange.asks() {
            note(&format!("{place}: the robot asks: {}", exchange.robot));
            // The next exchange has the answer.
            if index + 1 == exchanges.len() {
                exit = Exit::Findings;
            }
        } else if plan(&exchange.robot, (&name, &place), is_only, args, opened, report) != Exit::Success {
            exit = Exit::Findings;
        }
    }
    Ok(exit)
}

/// Converts one list of actions to a policy. `place` names its exchange for people.
fn plan(
    list: &str,
    (name, place): (&str, &str),
    is_only: bool,
    args: &DialogArgs,
    opened: &ProjectSession,
    report: &mut Report,
) -> Exit {
    let empty = Scene::default();
    let known = Knowledge::of(opened.told_facts());
    let situation = known.situation(opened.scene.as_ref().unwrap_or(&empty));
    let loose = match actions::read(list, name, &opened.session, opened.robot.as_ref(), &situation) {
        Ok(loose) => loose,
        Err(why) => return refuse(place, &why),
    };
    let comma = if place.is_empty() { "" } else { ", " };
    loose.warnings.iter().for_each(|text| note(&format!("warning: {place}{comma}{text}")));
    let to = args.to;
    let mut source = Source::new("dialog.motet", loose.policy.as_str());
    if args.fix {
        let fixed = fix::fix(&opened.session, &source, DOCUMENT, FixLimits::all(MOST_FIXES));
        for fix in &fixed.applied {
            note(&format!("completed: {place}{comma}{}", fix.title));
        }
        source = Source::new("dialog.motet", fixed.text.as_str());
    }
    let parsed = motet_syntax::read(&source, DOCUMENT);
    let diagnostics = opened.session.check(&parsed);
    let is_wrong = diagnostics.iter().any(|found| found.severity == Severity::Error);
    report.print(&diagnostics, &opened.sources(source));
    match motet::document::write(&parsed, None, opened.session.library(), to.into()) {
        // Several JSON documents are printed on one line each.
        Ok(text) if to == SyntaxArg::Json && !is_only => {
            report.out.json_line(&text.lines().map(str::trim).collect::<Vec<_>>().join(" "));
        }
        Ok(text) => report.out.document(&format!("{}\n", text.trim_end()), to == SyntaxArg::Json),
        Err(why) => return refuse(place, &why),
    }
    if is_wrong { Exit::Findings } else { Exit::Success }
}

/// Writes the exchange for a request: the visible and the feasible of the objects that it names, and the
/// plan or a question.
fn write(request: &str, opened: &ProjectSession, report: &mut Report) -> Result<Exit, CliError> {
    let Some(robot) = &opened.robot else {
        return Err(CliError::Message("a plan needs a robot: give --robot NAME".to_owned()));
    };
    let scene = opened.scene.clone().unwrap_or_default();
    let known = Knowledge::of(opened.told_facts());
    let situation = known.situation(&scene);
    let named = motet_requests::named(request, &situation);
    // Each search has its own budget, so that the same request gives the same text.
    let seen = prompt::seen(&opened.session, robot, &scene, &named, Duration::MAX);
    let (vision, feasibility) = exchange::sight(&seen);
    let answer = builtin::answer(&opened.session, Some(robot), request, &situation);
    let mut exit = Exit::Success;
    let said = match answer {
        Ok(answered) => {
            let policy = answered.planned.parsed.file.policies().next();
            let (list, left_out) = policy.map(|policy| actions::write(policy, &scene)).unwrap_or_default();
            for what in left_out {
                note(&format!("the list leaves out {what}"));
            }
            list
        }
        Err(why) => {
            exit = Exit::Findings;
            Problem::of_planning(&why, &scene).question
        }
    };
    let exchange =
        Exchange { history: String::new(), user: request.to_owned(), vision, feasibility, robot: said };
    report.out.line(exchange.write().trim_end());
    Ok(exit)
}

fn refuse(place: &str, why: &impl std::fmt::Display) -> Exit {
    let colon = if place.is_empty() { "" } else { ": " };
    note(&format!("no policy: {place}{colon}{why}"));
    Exit::Findings
}
