//! `motet dialog`: plans in InteLiPlan's dialect read as policies, and exchanges in it written.

use std::path::Path;

use motet_planner::builtin;
use motet_planner::dialect::actions;
use motet_planner::dialect::exchange::{self, Exchange};
use motet_planner::prompt::Prompt;
use motet_planner::request::{self, Situation};
use motet_runtime::Time;
use motet_runtime::memory::{Limits, Memory};
use motet_syntax::ast::File;
use motet_syntax::{Form, Severity, Source};

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

/// Every plan of a dialogue as a policy, checked.
fn read(path: &Path, to: DialogForm, setting: &Setting, report: &mut Report) -> Result<Exit, Trouble> {
    let text = read_small(path)?;
    let text = String::from_utf8_lossy(text.as_ref()).into_owned();
    let lists: Vec<String> = if text.contains('<') {
        match exchange::read(&text) {
            Ok(exchanges) => exchanges.into_iter().map(|exchange| exchange.robot).collect(),
            Err(why) => return Ok(refuse(&why.to_string())),
        }
    } else {
        vec![text]
    };
    let nothing = motet_robots::scene::Scene::default();
    let situation = Situation::new(setting.scene.as_ref().unwrap_or(&nothing));
    let mut exit = Exit::Clean;
    for (index, list) in lists.iter().enumerate() {
        let name = format!("exchange_{}", index + 1);
        let loose = match actions::read(list, &name, &setting.session, setting.robot.as_ref(), &situation) {
            Ok(loose) => loose,
            Err(why) => {
                exit = refuse(&format!("exchange {}: {why}", index + 1));
                continue;
            }
        };
        loose.warnings.iter().for_each(|text| note(&format!("warning: {text}")));
        let source = Source::new("dialog.motet", loose.policy.as_str());
        let parsed = motet_syntax::read(&source, DOCUMENT);
        let said = setting.session.check(&parsed);
        if said.iter().any(|said| said.severity == Severity::Error) {
            exit = Exit::Findings;
        }
        report.say(&said, &setting.sources(source));
        let form = match to {
            DialogForm::Text => Form::Text,
            DialogForm::Json => Form::Json,
        };
        match form::write(&parsed, None, setting.session.library(), form) {
            Ok(text) => report.out.line(text.trim_end()),
            Err(why) => exit = refuse(&why),
        }
    }
    Ok(exit)
}

/// The exchange of a request: what is seen and feasible of what it names, and the plan for it, or the question that it raises.
fn write(request: &str, setting: &Setting, report: &mut Report) -> Result<Exit, Trouble> {
    let Some(robot) = &setting.robot else {
        return Err(Trouble::Other("a robot is needed to plan: give --robot NAME".to_owned()));
    };
    let scene = setting.scene.clone().unwrap_or_default();
    let situation = Situation::new(&scene);
    let mut memory = Memory::new(Limits::default());
    memory.instruct(Time::ZERO, request);
    let prompt = Prompt {
        session: &setting.session,
        robot,
        scene: &scene,
        situation: &situation,
        memory: &memory,
        tokens: motet_planner::prompt::TOKENS,
    };
    let seen = prompt.seen(&request::named(request, &situation));
    let vision: Vec<String> = seen
        .iter()
        .map(|one| {
            let word = match one.seen {
                Some(true) => "seen",
                Some(false) => "not seen",
                None => "unknown",
            };
            format!("{}: {word}", one.id)
        })
        .collect();
    let feasibility: Vec<String> = seen
        .iter()
        .map(|one| match &one.feasible {
            Ok(()) => format!("{}: feasible", one.id),
            Err(why) => format!("{}: infeasible ({why})", one.id),
        })
        .collect();
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
        Err(why) => why.to_string(),
    };
    let exchange = Exchange {
        history: String::new(),
        user: request.to_owned(),
        vision: vision.join(", "),
        feasibility: feasibility.join(", "),
        robot: said,
    };
    report.out.line(exchange.write().trim_end());
    Ok(Exit::Clean)
}

fn refuse(why: &str) -> Exit {
    note(&format!("no policy: {why}"));
    Exit::Findings
}
