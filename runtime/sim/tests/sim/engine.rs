//! A graph through the engine and the simulator.

use crate::sim;
use motet_graph::{
    Binding, BindingId, CallNode, DurationBounds, FailureId, Graph, Kind, KindId, Node, NodeId, NodeKind,
    Primitive, PrimitiveId, ROOT, Region, Term, Type, Value,
};
use motet_runtime::{Engine, RunEnd, StartState, Time, run};
use motet_sim::{Faults, SimOptions};

/// A policy of calls, one after the other: primitive, arguments, and whether it binds `found`, which `None`
/// names.
fn policy(calls: &[(&str, &[(&str, Option<Value>)])], retries: u32) -> Graph {
    let span = DurationBounds { least_secs: 0.0, greatest_secs: 300.0 };
    let object = Type::Entity(KindId(1));
    let ty = |value: &Option<Value>| match value {
        Some(Value::Text(_)) => Type::Text,
        Some(_) => Type::Entity(KindId(0)),
        None => object.clone(),
    };
    let kind = |name: &str, parent| Kind { name: name.into(), parent };
    let failures = ["timeout", "failed", "not_found", "unreachable", "blocked", "slipped"];
    let primitives = calls.iter().map(|(name, args)| Primitive {
        name: (*name).into(),
        params: args
            .iter()
            .map(|(name, value)| motet_graph::Param { name: (*name).into(), ty: ty(value), default: None })
            .collect(),
        result: (*name == "detect").then(|| object.clone()),
        perceives: *name == "detect",
        uses: [].into(),
        fails: (0..failures.len() as u32).map(FailureId).collect(),
    });
    let nodes = calls.iter().enumerate().map(|(index, (name, args))| Node {
        path: format!("/steps/{index}").into(),
        region: ROOT,
        next: (index + 1 < calls.len()).then_some(NodeId(index as u32 + 1)),
        duration: span,
        kind: NodeKind::Call(CallNode {
            primitive: PrimitiveId(index as u32),
            args: args
                .iter()
                .map(|(_, value)| value.clone().map_or(Term::Binding(BindingId(0)), Term::Literal))
                .collect(),
            binds: (*name == "detect").then_some(BindingId(0)),
            manner: None,
            deadline_secs: 60.0,
            retries,
            needs: Vec::new(),
            motion: None,
            effects: Vec::new(),
            unsettles: Vec::new(),
            lasts: None,
        }),
    });
    Graph {
        names: Vec::new(),
        entities: Vec::new(),
        sentences: Vec::new(),
        result: None,
        goal: Vec::new(),
        hands: Vec::new(),
        policy: "fetch".into(),
        robot: "hsr".into(),
        kinds: vec![kind("Entity", None), kind("Object", Some(KindId(0)))],
        fluents: Vec::new(),
        measures: Vec::new(),
        primitives: primitives.collect(),
        failures: failures.map(Into::into).to_vec(),
        resources: Vec::new(),
        bindings: vec![Binding { name: "found".into(), ty: object.clone(), given: false, among: Vec::new() }],
        nodes: nodes.collect(),
        regions: vec![Region { owner: None, entry: Some(NodeId(0)) }],
        initial: Vec::new(),
        observe_within_secs: 0.3,
        duration: DurationBounds { least_secs: 0.0, greatest_secs: 5000.0 },
    }
}

fn entity(id: &str) -> Option<Value> {
    Some(Value::Entity(id.into()))
}

fn fetch(faults: &str, retries: u32) -> (RunEnd, motet_sim::Sim) {
    let what = Some(Value::Text("red mug".into()));
    let graph = policy(
        &[
            ("go", &[("to", entity("kitchen_table"))]),
            ("detect", &[("what", what)]),
            ("pick", &[("object", None)]),
            ("go", &[("to", entity("user"))]),
            ("handover", &[("object", None), ("to", entity("user"))]),
        ],
        retries,
    );
    let mut engine = Engine::new(graph, &StartState::default()).unwrap();
    let options = SimOptions { faults: Faults::from_json(faults).unwrap(), ..SimOptions::default() };
    let mut sim = sim("hsr", "kitchen", options);
    let end = run(&mut engine, &mut sim, &mut (), Time::ZERO);
    (end, sim)
}

#[test]
fn sim_policy_runs_to_its_goal() {
    let (end, sim) = fetch("{}", 0);
    assert_eq!(end, RunEnd::Done { why: None, result: None });
    assert_eq!(sim.holds("at", &["mug_1", "user"]), Some(true));
    assert!((20.0..90.0).contains(&sim.now().secs()), "{}", sim.now());
}

#[test]
fn sim_retry_gets_over_a_fault() {
    let slips = r#"{"calls": [{"primitive": "pick", "nth": 1, "then": {"fails": "slipped"}}]}"#;
    assert!(matches!(fetch(slips, 0).0, RunEnd::Failed { kind, .. } if kind == "slipped"));
    assert_eq!(fetch(slips, 1).0, RunEnd::Done { why: None, result: None });
}

#[test]
fn sim_deadline_ends_what_hangs() {
    let hangs = r#"{"calls": [{"primitive": "pick", "then": "hangs"}]}"#;
    assert!(matches!(fetch(hangs, 0).0, RunEnd::Failed { kind, .. } if kind == "timeout"));
}
