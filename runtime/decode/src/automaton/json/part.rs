//! What steps are made of beside blocks: conditions of a monitor with their reactions, handlers, branches.

use std::sync::Arc;

use smol_str::SmolStr;

use super::Rules;
use crate::automaton::compiler::Compiler;
use crate::automaton::{
    Action, BlockRole, BoundNames, ConditionUse, Entry, Guard, Meaning, NodeKind, Op, OpId, WordEnd,
    WordList, WordRole, WordTable,
};
use crate::subset::{MAX_COUNT, MAX_MEMBERS, NumberRange};

impl Compiler<'_> {
    /// The conditions of a monitor behind the first `[{"when":{"`, to their `]`.
    pub(super) fn whens(&mut self, rules: Rules) -> OpId {
        let start = self.asm.act(Action::Open(NodeKind::When));
        self.asm.act(Action::Condition(ConditionUse::Anything));
        self.asm.put(Op::Call(rules.condition));
        self.asm.literal(",\"for\":");
        self.number_or_null(NumberRange::DURATION);
        self.asm.literal(",\"then\":{\"");
        let reaction = self.asm.later();
        let after = self.asm.later();
        let at_most = NumberRange::whole(1, MAX_COUNT);

        let pause = self.asm.act(Action::Open(NodeKind::Pause));
        self.modifier("within", NumberRange::DURATION);
        self.asm.literal("}}");
        self.asm.act(Action::Close);
        self.asm.act(Action::Close);
        self.asm.put(Op::Jump(after));
        let restart = self.asm.act(Action::Open(NodeKind::Restart));
        self.asm.put(Op::Number(at_most));
        self.asm.literal("}}");
        self.asm.act(Action::Close);
        self.asm.act(Action::Close);
        self.asm.put(Op::Jump(after));
        let resume = self.asm.act(Action::Open(NodeKind::Resume));
        self.asm.put(Op::Number(at_most));
        self.asm.literal(",\"steps\":");
        self.block(rules, BlockRole::Reaction, Guard::Close);
        self.asm.literal("}}");
        self.asm.act(Action::Close);
        self.asm.act(Action::Close);
        self.asm.put(Op::Jump(after));
        let end = self.end("}");
        self.asm.act(Action::Close);
        self.asm.put(Op::Jump(after));
        self.asm.choose(
            reaction,
            &[
                ("react\":\"pause\"", pause, Guard::React(NodeKind::Pause)),
                ("react\":\"restart\",\"at_most\":", restart, Guard::React(NodeKind::Restart)),
                ("react\":\"resume\",\"at_most\":", resume, Guard::React(NodeKind::Resume)),
                ("end\":\"", end, Guard::Open),
            ],
        );
        let more = self.asm.act(Action::Count);
        self.asm.put(Op::Jump(start));
        let done = self.asm.put(Op::Return);
        let below = u8::try_from(MAX_MEMBERS - 1).unwrap_or(0);
        self.asm.choose(after, &[(",{\"when\":{\"", more, Guard::Below(below)), ("]", done, Guard::Open)]);
        start
    }

    /// The handlers of a `try` behind the first `[{"on":["`, to their `]`.
    pub(super) fn catches(&mut self, rules: Rules) -> OpId {
        let start = self.asm.act(Action::Open(NodeKind::Catch));
        self.asm.act(Action::Open(NodeKind::List));
        self.asm.put(Op::Call(rules.failures));
        self.asm.act(Action::Close);
        self.asm.literal(",\"steps\":");
        self.block(rules, BlockRole::Catch, Guard::Empty);
        self.asm.literal("}");
        self.asm.act(Action::Close);
        let after = self.asm.later();
        let more = self.asm.act(Action::Count);
        self.asm.put(Op::Jump(start));
        let done = self.asm.put(Op::Return);
        let below = u8::try_from(MAX_MEMBERS - 1).unwrap_or(0);
        self.asm.choose(after, &[(",{\"on\":[\"", more, Guard::Below(below)), ("]", done, Guard::Open)]);
        start
    }

    /// Kinds of failure behind the first `["`, to their `]`.
    pub(super) fn failures(&mut self) -> OpId {
        let start = self.asm.later();
        let more_kinds = self.asm.later();
        let after = self.asm.later();
        let any = self.asm.literal("]");
        self.asm.put(Op::Return);
        let more = self.asm.act(Action::Count);
        self.asm.put(Op::Jump(more_kinds));
        let done = self.asm.put(Op::Return);
        let below = u8::try_from(MAX_MEMBERS - 1).unwrap_or(0);
        self.asm.choose(after, &[(",\"", more, Guard::Below(below)), ("]", done, Guard::Open)]);
        let kinds = self.signatures.failures.iter().enumerate();
        let kinds: Vec<Entry> = kinds
            .filter(|(_, name)| *name != "any")
            .filter_map(|(index, name)| {
                let meaning = Meaning::Named(u16::try_from(index).ok()?);
                Some(Entry { name: name.clone(), meaning, to: Some(after), guard: Guard::Open })
            })
            .collect();
        let name = SmolStr::new_static("any");
        let any = Entry { name, meaning: Meaning::Any, to: Some(any), guard: Guard::Open };
        let word = |entries: Vec<Entry>| {
            let table = Arc::new(WordTable::new(entries));
            Op::Word(WordList {
                table,
                bound: BoundNames::None,
                role: WordRole::Free,
                ends: WordEnd::Tail,
                next: after,
            })
        };
        self.asm.set(more_kinds, word(kinds.clone()));
        self.asm.set(start, word(kinds.into_iter().chain([any]).collect()));
        start
    }

    /// The branches of a `parallel` behind the `[`, to their `]`.
    pub(super) fn branches(&mut self, rules: Rules) -> OpId {
        let start = self.asm.here();
        self.block(rules, BlockRole::Branch, Guard::Close);
        self.asm.literal(",");
        let second = self.asm.here();
        self.block(rules, BlockRole::Branch, Guard::Close);
        let after = self.asm.later();
        let more = self.asm.act(Action::Count);
        self.asm.put(Op::Jump(second));
        let done = self.asm.put(Op::Return);
        let below = u8::try_from(MAX_MEMBERS - 2).unwrap_or(0);
        self.asm.choose(after, &[(",", more, Guard::Below(below)), ("]", done, Guard::Open)]);
        start
    }
}
