//! Every reason for which a graph is refused, each by one change of a sound graph.

use motet_arbitrary::graph::vocabulary as v;
use motet_arbitrary::graph::{CallSketch, ReactionSketch, StepSketch, WatchSketch, graph};
use motet_graph::{
    BindingId, Comparison, Condition, Ending, Fact, FactArg, FailureId, FluentId, Graph, InitialFact, KindId,
    Manner, MeasureId, NodeId, NodeKind, PrimitiveId, Reaction, RegionId, ResourceId, Term, Type, Value,
    validate,
};

/// Nodes: 0 detect, 1 try, 2 pick, 3 replan, 4 monitor, 5 go, 6 say (block), 7 policy, 8 done, 9 parallel, 10
/// go, 11 say, 12 each, 13 go.
fn sound() -> Graph {
    let watch =
        WatchSketch { condition: v::nearer("user", 0.5), hold_secs: 0.2, react: ReactionSketch::Pause(60.0) };
    let block =
        WatchSketch::new(v::nearer("user", 0.2), ReactionSketch::Resume(1, vec![StepSketch::say("oh")]));
    graph(&[
        StepSketch::detect("mug"),
        StepSketch::Try(
            vec![StepSketch::Call(CallSketch::new(v::PICK, vec![CallSketch::NEAREST]))],
            vec![(Some(vec![v::UNREACHABLE]), vec![StepSketch::End(Ending::Replan)])],
        ),
        StepSketch::Monitor(vec![watch, block], vec![StepSketch::go("table")]),
        StepSketch::Inline(vec![StepSketch::End(Ending::Done)]),
        StepSketch::Parallel(vec![vec![StepSketch::go("shelf")], vec![StepSketch::say("hello")]]),
        StepSketch::Each(
            Term::List(vec![v::entity("cup")]),
            3,
            vec![StepSketch::Call(CallSketch::new(v::GO, vec![CallSketch::NEAREST]))],
        ),
    ])
}

/// The first finding after a change.
#[track_caller]
fn check(change: impl FnOnce(&mut Graph), expected: &str) {
    let mut graph = sound();
    change(&mut graph);
    let findings = validate(&graph).expect_err("the change must be noticed");
    let said: Vec<String> = findings.iter().map(ToString::to_string).collect();
    assert!(said.iter().any(|finding| finding == expected), "{said:#?}");
}

fn call(graph: &mut Graph, node: usize) -> &mut motet_graph::CallNode {
    match &mut graph.nodes[node].kind {
        NodeKind::Call(call) => call,
        other => panic!("{other:?} is no call"),
    }
}

fn watches(graph: &mut Graph) -> &mut Vec<motet_graph::Watch> {
    match &mut graph.nodes[4].kind {
        NodeKind::Monitor { watches, .. } => watches,
        other => panic!("{other:?} is no monitor"),
    }
}

fn wait(condition: Condition) -> NodeKind {
    NodeKind::Wait { condition, within_secs: 1.0 }
}

#[test]
fn sound_graph_is_valid() {
    assert_eq!(validate(&sound()), Ok(()));
}

#[test]
fn tables() {
    check(|g| g.failures[0] = "oops".into(), "failure 0: the first failure must be `timeout`");
    check(|g| g.kinds[0].parent = Some(KindId(1)), "kind 0: the kind `Entity` must come after its parent");
    check(|g| g.primitives[0].uses.push(ResourceId(9)), "primitive 0: resource 9 does not exist");
    check(|g| g.primitives[0].fails.push(FailureId(9)), "primitive 0: failure 9 does not exist");
    check(|g| g.bindings[0].ty = Type::Entity(KindId(9)), "binding 0: kind 9 does not exist");
    check(|g| g.resources[0].contains.push(ResourceId(9)), "resource 0: resource 9 does not exist");
    check(
        |g| g.resources = vec![g.resources[0].clone(); 129],
        "resources 128: 129 resources are more than the limit of 128",
    );
    check(
        |g| {
            g.initial.push(InitialFact {
                fact: v::fact(v::HOLDING, vec![Term::Binding(BindingId(0))]),
                value: true,
            })
        },
        "initial fact 1: the facts at the start must be made of literals",
    );
}

