//! The automaton of the text subset: the spelling of [`crate::canonical`], byte by byte. A space stands before what follows,
//! so behind each thing that may be left out it is the word after the space that tells whether it was.

mod call;
mod condition;
mod part;
mod step;
mod value;

use std::sync::Arc;

use motet_compiler::Session;
use motet_syntax::print::identifier;
use smol_str::SmolStr;

use super::compiler::Compiler;
use super::{
    Action, Automaton, BlockRole, BoundNames, ConditionUse, Constant, Entry, Guard, Meaning, NameUse,
    NodeKind, Op, OpId, WordEnd, WordList, WordRole, WordTable,
};
use crate::subset::Subset;

pub(super) fn compile(session: &Session, subset: Subset) -> Automaton {
    let signatures = session.signatures();
    let mut speller = Speller { of: Compiler::new(session, &signatures, subset), rules: Rules::default() };
    let start = speller.document();
    speller.of.finish(start)
}

/// The compiler of the text subset.
struct Speller<'a> {
    of: Compiler<'a>,
    rules: Rules,
}

/// The rules that others call.
#[derive(Clone, Copy, Default)]
struct Rules {
    /// A condition.
    condition: OpId,
    /// The steps of a block behind its `{ `, to its `}`.
    steps: OpId,
}

impl Speller<'_> {
    fn document(&mut self) -> OpId {
        self.rules.condition = self.condition();
        // The rule of a block's steps is called from within itself: its place comes first.
        self.rules.steps = self.of.asm.later();
        let steps = self.steps();
        let at = self.rules.steps;
        self.of.asm.set(at, Op::Jump(steps));

        let start = self.of.asm.literal("policy ");
        self.of.asm.put(Op::Name(NameUse::Policy));
        let robot = &self.of.signatures.robot;
        if !robot.is_empty() {
            self.of.asm.literal(&format!("for {} ", identifier(robot)));
        }
        let choice = self.of.asm.later();
        let goal = self.act(Action::Condition(ConditionUse::Goal));
        self.of.asm.put(Op::Call(self.rules.condition));
        self.act(Action::Head);
        self.of.asm.literal(" ");
        let end = self.jump();
        let none = self.act(Action::Constant(Constant::Null));
        self.act(Action::Head);
        let body = self.block(BlockRole::Body);
        self.land(end, body);
        self.of.asm.put(Op::Accept);
        let guard = if self.of.signatures.fluents.is_empty() { Guard::Never } else { Guard::Open };
        self.of.asm.maybe(choice, ("achieves ", goal, guard), (none, Guard::Open));
        start
    }

    /// A block of one step at least.
    fn block(&mut self, slot: BlockRole) -> OpId {
        let start = self.of.asm.literal("{ ");
        self.begun(slot);
        start
    }

    /// The same behind its `{ `.
    fn begun(&mut self, slot: BlockRole) -> OpId {
        let start = self.of.asm.later();
        let over = self.jump();
        // One rule serves all blocks; the slot is what it is told on entry.
        let rule = self.act(Action::Enter(slot));
        self.of.asm.put(Op::Jump(self.rules.steps));
        self.of.asm.set(start, Op::Call(rule));
        let next = self.of.asm.here();
        self.land(over, next);
        start
    }

    /// A block that may be empty.
    fn block_or_none(&mut self, slot: BlockRole) -> OpId {
        let start = self.of.asm.later();
        let block = self.block(slot);
        let over = self.jump();
        let empty = self.act(Action::Open(NodeKind::Block));
        self.act(Action::Close);
        let next = self.of.asm.here();
        self.land(over, next);
        self.of.asm.maybe(start, ("{ }", empty, Guard::Empty), (block, Guard::Open));
        start
    }

    fn act(&mut self, act: Action) -> OpId {
        self.of.asm.act(act)
    }

    /// A jump whose goal is known later.
    fn jump(&mut self) -> OpId {
        self.of.asm.later()
    }

    fn land(&mut self, jump: OpId, at: OpId) {
        self.of.asm.set(jump, Op::Jump(at));
    }

    /// One of several words, each with where it leads and when it is open.
    fn keywords(&mut self, at: OpId, ways: Vec<(SmolStr, OpId, Guard)>) {
        let entries = ways.into_iter().map(|(name, to, guard)| Entry {
            name,
            meaning: Meaning::Any,
            to: Some(to),
            guard,
        });
        let table = Arc::new(WordTable::new(entries));
        let (bound, role, ends) = (BoundNames::None, WordRole::Keyword, WordEnd::Whole);
        self.of.asm.set(at, Op::Word(WordList { table, bound, role, ends, next: at }));
    }
}
