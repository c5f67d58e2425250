//! `motet run`: checks a policy and runs it in simulation.

mod branch;
mod events;
mod lines;
mod pace;
mod screen;
mod tree;
mod view;
mod world;

use std::io::{self, IsTerminal};
use std::sync::Arc;

use motet_graph::Graph;
use motet_robots::scene::Scene;
use motet_runtime::{Engine, RunEnd, StartState, Time};
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
use view::View;
use world::Choices;

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
    let result = check_and_run(args, colors, &mut report);
    report.close(result)
}

fn check_and_run(args: &RunArgs, colors: Colors, report: &mut Report) -> Result<Exit, Trouble> {
    let (source, parsed) = document::read(&one_document(&args.file)?);
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
    let Some(robot) = &setting.robot else {
        return Err(no_robot(wanted_robot(&parsed.file)));
    };
    let scene = setting.scene.as_ref();
    let files: Vec<_> = setting.domains.iter().chain([&parsed.file]).collect();
    let simulator = choices.simulator(robot, scene, &graph, &files);
    let end = simulate(args, colors, graph, scene, simulator)?;
    Ok(match end {
        RunEnd::Done { .. } => Exit::Clean,
        RunEnd::Failed { .. } | RunEnd::Replan { .. } | RunEnd::Fault(_) => Exit::Failed,
        RunEnd::Interrupted => Exit::Interrupted,
    })
}

fn simulate(
    args: &RunArgs,
    colors: Colors,
    graph: Graph,
    scene: Option<&Scene>,
    mut simulator: Sim,
) -> Result<RunEnd, Trouble> {
    let mut engine = Engine::new(graph.clone(), &start(scene)).map_err(|wrong| {
        let first = wrong.first().map_or_else(String::new, |wrong| format!(": {wrong}"));
        Trouble::Other(format!("the compiled graph is not valid{first}"))
    })?;
    let graph = Arc::new(graph);
    let view: Box<dyn View> = match args.format {
        RunFormat::Json => Box::new(events::Events::new(graph)),
        RunFormat::Human if io::stdout().is_terminal() => Box::new(screen::Screen::new(graph, colors.stdout)),
        RunFormat::Human => Box::new(lines::Lines::new(graph, colors.stdout)),
    };
    pace::catch_interrupts()?;
    let mut pace = Pace::new(view, args.speed);
    let end = motet_runtime::run(&mut engine, &mut simulator, &mut pace, Time::ZERO);
    pace.finish(&end);
    Ok(end)
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