#[test]
fn regions_and_edges() {
    check(|g| g.regions[1].owner = None, "region 1: region 1 must have an owner");
    check(|g| g.regions[0].owner = Some(NodeId(1)), "region 0: region 0 must have no owner");
    check(
        |g| g.regions[1].owner = Some(NodeId(4)),
        "/steps/1: region 1 must be named exactly once, by the node that owns it",
    );
    check(|g| g.regions[1].entry = Some(NodeId(5)), "region 1: the edge to node 5 leaves the region");
    check(|g| g.nodes[0].next = Some(NodeId(2)), "/steps/0: the edge to node 2 leaves the region");
    check(|g| g.nodes[4].next = Some(NodeId(0)), "/steps/2: the edge to node 0 leads back");
    check(|g| g.nodes[4].next = Some(NodeId(99)), "/steps/2: node 99 does not exist");
    check(|g| g.nodes[0].next = Some(NodeId(4)), "/steps/2: more than one edge leads to the node");
    check(|g| g.nodes[0].next = None, "/steps/1: no edge leads to the node");
    check(|g| g.nodes[5].region = RegionId(99), "/steps/2/during/0: region 99 does not exist");
    check(
        |g| g.nodes[9].kind = NodeKind::Parallel { branches: vec![RegionId(99)] },
        "/steps/4: region 99 does not exist",
    );
}

#[test]
fn nesting() {
    let deep =
        |levels: usize| (0..levels).fold(StepSketch::say("a"), |inner, _| StepSketch::Sequence(vec![inner]));
    assert_eq!(validate(&graph(&[deep(1_024)])), Ok(()));
    let findings = validate(&graph(&[deep(1_025)])).unwrap_err();
    assert!(
        findings[0].to_string().ends_with("1025 levels of steps are more than the limit of 1024"),
        "{findings:?}"
    );
    let not = |levels: usize| {
        (0..levels).fold(Condition::Literal(true), |inner, _| Condition::Not(Box::new(inner)))
    };
    check(
        |g| g.nodes[13].kind = wait(not(49)),
        "/steps/5/steps/0: 49 levels of a condition or a term are more than the limit of 48",
    );
}

#[test]
fn endings() {
    let end = |how, of| NodeKind::End { how, of: Some(NodeId(of)), why: None };
    check(
        |g| g.nodes[3].kind = end(Ending::Done, 7),
        "/steps/1/catch/0/steps/0: the ending names node 7, which is no sub-policy around it",
    );
    check(
        |g| g.nodes[8].kind = end(Ending::Done, 1),
        "/steps/3:/steps/0: the ending names node 1, which is no sub-policy around it",
    );
    check(
        |g| g.nodes[8].kind = end(Ending::Replan, 7),
        "/steps/3:/steps/0: `replan` and `cannot` end the whole policy, not a sub-policy",
    );
    check(
        |g| watches(g)[0].reaction = Reaction::End { how: Ending::Done, of: Some(NodeId(7)), why: None },
        "/steps/2: the ending names node 7, which is no sub-policy around it",
    );
}

#[test]
fn numbers() {
    check(
        |g| call(g, 0).deadline_secs = f64::NAN,
        "/steps/0: the deadline is NaN, which is no finite number of at least 0",
    );
    check(
        |g| call(g, 0).deadline_secs = -1.0,
        "/steps/0: the deadline is -1, which is no finite number of at least 0",
    );
    for (part, shown) in [(0.0, "0"), (1.5, "1.5"), (f64::NAN, "NaN")] {
        check(
            |g| call(g, 0).manner = Some(Manner { speed: part, acceleration: 1.0 }),
            &format!("/steps/0: the part of the speed is {shown}, which is not above 0 and at most 1"),
        );
    }
    check(
        |g| call(g, 0).manner = Some(Manner { speed: 0.5, acceleration: -1.0 }),
        "/steps/0: the part of the acceleration is -1, which is not above 0 and at most 1",
    );
    check(
        |g| watches(g)[0].hold_secs = f64::INFINITY,
        "/steps/2: the time that a condition must hold is inf, which is no finite number of at least 0",
    );
    check(
        |g| watches(g)[0].reaction = Reaction::Pause { within_secs: -2.0 },
        "/steps/2: the longest pause is -2, which is no finite number of at least 0",
    );
    check(
        |g| g.observe_within_secs = -0.5,
        "policy: the time for an observation is -0.5, which is no finite number of at least 0",
    );
    check(
        |g| g.nodes[0].duration.least_secs = 11.0,
        "/steps/0: the least duration 11 s is above the greatest 10 s",
    );
    check(
        |g| {
            g.nodes[8].kind = NodeKind::End { how: Ending::Done, of: None, why: None };
            g.nodes[7].kind = NodeKind::Repeat { times: 0, body: g.nodes[8].region, until: None };
        },
        "/steps/3: a loop must run at least once",
    );
}

