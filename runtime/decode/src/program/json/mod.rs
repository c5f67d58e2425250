//! The program of the JSON surface: the spelling of [`crate::canonical`], byte by byte.

mod condition;
mod part;
mod value;

use std::sync::Arc;

use motet_compiler::Session;
use motet_compiler::signature::Type;

use super::compiler::Compiler;
use super::{
    Act, Asks, Bound, Callable, Ends, Entry, Guard, Kind, Meaning, Naming, Op, OpId, Plain, Program, Role,
    Slot, Table, Words,
};
use crate::surface::{MAX_COUNT, MAX_ITEMS, MAX_RETRIES, MAX_STEPS, Modifiers, NumberRange, Surface};

pub(super) fn compile(session: &Session, surface: Surface) -> Program {
    let signatures = session.signatures();
    let mut compiler = Compiler::new(session, &signatures, surface);
    let start = compiler.document();
    compiler.finish(start)
}

/// The rules that blocks call.
#[derive(Clone, Copy)]
struct Rules {
    /// A condition behind its `{"`.
    condition: OpId,
    /// The steps of a block, see [`Compiler::steps`].
    steps: OpId,
    /// Kinds of failure, see [`Compiler::failures`].
    failures: OpId,
    whens: OpId,
    catches: OpId,
    branches: OpId,
}

