//! Values, by the types that are asked for.

use std::sync::Arc;

use motet_compiler::signature::Type;
use motet_syntax::unit::Unit;

use super::Speller;
use crate::automaton::{
    Action, BoundNames, Constant, Guard, NodeKind, Op, OpId, WordEnd, WordList, WordRole, WordTable,
};
use crate::subset::{MAX_ITEMS, NumberRange};

impl Speller<'_> {
    /// A value of a type. Its word, and that of its elements.
    pub(super) fn value(
        &mut self,
        ty: &Type,
        card: Option<(f64, f64)>,
        role: WordRole,
    ) -> (Option<OpId>, Option<OpId>) {
        match ty {
            Type::Entity(_) | Type::Enum(_) | Type::Pose => {
                let tables = self.of.table(ty);
                let table = if role == WordRole::Of { tables.1 } else { tables.0 };
                (Some(self.word(table, ty, role)), None)
            }
            Type::Text => {
                let arg = if let WordRole::Argument(arg) = role { Some(arg) } else { None };
                self.text(arg);
                (None, None)
            }
            Type::Bool => {
                let choice = self.of.asm.later();
                let yes = self.act(Action::Constant(Constant::True));
                let over = self.jump();
                let no = self.act(Action::Constant(Constant::False));
                let next = self.of.asm.here();
                self.land(over, next);
                self.of.asm.choose(choice, &[("true", yes, Guard::Open), ("false", no, Guard::Open)]);
                (None, None)
            }
            Type::Int | Type::Number | Type::Quantity(_) => {
                if let Some(range) = NumberRange::of(ty, card) {
                    self.number(range);
                }
                (None, None)
            }
            Type::List(element) => {
                let choice = self.of.asm.later();
                let (open, item) = self.list(|speller| speller.value(element, None, WordRole::Free).0);
                let over = self.jump();
                let word = self.word(Arc::new(WordTable::default()), ty, role);
                let next = self.of.asm.here();
                self.land(over, next);
                self.of.asm.maybe(choice, ("[", open, Guard::Open), (word, Guard::Rare));
                (Some(word), item)
            }
        }
    }

    /// A list behind its `[`, to its `]`; what comes with its items.
    pub(super) fn list<T>(&mut self, item: impl FnOnce(&mut Self) -> T) -> (OpId, T) {
        let open = self.act(Action::Open(NodeKind::List));
        let items = self.of.asm.later();
        self.act(Action::Close);
        let over = self.jump();
        let rule = self.of.asm.here();
        let made = item(self);
        self.act(Action::Count);
        let after = self.of.asm.later();
        let more = self.of.asm.put(Op::Jump(rule));
        let done = self.of.asm.put(Op::Return);
        let most = u8::try_from(MAX_ITEMS).unwrap_or(0);
        self.of.asm.choose(after, &[(", ", more, Guard::Below(most)), ("]", done, Guard::Open)]);
        self.of.asm.set(items, Op::Call(rule));
        let next = self.of.asm.here();
        self.land(over, next);
        (open, made)
    }

    pub(super) fn word(&mut self, table: Arc<WordTable>, ty: &Type, role: WordRole) -> OpId {
        let bound = self.of.bound(ty);
        let next = self.of.asm.here() + 1;
        self.of.asm.put(Op::Word(WordList { table, bound, role, ends: WordEnd::Bare, next }))
    }

    /// A number with its unit.
    pub(super) fn number(&mut self, range: NumberRange) {
        let spelled = match range.unit {
            Some(Unit::Percent) => NumberRange { decimals: range.decimals.saturating_sub(2), ..range },
            _ => range,
        };
        self.of.asm.put(Op::Number(spelled));
        if let Some(unit) = range.unit {
            self.of.asm.literal(&format!(" {}", unit.symbol()));
        }
    }

    /// A text, or a name of one.
    pub(super) fn text(&mut self, arg: Option<u8>) {
        let choice = self.of.asm.later();
        let text = self.of.asm.put(Op::Text { arg });
        let over = self.jump();
        let role = arg.map_or(WordRole::Free, WordRole::Argument);
        let word = self.word(Arc::new(WordTable::default()), &Type::Text, role);
        let next = self.of.asm.here();
        self.land(over, next);
        self.of.asm.maybe(choice, ("\"", text, Guard::Open), (word, Guard::Rare));
    }

    /// What may be left out: a number of a modifier behind a word, or nothing.
    pub(super) fn number_or_none(&mut self, word: &str, range: NumberRange) {
        let choice = self.of.asm.later();
        let number = self.of.asm.here();
        self.number(range);
        let over = self.jump();
        let none = self.act(Action::Constant(Constant::Null));
        let next = self.of.asm.here();
        self.land(over, next);
        self.of.asm.maybe(choice, (word, number, Guard::Open), (none, Guard::Open));
    }

    /// The list of an `each`: a name, or entities of one kind.
    pub(super) fn list_of_entities(&mut self) {
        let choice = self.of.asm.later();
        let table = self.of.table(&Type::Entity(0)).0;
        let (open, ()) = self.list(|speller| {
            let next = speller.of.asm.here() + 1;
            let (bound, role, ends) = (BoundNames::None, WordRole::Alike, WordEnd::Bare);
            speller.of.asm.put(Op::Word(WordList { table, bound, role, ends, next }));
        });
        self.act(Action::BindItem);
        let over = self.jump();
        let (next, table) = (self.of.asm.here() + 1, Arc::new(WordTable::default()));
        let (bound, role, ends) = (BoundNames::Lists, WordRole::Free, WordEnd::Bare);
        let word = self.of.asm.put(Op::Word(WordList { table, bound, role, ends, next }));
        self.land(over, next);
        self.of.asm.maybe(choice, ("[", open, Guard::Open), (word, Guard::Rare));
    }
}
