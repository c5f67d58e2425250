//! Wire forms lose nothing, and the same value gives the same bytes.

use motet_graph::{Manner, NodeId, Pose, Value};
use motet_runtime::{
    Answer, CheckId, Command, DeferredMotion, DriverEvent, Effect, EndCause, Event, FailureReport, Fault,
    GoalId, NodeEnding, Outcome, Pattern, PendingCleanup, PerceivedFact, Query, RunEnd, Time, TraceEvent,
    TraceEventKind, Truth, Verification, journal,
};
use proptest::collection::vec;
use proptest::prelude::*;
use std::sync::Arc;

/// There and back: the same bytes, and the same value where numbers can be compared.
macro_rules! there_and_back {
    ($model:ty, $value:expr) => {{
        let value: $model = $value;
        let json = serde_json::to_string(&value).unwrap();
        let back: $model = serde_json::from_str(&json).unwrap();
        assert_eq!(format!("{value:?}"), format!("{back:?}"));
        assert_eq!(json, serde_json::to_string(&back).unwrap());
        json
    }};
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<u64>().prop_map(f64::from_bits),
        prop_oneof![Just(-0.0), Just(f64::NAN), Just(f64::INFINITY), Just(f64::NEG_INFINITY), Just(0.1)],
        any::<i32>().prop_map(f64::from),
    ]
    // One NaN is as good as another.
    .prop_map(|number| if number.is_nan() { f64::NAN } else { number })
}

fn value() -> impl Strategy<Value = Value> {
    let leaf = prop_oneof![
        any::<bool>().prop_map(Value::Bool),
        any::<i64>().prop_map(Value::Int),
        number().prop_map(Value::Number),
        any::<String>().prop_map(|text| Value::Text(text.into())),
        any::<String>().prop_map(|text| Value::Entity(text.into())),
        any::<String>().prop_map(|text| Value::Case(text.into())),
        vec(number(), 7).prop_map(|n| {
            Value::Pose(Pose { xyz: [n[0], n[1], n[2]], quaternion: [n[3], n[4], n[5], n[6]] })
        }),
    ];
    leaf.prop_recursive(3, 12, 4, |inner| vec(inner, 0..4).prop_map(Value::List))
}

fn query() -> impl Strategy<Value = Query> {
    let text = || any::<String>().prop_map(smol_str::SmolStr::from);
    let pattern = prop_oneof![Just(Pattern::Any), value().prop_map(Pattern::Is)];
    prop_oneof![
        (text(), vec(pattern, 0..3)).prop_map(|(fluent, args)| Query::Fact { fluent, args }),
        (text(), vec(value(), 0..3)).prop_map(|(measure, args)| Query::Measure { measure, args }),
        (text(), text()).prop_map(|(entity, field)| Query::Field { entity, field }),
    ]
}

fn failure() -> impl Strategy<Value = FailureReport> {
    (any::<String>(), proptest::option::of(any::<String>()))
        .prop_map(|(kind, text)| FailureReport { kind: kind.into(), text: text.map(Into::into) })
}

