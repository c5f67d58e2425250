//! The canonical subset in JSON: no white space, the key that tells what an object is first, all keys in
//! one order.
//!
//! A step and a condition are alternatives behind their `{"`, which belongs to the block or the condition
//! around them.

use super::{
    Action, Alternative, BlockRole, ChoiceStyle, CleanupOf, ConditionUse, Constant, Grammar, Guard, NameUse,
    NodeKind, Part, ValuePlace, WordRole,
};
use crate::subset::{MAX_COUNT, MAX_MEMBERS, NumberRange};

const COUNT: Part = Part::Number(NumberRange::whole(1, MAX_COUNT));

fn literal(text: &'static str) -> Part {
    Part::literal(text)
}

fn close() -> Part {
    Part::Action(Action::Close)
}

/// `null` or a condition.
fn condition_or_null(grammar: &Grammar, asked: ConditionUse, null: Guard) -> Part {
    let has_any = match asked {
        ConditionUse::Goal => grammar.has_goals(),
        ConditionUse::Branch | ConditionUse::Wait | ConditionUse::Until => grammar.has_conditions(),
    };
    let mut alternatives =
        vec![Alternative::new("null", null, vec![Part::Action(Action::Constant(Constant::Null))])];
    if has_any {
        alternatives.push(Alternative::new("", grammar.when_asked(asked), vec![Part::Condition(asked)]));
    }
    Part::Choice(ChoiceStyle::Literals, alternatives)
}

pub(super) fn document(grammar: &Grammar) -> Vec<Part> {
    // A string always has a JSON syntax.
    let robot = grammar.robot().map(|robot| serde_json::to_string(robot.as_str()).unwrap_or_default());
    let robot = robot.map(|robot| format!(",\"robot\":{robot}")).unwrap_or_default();
    let mut keeps = vec![Alternative::new("null", Guard::Open, Vec::new())];
    if let Some(rule) = grammar.keep_rule(ValuePlace::Operand) {
        let rules = Part::repeat(["", ",", "]"], [1, MAX_MEMBERS], rule);
        keeps.push(Alternative::new("[", Guard::Open, vec![rules]));
    }
    vec![
        literal("{\"motet\":1,\"policy\":"),
        Part::Name(NameUse::Policy),
        Part::ResultType,
        Part::literal(format!("{robot},\"achieves\":")),
        condition_or_null(grammar, ConditionUse::Goal, Guard::Open),
        literal(",\"keep\":"),
        Part::Choice(ChoiceStyle::Literals, keeps),
        Part::Action(Action::Head),
        literal(",\"steps\":"),
        Part::Block(BlockRole::Body, 1),
        Part::Cleanup(CleanupOf::Policy),
        literal("}"),
    ]
}