#[test]
fn calls() {
    check(|g| call(g, 5).primitive = PrimitiveId(9), "/steps/2/during/0: primitive 9 does not exist");
    check(|g| call(g, 5).args.clear(), "/steps/2/during/0: `go` takes 1 arguments, not 0");
    check(
        |g| call(g, 5).args[0] = v::text("there"),
        "/steps/2/during/0: argument 1 of `go` has the wrong type",
    );
    // A person is an entity, but no object.
    check(
        |g| {
            g.bindings[0].ty = Type::Entity(v::PERSON);
            g.primitives[3].result = Some(Type::Entity(v::PERSON));
        },
        "/steps/1/try/0: argument 1 of `pick` has the wrong type",
    );
    check(
        |g| call(g, 0).binds = None,
        "/steps/0: the call of `detect` must bind its result, and only its result",
    );
    check(
        |g| call(g, 5).binds = Some(BindingId(0)),
        "/steps/2/during/0: the call of `go` must bind its result, and only its result",
    );
    check(|g| call(g, 0).binds = Some(BindingId(9)), "/steps/0: binding 9 does not exist");
    check(|g| g.bindings[0].ty = Type::Text, "/steps/0: `it'0` cannot hold the value that is bound to it");
    check(|g| call(g, 2).needs[0].failure = FailureId(9), "/steps/1/try/0: failure 9 does not exist");
    check(
        |g| call(g, 2).effects[0].fact.args[0] = FactArg::Term(Term::Each),
        "/steps/1/try/0: the variable of `for each` is used where nothing is quantified",
    );
    check(|g| call(g, 2).effects[0].each = Some(KindId(9)), "/steps/1/try/0: kind 9 does not exist");
    check(|g| call(g, 2).effects[0].fact.fluent = FluentId(9), "/steps/1/try/0: fluent 9 does not exist");
    check(|g| call(g, 2).effects[0].fact.args.clear(), "/steps/1/try/0: `holding` takes 1 arguments, not 0");
}

#[test]
fn conditions() {
    let at = 13;
    let path = "/steps/5/steps/0";
    let compare = |comparison, left, right| wait(Condition::Compare(comparison, left, right));
    let number = || Term::Literal(Value::Number(1.0));
    let refuse = |kind: NodeKind, said: &str| check(|g| g.nodes[at].kind = kind, &format!("{path}: {said}"));
    refuse(
        compare(Comparison::Less, v::text("a"), number()),
        "the two sides of a comparison do not fit each other",
    );
    refuse(
        compare(Comparison::Equal, v::entity("mug"), v::text("mug")),
        "the two sides of a comparison do not fit each other",
    );
    refuse(
        compare(Comparison::Less, v::entity("mug"), v::entity("cup")),
        "the two sides of a comparison do not fit each other",
    );
    refuse(
        compare(
            Comparison::Less,
            Term::Arith(motet_graph::Arithmetic::Add, Box::new(v::text("a")), Box::new(number())),
            number(),
        ),
        "arithmetic needs numbers",
    );
    refuse(
        compare(Comparison::Less, Term::Field(Box::new(number()), "mass".into()), number()),
        "only an entity has the field `mass`",
    );
    refuse(
        compare(Comparison::Less, Term::Measure(MeasureId(9), vec![]), number()),
        "measure 9 does not exist",
    );
    let field = Term::Field(Box::new(v::entity("mug")), "owner".into());
    refuse(
        wait(Condition::Fact(Fact { fluent: v::HOLDING, args: vec![FactArg::Term(field)] })),
        "an argument of a fluent, a measure or a field must be known without observing",
    );
    refuse(
        compare(Comparison::Less, Term::Literal(Value::Number(f64::NAN)), number()),
        "a literal is NaN, which is no finite number",
    );
}

