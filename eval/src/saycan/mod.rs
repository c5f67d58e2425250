//! SayCan: the expected plan of an instruction is checked, compiled and run in simulation, and has to reach
//! its goal.

pub mod planned;
pub mod row;

use std::time::{Duration, Instant};

use motet_graph::Graph;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::{Engine, RunEnd, StartState, Time};
use motet_sim::{Sim, SimOptions};
use motet_syntax::{Severity, Source, Sources};

use row::Row;

use crate::{Judged, setup};

/// Judges a line: every plan of these rows is right.
///
/// # Errors
///
/// Where the line is no such row.
pub fn judge(line: &str) -> Result<Judged, String> {
    let row = Row::read(line).map_err(|error| error.to_string())?;
    let (end, took) = run(&row);
    Ok(Judged {
        expected_error: false,
        found_error: end.is_err(),
        class: None,
        step: None,
        took,
        group: None,
        note: end.err(),
        id: row.id,
    })
}

/// Runs a row to its goal, or to what stops it; and how long reading and compiling took.
pub fn run(row: &Row) -> (Result<(), String>, Duration) {
    let robot = setup::robot("hsr");
    let scene = setup::scene_from(&row.id, &row.scene());
    let mut sources = Sources::default();
    let (session, said) = setup::session(Some(&robot), Some(&scene), &mut sources);
    if let Some(wrong) = said.first() {
        return (Err(format!("{} {}", wrong.code, wrong.message)), Duration::ZERO);
    }
    let source = Source::new(row.id.as_str(), row.policy());
    let id = sources.add(source.clone());
    let begin = Instant::now();
    let compiled = session.compile(&motet_syntax::read(&source, id), None);
    let took = begin.elapsed();
    let end = || {
        if let Some(wrong) = compiled.diagnostics.iter().find(|said| said.severity == Severity::Error) {
            return Err(format!("{} {}", wrong.code, wrong.message));
        }
        let graph = compiled.graph.ok_or("no graph")?;
        let sim = simulate(graph, &robot, &scene)?;
        let reached = row.reached(|fluent, args| sim.holds(fluent, args) == Some(true));
        reached.then_some(()).ok_or_else(|| "goal missed".to_owned())
    };
    (end(), took)
}

/// The world at the end of a policy that was run in simulation.
fn simulate(graph: Graph, robot: &Robot, scene: &Scene) -> Result<Sim, String> {
    let entities = scene.entities.values().map(|entity| (entity.id.clone(), entity.kind.clone()));
    let start = StartState { entities: entities.collect(), ..StartState::default() };
    let mut engine = Engine::new(graph, &start).map_err(|wrong| format!("{wrong:?}"))?;
    let mut sim = Sim::new(robot, scene, SimOptions::default());
    match motet_runtime::run(&mut engine, &mut sim, &mut (), Time::ZERO) {
        RunEnd::Done { .. } => Ok(sim),
        end => Err(format!("ended in {end:?}")),
    }
}
