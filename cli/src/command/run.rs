//! `motet run`: checks a policy and runs it in simulation, with or without a journal.

mod branch;
mod events;
mod lines;
mod pace;
mod play;
mod resume;
mod saved;
mod screen;
mod tree;
mod view;
mod world;

use std::path::Path;

use motet_host::journal::Writer;
use motet_robots::scene::Scene;
use motet_runtime::journal::Head;
use motet_runtime::{Driver, Engine, Event, StartState, Time};
use motet_sim::Sim;
use motet_syntax::Severity;

use crate::args::{Format, RunArgs, RunFormat};
use crate::document;
use crate::exit::{Exit, Trouble};
use crate::input::one_document;
use crate::out::{Colors, note};
use crate::report::Report;
use crate::workbench::{Workbench, wanted_robot};
use pace::Pace;
use play::Play;
use saved::Saved;
use world::Choices;

pub(super) use play::journal_trouble;

/// Runs the command.
///
/// # Errors
///
/// The file cannot be read, or what it runs against cannot be used.
pub(crate) fn run(args: &RunArgs, colors: Colors) -> Result<Exit, Trouble> {
    let format = match args.format {
        RunFormat::Human => Format::Human,
        RunFormat::Json => Format::Json,
    };
    let mut report = Report::new(format, colors);
    let result = match (&args.resume, &args.file) {
        (Some(folder), _) => resume::resume(folder, args, colors),
        (None, Some(file)) => check_and_run(file, args, colors, &mut report),
        (None, None) => Err(Trouble::Other("a policy is needed".to_owned())),
    };
    report.close(result)
}

fn check_and_run(file: &Path, args: &RunArgs, colors: Colors, report: &mut Report) -> Result<Exit, Trouble> {
    let (source, parsed) = document::read(&one_document(file)?);
    let mut bench = Workbench::open(&args.world, report)?;
    let setting = bench.setting(&parsed.file, report)?;
    let choices = Choices::read(args, report)?;
    let compiled = setting.session.compile(&parsed, args.policy.as_deref());
    let sources = setting.sources(source);
    match args.format {
        RunFormat::Human => report.say(&compiled.diagnostics, &sources),
        RunFormat::Json => events::diagnostics(&compiled.diagnostics, &sources, &mut report.out),
    }
    let Some(graph) = compiled.graph else {
        let errors = compiled.diagnostics.iter().filter(|said| said.severity == Severity::Error).count();
        note(&format!("refused: {}, nothing has moved", crate::out::count(errors, "error")));
        return Ok(Exit::Findings);
    };
    let (Some(robot), Some(card)) = (&setting.robot, &setting.card) else {
        return Err(no_robot(wanted_robot(&parsed.file)));
    };
    let files: Vec<_> = setting.domains.iter().chain([&parsed.file]).collect();
    let options = choices.options(&graph, &files);
    let start = start(setting.scene.as_ref());
    let scene = setting.scene.clone().unwrap_or_default();
    let mut simulator = Sim::new(robot, &scene, options.clone());
    let capabilities = simulator.capabilities();
    let engine = Engine::new(graph, &start).map_err(|wrong| {
        let first = wrong.first().map_or_else(String::new, |wrong| format!(": {wrong}"));
        Trouble::Other(format!("the compiled graph is not valid{first}"))
    })?;
    let engine = engine.with_capabilities(capabilities.clone());
    let journal = match &args.record {
        Some(folder) => {
            let saved = Saved::simulator(card, setting.scene_text.clone(), &options);
            let mut head = Head::new(engine.graph());
            head.began_unix_ns = play::unix_ns();
            head.start = (&start).into();
            head.capabilities = (&capabilities).into();
            head.driver = saved.to_json()?;
            Some(Writer::create(folder, head).map_err(play::journal_trouble)?)
        }
        None => None,
    };
    let view = play::view(args.format, engine.graph(), colors);
    let pace = Pace::new(view, args.speed);
    let play = Play { engine, driver: &mut simulator, journal, from: Time::ZERO, events: vec![Event::Begin] };
    Ok(play::exit(&play.run(pace)?))
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