pub(super) fn steps(grammar: &Grammar) -> Vec<Alternative> {
    use BlockRole as Role;
    let calls = grammar.calls().into_iter().map(|(call, _)| call).collect();
    let calls = Part::Choice(ChoiceStyle::Names(WordRole::Callable), calls);
    let mut steps = vec![Alternative::new("do\":\"", Guard::Call, vec![calls]).cleaning()];
    steps.extend(grammar.let_step());
    let delay = vec![Part::open(NodeKind::Delay), Part::Number(NumberRange::DURATION)];
    steps.push(Alternative::new("wait\":", Guard::Room, delay).named("delay").cleaning());
    let mut add = |word: &'static str, guard: Guard, kind: NodeKind, parts: Vec<Part>| {
        let cleans = super::cleans(kind);
        let parts = std::iter::once(Part::open(kind)).chain(parts).collect();
        steps.push(Alternative { cleans, ..Alternative::new(word, guard, parts) });
    };
    let body = |role| [literal(",\"steps\":"), Part::Block(role, 1)];
    let sequence = [vec![Part::Name(NameUse::Group)], body(Role::Group).into()].concat();
    add("sequence\":", Guard::Nest, NodeKind::Sequence, sequence);
    if grammar.has_conditions() {
        add(
            "if\":",
            grammar.when_observed(Guard::If),
            NodeKind::If,
            vec![
                Part::Condition(ConditionUse::Branch),
                literal(",\"then\":"),
                Part::Block(Role::Then, 1),
                literal(",\"else\":"),
                Part::Block(Role::Else, 0),
                Part::Action(Action::Meet),
            ],
        );
        let mut wait = vec![Part::Condition(ConditionUse::Wait)];
        wait.extend(grammar.modifier("within", NumberRange::DEADLINE));
        add("wait\":", grammar.when_observed(Guard::Wait), NodeKind::Wait, wait);
        let whens = Part::repeat(["[", ",", "]"], [1, MAX_MEMBERS], when(grammar));
        let monitor = vec![whens, literal(",\"during\":"), Part::Block(Role::During, 1)];
        add("monitor\":", grammar.when_observed(Guard::Fix), NodeKind::Monitor, monitor);
    }
    let handler = vec![
        literal("{\"on\":"),
        Part::open(NodeKind::Catch),
        Part::Failures,
        Part::CaughtName,
        literal(",\"steps\":"),
        Part::Block(Role::Catch, 0),
        Part::Action(Action::Forget),
        literal("}"),
        close(),
    ];
    let handlers = Part::repeat(["[", ",", "]"], [1, MAX_MEMBERS], handler);
    add(
        "try\":",
        Guard::Nest,
        NodeKind::Try,
        vec![Part::Block(Role::Try, 1), literal(",\"catch\":"), handlers, Part::Action(Action::Meet)],
    );
    let mut repeat = [vec![COUNT], body(Role::Loop).into()].concat();
    let no_test = grammar.when_observed(Guard::NoTest);
    let no_test = if no_test == Guard::Never { Guard::Open } else { no_test };
    repeat.extend([literal(",\"until\":"), condition_or_null(grammar, ConditionUse::Until, no_test)]);
    add("repeat\":", Guard::Fix, NodeKind::Repeat, repeat);
    if grammar.has_lists() {
        let head = vec![
            Part::Name(NameUse::Item),
            literal(",\"in\":"),
            Part::EntityList,
            literal(",\"at_most\":"),
            COUNT,
        ];
        let each = [head, body(Role::Loop).into()].concat();
        add("each\":", Guard::Fix, NodeKind::Each, each);
    }
    let branches = Part::repeat(["[", ",", "]"], [2, MAX_MEMBERS], vec![Part::Block(Role::Branch, 1)]);
    add("parallel\":", Guard::Fix, NodeKind::Parallel, vec![branches, Part::Action(Action::Meet)]);
    let timed = [vec![Part::Number(NumberRange::DEADLINE)], body(Role::During).into()].concat();
    add("within\":", Guard::Interrupt, NodeKind::Within, timed);
    if let Some(rule) = grammar.keep_rule(ValuePlace::Plain) {
        let rules = Part::repeat(["[", ",", "]"], [1, MAX_MEMBERS], rule);
        add("keep\":", Guard::Interrupt, NodeKind::Keep, [vec![rules], body(Role::During).into()].concat());
    }
    for step in &mut steps {
        step.parts.push(close());
        step.parts.extend(step.is_composite().then_some(Part::Cleanup(CleanupOf::Step)));
        step.parts.push(literal("}"));
    }
    steps.push(ending(Guard::Done));
    steps
}

/// A condition of a monitor with its reaction.
fn when(grammar: &Grammar) -> Vec<Part> {
    let reacts = |word, kind: NodeKind, parts: Vec<Part>| {
        let parts = std::iter::once(Part::open(kind)).chain(parts).chain([literal("}"), close()]).collect();
        Alternative::new(word, Guard::React(kind), parts)
    };
    let resume = vec![COUNT, literal(",\"steps\":"), Part::Block(BlockRole::Reaction, 1)];
    let pause = grammar.modifier("within", NumberRange::DEADLINE).into_iter().collect();
    let reactions = vec![
        reacts("react\":\"pause\"", NodeKind::Pause, pause).named("pause"),
        reacts("react\":\"restart\",\"at_most\":", NodeKind::Restart, vec![COUNT]).named("restart"),
        reacts("react\":\"resume\",\"at_most\":", NodeKind::Resume, resume).named("resume"),
        ending(Guard::DoneWhen),
    ];
    vec![
        literal("{\"when\":"),
        Part::open(NodeKind::When),
        Part::Condition(ConditionUse::Branch),
        Part::OptionalNumber { lead: ",\"for\":".into(), range: NumberRange::DURATION },
        literal(",\"then\":{\""),
        Part::Choice(ChoiceStyle::Literals, reactions),
        literal("}"),
        close(),
    ]
}

/// An ending behind its `{"`.
fn ending(done: Guard) -> Alternative {
    let reason =
        Part::Value { ty: motet_compiler::signature::Type::Text, range: None, place: ValuePlace::Plain };
    let with_reason = |kind| vec![Part::open(kind), literal(",\"why\":"), reason.clone()];
    let given = Part::Given { lead: ",\"result\":", end: "" };
    let alternatives = vec![
        Alternative::new("done\"", done, vec![Part::open(NodeKind::Done), given]),
        Alternative::new("fail\"", Guard::Open, with_reason(NodeKind::Fail)),
        Alternative::new("cannot\"", Guard::Open, with_reason(NodeKind::Cannot)),
        Alternative::new("replan\"", Guard::Open, with_reason(NodeKind::Replan)),
    ];
    let parts = vec![Part::Choice(ChoiceStyle::Literals, alternatives), literal("}"), close()];
    Alternative::new("end\":\"", Guard::Open, parts).ending()
}
