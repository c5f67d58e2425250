//! Sketches drawn at random.

use super::vocabulary::{self as v, entity, fact};
use super::{CallSketch, ReactionSketch, StepSketch, WatchSketch, layout};
use motet_graph::{
    Comparison, Condition, Ending, Fact, FactArg, Graph, Manner, PrimitiveId, Term, TextPart, Type, Value,
    Verdict,
};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use smol_str::SmolStr;

/// Valid graphs of every node kind and every reaction, up to about a hundred nodes.
pub fn graphs() -> impl Strategy<Value = Graph> {
    steps().prop_map(|steps| layout::graph(&steps))
}

/// The steps of a policy.
pub fn steps() -> impl Strategy<Value = Vec<StepSketch>> {
    let step = leaf().prop_recursive(4, 40, 4, |inner| {
        let body = vec(inner, 0..4);
        let handlers = vec((option::of(vec(failure(), 0..3)), body.clone()), 0..3);
        prop_oneof![
            2 => body.clone().prop_map(StepSketch::Sequence),
            2 => body.clone().prop_map(StepSketch::Inline),
            2 => (conditions(), body.clone(), option::of(body.clone()))
                .prop_map(|(condition, then, otherwise)| StepSketch::If(condition, then, otherwise)),
            5 => (vec(when(body.clone()), 1..4), body.clone())
                .prop_map(|(whens, body)| StepSketch::Monitor(whens, body)),
            3 => (body.clone(), handlers).prop_map(|(body, handlers)| StepSketch::Try(body, handlers)),
            2 => (1..4_u32, body.clone(), option::of(conditions()))
                .prop_map(|(times, body, until)| StepSketch::Repeat(times, body, until)),
            2 => (list(), 0..4_u32, body.clone()).prop_map(|(list, n, body)| StepSketch::Each(list, n, body)),
            3 => (body.clone(), body.clone()).prop_map(|(body, cleanup)| StepSketch::Finally(body, cleanup)),
            3 => vec(body, 0..4).prop_map(StepSketch::Parallel),
        ]
    });
    vec(step, 0..6)
}

/// Conditions over the vocabulary.
pub fn conditions() -> impl Strategy<Value = Condition> {
    let leaf = prop_oneof![
        1 => any::<bool>().prop_map(Condition::Literal),
        3 => object().prop_map(|object| Condition::Fact(fact(v::HOLDING, vec![object]))),
        1 => Just(Condition::Fact(Fact { fluent: v::HOLDING, args: vec![FactArg::Any] })),
        2 => place().prop_map(|place| Condition::Fact(fact(v::AT, vec![entity("robot"), place]))),
        1 => object().prop_map(|object| Condition::Fact(fact(v::TRUSTED, vec![object]))),
        3 => Just(v::nearer("user", 0.5)),
        1 => Just(Condition::Compare(
            Comparison::More,
            Term::Field(Box::new(entity("mug")), SmolStr::new_static("mass")),
            Term::Literal(Value::Number(0.2)),
        )),
        1 => object().prop_map(|object| Condition::Compare(Comparison::Equal, object, entity("mug"))),
    ];
    leaf.prop_recursive(2, 6, 3, |inner| {
        prop_oneof![
            inner.clone().prop_map(|inner| Condition::Not(Box::new(inner))),
            vec(inner.clone(), 0..3).prop_map(Condition::All),
            vec(inner, 0..3).prop_map(Condition::AnyOf),
        ]
    })
}

fn leaf() -> impl Strategy<Value = StepSketch> {
    prop_oneof![
        12 => call().prop_map(StepSketch::Call),
        2 => (conditions(), 0.0..3.0).prop_map(|(condition, within)| StepSketch::Wait(condition, within)),
        1 => (0.0..3.0).prop_map(StepSketch::Delay),
        1 => ending().prop_map(StepSketch::End),
        2 => object().prop_map(StepSketch::Let),
        1 => list().prop_map(|list| StepSketch::Let(first(list))),
    ]
}

/// The first element of a list that is not empty.
fn first(list: Term) -> Term {
    match list {
        Term::List(items) if !items.is_empty() => Term::First(Box::new(Term::List(items))),
        _ => entity("cup"),
    }
}

/// A text that names an object and counts a list.
fn template() -> impl Strategy<Value = Term> {
    (object(), list()).prop_map(|(object, list)| {
        Term::Template(vec![
            TextPart::Literal("I see ".into()),
            TextPart::Value(Term::Count(Box::new(list)), Type::Int),
            TextPart::Literal(" beside ".into()),
            TextPart::Value(object, Type::Entity(v::OBJECT)),
        ])
    })
}

fn call() -> impl Strategy<Value = CallSketch> {
    let what = || prop_oneof![Just(v::text("mug")), Just(v::text("cup"))];
    let primitive = prop_oneof![
        3 => place().prop_map(|to| (v::GO, vec![to])),
        3 => object().prop_map(|object| (v::PICK, vec![object])),
        3 => (object(), place()).prop_map(|(object, on)| (v::PLACE, vec![object, on])),
        3 => what().prop_map(|what| (v::DETECT, vec![what])),
        1 => what().prop_map(|what| (v::DETECT_ALL, vec![what])),
        2 => what().prop_map(|text| (v::SAY, vec![text])),
        1 => template().prop_map(|text| (v::SAY, vec![text])),
    ];
    let part = || prop_oneof![Just(1.0), 0.01..1.0];
    let manner = prop_oneof![
        3 => Just(None),
        1 => (part(), part()).prop_map(|(speed, acceleration)| Some(Manner { speed, acceleration })),
    ];
    (primitive, manner, 0.0..5.0, 0..3_u32, any::<bool>()).prop_map(
        |((primitive, args), manner, deadline_secs, retries, proven)| {
            let verdict = if proven { Verdict::Proven } else { Verdict::Deferred };
            let _: PrimitiveId = primitive;
            CallSketch { primitive, args, manner, deadline_secs, retries, verdict }
        },
    )
}

fn when(body: impl Strategy<Value = Vec<StepSketch>> + 'static) -> impl Strategy<Value = WatchSketch> {
    let react = prop_oneof![
        3 => (0.0..3.0).prop_map(ReactionSketch::Pause),
        2 => (0..3_u32).prop_map(ReactionSketch::Restart),
        3 => (0..3_u32, body).prop_map(|(at_most, steps)| ReactionSketch::Resume(at_most, steps)),
        1 => ending().prop_map(ReactionSketch::End),
    ];
    let hold = prop_oneof![Just(0.0), 0.0..1.0];
    (conditions(), hold, react).prop_map(|(condition, hold_secs, react)| WatchSketch {
        condition,
        hold_secs,
        react,
    })
}

fn ending() -> impl Strategy<Value = Ending> {
    prop_oneof![Just(Ending::Done), Just(Ending::Fail), Just(Ending::Cannot), Just(Ending::Replan)]
}

fn object() -> impl Strategy<Value = Term> {
    prop_oneof![Just(entity("mug")), Just(entity("cup")), Just(CallSketch::NEAREST)]
}

fn place() -> impl Strategy<Value = Term> {
    prop_oneof![Just(entity("table")), Just(entity("shelf")), Just(entity("user"))]
}

fn list() -> impl Strategy<Value = Term> {
    vec(object(), 0..4).prop_map(Term::List)
}

fn failure() -> impl Strategy<Value = motet_graph::FailureId> {
    prop_oneof![
        Just(v::TIMEOUT),
        Just(v::FAILED),
        Just(v::EXHAUSTED),
        Just(v::UNREACHABLE),
        Just(v::NOT_FOUND)
    ]
}
