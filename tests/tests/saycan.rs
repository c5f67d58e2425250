//! The SayCan plans, turned into policies and scenes, check, compile and run to their goals in simulation.

#![allow(clippy::print_stdout, reason = "a skipped test says so")]

use std::path::Path;

use motet_runtime::{Engine, RunEnd, StartState, Time};
use motet_sim::{Options, Sim};
use motet_syntax::{Severity, Source, Sources};
use motet_tests::saycan::Row;
use motet_tests::setup;

/// Beside the checkout, where the reference data is kept.
const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/saycan/saycan.jsonl");

fn run(row: &Row) -> Result<(), String> {
    let robot = setup::robot("hsr");
    let scene = setup::scene_from(&row.id, &row.scene());
    let mut sources = Sources::default();
    let (session, said) = setup::session(Some(&robot), Some(&scene), &mut sources);
    if let Some(wrong) = said.first() {
        return Err(format!("{} {}", wrong.code, wrong.message));
    }
    let source = Source::new(row.id.as_str(), row.policy());
    let id = sources.add(source.clone());
    let compiled = session.compile(&motet_syntax::read(&source, id), None);
    if let Some(wrong) = compiled.diagnostics.iter().find(|said| said.severity == Severity::Error) {
        return Err(format!("{} {}", wrong.code, wrong.message));
    }
    let graph = compiled.graph.ok_or("no graph")?;
    let entities = scene.entities.values().map(|entity| (entity.id.clone(), entity.kind.clone())).collect();
    let start = StartState { facts: Vec::new(), entities };
    let mut engine = Engine::new(graph, &start).map_err(|wrong| format!("{wrong:?}"))?;
    let mut sim = Sim::new(&robot, &scene, Options::default());
    let end = motet_runtime::run(&mut engine, &mut sim, &mut (), Time::ZERO);
    if !matches!(end, RunEnd::Done { .. }) {
        return Err(format!("ended in {end:?}"));
    }
    if row.reached(|fluent, args| sim.holds(fluent, args) == Some(true)) {
        Ok(())
    } else {
        Err("goal missed".into())
    }
}

#[test]
fn every_plan_reaches_its_goal() {
    if !Path::new(DATA).exists() {
        println!("skipped: {DATA} is not there");
        return;
    }
    let text = std::fs::read_to_string(DATA).unwrap();
    let rows: Vec<_> = text.lines().map(|line| Row::read(line).unwrap()).collect();
    assert!(rows.len() >= 50, "the file holds {} rows", rows.len());
    let wrong: Vec<_> =
        rows.iter().filter_map(|row| run(row).err().map(|why| format!("{}: {why}", row.id))).collect();
    assert!(wrong.is_empty(), "{} of {} rows: {wrong:#?}", wrong.len(), rows.len());
}

#[test]
fn a_plan_for_an_object_that_is_not_there_is_refused_before_it_runs() {
    let row = r#"{"id": "made-up", "instruction": "Bring me the banana.", "robot_start": {"at": "user", "holding": null},
        "scene": {"apple": "table"}, "expected_plan": [{"op": "go", "args": ["table"]}, {"op": "pick", "args": ["banana"]}],
        "goal": [["holding", "banana"]]}"#;
    let why = run(&Row::read(row).unwrap()).unwrap_err();
    assert!(why.starts_with("M0202"), "{why}");
}
