//! `motet do`: carries out a request in simulation: plans, checks, runs, asks, and replans.

mod flags;
mod observer;
mod operator;
mod planner;
mod record;

use std::cell::RefCell;
use std::rc::Rc;

use motet_planner::Planner;
use motet_planner::dialogue::{Conversation, DialogueSetup, Outcome};
use motet_runtime::{Driver, Time};
use motet_sim::Sim;

use super::run;
use crate::error::{CliError, Exit};
use crate::flags::{DiagnosticFormat, OutputFormat};
use crate::output::{Colors, note};
use crate::report::Report;
use crate::runner::catch_interrupts;
pub(crate) use flags::DoArgs;
use observer::RunObserver;
use operator::{AskingDriver, OperatorInput, OperatorPrompt};
use record::ConversationRecord;

/// Runs the command.
pub(crate) fn run(args: &DoArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run_held(DiagnosticFormat::Human, colors, |report| plan_and_run(args, colors, report))
}

fn plan_and_run(args: &DoArgs, colors: Colors, report: &mut Report) -> Result<Exit, CliError> {
    let mut project = args.session.project().open_with(report)?;
    let opened = project.session(report)?;
    let Some(robot) = opened.robot.clone() else {
        return Err(CliError::Message("a request needs a robot: give --robot NAME".to_owned()));
    };
    let scene = opened.scene.clone().unwrap_or_default();
    let (domains, geometry) = (opened.domains.clone(), opened.geometry.clone());
    let eye = geometry.as_ref().and_then(|geometry| geometry.eye());
    let simulator = run::simulator((&robot, &opened.session), &scene, eye, &args.simulation, report)?;
    let operator = Rc::new(OperatorInput::read(&args.ask)?);
    let record = args.record.as_deref().map(ConversationRecord::create).transpose()?;
    let setting = DialogueSetup {
        robot,
        scene,
        domains,
        geometry,
        options: motet_compiler::CheckOptions { max_duration_secs: args.session.max_duration },
    };
    let mut planner = planner::planner(args, colors, record.clone())?;
    catch_interrupts()?;
    let outcome = carry_out(args, colors, &setting, &mut *planner, simulator, &operator, record)?;
    Ok(match &outcome {
        Outcome::Done => Exit::Success,
        Outcome::Stopped => Exit::Interrupted,
        Outcome::Declined(why) => {
            note(&format!("declined{}{why}", if why.is_empty() { "" } else { ": " }));
            Exit::Failed
        }
        Outcome::GivenUp => {
            note("given up");
            Exit::Failed
        }
        Outcome::Failed(problem) => {
            note(&format!("not done ({}): {}", problem.kind.name(), problem.question));
            Exit::Failed
        }
    })
}

fn carry_out(
    args: &DoArgs,
    colors: Colors,
    setting: &DialogueSetup,
    planner: &mut dyn Planner,
    simulator: Sim,
    operator: &Rc<OperatorInput>,
    record: Option<ConversationRecord>,
) -> Result<Outcome, CliError> {
    let mut conversation = Conversation::new(setting);
    let mut world = Rc::new(RefCell::new(simulator));
    let (mut sight, eyes) = (Rc::clone(&world), Rc::clone(&world));
    let mut robot = AskingDriver::new(&mut world, Rc::clone(operator), &setting.scene);
    let mut pointing;
    let driver: &mut dyn Driver = if args.model.camera {
        conversation = conversation.with_eyes(eyes);
        let is_shown = args.format == OutputFormat::Human;
        let log = observer::PointLog { is_shown, record: record.clone() };
        pointing = observer::pointing(&args.model, &mut robot, &mut sight, &setting.scene, log)?;
        &mut pointing
    } else {
        &mut robot
    };
    let mut observer = RunObserver::new(args, colors, Rc::clone(operator), record);
    let mut prompt = OperatorPrompt(Rc::clone(operator));
    observer.requested(&args.request);
    let (outcome, _) =
        conversation.carry_out(&args.request, planner, driver, &mut prompt, &mut observer, Time::ZERO);
    observer.finish(&outcome)?;
    Ok(outcome)
}
