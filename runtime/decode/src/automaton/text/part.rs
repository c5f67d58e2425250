//! What steps are made of beside blocks: conditions of a monitor with their reactions, handlers, branches.

use std::sync::Arc;

use motet_syntax::print::identifier;
use smol_str::SmolStr;

use super::Speller;
use crate::automaton::{
    Action, BlockRole, BoundNames, ConditionUse, Entry, Guard, Meaning, NodeKind, Op, OpId, WordEnd,
    WordList, WordRole, WordTable,
};
use crate::subset::{MAX_COUNT, MAX_MEMBERS, NumberRange};

/// So many more may follow the first.
const MORE: u8 = MAX_MEMBERS as u8 - 1;

impl Speller<'_> {
    /// A monitor behind `monitor { when `.
    pub(super) fn monitor(&mut self, after: OpId) -> OpId {
        let start = self.act(Action::Open(NodeKind::Monitor));
        let whens = self.of.asm.later();
        self.begun(BlockRole::During);
        self.close(after);
        let rule = self.whens();
        self.of.asm.set(whens, Op::Call(rule));
        start
    }

    /// The conditions of a monitor behind the first `when `, to `} during { `.
    fn whens(&mut self) -> OpId {
        let start = self.act(Action::Open(NodeKind::When));
        self.act(Action::Condition(ConditionUse::Anything));
        self.of.asm.put(Op::Call(self.rules.condition));
        self.number_or_none(" for ", NumberRange::DURATION);
        self.of.asm.literal(" then ");
        let reaction = self.of.asm.later();
        let after = self.act(Action::Close);
        self.act(Action::Close);
        self.of.asm.literal(" ");
        let next = self.of.asm.later();
        let more = self.act(Action::Count);
        self.of.asm.put(Op::Jump(start));
        let done = self.of.asm.put(Op::Return);
        self.of.asm.choose(next, &[("when ", more, Guard::Below(MORE)), ("} during { ", done, Guard::Open)]);

        let pause = self.act(Action::Open(NodeKind::Pause));
        self.modifier(" within ", NumberRange::DURATION);
        self.of.asm.put(Op::Jump(after));
        let at_most = NumberRange::whole(1, MAX_COUNT);
        let restart = self.act(Action::Open(NodeKind::Restart));
        self.number(at_most);
        self.of.asm.put(Op::Jump(after));
        let resume = self.act(Action::Open(NodeKind::Resume));
        self.number(at_most);
        self.of.asm.literal(" ");
        self.block(BlockRole::Reaction);
        self.of.asm.put(Op::Jump(after));
        let mut ways = self.endings("done", Guard::DoneWhen, |speller, _| {
            speller.of.asm.put(Op::Jump(after));
        });
        ways.extend([
            (SmolStr::new_static("pause"), pause, Guard::React(NodeKind::Pause)),
            (SmolStr::new_static("restart at most "), restart, Guard::React(NodeKind::Restart)),
            (SmolStr::new_static("resume at most "), resume, Guard::React(NodeKind::Resume)),
        ]);
        self.keywords(reaction, ways);
        start
    }

    /// A `try` behind its word.
    pub(super) fn attempt(&mut self, after: OpId) -> OpId {
        let start = self.act(Action::Open(NodeKind::Try));
        self.block(BlockRole::Try);
        self.of.asm.literal(" catch ");
        let rule = self.of.asm.later();
        self.close(after);
        let handler = self.act(Action::Open(NodeKind::Catch));
        self.act(Action::Open(NodeKind::List));
        let failures = self.of.asm.later();
        self.act(Action::Close);
        self.block_or_none(BlockRole::Catch);
        self.act(Action::Close);
        let choice = self.of.asm.later();
        let more = self.act(Action::Count);
        self.of.asm.put(Op::Jump(handler));
        let done = self.of.asm.put(Op::Return);
        self.of.asm.maybe(choice, (" catch ", more, Guard::Below(MORE)), (done, Guard::Open));
        self.of.asm.set(rule, Op::Call(handler));
        let kinds = self.failures();
        self.of.asm.set(failures, Op::Call(kinds));
        start
    }

    /// Kinds of failure, to the space behind them.
    fn failures(&mut self) -> OpId {
        let start = self.of.asm.later();
        let more_kinds = self.of.asm.later();
        let after = self.of.asm.later();
        let any = self.of.asm.literal(" ");
        self.of.asm.put(Op::Return);
        let more = self.act(Action::Count);
        self.of.asm.put(Op::Jump(more_kinds));
        let done = self.of.asm.put(Op::Return);
        self.of.asm.choose(after, &[(", ", more, Guard::Below(MORE)), (" ", done, Guard::Open)]);
        let kinds = self.of.signatures.failures.iter().enumerate();
        let kinds = kinds.filter(|(_, name)| *name != "any").filter_map(|(index, name)| {
            let meaning = Meaning::Named(u16::try_from(index).ok()?);
            let name = identifier(name).into();
            Some(Entry { name, meaning, to: Some(after), guard: Guard::Open })
        });
        let kinds: Vec<Entry> = kinds.collect();
        let name = SmolStr::new_static("any");
        let any = Entry { name, meaning: Meaning::Any, to: Some(any), guard: Guard::Open };
        let word = |entries: Vec<Entry>| {
            let (table, bound) = (Arc::new(WordTable::new(entries)), BoundNames::None);
            Op::Word(WordList { table, bound, role: WordRole::Free, ends: WordEnd::Bare, next: after })
        };
        self.of.asm.set(more_kinds, word(kinds.clone()));
        self.of.asm.set(start, word(kinds.into_iter().chain([any]).collect()));
        start
    }

    /// Branches behind `parallel { { `.
    pub(super) fn parallel(&mut self, after: OpId) -> OpId {
        let start = self.act(Action::Open(NodeKind::Parallel));
        let rule = self.of.asm.later();
        self.close(after);
        let branches = self.begun(BlockRole::Branch);
        self.of.asm.literal(" { ");
        let second = self.begun(BlockRole::Branch);
        self.of.asm.literal(" ");
        let choice = self.of.asm.later();
        let more = self.act(Action::Count);
        self.of.asm.put(Op::Jump(second));
        let done = self.of.asm.put(Op::Return);
        self.of.asm.choose(choice, &[("{ ", more, Guard::Below(MORE - 1)), ("}", done, Guard::Open)]);
        self.of.asm.set(rule, Op::Call(branches));
        start
    }
}