fn driver_event() -> impl Strategy<Value = DriverEvent> {
    let goal = || any::<u64>().prop_map(GoalId::from_number);
    let outcome = prop_oneof![
        proptest::option::of(value()).prop_map(Outcome::Success),
        failure().prop_map(Outcome::Failure),
        Just(Outcome::Interrupted),
    ];
    let answer = prop_oneof![
        Just(Answer::Unknown),
        any::<bool>().prop_map(Answer::Truth),
        value().prop_map(Answer::Value)
    ];
    prop_oneof![
        goal().prop_map(|goal| DriverEvent::Acknowledged { goal }),
        (goal(), failure()).prop_map(|(goal, failure)| DriverEvent::Refused { goal, failure }),
        (goal(), outcome).prop_map(|(goal, outcome)| DriverEvent::Ended { goal, outcome }),
        goal().prop_map(|goal| DriverEvent::NotHeld { goal }),
        (goal(), ".{0,8}", any::<bool>()).prop_map(|(goal, text, own_motion)| {
            DriverEvent::Feedback { goal, text: text.into(), own_motion }
        }),
        goal().prop_map(|goal| DriverEvent::Stopped { goal }),
        goal().prop_map(|goal| DriverEvent::Lost { goal }),
        Just(DriverEvent::DriverLost),
        Just(DriverEvent::DriverGone),
        (query(), answer).prop_map(|(query, answer)| DriverEvent::Observed { query, answer }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn wire_events(event in driver_event()) {
        there_and_back!(Event, Event::Driver(event));
    }

    #[test]
    fn wire_starts(
        (goal, node, deadline) in any::<(u64, u32, u64)>(),
        args in vec((any::<String>(), value()), 0..4),
        manner in proptest::option::of((0.01..1.0, 0.01..1.0)),
    ) {
        let command = Command {
            primitive: "pick".into(),
            args: args.into_iter().map(|(name, value)| (name.into(), value)).collect(),
            uses: ["hand".into()].into(),
            manner: manner.map(|(speed, acceleration)| Manner { speed, acceleration }),
            deadline_secs: 20.1,
            motions: Vec::new(),
            leaves: None,
        };
        let (goal, node, command) = (GoalId::from_number(goal), NodeId(node), Arc::new(command));
        let deadline = Time::from_nanos(deadline);
        let start = Effect::Start { goal, node, command: Arc::clone(&command), deadline };
        there_and_back!(Effect, start);
        there_and_back!(Effect, Effect::Update { goal, node, command, deadline });
    }

    #[test]
    fn wire_motions(args in vec(value(), 0..3), check: u64, why: String) {
        let (primitive, uses) = ("pick".into(), [].into());
        let (manner, motions, leaves) = (None, Vec::new(), None);
        let command =
            Command { primitive, args: Vec::new(), uses, manner, deadline_secs: 20.1, motions, leaves };
        let motion = Arc::new(DeferredMotion { query: "reach".into(), args, command: Arc::new(command) });
        let check = CheckId::from_number(check);
        there_and_back!(Effect, Effect::Verify { check, node: NodeId(3), motion });
        let why = smol_str::SmolStr::from(why);
        for verdict in [
            Verification::Feasible { witness: None, leaves: None },
            Verification::Infeasible { failure: "unreachable".into(), why: why.clone() },
            Verification::Unknown { why },
        ] {
            there_and_back!(Event, Event::Verified { check, verdict });
        }
    }

    #[test]
    fn wire_questions(query in query()) {
        there_and_back!(Effect, Effect::Watch { query: Arc::new(query) });
    }
}

#[test]
fn wire_form_keeps_its_bytes() {
    let mut lines = Vec::new();
    let (node, goal) = (NodeId(7), GoalId::from_number(u64::MAX));
    let (ending, cause) = (NodeEnding::Failure(motet_graph::FailureId(3)), EndCause::Lost);
    for what in [
        TraceEventKind::Entered { node },
        TraceEventKind::Ended { node, ending, cause },
        TraceEventKind::Started { node, goal, attempt: 2 },
        TraceEventKind::GoalEnded { node, goal, ending: NodeEnding::Interrupted, cause: EndCause::Swap },
        TraceEventKind::Guard { node, need: 1, truth: Truth::Unknown },
        TraceEventKind::Verified {
            node,
            verdict: Box::new(Verification::Feasible { witness: None, leaves: None }),
        },
        TraceEventKind::Tested { node, truth: Truth::True },
        TraceEventKind::GoalObserved { truth: Truth::Unknown },
        TraceEventKind::Fired { node, watch: 1, truth: Truth::False },
        TraceEventKind::WentOn { node, watch: 0 },
        TraceEventKind::Swapped { policy: "b".into() },
        TraceEventKind::Kept { node, goal },
        TraceEventKind::Updated { node, goal },
        TraceEventKind::Bound {
            binding: motet_graph::BindingId(1),
            value: Box::new(Value::Number(f64::NAN)),
        },
    ] {
        let record = TraceEvent { at: Time::NEVER, revision: 1, what };
        lines.push(there_and_back!(Effect, Effect::Report(record)));
    }
    let why = Some("because".to_owned());
    for end in [
        RunEnd::Done { why: None, result: None },
        RunEnd::Done { why: None, result: Some(Value::Entity("mug".into())) },
        RunEnd::Failed { kind: "slipped".into(), why: why.clone(), node },
        RunEnd::Declined { why: why.clone() },
        RunEnd::Replan { why },
        RunEnd::Interrupted,
        RunEnd::Fault(Fault::NotStopped { node, revision: 1 }),
        RunEnd::Fault(Fault::StepBudget { steps: 1 }),
        RunEnd::Fault(Fault::Stalled),
    ] {
        lines.push(there_and_back!(Effect, Effect::Finished(Box::new(end))));
    }
    let fact = Query::Fact {
        fluent: "holding".into(),
        args: vec![Pattern::Any, Pattern::Is(Value::Entity("mug".into()))],
    };
    let measure = Query::Measure { measure: "distance".into(), args: vec![Value::Entity("user".into())] };
    let field = Query::Field { entity: "mug".into(), field: "width".into() };
    let command = Arc::new(Command {
        primitive: "pick".into(),
        args: vec![("object".into(), Value::Entity("mug".into()))],
        uses: ["hand".into()].into(),
        manner: Some(Manner { speed: 0.3, acceleration: 0.25 }),
        deadline_secs: 20.1,
        motions: Vec::new(),
        leaves: None,
    });
    let check = CheckId::from_number(4);
    let deadline = Time::from_nanos(30_100_000_000);
    let motion = Arc::new(DeferredMotion {
        query: "reach".into(),
        args: vec![Value::Entity("mug".into())],
        command: Arc::clone(&command),
    });
    for effect in [
        Effect::Start { goal, node, command: Arc::clone(&command), deadline },
        Effect::Update { goal, node, command, deadline },
        Effect::Cancel { goal },
        Effect::Hold { goal },
        Effect::Proceed { goal },
        Effect::SafeStop { goal },
        Effect::Observe { query: Arc::new(fact.clone()) },
        Effect::Watch { query: Arc::new(measure.clone()) },
        Effect::Unwatch { query: Arc::new(field.clone()) },
        Effect::Verify { check, node, motion },
    ] {
        lines.push(there_and_back!(Effect, effect));
    }
    let failure = FailureReport::from("slipped");
    let told = FailureReport { text: Some("the mug is wet".into()), ..failure.clone() };
    let verdict = Verification::Infeasible { failure: "unreachable".into(), why: "0.3 m too far".into() };
    let driver = Event::Driver;
    for event in [
        Event::Begin,
        Event::Tick,
        Event::Hold,
        Event::Proceed,
        Event::Stop,
        Event::Verified { check, verdict },
        Event::Verified { check, verdict: Verification::Unknown { why: "no body".into() } },
        Event::Noticed {
            query: Query::Fact { fluent: "clear".into(), args: vec![Pattern::Any] },
            answer: Answer::Truth(true),
        },
        driver(DriverEvent::Acknowledged { goal }),
        driver(DriverEvent::Refused { goal, failure: failure.clone() }),
        driver(DriverEvent::Ended { goal, outcome: Outcome::Success(None) }),
        driver(DriverEvent::Ended { goal, outcome: Outcome::Success(Some(Value::Text("red".into()))) }),
        driver(DriverEvent::Ended { goal, outcome: Outcome::Failure(failure) }),
        driver(DriverEvent::Ended { goal, outcome: Outcome::Failure(told) }),
        driver(DriverEvent::Ended { goal, outcome: Outcome::Interrupted }),
        driver(DriverEvent::NotHeld { goal }),
        driver(DriverEvent::Feedback { goal, text: "half way".into(), own_motion: false }),
        driver(DriverEvent::Feedback { goal, text: "around a box".into(), own_motion: true }),
        driver(DriverEvent::Stopped { goal }),
        driver(DriverEvent::Lost { goal }),
        driver(DriverEvent::DriverLost),
        driver(DriverEvent::DriverGone),
        driver(DriverEvent::Observed { query: fact.clone(), answer: Answer::Truth(true) }),
        driver(DriverEvent::Observed { query: measure, answer: Answer::Unknown }),
        driver(DriverEvent::Observed { query: field, answer: Answer::Value(Value::Number(0.5)) }),
    ] {
        lines.push(there_and_back!(Event, event));
    }
    let start = motet_runtime::StartState {
        facts: vec![(fact.clone(), Truth::Unknown)],
        some: vec![fact.clone()],
        entities: vec![("mug".into(), "Object".into())],
        bindings: vec![("drink".into(), Value::Int(3))],
        lasting: vec![PerceivedFact {
            fact: fact.clone(),
            uses: vec!["base".into()],
            entities: vec!["mug".into()],
        }],
        pending: vec![PendingCleanup { path: "/steps/0".into(), steps: vec!["close(drawer)".into()] }],
    };
    lines.push(serde_json::to_string(&start).unwrap());
    lines.push(serde_json::to_string(&motet_runtime::EngineSettings::default()).unwrap());
    lines.push(serde_json::to_string(&motet_runtime::Capabilities::default()).unwrap());
    insta::assert_snapshot!(lines.join("\n"));
}

#[test]
fn wire_unknown_keys_are_refused() {
    let wrong = r#"{"driver":{"acknowledged":{"goal":1,"gaol":2}}}"#;
    let error = serde_json::from_str::<Event>(wrong).unwrap_err().to_string();
    assert!(error.contains("unknown field `gaol`"), "{error}");
}

/// A change of a schema is a new version of the journal or of the graph, unless old files can still be read.
/// An entry holds graphs, events, effects and trace events, so its schema has all of theirs.
#[test]
fn journal_schema_is_as_recorded() {
    insta::assert_json_snapshot!(serde_json::json!({
        "versions": [journal::VERSION, journal::WIRE_VERSION, motet_graph::encode::VERSION],
        "entry": schemars::schema_for!(journal::JournalEntry),
        "snapshot": schemars::schema_for!(motet_runtime::Snapshot),
    }));
}
