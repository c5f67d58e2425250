//! The canonical subset in text: one line, one space between words and around braces, `when` always in
//! braces, no `else if`.

use motet_compiler::signature::Type;
use motet_syntax::print::identifier;

use super::{
    Action, Alternative, BlockRole, ChoiceStyle, CleanupOf, ConditionUse, Constant, Grammar, Guard, NameUse,
    NodeKind, Part, ValuePlace,
};
use crate::subset::{MAX_COUNT, MAX_MEMBERS, MAX_STEPS, NumberRange};

const COUNT: Part = Part::Number(NumberRange::whole(1, MAX_COUNT));

fn literal(text: &'static str) -> Part {
    Part::literal(text)
}

fn block(role: BlockRole) -> Part {
    Part::Block(role, 1)
}

fn no_value() -> Vec<Part> {
    vec![Part::Action(Action::Constant(Constant::Null))]
}

pub(super) fn document(grammar: &Grammar) -> Vec<Part> {
    let mut parts = vec![literal("policy "), Part::Name(NameUse::Policy), Part::ResultType];
    parts.extend(grammar.robot().map(|robot| Part::literal(format!("for {} ", identifier(robot)))));
    let goal = vec![Part::Condition(ConditionUse::Goal), literal(" ")];
    let present = Alternative::new("achieves ", grammar.when_asked(ConditionUse::Goal), goal);
    parts.push(optional(present, no_value(), Guard::Open));
    if let Some(rule) = grammar.keep_rule(ValuePlace::Operand) {
        let rules = Part::repeat(["", ", ", " "], [1, MAX_MEMBERS], rule);
        let present = Alternative::new("keep ", Guard::Open, vec![rules]);
        parts.push(optional(present, Vec::new(), Guard::Open));
    }
    parts.extend([Part::Action(Action::Head), block(BlockRole::Body), Part::Cleanup(CleanupOf::Policy)]);
    parts
}

fn optional(present: Alternative, absent: Vec<Part>, absent_guard: Guard) -> Part {
    Part::Optional { present: Box::new(present), absent, absent_guard }
}

