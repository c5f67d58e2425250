//! Conditions: fluents, comparisons, and what joins them.

use std::sync::Arc;

use motet_compiler::signature::Type;
use smol_str::SmolStr;

use crate::automaton::compiler::Compiler;
use crate::automaton::{
    Action, BoundNames, Entry, Guard, Meaning, NodeKind, Op, OpId, WordEnd, WordList, WordRole, WordTable,
};
use crate::subset::{MAX_MEMBERS, is_text};

impl Compiler<'_> {
    /// A condition behind its `{"`, with its brace.
    pub(super) fn condition(&mut self) -> OpId {
        let start = self.asm.later();
        let end = self.asm.literal("}");
        self.asm.act(Action::Close);
        self.asm.put(Op::Return);
        let mut ways = Vec::new();
        let signatures = self.signatures;

        let mut entries = Vec::new();
        for (index, fluent) in signatures.fluents.iter().enumerate() {
            let Ok(number) = u16::try_from(index) else { break };
            let at = self.asm.act(Action::Open(NodeKind::Is(number)));
            let mut args = Vec::new();
            for (name, ty) in &fluent.params {
                self.asm.literal(&format!(",\"{name}\":"));
                args.extend(self.value(ty, None, WordRole::Of).0);
            }
            self.asm.put(Op::Jump(end));
            self.fluents.push(args);
            if is_text(&fluent.name) && fluent.name != "monitored" {
                entries.push(Entry {
                    name: fluent.name.clone(),
                    meaning: Meaning::Named(number),
                    to: Some(at),
                    guard: Guard::Open,
                });
            }
        }
        let is = self.words(entries, WordRole::Fluent);
        ways.push(("is\":\"", is, Guard::Is));

        let not = self.asm.act(Action::Open(NodeKind::Not));
        self.asm.act(Action::Negate);
        self.asm.act(Action::Deeper);
        self.asm.put(Op::Call(start));
        self.asm.put(Op::Jump(end));
        ways.push(("not\":{\"", not, Guard::Not));
        for (word, kind, guard) in
            [("all\":[{\"", NodeKind::All, Guard::All), ("any\":[{\"", NodeKind::Any, Guard::Any)]
        {
            let at = self.asm.act(Action::Open(kind));
            self.asm.act(Action::Deeper);
            self.asm.act(Action::Loosen);
            let rule = self.asm.here() + 2;
            self.asm.put(Op::Call(rule));
            self.asm.put(Op::Jump(end));
            self.asm.put(Op::Call(start));
            self.asm.literal(",{\"");
            let second = self.asm.put(Op::Call(start));
            let after = self.asm.later();
            let more = self.asm.act(Action::Count);
            self.asm.put(Op::Jump(second));
            let done = self.asm.put(Op::Return);
            let below = u8::try_from(MAX_MEMBERS - 2).unwrap_or(0);
            self.asm.choose(after, &[(",{\"", more, Guard::Below(below)), ("]", done, Guard::Open)]);
            ways.push((word, at, guard));
        }

        let mut entries = Vec::new();
        for (index, measure) in signatures.measures.iter().enumerate() {
            let Ok(number) = u16::try_from(index) else { break };
            let has_values = measure.params.iter().all(|(_, ty)| !self.table(ty).0.entries.is_empty());
            if !measure.is_observable || !has_values {
                continue;
            }
            let at = self.asm.act(Action::Open(NodeKind::Get(number)));
            for (name, ty) in &measure.params {
                self.asm.literal(&format!(",\"{name}\":"));
                self.value(ty, None, WordRole::Free);
            }
            if self.comparison(&measure.result, end) {
                let meaning = Meaning::Named(number);
                entries.push(Entry { name: measure.name.clone(), meaning, to: Some(at), guard: Guard::Open });
            }
        }
        self.measures = !entries.is_empty();
        if !entries.is_empty() {
            let get = self.words(entries, WordRole::Head);
            ways.push(("get\":\"", get, Guard::Loose));
        }
        let mut entries: Vec<Entry> = Vec::new();
        for (index, field) in signatures.fields.iter().enumerate() {
            let Ok(number) = u16::try_from(index) else { break };
            let is_first = entries.iter().all(|entry| entry.name != field.name);
            let has_one = signatures.entities_of(field.kind).next().is_some();
            if !is_first || !has_one {
                continue;
            }
            let at = self.asm.act(Action::Open(NodeKind::Field(number)));
            self.asm.literal(",\"of\":");
            self.value(&Type::Entity(field.kind), None, WordRole::Free);
            if self.comparison(&field.ty, end) {
                let meaning = Meaning::Named(number);
                entries.push(Entry { name: field.name.clone(), meaning, to: Some(at), guard: Guard::Open });
            }
        }
        if !entries.is_empty() {
            let field = self.words(entries, WordRole::Head);
            ways.push(("field\":\"", field, Guard::Loose));
        }
        self.asm.choose(start, &ways);
        start
    }

    pub(super) fn words(&mut self, entries: Vec<Entry>, role: WordRole) -> OpId {
        let next = self.asm.here();
        let table = Arc::new(WordTable::new(entries));
        self.asm.put(Op::Word(WordList { table, bound: BoundNames::None, role, ends: WordEnd::Tail, next }))
    }

    /// `,"is":"less","than":0.5`; false where nothing can be compared with.
    pub(super) fn comparison(&mut self, ty: &Type, end: OpId) -> bool {
        self.asm.literal(",\"is\":\"");
        self.relation(ty, WordEnd::Tail, |relation| SmolStr::new_static(relation.word()));
        self.asm.literal(",\"than\":");
        let can = self.operand(ty, WordEnd::Quoted).unwrap_or_else(|| {
            self.value(ty, None, WordRole::Free);
            true
        });
        self.asm.put(Op::Jump(end));
        can
    }
}
