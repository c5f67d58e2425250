//! A conversation with a robot on any driver: `motet do` is one of a single request, `motet talk` one of
//! many.

mod flags;
mod observer;
pub(crate) mod operator;
mod planner;
mod record;
pub(crate) mod words;

use std::rc::Rc;

use motet::driver_camera::DriverCamera;
use motet::run::run_id;
use motet_planner::dialogue::{Conversation, Outcome};
use motet_project::SavedProject;
use motet_runtime::{Driver, Time};
use serde_json::json;

pub(crate) use flags::ConversationArgs;
use observer::RunObserver;
use operator::{OperatorAnswers, OperatorInput, OperatorPrompt};
use record::ConversationRecord;

use crate::error::{CliError, Exit};
use crate::flags::OutputFormat;
use crate::interrupt::{guard_runs, is_interrupted};
use crate::output::queue::WhenFull;
use crate::output::{Colors, escape, note};
use crate::questions::{QuestionDriver, jumps};
use crate::ready_driver::{ReadyDriver, RunSubject, open_driver};
use crate::report::Report;
use crate::swap_checker::dialogue_setup;
use crate::view::live::LivePage;

/// Carries out one request, or without one every line of a person until there are no more.
pub(crate) fn converse(
    request: Option<&str>,
    args: &ConversationArgs,
    colors: Colors,
    report: &mut Report,
) -> Result<Exit, CliError> {
    args.driver.refuse_flags()?;
    let mut project = args.session.project_here()?.open_with(report)?;
    let opened = project.session(report)?;
    let Some(setup) = dialogue_setup(opened) else {
        return Err(CliError::Message("a request needs a robot: give --robot NAME".to_owned()));
    };
    let takes: &[&str] = match args.ask.first().map(String::as_str) {
        None | Some("terminal") => &["stop", "hold", "answer", "say"],
        Some(_) => &["stop", "hold"],
    };
    let page = LivePage::shared(&args.page, opened, takes)?;
    let operator = Rc::new(OperatorInput::read(&args.ask, args.words.live, page.as_ref())?);
    let mut prompt = OperatorPrompt { input: Rc::clone(&operator), page: page.clone() };
    let record = args.record.as_deref().map(ConversationRecord::create).transpose()?;
    if let (Some(record), Some(project)) = (&record, SavedProject::of(opened)) {
        record.write("opened", json!({"project": project}));
    }
    let run = run_id();
    let subject = RunSubject { run: &run, policy: None, opened };
    let ready = open_driver(&args.driver, &args.session.environment, &subject, report)?;
    if args.model.camera && !ready.driver.capabilities().look {
        return Err(CliError::Message("--camera needs a driver that takes pictures".to_owned()));
    }
    let mut planner = planner::planner(args, ready.speed, setup.options, colors, record.clone())?;
    let is_simulated = matches!(ready.eyes, DriverCamera::Simulator(_));
    guard_runs(if is_simulated { WhenFull::Wait } else { WhenFull::GoOn })?;
    let ReadyDriver { mut driver, eyes, saved, clock, speed, settings } = ready;
    let mut talk = Conversation::new(&setup).with_runs(&run, settings, args.on_instruction.into());
    talk.tell(opened.told_facts());
    let mut asking;
    // The simulated person of a script answers the questions of policies.
    let robot: &mut dyn Driver = if args.driver.answers.is_none() {
        let answers = OperatorAnswers { operator: prompt.clone(), scene: &setup.scene };
        asking = QuestionDriver::new(&mut *driver, answers, Time::ZERO, jumps(speed, clock));
        &mut asking
    } else {
        &mut *driver
    };
    let mut sight;
    let mut pointing;
    let task = Rc::default();
    let robot: &mut dyn Driver = if args.model.camera {
        talk = talk.with_eyes(eyes.clone());
        sight = eyes;
        let is_shown = args.format == OutputFormat::Human;
        let log = observer::PointLog { is_shown, record: record.clone() };
        pointing = observer::pointing(&args.model, robot, &mut sight, &setup.scene, (log, Rc::clone(&task)))?;
        &mut pointing
    } else {
        robot
    };
    let mut observer =
        RunObserver::new(args, colors, (clock, speed), Rc::clone(&operator), record).with_task(task);
    observer.page.clone_from(&page);
    // What a model saw in pictures is in no journal.
    let saved = saved.filter(|_| !args.model.camera);
    observer.driver = saved.map(|saved| saved.with_person(args.driver.answers.is_none()));
    let mut now = Time::ZERO;
    let mut exit = Exit::Success;
    let mut next = request.map(ToOwned::to_owned);
    loop {
        let line = match next.take() {
            Some(line) => line,
            None if request.is_some() => break,
            None => match next_line(&operator, robot, &mut now) {
                Some(line) => line,
                None => break,
            },
        };
        observer.requested(&line);
        if request.is_none() && idle_words(&line, &mut talk, &mut observer) {
            continue;
        }
        let (outcome, after) = talk.carry_out(&line, &mut *planner, robot, &mut prompt, &mut observer, now);
        now = after;
        observer.outcome(&outcome);
        exit = exit.or_worse(exit_of(&outcome));
    }
    if observer.is_unanswered {
        exit = exit.or_worse(Exit::Failed);
    }
    let is_done = request.is_some() && exit == Exit::Success;
    if is_interrupted() && !is_done {
        exit = if observer.is_unstopped { Exit::Failed } else { Exit::Interrupted };
    }
    observer.finish()?;
    page.iter().for_each(|page| page.borrow_mut().finish());
    Ok(exit)
}

/// Next line of the person, or words that the driver heard. The driver is looked after meanwhile.
fn next_line(operator: &OperatorInput, robot: &mut dyn Driver, now: &mut Time) -> Option<String> {
    operator.prompt();
    let line = operator.line(&mut || {
        *now = robot.rest(*now);
        robot.heard().map(|heard| heard.text.to_string())
    })?;
    if !operator.is_echoed() {
        note(&format!("> {}", escape(&line)));
    }
    Some(line)
}

/// Takes in a line that asks for nothing: a statement, or words for a moving robot while none moves.
fn idle_words(line: &str, talk: &mut Conversation<'_>, observer: &mut RunObserver<'_>) -> bool {
    let is_control =
        motet_requests::stops(line) || motet_requests::holds(line) || motet_requests::proceeds(line);
    if is_control {
        observer.say(line, "I am not moving.");
    } else if talk.note(line) {
        observer.say(line, "I take note of that.");
    } else {
        return false;
    }
    true
}

/// Exit code of an outcome, whose reason is printed.
fn exit_of(outcome: &Outcome) -> Exit {
    match outcome {
        Outcome::Done => return Exit::Success,
        Outcome::Stopped if is_interrupted() => return Exit::Interrupted,
        Outcome::Stopped => note("stopped"),
        Outcome::Declined(why) => {
            note(&format!("declined{}{}", if why.is_empty() { "" } else { ": " }, escape(why)));
        }
        Outcome::GivenUp => note("given up"),
        Outcome::Failed(problem) => {
            note(&format!("not done ({}): {}", problem.kind.name(), escape(&problem.question)));
        }
    }
    Exit::Failed
}
