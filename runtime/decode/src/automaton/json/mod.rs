//! The automaton of the JSON subset: the spelling of [`crate::canonical`], byte by byte.

mod condition;
mod part;
mod value;

use std::sync::Arc;

use motet_compiler::Session;
use motet_compiler::signature::Type;

use super::compiler::Compiler;
use super::{
    Action, Automaton, BlockRole, BoundNames, Callable, ConditionUse, Constant, Entry, Guard, Meaning,
    NameUse, NodeKind, Op, OpId, WordEnd, WordList, WordRole, WordTable,
};
use crate::subset::{MAX_COUNT, MAX_ITEMS, MAX_RETRIES, MAX_STEPS, Modifiers, NumberRange, Subset};

pub(super) fn compile(session: &Session, subset: Subset) -> Automaton {
    let signatures = session.signatures();
    let mut compiler = Compiler::new(session, &signatures, subset);
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
        self.asm.put(Op::Name(NameUse::Policy));
        let robot = &self.signatures.robot;
        if !robot.is_empty() {
            self.asm.literal(&format!(",\"robot\":\"{robot}\""));
        }
        self.asm.literal(",\"achieves\":");
        let choice = self.asm.later();
        let goal = self.asm.act(Action::Condition(ConditionUse::Goal));
        self.asm.put(Op::Call(condition));
        let end = self.asm.put(Op::Jump(0));
        let null = self.asm.act(Action::Constant(Constant::Null));
        let head = self.asm.act(Action::Head);
        self.asm.set(end, Op::Jump(head));
        if self.signatures.fluents.is_empty() {
            self.asm.choose(choice, &[("null", null, Guard::Open)]);
        } else {
            self.asm.choose(choice, &[("null", null, Guard::Open), ("{\"", goal, Guard::Open)]);
        }
        self.asm.literal(",\"steps\":");
        self.block(rules, BlockRole::Body, Guard::Close);
        self.asm.literal("}");
        self.asm.put(Op::Accept);
        start
    }

    /// A block in its brackets.
    fn block(&mut self, rules: Rules, slot: BlockRole, close: Guard) {
        self.asm.literal("[");
        let choice = self.asm.later();
        let enter = self.asm.here();
        // One rule serves all blocks; the slot is what it is told on entry.
        let call = self.asm.put(Op::Call(0));
        let over = self.asm.put(Op::Jump(0));
        let rule = self.asm.act(Action::Enter(slot));
        self.asm.put(Op::Jump(rules.steps));
        self.asm.set(call, Op::Call(rule));
        let empty = self.asm.act(Action::Open(NodeKind::Block));
        self.asm.act(Action::Close);
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

        let sequence = self.asm.act(Action::Open(NodeKind::Sequence));
        self.asm.put(Op::Name(NameUse::Group));
        self.asm.literal(",\"steps\":");
        self.block(rules, BlockRole::Group, Guard::Close);
        self.close(after);
        ways.push(("sequence\":\"", sequence, Guard::Nest));

        let choice = self.asm.act(Action::Open(NodeKind::If));
        self.asm.act(Action::Condition(ConditionUse::Anything));
        self.asm.put(Op::Call(rules.condition));
        self.asm.literal(",\"then\":");
        self.block(rules, BlockRole::Then, Guard::Close);
        self.asm.literal(",\"else\":");
        self.block(rules, BlockRole::Else, Guard::Empty);
        self.close(after);
        if self.observes {
            ways.push(("if\":{\"", choice, Guard::Nest));
        }

        let wait = self.asm.act(Action::Open(NodeKind::Wait));
        self.asm.act(Action::Condition(ConditionUse::Wait));
        self.asm.put(Op::Call(rules.condition));
        self.modifier("within", NumberRange::DURATION);
        self.close(after);
        if self.observes {
            ways.push(("wait\":{\"", wait, Guard::Wait));
        }

        let monitor = self.asm.act(Action::Open(NodeKind::Monitor));
        self.asm.put(Op::Call(rules.whens));
        self.asm.literal(",\"during\":");
        self.block(rules, BlockRole::During, Guard::Close);
        self.close(after);
        if self.observes {
            ways.push(("monitor\":[{\"when\":{\"", monitor, Guard::Fix));
        }

        let attempt = self.asm.act(Action::Open(NodeKind::Try));
        self.block(rules, BlockRole::Try, Guard::Close);
        self.asm.literal(",\"catch\":[{\"on\":[\"");
        self.asm.put(Op::Call(rules.catches));
        self.close(after);
        ways.push(("try\":", attempt, Guard::Nest));

        let repeat = self.asm.act(Action::Open(NodeKind::Repeat));
        self.asm.put(Op::Number(NumberRange::whole(1, MAX_COUNT)));
        self.asm.literal(",\"steps\":");
        self.block(rules, BlockRole::Loop, Guard::Close);
        self.asm.literal(",\"until\":");
        let until = self.asm.later();
        let test = self.asm.act(Action::Condition(ConditionUse::Until));
        self.asm.put(Op::Call(rules.condition));
        let over = self.asm.put(Op::Jump(0));
        let none = self.asm.act(Action::Constant(Constant::Null));
        let end = self.close(after);
        self.asm.set(over, Op::Jump(end));
        if self.observes {
            self.asm.choose(until, &[("null", none, Guard::NoTest), ("{\"", test, Guard::Open)]);
        } else {
            self.asm.choose(until, &[("null", none, Guard::Open)]);
        }
        ways.push(("repeat\":", repeat, Guard::Fix));

        let each = self.asm.act(Action::Open(NodeKind::Each));
        self.asm.put(Op::Name(NameUse::Item));
        self.asm.literal(",\"in\":");
        self.list_of_entities();
        self.asm.literal(",\"at_most\":");
        self.asm.put(Op::Number(NumberRange::whole(1, MAX_COUNT)));
        self.asm.literal(",\"steps\":");
        self.block(rules, BlockRole::Loop, Guard::Close);
        self.asm.act(Action::Forget);
        self.close(after);
        ways.push(("each\":\"", each, Guard::Fix));

        let parallel = self.asm.act(Action::Open(NodeKind::Parallel));
        self.asm.put(Op::Call(rules.branches));
        self.close(after);
        ways.push(("parallel\":[", parallel, Guard::Fix));

        let end = self.end("");
        self.asm.act(Action::StepDone);
        let dead = self.asm.later();
        ways.push(("end\":\"", end, Guard::Open));

        self.asm.choose(start, &ways);
        let more = self.asm.put(Op::Jump(start));
        let leave = self.asm.act(Action::Leave);
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
        self.asm.act(Action::Open(NodeKind::List));
        let items = self.asm.put(Op::Call(0));
        self.asm.act(Action::Close);
        self.asm.act(Action::BindItem);
        let over = self.asm.put(Op::Jump(0));
        let table = self.table(&Type::Entity(0)).0;
        let rule = self.asm.here();
        let words = WordList {
            table,
            bound: BoundNames::None,
            role: WordRole::Alike,
            ends: WordEnd::Quoted,
            next: rule + 1,
        };
        self.asm.put(Op::Word(words));
        self.asm.act(Action::Count);
        let after = self.asm.later();
        let more = self.asm.put(Op::Jump(rule));
        let done = self.asm.put(Op::Return);
        let most = u8::try_from(MAX_ITEMS).unwrap_or(0);
        self.asm.choose(after, &[(",", more, Guard::Below(most)), ("]", done, Guard::Open)]);
        self.asm.set(items, Op::Call(rule));
        let (next, table) = (self.asm.here() + 1, Arc::new(WordTable::default()));
        let words =
            WordList { table, bound: BoundNames::Lists, role: WordRole::Free, ends: WordEnd::Quoted, next };
        let word = self.asm.put(Op::Word(words));
        self.asm.set(over, Op::Jump(next));
        self.asm.set(fork, Op::Fork { byte: b'"', then: word, other: open });
    }

    /// The brace behind a step.
    fn close(&mut self, after: OpId) -> OpId {
        let at = self.asm.literal("}");
        self.asm.act(Action::Close);
        self.asm.act(Action::StepDone);
        self.asm.put(Op::Jump(after));
        at
    }

    /// An ending behind `end":"`, with its brace and `more` behind that.
    fn end(&mut self, more: &str) -> OpId {
        let choice = self.asm.later();
        let mut jumps = Vec::new();
        let mut start = |compiler: &mut Self, kind: NodeKind| {
            let at = compiler.asm.act(Action::Open(kind));
            if kind != NodeKind::Done {
                compiler.asm.literal(",\"why\":\"");
                compiler.text(None);
            }
            jumps.push(compiler.asm.put(Op::Jump(0)));
            at
        };
        let done = start(self, NodeKind::Done);
        let fail = start(self, NodeKind::Fail);
        let replan = start(self, NodeKind::Replan);
        let end = self.asm.literal(&format!("}}{more}"));
        self.asm.act(Action::Close);
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
        let table = Arc::new(WordTable::default());
        let role = arg.map_or(WordRole::Free, WordRole::Argument);
        let word = self.asm.put(Op::Word(WordList { table, bound, role, ends: WordEnd::Tail, next }));
        self.asm.set(fork, Op::Fork { byte: b'$', then: word, other: text });
        self.asm.set(over, Op::Jump(next));
    }

    fn modifier(&mut self, key: &str, range: NumberRange) {
        if self.subset.modifiers == Modifiers::Written {
            self.asm.literal(&format!(",\"{key}\":"));
            self.number_or_null(range);
        }
    }

    fn number_or_null(&mut self, range: NumberRange) {
        let fork = self.asm.later();
        let number = self.asm.put(Op::Number(range));
        let over = self.asm.put(Op::Jump(0));
        let null = self.asm.literal("null");
        let next = self.asm.act(Action::Constant(Constant::Null));
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
            let at = self.asm.act(Action::Open(NodeKind::Do(number)));
            let mut made = Callable::new(self.session, callable);
            for (place, param) in callable.params.iter().enumerate() {
                self.asm.literal(&format!(",\"{}\":", param.name));
                let role = WordRole::Argument(u8::try_from(place).unwrap_or(u8::MAX));
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
                self.asm.put(Op::Name(NameUse::Result(ty)));
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
        let table = Arc::new(WordTable::new(entries));
        let words = WordList {
            table,
            bound: BoundNames::None,
            role: WordRole::Callable,
            ends: WordEnd::Tail,
            next: after,
        };
        self.asm.set(start, Op::Word(words));
        start
    }
}