#[test]
fn loops_and_handlers() {
    check(
        |g| {
            if let NodeKind::Each { list, .. } = &mut g.nodes[12].kind {
                *list = v::entity("cup");
            }
        },
        "/steps/5: a loop, a count and a first element need a list",
    );
    check(
        |g| {
            if let NodeKind::Each { list, .. } = &mut g.nodes[12].kind {
                *list = Term::List(vec![v::text("cup")]);
            }
        },
        "/steps/5: `item'1` cannot hold the value that is bound to it",
    );
    check(
        |g| {
            if let NodeKind::Try { handlers, .. } = &mut g.nodes[1].kind {
                handlers[0].on = Some(vec![FailureId(9)]);
            }
        },
        "/steps/1: failure 9 does not exist",
    );
}

#[test]
fn bindings() {
    // The loop's item is not bound outside of the loop.
    check(
        |g| call(g, 5).args[0] = Term::Binding(BindingId(1)),
        "/steps/2/during/0: `item'1` is used before it is bound",
    );
    check(
        |g| call(g, 0).args[0] = Term::Binding(BindingId(0)),
        "/steps/0: `it'0` is used before it is bound",
    );
}

/// Nodes: 0 try, 1 detect, 2 detect (handler), 3 pick of what either found.
fn either() -> Graph {
    let pick = StepSketch::Call(CallSketch::new(v::PICK, vec![CallSketch::NEAREST]));
    let handler = (None, vec![StepSketch::detect("cup")]);
    graph(&[StepSketch::Try(vec![StepSketch::detect("mug")], vec![handler]), pick])
}

#[test]
fn bindings_of_several_ways() {
    let graph = either();
    assert_eq!(validate(&graph), Ok(()));
    assert_eq!(call(&mut either(), 3).args[0], Term::Binding(BindingId(0)));
    let unbound = Some("/steps/1: `it'0` is used before it is bound".to_owned());
    let said = |change: &dyn Fn(&mut Graph)| {
        let mut graph = graph.clone();
        change(&mut graph);
        let findings = validate(&graph).err().unwrap_or_default();
        // The contract of `pick` mentions the object several times.
        findings.first().map(ToString::to_string)
    };
    let say = NodeKind::Call(call(&mut self::graph(&[StepSketch::say("no")]), 0).clone());
    let end = |how| NodeKind::End { how, of: None, why: None };
    for node in [1, 2] {
        assert_eq!(said(&|g| g.nodes[node].kind = say.clone()), unbound);
        assert_eq!(said(&|g| g.nodes[node].kind = end(Ending::Replan)), None);
    }
    // The other way ends a sub-policy, which goes on behind it.
    let handler = (None, vec![StepSketch::End(Ending::Done)]);
    let pick = StepSketch::Call(CallSketch::new(v::PICK, vec![Term::Binding(BindingId(0))]));
    let inside = StepSketch::Try(vec![StepSketch::detect("mug")], vec![handler]);
    let part = self::graph(&[StepSketch::Inline(vec![inside.clone(), pick.clone()])]);
    assert_eq!(validate(&part), Ok(()));
    let part = self::graph(&[StepSketch::Inline(vec![inside]), pick.clone()]);
    let findings = validate(&part).unwrap_err();
    assert_eq!(Some(findings[0].to_string()), unbound);
    // A body that binds and never goes on leaves the handlers.
    let body = vec![StepSketch::End(Ending::Fail)];
    let handler = (None, vec![StepSketch::detect("mug")]);
    assert_eq!(validate(&self::graph(&[StepSketch::Try(body, vec![handler]), pick])), Ok(()));
}

