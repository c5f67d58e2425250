//! The declarations that sketched graphs use.

use motet_graph::{
    Binding, CallEffect, Comparison, Condition, DurationBounds, EntityName, Fact, FactArg, FailureId,
    FailureSentence, Fluent, FluentId, Graph, InitialFact, Kind, KindId, Measure, MeasureId, Need, Param,
    Primitive, PrimitiveId, Resource, ResourceId, Term, Type, Unsettled, Value, Verdict,
};
use smol_str::SmolStr;

/// The root kind `Entity`.
pub const ENTITY: KindId = KindId(0);
/// `Object`, below `Entity`.
pub const OBJECT: KindId = KindId(1);
/// `Person`, below `Entity`.
pub const PERSON: KindId = KindId(2);

/// `holding(object: Object)`, observable.
pub const HOLDING: FluentId = FluentId(0);
/// `at(what: Entity, where: Entity)`, observable.
pub const AT: FluentId = FluentId(1);
/// `trusted(object: Object)`, known only by effects.
pub const TRUSTED: FluentId = FluentId(2);

/// `distance(to: Entity) -> Length`
pub const DISTANCE: MeasureId = MeasureId(0);

/// `go(to: Entity)` uses the base and makes `at(robot, to)`.
pub const GO: PrimitiveId = PrimitiveId(0);
/// `pick(object: Object)` uses the base, the arm and the hand and makes `holding(object)`.
pub const PICK: PrimitiveId = PrimitiveId(1);
/// `place(object: Object, on: Entity)` undoes `pick`.
pub const PLACE: PrimitiveId = PrimitiveId(2);
/// `detect(what: Text) -> Object` uses the camera, which the arm contains.
pub const DETECT: PrimitiveId = PrimitiveId(3);
/// `say(text: Text)` uses nothing.
pub const SAY: PrimitiveId = PrimitiveId(4);
/// `detect_all(what: Text) -> List<Object>` uses the camera.
pub const DETECT_ALL: PrimitiveId = PrimitiveId(5);

/// The failure kind `timeout`.
pub const TIMEOUT: FailureId = FailureId(0);
/// The failure kind `failed`.
pub const FAILED: FailureId = FailureId(1);
/// The failure kind `exhausted`.
pub const EXHAUSTED: FailureId = FailureId(2);
/// The failure kind `unreachable`.
pub const UNREACHABLE: FailureId = FailureId(3);
/// The failure kind `not_found`.
pub const NOT_FOUND: FailureId = FailureId(4);

