//! On top of a driver that loses, doubles, delays and swaps reports, refuses, and falls silent, the engine
//! keeps its promises: nothing is started twice or beside what it conflicts with, and every run ends.

use motet_runtime::conformance::{EngineGuarantees, FaultRates, FaultyDriver};
use motet_runtime::{Driver, Engine, RunEnd, StartState, Time, run};
use motet_sim::{Sim, SimOptions};
use motet_syntax::{FileId, Source, Sources};
use motet_tests::setup;
use std::collections::BTreeMap;
use std::path::Path;

/// The examples for the HSR in the kitchen, compiled.
fn graphs() -> Vec<motet_graph::Graph> {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "motet"));
    paths.sort();
    let texts = paths.iter().map(|path| std::fs::read_to_string(path).unwrap());
    let compiled = texts.filter(|text| text.contains("Robot hsr, scene kitchen.")).map(|text| {
        let parsed = motet_syntax::read(&Source::new("example.motet", text), FileId(0));
        session.compile(&parsed, None).graph.unwrap()
    });
    compiled.collect()
}

#[test]
fn engine_on_any_driver_the_engine_keeps_its_promises() {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let graphs = graphs();
    assert!(graphs.len() > 3, "{}", graphs.len());
    let late = Time::from_secs(8.0);
    let some = FaultRates {
        loses: 30,
        doubles: 100,
        delays: 200,
        late,
        reorders: 100,
        refuses: 30,
        deaf: 20,
        ..FaultRates::default()
    };
    let mild = FaultRates { doubles: 200, delays: 100, late, reorders: 200, ..FaultRates::default() };
    let silent = FaultRates { silence: 50, ..some };
    let (mut ends, mut starts) = (BTreeMap::<&str, u32>::new(), 0);
    for seed in 0..60_u64 {
        for (graph, mischief) in graphs.iter().flat_map(|graph| [mild, some, silent].map(|of| (graph, of))) {
            let sim = Sim::new(&robot, &scene, SimOptions { seed, ..SimOptions::default() });
            let mut driver = FaultyDriver::new(sim, mischief, seed);
            let engine = Engine::new(graph.clone(), &StartState::default()).unwrap();
            let mut engine = engine.with_capabilities(driver.capabilities());
            let mut promises = EngineGuarantees::new(graph);
            let end = run(&mut engine, &mut driver, &mut promises, Time::ZERO);
            assert_eq!(promises.broken(), [""; 0], "{}, seed {seed}, {mischief:?}", graph.policy);
            starts += promises.starts();
            let name = match end {
                RunEnd::Done { .. } => "done",
                RunEnd::Failed { .. } => "failed",
                RunEnd::Declined { .. } => "declined",
                RunEnd::Replan { .. } => "replan",
                RunEnd::Interrupted => "interrupted",
                RunEnd::Fault(_) => "fault",
            };
            *ends.entry(name).or_default() += 1;
        }
    }
    assert!(starts > 1_000 && ends.len() >= 3, "the mischief is of several kinds: {starts} starts, {ends:?}");
}
