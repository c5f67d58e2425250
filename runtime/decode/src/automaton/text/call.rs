//! Calls, with the names of their results before them.

use motet_syntax::print::identifier;
use smol_str::{SmolStr, format_smolstr};

use super::Speller;
use crate::automaton::{Action, Callable, Guard, NameUse, NodeKind, Op, OpId, WordRole};
use crate::subset::{MAX_RETRIES, Modifiers, NumberRange};

impl Speller<'_> {
    /// What a step can call: the words of a step that begin with a call, `let ` among them.
    pub(super) fn calls(&mut self, after: OpId) -> Vec<(SmolStr, OpId, Guard)> {
        let signatures = self.of.signatures;
        let (mut plain, mut named) = (Vec::new(), Vec::new());
        for (index, callable) in signatures.callables.iter().enumerate() {
            let Ok(number) = u16::try_from(index) else { break };
            let at = self.act(Action::Open(NodeKind::Do(number)));
            let mut made = Callable::new(self.of.session, callable);
            for (place, param) in callable.params.iter().enumerate() {
                if place > 0 {
                    self.of.asm.literal(", ");
                }
                let role = WordRole::Argument(u8::try_from(place).unwrap_or(u8::MAX));
                let spelled = self.value(&param.ty, param.range, role);
                made.words.push(spelled.0);
                made.elements.push(spelled.1);
            }
            self.of.asm.literal(")");
            if !callable.is_policy {
                self.modifier(" within ", NumberRange::DURATION);
                self.modifier(" retry ", NumberRange::whole(0, MAX_RETRIES));
            }
            if let Some(ty) = &callable.result {
                let ty = self.of.type_number(ty);
                self.act(Action::Bind(ty));
            }
            self.close(after);
            self.of.callables.push(made);
            let way = (format_smolstr!("{}(", identifier(&callable.name)), at, Guard::Callable(number));
            if callable.result.is_some() { named.push(way) } else { plain.push(way) }
        }
        if !named.is_empty() {
            let bound = self.of.asm.put(Op::Name(NameUse::Let));
            self.of.asm.literal("= ");
            let called = self.of.asm.later();
            self.keywords(called, named);
            plain.push((SmolStr::new_static("let "), bound, Guard::Let));
        }
        plain
    }

    /// The place of a modifier, where the subset has it.
    pub(super) fn modifier(&mut self, word: &str, range: NumberRange) {
        if self.of.subset.modifiers == Modifiers::Written {
            self.number_or_none(word, range);
        }
    }

    /// The end of a step.
    pub(super) fn close(&mut self, after: OpId) -> OpId {
        let at = self.act(Action::Close);
        self.act(Action::StepDone);
        self.of.asm.put(Op::Jump(after));
        at
    }
}
