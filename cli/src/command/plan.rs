//! `motet plan`: a policy for a request or a goal, by the planner that needs no model.

use motet_compiler::plan::{Goal, Lasts, NoPlan};
use motet_planner::builtin::{self, PlanError};
use motet_requests::{Aim, RequestContext};
use motet_robots::scene::Scene;
use motet_syntax::ast::File;
use motet_syntax::{Source, Syntax};

use crate::args::{Format, PlanArgs, PlanForm};
use crate::exit::{Exit, Trouble};
use crate::form;
use crate::out::{Colors, note};
use crate::report::Report;
use crate::workbench::Workbench;

/// Runs the command.
///
/// # Errors
///
/// What it plans for cannot be used.
pub(crate) fn run(args: &PlanArgs, colors: Colors) -> Result<Exit, Trouble> {
    let mut report = Report::new(Format::Human, colors);
    report.hold();
    let result = plan(args, &mut report);
    report.close(result)
}

fn plan(args: &PlanArgs, report: &mut Report) -> Result<Exit, Trouble> {
    let mut bench = Workbench::open(&args.world, report)?;
    let setting = bench.setting(&File::default(), report)?;
    let robot = setting.robot.as_ref();
    let planned = match &args.request {
        Some(request) => {
            let nothing = Scene::default();
            let situation = RequestContext::new(setting.scene.as_ref().unwrap_or(&nothing));
            builtin::answer(&setting.session, robot, request, &situation).map(|answered| {
                answered.understood.notes.iter().for_each(|text| note(text));
                answered.planned
            })
        }
        None => goals(&args.goal)
            .map_err(PlanError::from)
            .and_then(|aims| builtin::plan(&setting.session, robot, "plan", &aims)),
    };
    match planned {
        Ok(planned) => {
            let sources = setting.sources(Source::new("plan.motet", planned.text.as_str()));
            report.say(&planned.compiled.diagnostics, &sources);
            let form = match args.to {
                PlanForm::Text => Syntax::Text,
                PlanForm::Json => Syntax::Json,
            };
            match form::write(&planned.parsed, None, setting.session.library(), form) {
                Ok(text) => report.out.line(text.trim_end()),
                Err(why) => return Ok(refuse(&why.to_string())),
            }
            Ok(Exit::Clean)
        }
        Err(PlanError::NoPlan(NoPlan::Wrong { diagnostics })) => {
            for said in &diagnostics {
                note(&format!("{}: {}", said.code, said.message));
            }
            Ok(Exit::Findings)
        }
        Err(why) => Ok(refuse(&why.to_string())),
    }
}

fn goals(texts: &[String]) -> Result<Vec<Aim>, NoPlan> {
    let aim = |(index, text): (usize, &String)| {
        let goal = Goal::read(text, Lasts::ToTheEnd)?;
        Ok(Aim { goal, name: format!("goal_{}", index + 1), only_if: None })
    };
    texts.iter().enumerate().map(aim).collect()
}

fn refuse(why: &str) -> Exit {
    note(&format!("no plan: {why}"));
    Exit::Findings
}
