//! Values, by the types that are asked for.

use std::sync::Arc;

use motet_compiler::signature::Type;

use crate::automaton::compiler::Compiler;
use crate::automaton::{Action, Constant, Guard, NodeKind, Op, OpId, WordEnd, WordList, WordRole, WordTable};
use crate::subset::{MAX_ITEMS, NumberRange};

impl Compiler<'_> {
    /// A value of a type. Its word, and that of its elements.
    pub(super) fn value(
        &mut self,
        ty: &Type,
        card: Option<(f64, f64)>,
        role: WordRole,
    ) -> (Option<OpId>, Option<OpId>) {
        match ty {
            Type::Entity(_) | Type::Enum(_) | Type::Pose => {
                let table = if role == WordRole::Of { self.table(ty).1 } else { self.table(ty).0 };
                (Some(self.word(table, ty, role)), None)
            }
            Type::Text => {
                self.asm.literal("\"");
                let arg = if let WordRole::Argument(arg) = role { Some(arg) } else { None };
                self.text(arg);
                (None, None)
            }
            Type::Bool => {
                let (choice, t) = (self.asm.later(), self.asm.act(Action::Constant(Constant::True)));
                let over = self.asm.put(Op::Jump(0));
                let f = self.asm.act(Action::Constant(Constant::False));
                let next = self.asm.here();
                self.asm.set(over, Op::Jump(next));
                self.asm.choose(choice, &[("true", t, Guard::Open), ("false", f, Guard::Open)]);
                (None, None)
            }
            Type::Int | Type::Number | Type::Quantity(_) => {
                if let Some(range) = NumberRange::of(ty, card) {
                    self.asm.put(Op::Number(range));
                }
                (None, None)
            }
            Type::List(element) => {
                let fork = self.asm.later();
                let open = self.asm.literal("[");
                self.asm.act(Action::Open(NodeKind::List));
                let items = self.asm.put(Op::Call(0));
                self.asm.act(Action::Close);
                let over = self.asm.put(Op::Jump(0));
                let rule = self.asm.here();
                let (item, _) = self.value(element, None, WordRole::Free);
                self.asm.act(Action::Count);
                let after = self.asm.later();
                let more = self.asm.put(Op::Jump(rule));
                let done = self.asm.put(Op::Return);
                let most = u8::try_from(MAX_ITEMS).unwrap_or(0);
                self.asm.choose(after, &[(",", more, Guard::Below(most)), ("]", done, Guard::Open)]);
                self.asm.set(items, Op::Call(rule));
                let word = self.word(Arc::new(WordTable::default()), ty, role);
                let next = self.asm.here();
                self.asm.set(over, Op::Jump(next));
                self.asm.set(fork, Op::Fork { byte: b'"', then: word, other: open });
                (Some(word), item)
            }
        }
    }

    pub(super) fn word(&mut self, table: Arc<WordTable>, ty: &Type, role: WordRole) -> OpId {
        let bound = self.bound(ty);
        let next = self.asm.here() + 1;
        self.asm.put(Op::Word(WordList { table, bound, role, ends: WordEnd::Quoted, next }))
    }
}