pub(super) fn steps(grammar: &Grammar) -> Vec<Alternative> {
    let (named, plain): (Vec<_>, Vec<_>) =
        grammar.calls().into_iter().partition(|(_, has_result)| *has_result);
    let mut steps: Vec<Alternative> = plain.into_iter().map(|(call, _)| call).collect();
    let named: Vec<Alternative> =
        named.into_iter().map(|(call, _)| call).chain(grammar.let_words()).collect();
    if !named.is_empty() {
        let named = Part::Choice(ChoiceStyle::Keywords, named);
        let parts = vec![Part::Name(NameUse::Let), literal("= "), named];
        steps.push(Alternative::new("let ", Guard::Let, parts).cleaning());
    }
    let delay = vec![Part::open(NodeKind::Delay), Part::Number(NumberRange::DURATION)];
    steps.push(Alternative::new("wait ", Guard::Room, delay).named("delay").cleaning());
    let mut add = |word: &'static str, guard: Guard, kind: NodeKind, parts: Vec<Part>| {
        let cleans = super::cleans(kind);
        let parts = std::iter::once(Part::open(kind)).chain(parts).collect();
        steps.push(Alternative { cleans, ..Alternative::new(word, guard, parts) });
    };
    let sequence = vec![Part::Name(NameUse::Group), block(BlockRole::Group)];
    add("sequence ", Guard::Nest, NodeKind::Sequence, sequence);
    if grammar.has_conditions() {
        let otherwise = Alternative::new(" else ", Guard::Open, vec![block(BlockRole::Else)]);
        let no_block = vec![Part::open(NodeKind::Block), Part::Action(Action::Close)];
        let parts = vec![
            Part::Condition(ConditionUse::Branch),
            literal(" "),
            block(BlockRole::Then),
            optional(otherwise, no_block, Guard::Empty),
            Part::Action(Action::Meet),
        ];
        add("if ", grammar.when_observed(Guard::If), NodeKind::If, parts);
        let mut wait = vec![Part::Condition(ConditionUse::Wait)];
        wait.extend(grammar.modifier("within", NumberRange::DEADLINE));
        add("wait until ", grammar.when_observed(Guard::Wait), NodeKind::Wait, wait);
        let whens = Part::repeat([" when ", " when ", " } during "], [1, MAX_MEMBERS], when(grammar));
        let monitor = vec![whens, block(BlockRole::During)];
        add("monitor {", grammar.when_observed(Guard::Fix), NodeKind::Monitor, monitor);
    }
    let handler = vec![
        Part::open(NodeKind::Catch),
        Part::Failures,
        Part::CaughtName,
        Part::Block(BlockRole::Catch, 0),
        Part::Action(Action::Forget),
        Part::Action(Action::Close),
    ];
    let handlers = Part::repeat([" catch ", " catch ", ""], [1, MAX_MEMBERS], handler);
    let meet = Part::Action(Action::Meet);
    add("try ", Guard::Nest, NodeKind::Try, vec![block(BlockRole::Try), handlers, meet.clone()]);
    let test = vec![Part::Condition(ConditionUse::Until)];
    let test = Alternative::new(" until ", grammar.when_asked(ConditionUse::Until), test);
    let no_test = if test.guard == Guard::Never { Guard::Open } else { Guard::NoTest };
    let until = optional(test, no_value(), no_test);
    add("repeat ", Guard::Fix, NodeKind::Repeat, vec![COUNT, literal(" "), block(BlockRole::Loop), until]);
    if grammar.has_lists() {
        let each = vec![
            Part::Name(NameUse::Item),
            literal("in "),
            Part::EntityList,
            literal(" at most "),
            COUNT,
            literal(" "),
            block(BlockRole::Loop),
        ];
        add("each ", Guard::Fix, NodeKind::Each, each);
    }
    let branches = Part::repeat([" ", " ", " }"], [2, MAX_MEMBERS], vec![block(BlockRole::Branch)]);
    add("parallel {", Guard::Fix, NodeKind::Parallel, vec![branches, meet]);
    let timed = vec![Part::Number(NumberRange::DEADLINE), literal(" "), block(BlockRole::During)];
    add("within ", Guard::Interrupt, NodeKind::Within, timed);
    if let Some(rule) = grammar.keep_rule(ValuePlace::Plain) {
        let rules = Part::repeat(["", ", ", " "], [1, MAX_MEMBERS], rule);
        add("keep ", Guard::Interrupt, NodeKind::Keep, vec![rules, block(BlockRole::During)]);
    }
    // The parts behind `let` end with the calls themselves.
    steps.extend(endings(Guard::Done, Part::Given { lead: "", end: " " }));
    for step in &mut steps {
        step.parts.push(Part::Action(Action::Close));
        step.parts.extend(step.is_composite().then_some(Part::Cleanup(CleanupOf::Step)));
    }
    steps
}

/// A condition of a monitor with its reaction, behind `when `.
fn when(grammar: &Grammar) -> Vec<Part> {
    let reacts = |word, kind: NodeKind, parts: Vec<Part>| {
        let parts = std::iter::once(Part::open(kind)).chain(parts).collect();
        Alternative::new(word, Guard::React(kind), parts)
    };
    let pause = grammar.modifier("within", NumberRange::DEADLINE).into_iter().collect();
    let mut reactions = endings(Guard::DoneWhen, Part::Given { lead: " ", end: "" });
    let resume = vec![COUNT, literal(" "), block(BlockRole::Reaction)];
    reactions.extend([
        reacts("pause", NodeKind::Pause, pause),
        reacts("restart at most ", NodeKind::Restart, vec![COUNT]),
        reacts("resume at most ", NodeKind::Resume, resume),
    ]);
    vec![
        Part::open(NodeKind::When),
        Part::Condition(ConditionUse::Branch),
        Part::OptionalNumber { lead: " for ".into(), range: NumberRange::DURATION },
        literal(" then "),
        Part::Choice(ChoiceStyle::Keywords, reactions),
        Part::Action(Action::Close),
        Part::Action(Action::Close),
    ]
}

fn endings(done: Guard, given: Part) -> Vec<Alternative> {
    let reason = Part::Value { ty: Type::Text, range: None, place: ValuePlace::Plain };
    let room = Guard::Below(u8::try_from(MAX_STEPS).unwrap_or(u8::MAX));
    let with_reason = |kind| vec![Part::open(kind), reason.clone()];
    vec![
        Alternative::new("done", done, vec![Part::open(NodeKind::Done), given]).ending(),
        Alternative::new("fail ", room, with_reason(NodeKind::Fail)).ending(),
        Alternative::new("cannot ", room, with_reason(NodeKind::Cannot)).ending(),
        Alternative::new("replan ", room, with_reason(NodeKind::Replan)).ending(),
    ]
}