impl Compiler<'_> {
    fn document(&mut self) -> OpId {
        let condition = self.condition();
        // The rule of a block's steps is called from within itself: its place comes first.
        let steps = self.asm.later();
        let failures = self.failures();
        let mut rules = Rules { condition, steps, failures, whens: 0, catches: 0, branches: 0 };
        rules.whens = self.whens(rules);
        rules.catches = self.catches(rules);
        rules.branches = self.branches(rules);
        let steps_at = self.steps(rules);
        self.asm.set(steps, Op::Jump(steps_at));

        let start = self.asm.literal("{\"motet\":1,\"policy\":\"");
        self.asm.put(Op::Name(Naming::Policy));
        let robot = &self.signatures.robot;
        if !robot.is_empty() {
            self.asm.literal(&format!(",\"robot\":\"{robot}\""));
        }
        self.asm.literal(",\"achieves\":");
        let choice = self.asm.later();
        let goal = self.asm.act(Act::Condition(Asks::Goal));
        self.asm.put(Op::Call(condition));
        let end = self.asm.put(Op::Jump(0));
        let null = self.asm.act(Act::Say(Plain::Null));
        let head = self.asm.act(Act::Head);
        self.asm.set(end, Op::Jump(head));
        if self.signatures.fluents.is_empty() {
            self.asm.choose(choice, &[("null", null, Guard::Open)]);
        } else {
            self.asm.choose(choice, &[("null", null, Guard::Open), ("{\"", goal, Guard::Open)]);
        }
        self.asm.literal(",\"steps\":");
        self.block(rules, Slot::Body, Guard::Close);
        self.asm.literal("}");
        self.asm.put(Op::Accept);
        start
    }

    /// A block in its brackets.
    fn block(&mut self, rules: Rules, slot: Slot, close: Guard) {
        self.asm.literal("[");
        let choice = self.asm.later();
        let enter = self.asm.here();
        // One rule serves all blocks; the slot is what it is told on entry.
        let call = self.asm.put(Op::Call(0));
        let over = self.asm.put(Op::Jump(0));
        let rule = self.asm.act(Act::Enter(slot));
        self.asm.put(Op::Jump(rules.steps));
        self.asm.set(call, Op::Call(rule));
        let empty = self.asm.act(Act::Open(Kind::Block));
        self.asm.act(Act::Close);
        let next = self.asm.here();
        self.asm.set(over, Op::Jump(next));
        if close == Guard::Empty {
            self.asm.choose(choice, &[("{\"", enter, Guard::Open), ("]", empty, Guard::Empty)]);
        } else {
            self.asm.choose(choice, &[("{\"", enter, Guard::Open)]);
        }
    }

    /// The steps of a block behind the first `[{"`, to its `]`.
    fn steps(&mut self, rules: Rules) -> OpId {
        let start = self.asm.later();
        let after = self.asm.later();
        let mut ways: Vec<(&str, OpId, Guard)> = Vec::new();

        let callable = self.calls(after);
        ways.push(("do\":\"", callable, Guard::Call));

        let sequence = self.asm.act(Act::Open(Kind::Sequence));
        self.asm.put(Op::Name(Naming::Group));
        self.asm.literal(",\"steps\":");
        self.block(rules, Slot::Group, Guard::Close);
        self.close(after);
        ways.push(("sequence\":\"", sequence, Guard::Nest));

        let choice = self.asm.act(Act::Open(Kind::If));
        self.asm.act(Act::Condition(Asks::Anything));
        self.asm.put(Op::Call(rules.condition));
        self.asm.literal(",\"then\":");
        self.block(rules, Slot::Then, Guard::Close);
        self.asm.literal(",\"else\":");
        self.block(rules, Slot::Else, Guard::Empty);
        self.close(after);
        if self.observes {
            ways.push(("if\":{\"", choice, Guard::Nest));
        }

        let wait = self.asm.act(Act::Open(Kind::Wait));
        self.asm.act(Act::Condition(Asks::Wait));
        self.asm.put(Op::Call(rules.condition));
        self.modifier("within", NumberRange::DURATION);
        self.close(after);
        if self.observes {
            ways.push(("wait\":{\"", wait, Guard::Wait));
        }

        let monitor = self.asm.act(Act::Open(Kind::Monitor));
        self.asm.put(Op::Call(rules.whens));
        self.asm.literal(",\"during\":");
        self.block(rules, Slot::During, Guard::Close);
        self.close(after);
        if self.observes {
            ways.push(("monitor\":[{\"when\":{\"", monitor, Guard::Fix));
        }

        let attempt = self.asm.act(Act::Open(Kind::Try));
        self.block(rules, Slot::Try, Guard::Close);
        self.asm.literal(",\"catch\":[{\"on\":[\"");
        self.asm.put(Op::Call(rules.catches));
        self.close(after);
        ways.push(("try\":", attempt, Guard::Nest));

        let repeat = self.asm.act(Act::Open(Kind::Repeat));
        self.asm.put(Op::Number(NumberRange::whole(1, MAX_COUNT)));
        self.asm.literal(",\"steps\":");
        self.block(rules, Slot::Loop, Guard::Close);
        self.asm.literal(",\"until\":");
        let until = self.asm.later();
        let test = self.asm.act(Act::Condition(Asks::Until));
        self.asm.put(Op::Call(rules.condition));
        let over = self.asm.put(Op::Jump(0));
        let none = self.asm.act(Act::Say(Plain::Null));
        let end = self.close(after);
        self.asm.set(over, Op::Jump(end));
        if self.observes {
            self.asm.choose(until, &[("null", none, Guard::NoTest), ("{\"", test, Guard::Open)]);
        } else {
            self.asm.choose(until, &[("null", none, Guard::Open)]);
        }
        ways.push(("repeat\":", repeat, Guard::Fix));

        let each = self.asm.act(Act::Open(Kind::Each));
        self.asm.put(Op::Name(Naming::Item));
        self.asm.literal(",\"in\":");
        self.list_of_entities();
        self.asm.literal(",\"at_most\":");
        self.asm.put(Op::Number(NumberRange::whole(1, MAX_COUNT)));
        self.asm.literal(",\"steps\":");
        self.block(rules, Slot::Loop, Guard::Close);
        self.asm.act(Act::Forget);
        self.close(after);
        ways.push(("each\":\"", each, Guard::Fix));

        let parallel = self.asm.act(Act::Open(Kind::Parallel));
        self.asm.put(Op::Call(rules.branches));
        self.close(after);
        ways.push(("parallel\":[", parallel, Guard::Fix));

        let end = self.end("");
        self.asm.act(Act::StepDone);
        let dead = self.asm.later();
        ways.push(("end\":\"", end, Guard::Open));

        self.asm.choose(start, &ways);
        let more = self.asm.put(Op::Jump(start));
        let leave = self.asm.act(Act::Leave);
        self.asm.put(Op::Return);
        let room = u8::try_from(MAX_STEPS).unwrap_or(u8::MAX);
        self.asm.choose(after, &[(",{\"", more, Guard::Below(room)), ("]", leave, Guard::Close)]);
        // No way leads on from an ending, so nothing that follows from the end of the block can be refuted.
        self.asm.choose(dead, &[(",{\"", more, Guard::Below(room)), ("]", leave, Guard::Open)]);
        start
    }

    /// The list of an `each`: a name, or entities of one kind.
    fn list_of_entities(&mut self) {
        let fork = self.asm.later();
        let open = self.asm.literal("[");
        self.asm.act(Act::Open(Kind::List));
        let items = self.asm.put(Op::Call(0));
        self.asm.act(Act::Close);
        self.asm.act(Act::BindItem);
        let over = self.asm.put(Op::Jump(0));
        let table = self.table(&Type::Entity(0)).0;
        let rule = self.asm.here();
        let words =
            Words { table, bound: Bound::None, role: Role::Alike, ends: Ends::Quoted, next: rule + 1 };
        self.asm.put(Op::Word(words));
        self.asm.act(Act::Count);
        let after = self.asm.later();
        let more = self.asm.put(Op::Jump(rule));
        let done = self.asm.put(Op::Return);
        let most = u8::try_from(MAX_ITEMS).unwrap_or(0);
        self.asm.choose(after, &[(",", more, Guard::Below(most)), ("]", done, Guard::Open)]);
        self.asm.set(items, Op::Call(rule));
        let (next, table) = (self.asm.here() + 1, Arc::new(Table::default()));
        let words = Words { table, bound: Bound::Lists, role: Role::Free, ends: Ends::Quoted, next };
        let word = self.asm.put(Op::Word(words));
        self.asm.set(over, Op::Jump(next));
        self.asm.set(fork, Op::Fork { byte: b'"', then: word, other: open });
    }

    /// The brace behind a step.
    fn close(&mut self, after: OpId) -> OpId {
        let at = self.asm.literal("}");
        self.asm.act(Act::Close);
        self.asm.act(Act::StepDone);
        self.asm.put(Op::Jump(after));
        at
    }

    /// An ending behind `end":"`, with its brace and `more` behind that.
    fn end(&mut self, more: &str) -> OpId {
        let choice = self.asm.later();
        let mut jumps = Vec::new();
        let mut start = |compiler: &mut Self, kind: Kind| {
            let at = compiler.asm.act(Act::Open(kind));
            if kind != Kind::Done {
                compiler.asm.literal(",\"why\":\"");
                compiler.text(None);
            }
            jumps.push(compiler.asm.put(Op::Jump(0)));
            at
        };
        let done = start(self, Kind::Done);
        let fail = start(self, Kind::Fail);
        let replan = start(self, Kind::Replan);
        let end = self.asm.literal(&format!("}}{more}"));
        self.asm.act(Act::Close);
        for jump in jumps {
            self.asm.set(jump, Op::Jump(end));
        }
        let guard = if more.is_empty() { Guard::Done } else { Guard::DoneWhen };
        self.asm.choose(
            choice,
            &[("done\"", done, guard), ("fail\"", fail, Guard::Open), ("replan\"", replan, Guard::Open)],
        );
        choice
    }

    /// A text behind its quote, or a name of one.
    fn text(&mut self, arg: Option<u8>) {
        let fork = self.asm.later();
        let text = self.asm.put(Op::Text { arg });
        let over = self.asm.put(Op::Jump(0));
        let next = self.asm.here() + 1;
        let bound = self.bound(&Type::Text);
        let table = Arc::new(Table::default());
        let role = arg.map_or(Role::Free, Role::Argument);
        let word = self.asm.put(Op::Word(Words { table, bound, role, ends: Ends::Tail, next }));
        self.asm.set(fork, Op::Fork { byte: b'$', then: word, other: text });
        self.asm.set(over, Op::Jump(next));
    }

    fn modifier(&mut self, key: &str, range: NumberRange) {
        if self.surface.modifiers == Modifiers::Written {
            self.asm.literal(&format!(",\"{key}\":"));
            self.number_or_null(range);
        }
    }

    fn number_or_null(&mut self, range: NumberRange) {
        let fork = self.asm.later();
        let number = self.asm.put(Op::Number(range));
        let over = self.asm.put(Op::Jump(0));
        let null = self.asm.literal("null");
        let next = self.asm.act(Act::Say(Plain::Null));
        self.asm.set(over, Op::Jump(next + 1));
        self.asm.set(fork, Op::Fork { byte: b'n', then: null, other: number });
    }

    /// What a step can call, behind `do":"`.
    fn calls(&mut self, after: OpId) -> OpId {
        let start = self.asm.later();
        let signatures = self.signatures;
        let mut entries = Vec::new();
        for (index, callable) in signatures.callables.iter().enumerate() {
            let Ok(number) = u16::try_from(index) else { break };
            let at = self.asm.act(Act::Open(Kind::Do(number)));
            let mut made = Callable::new(self.session, callable);
            for (place, param) in callable.params.iter().enumerate() {
                self.asm.literal(&format!(",\"{}\":", param.name));
                let role = Role::Argument(u8::try_from(place).unwrap_or(u8::MAX));
                let spelled = self.value(&param.ty, param.range, role);
                made.words.push(spelled.0);
                made.elements.push(spelled.1);
            }
            if !callable.is_policy {
                self.modifier("within", NumberRange::DURATION);
                self.modifier("retry", NumberRange::whole(0, MAX_RETRIES));
            }
            if let Some(ty) = &callable.result {
                self.asm.literal(",\"as\":\"");
                let ty = self.type_number(ty);
                self.asm.put(Op::Name(Naming::Result(ty)));
            }
            self.close(after);
            self.callables.push(made);
            entries.push(Entry {
                name: callable.name.clone(),
                meaning: Meaning::Named(number),
                to: Some(at),
                guard: Guard::Open,
            });
        }
        let table = Arc::new(Table::new(entries));
        let words = Words { table, bound: Bound::None, role: Role::Callable, ends: Ends::Tail, next: after };
        self.asm.set(start, Op::Word(words));
        start
    }
}
