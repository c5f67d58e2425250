//! Steps, in a block.

use smol_str::SmolStr;

use super::Speller;
use crate::automaton::{Action, BlockRole, ConditionUse, Constant, Guard, NameUse, NodeKind, Op, OpId};
use crate::subset::{MAX_COUNT, MAX_STEPS, NumberRange};

impl Speller<'_> {
    /// The steps of a block behind its `{ `, to its `}`.
    pub(super) fn steps(&mut self) -> OpId {
        let start = self.of.asm.later();
        // Behind a step and the space after it; behind an ending, from which no way leads on, the block may always end.
        let after = self.of.asm.literal(" ");
        let more = self.of.asm.later();
        let dead = self.of.asm.literal(" ");
        let over = self.of.asm.later();
        let mut ways = self.calls(after);
        self.blocks(after, &mut ways);
        ways.extend(self.endings("done ", Guard::Done, |speller, kind| {
            speller.act(Action::Close);
            speller.act(Action::StepDone);
            speller.of.asm.put(Op::Jump(if kind == NodeKind::Done { over } else { dead }));
        }));
        let leave = self.act(Action::Leave);
        self.of.asm.put(Op::Return);
        let with = |guard: Guard| {
            let end = (SmolStr::new_static("}"), leave, guard);
            ways.iter().cloned().chain([end]).collect::<Vec<_>>()
        };
        let (more_ways, over_ways) = (with(Guard::Close), with(Guard::Open));
        self.keywords(start, ways);
        self.keywords(more, more_ways);
        self.keywords(over, over_ways);
        start
    }

    /// Steps with blocks, and waiting.
    fn blocks(&mut self, after: OpId, ways: &mut Vec<(SmolStr, OpId, Guard)>) {
        let mut add = |word: &'static str, at: OpId, guard: Guard| {
            ways.push((SmolStr::new_static(word), at, guard));
        };
        let sequence = self.act(Action::Open(NodeKind::Sequence));
        self.of.asm.put(Op::Name(NameUse::Group));
        self.block(BlockRole::Group);
        self.close(after);
        add("sequence ", sequence, Guard::Nest);

        if self.of.observes {
            add("if ", self.choice(after), Guard::Nest);

            let wait = self.act(Action::Open(NodeKind::Wait));
            self.act(Action::Condition(ConditionUse::Wait));
            self.of.asm.put(Op::Call(self.rules.condition));
            self.modifier(" within ", NumberRange::DURATION);
            self.close(after);
            add("wait until ", wait, Guard::Wait);

            let monitor = self.monitor(after);
            add("monitor { when ", monitor, Guard::Fix);
        }
        let attempt = self.attempt(after);
        add("try ", attempt, Guard::Nest);

        let repeat = self.repeat(after);
        add("repeat ", repeat, Guard::Fix);

        let each = self.act(Action::Open(NodeKind::Each));
        self.of.asm.put(Op::Name(NameUse::Item));
        self.of.asm.literal("in ");
        self.list_of_entities();
        self.of.asm.literal(" at most ");
        self.number(NumberRange::whole(1, MAX_COUNT));
        self.of.asm.literal(" ");
        self.block(BlockRole::Loop);
        self.act(Action::Forget);
        self.close(after);
        add("each ", each, Guard::Fix);

        let parallel = self.parallel(after);
        add("parallel { { ", parallel, Guard::Fix);
    }

    fn choice(&mut self, after: OpId) -> OpId {
        let start = self.act(Action::Open(NodeKind::If));
        self.act(Action::Condition(ConditionUse::Anything));
        self.of.asm.put(Op::Call(self.rules.condition));
        self.of.asm.literal(" ");
        self.block(BlockRole::Then);
        let choice = self.of.asm.later();
        let otherwise = self.begun(BlockRole::Else);
        let over = self.jump();
        let none = self.act(Action::Open(NodeKind::Block));
        self.act(Action::Close);
        let end = self.close(after);
        self.land(over, end);
        self.of.asm.maybe(choice, (" else { ", otherwise, Guard::Open), (none, Guard::Empty));
        start
    }

    fn repeat(&mut self, after: OpId) -> OpId {
        let start = self.act(Action::Open(NodeKind::Repeat));
        self.number(NumberRange::whole(1, MAX_COUNT));
        self.of.asm.literal(" ");
        self.block(BlockRole::Loop);
        let choice = self.of.asm.later();
        let test = self.act(Action::Condition(ConditionUse::Until));
        self.of.asm.put(Op::Call(self.rules.condition));
        let over = self.jump();
        let none = self.act(Action::Constant(Constant::Null));
        let end = self.close(after);
        self.land(over, end);
        let guard = if self.of.observes { Guard::Open } else { Guard::Never };
        let absent = if self.of.observes { Guard::NoTest } else { Guard::Open };
        self.of.asm.maybe(choice, (" until ", test, guard), (none, absent));
        start
    }

    /// Endings, `done` with this word and guard; `end` is behind each of them.
    pub(super) fn endings(
        &mut self,
        word: &'static str,
        done: Guard,
        mut end: impl FnMut(&mut Self, NodeKind),
    ) -> Vec<(SmolStr, OpId, Guard)> {
        let room = u8::try_from(MAX_STEPS).unwrap_or(u8::MAX);
        let rows = [
            (word, NodeKind::Done, done),
            ("fail ", NodeKind::Fail, Guard::Below(room)),
            ("replan ", NodeKind::Replan, Guard::Below(room)),
        ];
        rows.map(|(word, kind, guard)| {
            let at = self.act(Action::Open(kind));
            if kind != NodeKind::Done {
                self.text(None);
            }
            end(self, kind);
            (SmolStr::new_static(word), at, guard)
        })
        .into()
    }
}
