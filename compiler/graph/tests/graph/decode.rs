//! Documents that are no graph are refused with a clear word.

use motet_arbitrary::graph::{ReactionSketch, StepSketch, WatchSketch, graph, vocabulary as v};
use motet_graph::{
    Arithmetic, Clearance, Comparison, Condition, Configuration, Ending, Fact, FactArg, Graph, Grasp,
    InitialFact, Motion, NodeKind, Pose, Term, Unsettled, Value, Verdict, Waypoint, Witness, decode, draw,
    encode, hash,
};

#[track_caller]
fn refuse(text: &str, expected: &str) {
    let error = decode(text).expect_err("it must be refused").to_string();
    assert!(error.starts_with(expected), "{error}");
}

fn document() -> String {
    encode(&graph(&[StepSketch::go("table")]))
}

#[test]
fn forms() {
    refuse("", "no graph: EOF while parsing a value at line 1 column 0");
    refuse("[]", "no graph: ");
    refuse("{}", "no graph: missing field `motet_graph`");
    refuse("{\"motet_graph\": 1}", "the graph has version 1; this program reads version 6");
    refuse("{\"motet_graph\": 6}", "no graph: missing field `policy`");
    refuse(&document().replacen("\"policy\"", "\"polcy\"", 1), "no graph: unknown field `polcy`");
    refuse(&document().replacen("\"retries\"", "\"x\":1,\"retries\"", 1), "no graph: unknown field `x`");
    refuse(
        &document().replacen("\"robot\"", "\"policy\":\"b\",\"robot\"", 1),
        "no graph: duplicate field `policy`",
    );
    refuse(&format!("{} {{}}", document()), "no graph: trailing characters");
    refuse(&"[".repeat(100_000), "no graph: ");
    refuse(
        &document().replace("table", "shelf"),
        "the graph was changed after it was written: its hash is sha256:",
    );
    refuse(
        &" ".repeat(64 * 1024 * 1024 + 1),
        "the graph has 67108865 bytes, more than the limit of 67108864",
    );
}

#[test]
fn hash_stands_in_the_document() {
    let graph = graph(&[StepSketch::go("table")]);
    assert!(encode(&graph).starts_with(&format!("{{\"motet_graph\":6,\"hash\":\"{}\",", hash(&graph))));
}

#[test]
fn deepest_graph_can_be_written_read_and_drawn() {
    let deep = (0..1_024).fold(StepSketch::say("a"), |inner, _| StepSketch::Sequence(vec![inner]));
    let graph = graph(&[deep]);
    assert_eq!(decode(&encode(&graph)).unwrap(), graph);
    assert!(draw::text(&graph).lines().count() > 1_000);
    assert!(draw::dot(&graph).lines().count() > 1_000);
    assert!(draw::mermaid(&graph).lines().count() > 1_000);
}

/// A graph with every kind of node and of value.
fn sample() -> Graph {
    let near = || v::nearer("user", 1.5);
    let holding = |of: &str| Condition::Fact(v::fact(v::HOLDING, vec![v::entity(of)]));
    let mut graph = graph(&[
        StepSketch::detect("mug"),
        StepSketch::Sequence(vec![StepSketch::go("table"), StepSketch::pick("mug")]),
        StepSketch::Inline(vec![StepSketch::End(Ending::Done)]),
        StepSketch::If(
            Condition::All(vec![near(), Condition::Not(Box::new(holding("mug")))]),
            vec![StepSketch::say("yes")],
            Some(vec![StepSketch::Wait(Condition::AnyOf(vec![near(), Condition::Literal(true)]), 2.5)]),
        ),
        StepSketch::Monitor(
            vec![
                WatchSketch::new(near(), ReactionSketch::Pause(3.0)),
                WatchSketch::new(near(), ReactionSketch::Restart(2)),
                WatchSketch::new(near(), ReactionSketch::Resume(1, vec![StepSketch::say("wait")])),
                WatchSketch::new(near(), ReactionSketch::End(Ending::Replan)),
            ],
            vec![StepSketch::go("user")],
        ),
        StepSketch::Try(
            vec![StepSketch::go("shelf")],
            vec![(Some(vec![v::UNREACHABLE]), vec![StepSketch::say("no")]), (None, vec![])],
        ),
        StepSketch::Repeat(3, vec![StepSketch::say("again")], Some(near())),
        StepSketch::Each(Term::List(vec![v::entity("mug")]), 4, vec![StepSketch::say("one")]),
        StepSketch::Parallel(vec![vec![StepSketch::say("a")], vec![StepSketch::go("table")]]),
        StepSketch::End(Ending::Fail),
    ]);
    let pose = Value::Pose(Pose { xyz: [1.0, -0.5, 0.25], quaternion: [0.0, 0.0, 0.0, 1.0] });
    let values =
        vec![Value::Bool(true), Value::Int(-3), Value::Number(0.1), pose, Value::Case("left".into())];
    let fact = v::fact(v::TRUSTED, vec![Term::Literal(Value::List(values))]);
    graph.initial.push(InitialFact { fact, value: true });
    graph.bindings[0].given = true;
    let calls = graph.nodes.iter_mut().filter_map(|node| match &mut node.kind {
        NodeKind::Call(call) => Some(call),
        _ => None,
    });
    for (call, verdict) in calls.zip([Verdict::Proven, Verdict::Deferred]) {
        let is_proven = verdict == Verdict::Proven;
        call.motion = Some(Motion {
            query: "reach".into(),
            args: vec![v::entity("mug"), Term::Each, Term::Field(Box::new(v::entity("mug")), "width".into())],
            verdict,
            witness: is_proven.then(|| {
                Box::new(Witness {
                    joints: vec!["arm_lift".into()],
                    path: vec![Waypoint { base: [0.0, 1.0, 2.0], joints: vec![0.5], at: 0.0, ramp: 0.0 }],
                    grasp: Some(Grasp {
                        xyz: [0.1; 3],
                        quaternion: [0.0, 0.0, 0.0, 1.0],
                        width: 0.08,
                        object: None,
                    }),
                    clearance: 0.02,
                    keeps: Clearance { base: 0.04, arm: 0.01 },
                    limit: Some(0.1),
                    payload: None,
                })
            }),
            leaves: is_proven.then(|| {
                Box::new(Configuration { base: [0.0, 1.0, 2.0], joints: [("arm_lift".into(), 0.1)].into() })
            }),
            why: (!is_proven).then(|| "the pose is not known".into()),
        });
        let when = Some(Condition::Compare(
            Comparison::AtLeast,
            Term::Arith(Arithmetic::Add, Box::new(Term::Literal(Value::Int(1))), Box::new(Term::Each)),
            Term::Literal(Value::Number(2.5)),
        ));
        call.unsettles.push(Unsettled {
            fact: Fact { fluent: v::AT, args: vec![FactArg::Any, FactArg::Term(Term::Each)] },
            when,
            each: Some(v::OBJECT),
        });
    }
    graph
}

#[test]
fn encoding_keeps_its_bytes() {
    insta::assert_snapshot!(encode(&sample()).replace(",\"", ",\n\""));
}