/// A graph with the declarations and nothing else.
#[must_use]
pub fn declarations() -> Graph {
    let name = SmolStr::new_static;
    let kind = |text, parent| Kind { name: name(text), parent };
    let fluent = |text, params, observable| Fluent { name: name(text), params, observable };
    let primitive = |text,
                     params: Vec<(&'static str, Type)>,
                     result: Option<Type>,
                     perceives,
                     uses: &[u32],
                     fails: &[u32]| {
        Primitive {
            name: name(text),
            params: params
                .into_iter()
                .map(|(param, ty)| Param { name: name(param), ty, default: None })
                .collect(),
            result,
            perceives,
            uses: uses.iter().map(|id| ResourceId(*id)).collect(),
            fails: fails.iter().map(|id| FailureId(*id)).collect(),
        }
    };
    let (entity, object) = (Type::Entity(ENTITY), Type::Entity(OBJECT));
    let length = Type::Quantity(name("Length"));
    Graph {
        policy: name("sketch"),
        robot: name("mock"),
        kinds: vec![kind("Entity", None), kind("Object", Some(ENTITY)), kind("Person", Some(ENTITY))],
        fluents: vec![
            fluent("holding", vec![object.clone()], true),
            fluent("at", vec![entity.clone(), entity.clone()], true),
            fluent("trusted", vec![object.clone()], false),
        ],
        measures: vec![Measure { name: name("distance"), params: vec![entity.clone()], result: length }],
        primitives: vec![
            primitive("go", vec![("to", entity.clone())], None, false, &[0], &[0, 3]),
            primitive("pick", vec![("object", object.clone())], None, false, &[0, 1, 2], &[0, 3, 4]),
            primitive(
                "place",
                vec![("object", object.clone()), ("on", entity)],
                None,
                false,
                &[0, 1, 2],
                &[0, 3],
            ),
            primitive("detect", vec![("what", Type::Text)], Some(object.clone()), true, &[3], &[0, 4]),
            primitive("say", vec![("text", Type::Text)], None, false, &[], &[0]),
            primitive(
                "detect_all",
                vec![("what", Type::Text)],
                Some(Type::List(Box::new(object))),
                true,
                &[3],
                &[0],
            ),
        ],
        failures: ["timeout", "failed", "exhausted", "unreachable", "not_found"].map(name).to_vec(),
        resources: vec![
            Resource { name: name("base"), contains: Vec::new() },
            Resource { name: name("arm"), contains: vec![ResourceId(3)] },
            Resource { name: name("hand"), contains: Vec::new() },
            Resource { name: name("camera"), contains: Vec::new() },
        ],
        bindings: Vec::<Binding>::new(),
        names: vec![EntityName { entity: name("mug"), name: name("red mug") }],
        entities: Vec::new(),
        sentences: vec![FailureSentence { failure: UNREACHABLE, text: name("no motion leads there") }],
        result: None,
        goal: Vec::new(),
        hands: Vec::new(),
        nodes: Vec::new(),
        regions: Vec::new(),
        initial: vec![InitialFact { fact: Fact { fluent: HOLDING, args: vec![FactArg::Any] }, value: false }],
        observe_within_secs: 0.5,
        duration: DurationBounds::default(),
    }
}

/// A literal entity as a term.
#[must_use]
pub fn entity(id: &str) -> Term {
    Term::Literal(Value::Entity(SmolStr::new(id)))
}

/// A literal text as a term.
#[must_use]
pub fn text(text: &str) -> Term {
    Term::Literal(Value::Text(SmolStr::new(text)))
}

/// A fluent applied to terms.
#[must_use]
pub fn fact(fluent: FluentId, args: Vec<Term>) -> Fact {
    Fact { fluent, args: args.into_iter().map(FactArg::Term).collect() }
}

/// `distance(to) < limit_m`
#[must_use]
pub fn nearer(to: &str, limit_m: f64) -> Condition {
    let distance = Term::Measure(DISTANCE, vec![entity(to)]);
    Condition::Compare(Comparison::Less, distance, Term::Literal(Value::Number(limit_m)))
}

/// Contract of a primitive with these arguments.
pub(super) fn contract(primitive: PrimitiveId, args: &[Term], verdict: Verdict) -> Contract {
    let arg = |index: usize| args.get(index).cloned().unwrap_or_else(|| entity("mug"));
    let effect = |fact, value| CallEffect { fact, value, when: None, each: None };
    let need = |condition, failure| Need { condition, when: None, each: None, verdict, failure };
    let nowhere = Fact { fluent: AT, args: vec![FactArg::Term(entity("robot")), FactArg::Any] };
    let somewhere_else = Fact { fluent: AT, args: vec![FactArg::Term(arg(0)), FactArg::Any] };
    let held = || fact(HOLDING, vec![arg(0)]);
    match primitive {
        GO => Contract {
            needs: Vec::new(),
            effects: vec![effect(fact(AT, vec![entity("robot"), arg(0)]), true), effect(nowhere, false)],
            unsettles: Vec::new(),
        },
        PICK => Contract {
            needs: vec![need(
                Condition::Not(Box::new(Condition::Fact(Fact { fluent: HOLDING, args: vec![FactArg::Any] }))),
                FAILED,
            )],
            effects: vec![effect(held(), true), effect(somewhere_else, false)],
            unsettles: vec![Unsettled { fact: fact(TRUSTED, vec![arg(0)]), when: None, each: None }],
        },
        PLACE => Contract {
            needs: vec![need(Condition::Fact(held()), UNREACHABLE)],
            effects: vec![
                effect(held(), false),
                effect(fact(AT, vec![arg(0), arg(1)]), true),
                effect(fact(TRUSTED, vec![arg(0)]), true),
            ],
            unsettles: Vec::new(),
        },
        PrimitiveId(_) => Contract::default(),
    }
}

/// Preconditions, effects and unsettled facts of a call.
#[derive(Default)]
pub(super) struct Contract {
    pub(super) needs: Vec<Need>,
    pub(super) effects: Vec<CallEffect>,
    pub(super) unsettles: Vec<Unsettled>,
}
