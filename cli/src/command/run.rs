//! `motet run`: checks a policy and runs it in simulation, with or without a journal.

mod branch;
mod drive;
mod events;
mod export;
mod faults;
mod lines;
mod made_up;
mod pace;
mod play;
mod resume;
mod saved;
mod saved_guard;
mod screen;
mod tree;
mod view;
mod world;

use std::path::Path;

use motet_compiler::Session;
use motet_graph::Graph;
use motet_planner::runtime_check::Guard;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::{Driver, EngineSettings, Event, StartState, Time};
use motet_sim::{Faults, Sim, SimOptions};
use motet_syntax::{Parsed, Severity};

use crate::args::{Format, RunArgs, RunFormat, SimulatedArgs, Speed};
use crate::document;
use crate::exit::{Exit, Trouble};
use crate::input::one_document;
use crate::out::{Colors, note};
use crate::report::Report;
use crate::workbench::{Setting, Workbench, wanted_robot};
use play::Play;
use saved::Saved;
use saved_guard::SavedGuard;
use view::Clock;
use world::Choices;

pub(crate) use drive::run as drive;
pub(crate) use export::mcap;
pub(crate) use pace::{Pace, catch_interrupts, is_interrupted};
pub(super) use play::{head, journal_trouble};

/// Runs the command.
///
/// # Errors
///
/// The file cannot be read, or what it runs against cannot be used.
pub(crate) fn run(args: &RunArgs, colors: Colors) -> Result<Exit, Trouble> {
    let mut report = Report::new(form_of(args.format), colors);
    let result = match (&args.resume, &args.file) {
        (Some(folder), _) => resume::resume(folder, args, colors),
        (None, Some(file)) => check_and_run(file, args, colors, &mut report),
        (None, None) => Err(Trouble::Other("a policy is needed".to_owned())),
    };
    report.close(result)
}

fn check_and_run(file: &Path, args: &RunArgs, colors: Colors, report: &mut Report) -> Result<Exit, Trouble> {
    let mut bench = Workbench::open(&args.world, report)?;
    let choices = Choices::read(args, report)?;
    let policy = args.policy.as_deref();
    let Some((graph, parsed, setting)) = compile(file, policy, args.format, &mut bench, report)? else {
        return Ok(Exit::Findings);
    };
    let (Some(robot), Some(card)) = (&setting.robot, &setting.card) else {
        return Err(no_robot(wanted_robot(&parsed.file)));
    };
    choices.fit(&setting.session.signatures())?;
    let files: Vec<_> = setting.domains.iter().chain([&parsed.file]).collect();
    let options = choices.options(&graph, &files);
    let start = start(setting.scene.as_ref());
    let scene = setting.scene.clone().unwrap_or_default();
    let mut simulator = Sim::new(robot, &scene, options.clone());
    let verifies = args.simulated.speed.verifies();
    let guard = setting.session.course().map(|course| Guard::new(course, verifies));
    let engine =
        play::engine(graph, &start, simulator.capabilities(), guard.as_ref(), EngineSettings::default())?;
    let journal = match &args.record {
        Some(folder) => {
            let saved = Saved::simulator(
                card,
                setting.scene_text.clone(),
                &options,
                SavedGuard::of(&args.world, setting),
            );
            Some(play::journal(folder, &engine, &start, &saved)?)
        }
        None => None,
    };
    let view = play::view(args.format, engine.graph(), colors, Clock::Simulated);
    let pace = Pace::new(view, args.simulated.speed).with_guard(guard);
    let play = Play { engine, driver: &mut simulator, journal, from: Time::ZERO, events: vec![Event::Begin] };
    Ok(play::exit(&play.run(pace)?))
}

/// Reads and compiles a policy, and says what the check says. None where it is refused.
fn compile<'b>(
    file: &Path,
    policy: Option<&str>,
    format: RunFormat,
    bench: &'b mut Workbench,
    report: &mut Report,
) -> Result<Option<(Graph, Parsed, &'b Setting)>, Trouble> {
    let (source, parsed) = document::read(&one_document(file)?);
    let setting = bench.setting(&parsed.file, report)?;
    let compiled = setting.session.compile(&parsed, policy);
    let sources = setting.sources(source);
    match format {
        RunFormat::Human => report.say(&compiled.diagnostics, &sources),
        RunFormat::Json => events::diagnostics(&compiled.diagnostics, &sources, &mut report.out),
    }
    if let Some(graph) = compiled.graph {
        return Ok(Some((graph, parsed, setting)));
    }
    let errors = compiled.diagnostics.iter().filter(|said| said.severity == Severity::Error).count();
    note(&format!("refused: {}, nothing has moved", crate::out::count(errors, "error")));
    Ok(None)
}

/// The form of diagnostics that goes with the form of a run.
const fn form_of(format: RunFormat) -> Format {
    match format {
        RunFormat::Human => Format::Human,
        RunFormat::Json => Format::Json,
    }
}

/// What is known at the start beside what stands in the graph: which entities there are.
fn start(scene: Option<&Scene>) -> StartState {
    let entities = scene.iter().flat_map(|scene| &scene.entities);
    StartState {
        entities: entities.map(|(id, entity)| (id.clone(), entity.kind.clone())).collect(),
        ..StartState::default()
    }
}

fn no_robot(wanted: Option<String>) -> Trouble {
    match wanted {
        Some(name) => Trouble::Unknown {
            what: "built-in robot",
            name,
            help: "give the folder of its card with --robot FOLDER".to_owned(),
        },
        None => Trouble::Other(
            "a robot is needed to run a policy: give --robot NAME, or write `for NAME` after the policy's name".to_owned(),
        ),
    }
}

/// What shows and paces the run of a graph, for other commands that run policies.
pub(super) fn stage(format: RunFormat, graph: &Graph, colors: Colors, speed: Speed) -> Pace {
    Pace::new(play::view(format, graph, colors, Clock::Simulated), speed)
}

/// A simulated room, for other commands that run policies, with the camera in the base's frame where that is known. Faults
/// may name what a session of the robot knows in that room.
///
/// # Errors
///
/// The faults cannot be read, have a mistake, or name what is not there.
pub(super) fn simulator(
    (robot, session): (&Robot, &Session),
    scene: &Scene,
    eye: Option<[f64; 3]>,
    args: &SimulatedArgs,
    report: &mut Report,
) -> Result<Sim, Trouble> {
    let faults = match &args.faults {
        Some(path) => {
            let (there, _) = session.elsewhere(Some(scene), None);
            world::fitting_faults(path, &there.signatures(), report)?
        }
        None => Faults::default(),
    };
    Ok(Sim::new(robot, scene, SimOptions { seed: args.seed, faults, eye, ..SimOptions::default() }))
}
