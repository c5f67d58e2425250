//! Lowering of values, by the types that are asked for.

use std::sync::Arc;

use motet_compiler::signature::Type;
use motet_syntax::print::identifier;
use motet_syntax::unit::Unit;
use smol_str::{SmolStr, format_smolstr};

use super::lowering::Lowering;
use super::{BoundNames, Meaning, Op, OpId, Word, WordEnd, WordList, WordTable};
use crate::grammar::{Action, Constant, Guard, NameUse, NodeKind, Relation, ValuePlace, ValueSet, WordRole};
use crate::subset::{MAX_ITEMS, NumberRange};

impl Lowering<'_> {
    /// A value at a place of the grammar.
    pub(super) fn placed_value(&mut self, ty: &Type, range: Option<(f64, f64)>, place: ValuePlace) {
        let role = match place {
            ValuePlace::Argument(number) => WordRole::Argument(number),
            ValuePlace::OfFluent => WordRole::Of,
            ValuePlace::Plain => WordRole::Free,
            ValuePlace::Operand => return self.operand(ty),
        };
        let (word, element) = match (role, ty) {
            (WordRole::Argument(place), Type::Entity(_)) => (Some(self.entity_or_first(ty, place)), None),
            (WordRole::Argument(place), Type::Pose) => (Some(self.pose(place)), None),
            _ => self.value(ty, range, role),
        };
        match self.owner {
            // The operations of a cleanup are the same once more.
            Some(NodeKind::Do(_)) if self.in_cleanup => {}
            Some(NodeKind::Do(number)) if matches!(role, WordRole::Argument(_)) => {
                if let Some(callable) = self.callables.get_mut(usize::from(number)) {
                    callable.words.push(word);
                    callable.elements.push(element);
                }
            }
            Some(NodeKind::Is(number)) if role == WordRole::Of => {
                self.fluents.get_mut(usize::from(number)).into_iter().for_each(|words| words.extend(word));
            }
            _ => {}
        }
    }

    /// A value of a type. The operation of its word, and that of its elements, where they are words.
    fn value(
        &mut self,
        ty: &Type,
        range: Option<(f64, f64)>,
        role: WordRole,
    ) -> (Option<OpId>, Option<OpId>) {
        match ty {
            Type::Entity(_) | Type::Enum(_) | Type::Pose | Type::Failure => {
                let (table, with_any) = self.table(ty);
                (Some(self.word(if role == WordRole::Of { with_any } else { table }, ty, role)), None)
            }
            Type::Text => {
                self.text(role);
                (None, None)
            }
            Type::Bool => {
                let choice = self.later();
                let yes = self.constant(Constant::True);
                let over = self.later();
                let no = self.constant(Constant::False);
                self.land_here(over);
                self.asm
                    .choose(choice, &[("true".into(), yes, Guard::Open), ("false".into(), no, Guard::Open)]);
                (None, None)
            }
            Type::Int | Type::Number | Type::Quantity(_) => {
                if let Some(range) = NumberRange::of(ty, range) {
                    self.number(range);
                }
                (None, None)
            }
            Type::List(element) => {
                let mut item = None;
                let (choice, open) = self.list(|lowering| {
                    item = lowering.value(element, None, WordRole::Free).0;
                });
                let over = self.later();
                let word = self.word(Arc::new(WordTable::default()), ty, role);
                self.land_here(over);
                self.list_or_word(choice, open, word);
                (Some(word), item)
            }
        }
    }

    /// A list that is written out; the place of the choice before it, and where the list begins.
    fn list(&mut self, item: impl FnOnce(&mut Self)) -> (OpId, OpId) {
        let choice = self.later();
        let is_json = self.is_json();
        let open = self.asm.here();
        if is_json {
            self.asm.literal("[");
        }
        self.act(Action::Open(NodeKind::List));
        let items = self.later();
        self.act(Action::Close);
        let over = self.later();
        let rule = self.asm.here();
        item(self);
        self.act(Action::Count);
        let most = u8::try_from(MAX_ITEMS).unwrap_or(0);
        self.next_member([if is_json { "," } else { ", " }, "]"], rule, most);
        self.asm.set(items, Op::Call(rule));
        self.land_here(over);
        (choice, open)
    }

    /// Tells a list from a name of one.
    fn list_or_word(&mut self, choice: OpId, open: OpId, word: OpId) {
        if self.is_json() {
            self.asm.set(choice, Op::Fork { byte: b'"', then: word, guard: Guard::Open, other: open });
        } else {
            self.asm.optional(choice, ("[", open, Guard::Open), (word, Guard::Rare));
        }
    }

    /// The list of an `each`: a name, or entities of one kind.
    pub(super) fn entity_list(&mut self) {
        let table = self.table(&Type::Entity(0)).0;
        let ends = self.word_end();
        let (choice, open) = self.list(|lowering| {
            let next = lowering.asm.here() + 1;
            let (bound, role) = (BoundNames::None, WordRole::Alike);
            lowering.asm.put(Op::Word(WordList { table, bound, role, ends, next }));
        });
        self.act(Action::BindItem);
        let over = self.later();
        let (next, table) = (self.asm.here() + 1, Arc::new(WordTable::default()));
        let (bound, role) = (BoundNames::Lists, WordRole::Free);
        let word = self.asm.put(Op::Word(WordList { table, bound, role, ends, next }));
        self.land_here(over);
        self.list_or_word(choice, open, word);
    }

    /// The name of a list in a term on it, or of a failure before its field.
    pub(super) fn bound_name(&mut self, bound: BoundNames) {
        self.bound_word(bound, WordRole::Free);
    }

    /// The name that a handler gives its failure, or nothing.
    pub(super) fn caught_name(&mut self) {
        let is_json = self.is_json();
        if is_json {
            self.asm.literal(",\"as\":");
        }
        let choice = self.later();
        let ty = self.type_number(&Type::Failure);
        let name = self.asm.put(Op::Name(NameUse::Result(ty)));
        let none = self.asm.here();
        if is_json {
            let transitions = [("null".into(), none, Guard::Open), ("\"".into(), name, Guard::Open)];
            self.asm.choose(choice, &transitions);
        } else {
            self.asm.optional(choice, ("as ", name, Guard::Open), (none, Guard::Open));
        }
    }

    /// A kind of failure.
    pub(super) fn failure_kind(&mut self) {
        let is_json = self.is_json();
        let failures = self.signatures.failures.iter().zip(0u16..).filter(|(name, _)| *name != "any");
        let words = failures.map(|(name, number)| Word {
            name: if is_json { name.clone() } else { identifier(name).into() },
            meaning: Meaning::Named(number),
            to: None,
            guard: Guard::Open,
        });
        let (table, ends) = (Arc::new(WordTable::new(words)), self.word_end());
        self.plain_word(table, ends);
    }

    /// The type of the policy's result, or nothing.
    pub(super) fn result_type(&mut self) {
        let is_json = self.is_json();
        if is_json {
            self.asm.literal(",\"result\":");
        }
        let types = self.grammar.result_types().into_iter();
        let words = types.map(|(number, name)| Word {
            name: if is_json { name } else { format_smolstr!("{name} ") },
            meaning: Meaning::Named(number),
            to: None,
            guard: Guard::Open,
        });
        let table = Arc::new(WordTable::new(words));
        let choice = self.later();
        let some = self.asm.here();
        self.plain_word(table, if is_json { WordEnd::Tail } else { WordEnd::Whole });
        self.act(Action::Gives);
        let none = self.asm.here();
        if is_json {
            let transitions = [("null".into(), none, Guard::Open), ("\"".into(), some, Guard::Open)];
            self.asm.choose(choice, &transitions);
        } else {
            self.asm.optional(choice, ("-> ", some, Guard::Open), (none, Guard::Open));
        }
    }

    /// The result of a `done`, if the policy gives one.
    pub(super) fn given(&mut self, [lead, end]: [&str; 2]) {
        let choice = self.later();
        let then = self.asm.here();
        if !lead.is_empty() {
            self.asm.literal(lead);
        }
        self.bound_word(BoundNames::Given, WordRole::Free);
        if !end.is_empty() {
            self.asm.literal(end);
        }
        let other = self.asm.here();
        self.asm.set(choice, Op::Gives { then, other });
    }

    /// A pose that is an argument of a call: the name of one, or one that is written out. The operation of
    /// its word.
    fn pose(&mut self, place: u8) -> OpId {
        let ty = Type::Pose;
        let [open, separator, end] =
            if self.is_json() { ["{\"pose\":[", ",", "]}"] } else { ["pose(", ", ", ")"] };
        let choice = self.grammar.has_poses().then(|| self.later());
        let table = self.table(&ty).0;
        let role = WordRole::Argument(place);
        let word = self.word(table, &ty, role);
        let Some(choice) = choice else { return word };
        let over = self.later();
        let pose = self.asm.here();
        if self.is_json() {
            self.asm.literal(open);
        }
        self.act(Action::Open(NodeKind::Pose));
        for (index, range) in NumberRange::of_pose().into_iter().enumerate() {
            if index > 0 {
                self.asm.literal(separator);
            }
            self.number(range);
        }
        self.asm.literal(end);
        self.act(Action::Close);
        self.land_here(over);
        if self.is_json() {
            self.asm.set(choice, Op::Fork { byte: b'{', then: pose, guard: Guard::Pose, other: word });
        } else {
            self.asm.optional(choice, (open, pose, Guard::Pose), (word, Guard::Rare));
        }
        word
    }

    fn bound_word(&mut self, bound: BoundNames, role: WordRole) -> OpId {
        let (next, table, ends) = (self.asm.here() + 1, Arc::new(WordTable::default()), self.word_end());
        self.asm.put(Op::Word(WordList { table, bound, role, ends, next }))
    }

    /// An entity that is an argument of a call, or the first element of a list. The operation of its word.
    fn entity_or_first(&mut self, ty: &Type, place: u8) -> OpId {
        let role = WordRole::Argument(place);
        let lists = Type::List(Box::new(ty.clone()));
        let is_first = self.grammar.has_term("first") && self.grammar.can_bind(&lists);
        let choice = is_first.then(|| self.later());
        let table = self.table(ty).0;
        let word = self.word(table, ty, role);
        let Some(choice) = choice else { return word };
        let over = self.later();
        let number = self.type_number(ty);
        let [open, end] = if self.is_json() { ["{\"get\":\"first\",\"of\":", "}"] } else { ["first(", ")"] };
        let guard = Guard::First(place, number);
        let first = self.asm.here();
        if self.is_json() {
            self.asm.literal(open);
        }
        self.bound_word(BoundNames::First(number), role);
        self.asm.literal(end);
        self.land_here(over);
        if self.is_json() {
            self.asm.set(choice, Op::Fork { byte: b'{', then: first, guard, other: word });
        } else {
            self.asm.optional(choice, (open, first, guard), (word, Guard::Open));
        }
        word
    }

    fn word_end(&self) -> WordEnd {
        if self.is_json() { WordEnd::Quoted } else { WordEnd::Bare }
    }

    /// One of some words and of the names bound to a type.
    fn word(&mut self, table: Arc<WordTable>, ty: &Type, role: WordRole) -> OpId {
        let ends = self.word_end();
        self.word_with(table, ty, role, ends)
    }

    fn word_with(&mut self, table: Arc<WordTable>, ty: &Type, role: WordRole, ends: WordEnd) -> OpId {
        let fits = self.types.iter().any(|actual| self.signatures.fits(ty, actual));
        let bound = if fits { BoundNames::Type(self.type_number(ty)) } else { BoundNames::None };
        let next = self.asm.here() + 1;
        self.asm.put(Op::Word(WordList { table, bound, role, ends, next }))
    }

    fn type_number(&mut self, ty: &Type) -> u16 {
        let at = self.types.iter().position(|known| known == ty).unwrap_or_else(|| {
            self.types.push(ty.clone());
            self.types.len() - 1
        });
        u16::try_from(at).unwrap_or(u16::MAX)
    }

    /// One of some words, none of them bound.
    fn plain_word(&mut self, table: Arc<WordTable>, ends: WordEnd) {
        let next = self.asm.here() + 1;
        let (bound, role) = (BoundNames::None, WordRole::Free);
        self.asm.put(Op::Word(WordList { table, bound, role, ends, next }));
    }

    /// The right side of a comparison.
    fn operand(&mut self, ty: &Type) {
        match ty {
            Type::Int | Type::Number | Type::Quantity(_) | Type::Bool => {
                self.value(ty, None, WordRole::Free);
            }
            Type::Text => {
                self.asm.literal("\"");
                self.asm.put(Op::Text { arg: None });
            }
            Type::Entity(_) | Type::Enum(_) => {
                let (table, ends) = (self.table(ty).0, self.word_end());
                self.plain_word(table, ends);
            }
            // The grammar compares nothing with these.
            Type::Pose | Type::Failure | Type::List(_) => {}
        }
    }

    /// The relations by which values of a type are compared.
    pub(super) fn relation(&mut self, ty: &Type) {
        let is_json = self.is_json();
        if is_json {
            self.asm.literal("\"");
        }
        let relations = Relation::ALL.iter().zip(0..);
        let relations = relations
            .filter(|(relation, _)| ValueSet::is_ordered(ty) || Relation::EQUALITY.contains(relation));
        let words = relations.map(|(relation, number)| Word {
            name: match is_json {
                true => SmolStr::new_static(relation.word()),
                false => format_smolstr!("{} ", relation.symbol()),
            },
            meaning: Meaning::Named(number),
            to: None,
            guard: Guard::Open,
        });
        let table = Arc::new(WordTable::new(words));
        self.plain_word(table, if is_json { WordEnd::Tail } else { WordEnd::Whole });
    }

    /// A number; in text with its unit.
    pub(super) fn number(&mut self, range: NumberRange) {
        if self.is_json() {
            self.asm.put(Op::Number(range));
            return;
        }
        self.asm.put(Op::Number(range.spelled_in_text()));
        if let Some(unit) = range.unit {
            self.asm.literal(&format!(" {}", Unit::symbol(unit)));
        }
    }

    /// A number or its default. A deadline may turn out to be that of a block behind it.
    pub(super) fn optional_number(&mut self, lead: &str, range: NumberRange, is_deadline: bool) {
        let is_json = self.is_json();
        if is_json {
            self.asm.literal(lead);
        }
        let choice = self.later();
        let number = self.asm.here();
        self.number(range);
        if is_deadline {
            self.split();
        }
        let over = self.later();
        let none = self.asm.here();
        if is_json {
            self.asm.literal("null");
        }
        self.constant(Constant::Null);
        self.land_here(over);
        if is_json {
            self.asm.set(choice, Op::Fork { byte: b'n', then: none, guard: Guard::Open, other: number });
        } else {
            self.asm.optional(choice, (lead, number, Guard::Open), (none, Guard::Open));
        }
    }

    /// A manner, or its default.
    pub(super) fn manner(&mut self) {
        const WORDS: [(&str, Constant); 2] = [("slowly", Constant::Slowly), ("gently", Constant::Gently)];
        let lead = self.grammar.manner_lead();
        let mut jumps = Vec::new();
        if self.is_json() {
            self.asm.literal(lead);
            let [null_or, word_or] = [self.later(), self.later()];
            let part = self.asm.here();
            self.number(NumberRange::PART);
            jumps.push(self.later());
            let null = self.asm.literal("null");
            self.constant(Constant::Null);
            jumps.push(self.later());
            let (words, mut transitions) = (self.later(), Vec::new());
            for (word, constant) in WORDS {
                transitions.push((format_smolstr!("\"{word}\""), self.constant(constant), Guard::Open));
                jumps.push(self.later());
            }
            jumps.into_iter().for_each(|jump| self.land_here(jump));
            self.asm.choose(words, &transitions);
            let guard = Guard::Open;
            self.asm.set(null_or, Op::Fork { byte: b'n', then: null, guard, other: word_or });
            self.asm.set(word_or, Op::Fork { byte: b'"', then: words, guard, other: part });
            return;
        }
        for (word, constant) in WORDS {
            let choice = self.later();
            let then = self.constant(constant);
            jumps.push(self.later());
            let other = self.asm.here();
            self.asm.optional(choice, (&format!("{lead}{word}"), then, Guard::Open), (other, Guard::Open));
        }
        self.optional_number(&format!("{lead}at "), NumberRange::PART, false);
        jumps.into_iter().for_each(|jump| self.land_here(jump));
    }

    /// A text, or a name of one.
    fn text(&mut self, role: WordRole) {
        let arg = if let WordRole::Argument(arg) = role { Some(arg) } else { None };
        let role = if arg.is_some() { role } else { WordRole::Free };
        let is_json = self.is_json();
        if is_json {
            self.asm.literal("\"");
        }
        let choice = self.later();
        let text = self.asm.put(Op::Text { arg });
        let over = self.later();
        let ends = if is_json { WordEnd::Tail } else { WordEnd::Bare };
        let word = self.word_with(Arc::new(WordTable::default()), &Type::Text, role, ends);
        self.land_here(over);
        if is_json {
            self.asm.set(choice, Op::Fork { byte: b'$', then: word, guard: Guard::Open, other: text });
        } else {
            self.asm.optional(choice, ("\"", text, Guard::Open), (word, Guard::Rare));
        }
    }
}
