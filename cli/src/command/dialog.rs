//! `motet dialog`: plans in InteLiPlan's dialect read as policies, and exchanges in it written.

use std::path::Path;
use std::time::Duration;

use motet_planner::builtin;
use motet_planner::dialect::actions;
use motet_planner::dialect::exchange::{self, Exchange};
use motet_planner::dialogue::Problem;
use motet_planner::prompt;
use motet_requests::RequestContext;
use motet_robots::scene::Scene;
use motet_syntax::ast::File;
use motet_syntax::{Severity, Source, Syntax};

use crate::args::{DialogArgs, DialogForm, Format};
use crate::exit::{Exit, Trouble};
use crate::form;
use crate::input::read_small;
use crate::out::{Colors, note};
use crate::report::Report;
use crate::workbench::{DOCUMENT, Setting, Workbench};

/// Runs the command.
///
/// # Errors
///
/// The file, the robot or the scene cannot be used.
pub(crate) fn run(args: &DialogArgs, colors: Colors) -> Result<Exit, Trouble> {
    let mut report = Report::new(Format::Human, colors);
    report.hold();
    let result = converse(args, &mut report);
    report.close(result)
}

fn converse(args: &DialogArgs, report: &mut Report) -> Result<Exit, Trouble> {
    let mut bench = Workbench::open(&args.world, report)?;
    let setting = bench.setting(&File::default(), report)?;
    match (&args.write, &args.file) {
        (Some(request), _) => write(request, setting, report),
        (None, Some(path)) => read(path, args.to, setting, report),
        (None, None) => Err(Trouble::Other("a file or --write REQUEST is needed".to_owned())),
    }
}

/// Every plan of a dialogue as a policy, checked. What the robot only asks is said.
fn read(path: &Path, to: DialogForm, setting: &Setting, report: &mut Report) -> Result<Exit, Trouble> {
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
        return Ok(plan(&text, "plan", "", true, to, setting, report));
    }
    let is_only = exchanges.len() == 1;
    let mut exit = Exit::Clean;
    for (index, exchange) in exchanges.iter().enumerate() {
        let (name, place) = (format!("exchange_{}", index + 1), format!("exchange {}", index + 1));
        if exchange.asks() {
            note(&format!("{place}: the robot asks: {}", exchange.robot));
        } else if plan(&exchange.robot, &name, &place, is_only, to, setting, report) != Exit::Clean {
            exit = Exit::Findings;
        }
    }
    Ok(exit)
}

/// One list of actions as a policy; `place` says where it stands, for people.
fn plan(
    list: &str,
    name: &str,
    place: &str,
    is_only: bool,
    to: DialogForm,
    setting: &Setting,
    report: &mut Report,
) -> Exit {
    let nothing = Scene::default();
    let situation = RequestContext::new(setting.scene.as_ref().unwrap_or(&nothing));
    let loose = match actions::read(list, name, &setting.session, setting.robot.as_ref(), &situation) {
        Ok(loose) => loose,
        Err(why) => return refuse(place, &why),
    };
    let comma = if place.is_empty() { "" } else { ", " };
    loose.warnings.iter().for_each(|text| note(&format!("warning: {place}{comma}{text}")));
    let source = Source::new("dialog.motet", loose.policy.as_str());
    let parsed = motet_syntax::read(&source, DOCUMENT);
    let said = setting.session.check(&parsed);
    let is_wrong = said.iter().any(|said| said.severity == Severity::Error);
    report.say(&said, &setting.sources(source));
    let form = match to {
        DialogForm::Text => Syntax::Text,
        DialogForm::Json => Syntax::Json,
    };
    match form::write(&parsed, None, setting.session.library(), form) {
        // Of several JSON documents each is a line.
        Ok(text) if to == DialogForm::Json && !is_only => {
            report.out.line(&text.lines().map(str::trim).collect::<Vec<_>>().join(" "));
        }
        Ok(text) => report.out.line(text.trim_end()),
        Err(why) => return refuse(place, &why),
    }
    if is_wrong { Exit::Findings } else { Exit::Clean }
}

/// The exchange of a request: what is seen and feasible of what it names, and the plan for it, or the question that it raises.
fn write(request: &str, setting: &Setting, report: &mut Report) -> Result<Exit, Trouble> {
    let Some(robot) = &setting.robot else {
        return Err(Trouble::Other("a robot is needed to plan: give --robot NAME".to_owned()));
    };
    let scene = setting.scene.clone().unwrap_or_default();
    let situation = RequestContext::new(&scene);
    let named = motet_requests::named(request, &situation);
    // The dialect's texts tell what numbers tell, and no more than that.
    let seen = prompt::seen(&setting.session, robot, &scene, &named, Duration::ZERO);
    let (vision, feasibility) = exchange::sight(&seen);
    let answer = builtin::answer(&setting.session, Some(robot), request, &situation);
    let said = match answer {
        Ok(answered) => {
            let policy = answered.planned.parsed.file.policies().next();
            let (list, left_out) = policy.map(|policy| actions::write(policy, &scene)).unwrap_or_default();
            for what in left_out {
                note(&format!("left out of the list: {what}"));
            }
            list
        }
        Err(why) => Problem::of_planning(&why, &scene).question,
    };
    let exchange =
        Exchange { history: String::new(), user: request.to_owned(), vision, feasibility, robot: said };
    report.out.line(exchange.write().trim_end());
    Ok(Exit::Clean)
}

fn refuse(place: &str, why: &impl std::fmt::Display) -> Exit {
    let colon = if place.is_empty() { "" } else { ": " };
    note(&format!("no policy: {place}{colon}{why}"));
    Exit::Findings
}