#[test]
fn bindings_of_what_may_not_run() {
    let pick = StepSketch::Call(CallSketch::new(v::PICK, vec![Term::Binding(BindingId(0))]));
    let detect = || vec![StepSketch::detect("mug")];
    let near = || v::nearer("user", 0.5);
    let done = |before: Vec<StepSketch>| {
        let done = [before, vec![StepSketch::End(Ending::Done)]].concat();
        StepSketch::If(near(), done, None)
    };
    let bound = [
        StepSketch::Sequence(detect()),
        StepSketch::Repeat(2, detect(), None),
        StepSketch::Monitor(vec![WatchSketch::new(near(), ReactionSketch::Pause(1.0))], detect()),
        StepSketch::Parallel(vec![detect(), vec![StepSketch::say("oh")]]),
        // The way that is left with `done`, or the end, has bound it.
        StepSketch::Inline(detect()),
        StepSketch::Inline([detect(), vec![StepSketch::End(Ending::Done)]].concat()),
        StepSketch::Inline([detect(), vec![done(vec![StepSketch::say("oh")])]].concat()),
        StepSketch::Inline(vec![StepSketch::If(near(), vec![StepSketch::End(Ending::Fail)], Some(detect()))]),
    ];
    for step in bound {
        assert_eq!(validate(&graph(&[step.clone(), pick.clone()])), Ok(()), "{step:?}");
    }
    let resume = WatchSketch::new(near(), ReactionSketch::Resume(1, detect()));
    let unbound = [
        StepSketch::If(near(), detect(), None),
        StepSketch::If(near(), detect(), Some(Vec::new())),
        StepSketch::Monitor(vec![resume], vec![StepSketch::say("oh")]),
        // A way that is done before.
        StepSketch::Inline([vec![done(vec![])], detect()].concat()),
        StepSketch::Inline([vec![done(vec![StepSketch::say("oh")])], detect()].concat()),
    ];
    for step in unbound {
        let findings = validate(&graph(&[step.clone(), pick.clone()])).unwrap_err();
        assert_eq!(findings[0].to_string(), "/steps/1: `it'0` is used before it is bound", "{step:?}");
    }
    // A loop over a list binds its item first.
    let pick = StepSketch::Call(CallSketch::new(v::PICK, vec![Term::Binding(BindingId(1))]));
    let each = StepSketch::Each(Term::List(vec![v::entity("cup")]), 3, detect());
    let findings = validate(&graph(&[each, pick])).unwrap_err();
    assert_eq!(findings[0].to_string(), "/steps/1: `it'1` is used before it is bound");
}

#[test]
fn resources() {
    // A `go` in the second branch needs the base of the first.
    check(
        |g| {
            let go = g.nodes[10].kind.clone();
            g.nodes[11].kind = go;
        },
        "/steps/4: two branches need `base` at the same time",
    );
    // `pick` needs the arm, which contains the camera that `detect` needs.
    check(
        |g| {
            g.nodes[10].kind = g.nodes[2].kind.clone();
            g.nodes[11].kind = g.nodes[0].kind.clone();
        },
        "/steps/4: two branches need `camera` at the same time",
    );
}

#[test]
fn hundred_findings_are_enough() {
    let mut graph = graph(&vec![StepSketch::go("table"); 500]);
    for node in &mut graph.nodes {
        node.duration.least_secs = -1.0;
    }
    assert_eq!(validate(&graph).unwrap_err().len(), 100);
}

#[test]
fn failures_results_and_goals() {
    use motet_arbitrary::graph::with_named_failures;
    use motet_graph::{FailureId, FailureSentence};
    let handler = (None, vec![StepSketch::say("oh")]);
    let tried = StepSketch::Try(vec![StepSketch::go("table")], vec![handler]);
    let named = || with_named_failures(graph(&[tried.clone(), StepSketch::say("behind")]));
    assert_eq!(validate(&named()), Ok(()));
    let refused = |change: &dyn Fn(&mut Graph), expected: &str| {
        let mut graph = named();
        change(&mut graph);
        assert_eq!(validate(&graph).unwrap_err()[0].to_string(), expected);
    };
    // What the handler is given is not known behind it.
    let args = |graph: &Graph, node: usize| match &graph.nodes[node].kind {
        NodeKind::Call(call) => call.args.clone(),
        kind => panic!("{kind:?}"),
    };
    refused(
        &|graph| {
            let said = args(graph, 2);
            if let NodeKind::Call(call) = &mut graph.nodes[3].kind {
                call.args = said;
            }
        },
        "/steps/1: `failure'1` is used before it is bound",
    );
    refused(
        &|graph| graph.bindings[0].ty = Type::Text,
        "/steps/0: `kind'0` cannot hold the value that is bound to it",
    );
    refused(
        &|graph| graph.sentences = vec![FailureSentence { failure: FailureId(9), text: "oh".into() }],
        "sentence 0: failure 9 does not exist",
    );
    refused(&|graph| graph.result = Some(BindingId(9)), "result 0: binding 9 does not exist");
    let unbound = Condition::Fact(v::fact(v::HOLDING, vec![Term::Binding(BindingId(1))]));
    refused(
        &|graph| graph.goal = vec![unbound.clone()],
        "/achieves: argument 1 of `holding` has the wrong type",
    );
}
