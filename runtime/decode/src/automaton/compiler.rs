//! What the compilers of both subsets share: types by number, words by type, and the automaton that is made in the end.

use std::sync::Arc;

use motet_compiler::signature::{Signatures, Type};
use motet_compiler::{Session, draft::Draft};
use motet_syntax::Syntax;
use motet_syntax::print::identifier;
use motet_syntax::words::RESERVED;
use rustc_hash::{FxHashMap, FxHashSet};
use smol_str::SmolStr;

use super::{
    Assembler, Automaton, BoundNames, Callable, Entry, Guard, Meaning, Op, OpId, WordEnd, WordList, WordRole,
    WordTable,
};
use crate::subset::{NumberRange, Relation, Subset};

/// A automaton in the making.
pub(super) struct Compiler<'a> {
    pub(super) asm: Assembler,
    types: Vec<Type>,
    tables: FxHashMap<Type, (Arc<WordTable>, Arc<WordTable>)>,
    pub(super) callables: Vec<Callable>,
    pub(super) fluents: Vec<Vec<OpId>>,
    pub(super) measures: bool,
    pub(super) subset: Subset,
    /// Whether the robot observes anything that a condition could be about.
    pub(super) observes: bool,
    pub(super) signatures: &'a Signatures,
    pub(super) session: &'a Session,
}

impl<'a> Compiler<'a> {
    pub(super) fn new(session: &'a Session, signatures: &'a Signatures, subset: Subset) -> Self {
        Self {
            asm: Assembler::default(),
            types: signatures.bindable(),
            tables: FxHashMap::default(),
            callables: Vec::new(),
            fluents: Vec::new(),
            measures: false,
            subset,
            observes: signatures.fluents.iter().any(|fluent| fluent.is_observable),
            signatures,
            session,
        }
    }

    /// The automaton, which begins at `start`.
    pub(super) fn finish(self, start: OpId) -> Automaton {
        let Self { asm, types, callables, fluents, measures, subset, session, .. } = self;
        let rest = asm.rests();
        let signatures = session.signatures();
        let bits = signatures.fluents.iter().map(|fluent| Draft::fluent(session, &fluent.name));
        let fluent_bits = bits.collect();
        let taken = taken(&signatures, subset);
        let ops = asm.ops;
        Automaton {
            ops,
            rest,
            start,
            types,
            callables,
            fluents,
            fluent_bits,
            measures,
            subset,
            taken,
            signatures,
        }
    }

    pub(super) fn type_number(&mut self, ty: &Type) -> u16 {
        let at = self.types.iter().position(|known| known == ty).unwrap_or_else(|| {
            self.types.push(ty.clone());
            self.types.len() - 1
        });
        u16::try_from(at).unwrap_or(u16::MAX)
    }

    pub(super) fn bound(&mut self, ty: &Type) -> BoundNames {
        let fits = self.types.iter().any(|actual| self.signatures.fits(ty, actual));
        if fits { BoundNames::Type(self.type_number(ty)) } else { BoundNames::None }
    }

    /// The relations that values of a type are compared by, each under its spelling.
    pub(super) fn relation(&mut self, ty: &Type, ends: WordEnd, spelled: impl Fn(Relation) -> SmolStr) {
        let is_ordered = NumberRange::of(ty, None).is_some();
        let relations = Relation::ALL.iter().zip(0..);
        let relations = relations.filter(|(relation, _)| is_ordered || Relation::EQUALITY.contains(relation));
        let entries = relations.map(|(relation, place)| Entry {
            name: spelled(*relation),
            meaning: Meaning::Named(place),
            to: None,
            guard: Guard::Open,
        });
        self.plain_word(Arc::new(WordTable::new(entries)), ends);
    }

    /// What a value of a type is compared with, and whether there is anything; none of what each subset spells in its
    /// own way: numbers with their ranges, true and false.
    pub(super) fn operand(&mut self, ty: &Type, ends: WordEnd) -> Option<bool> {
        match ty {
            Type::Int | Type::Number | Type::Quantity(_) if NumberRange::of(ty, None).is_none() => {
                Some(false)
            }
            Type::Int | Type::Number | Type::Quantity(_) | Type::Bool => None,
            Type::Text => {
                self.asm.literal("\"");
                self.asm.put(Op::Text { arg: None });
                Some(true)
            }
            Type::Entity(_) | Type::Enum(_) => {
                let table = self.table(ty).0;
                let can = !table.entries.is_empty();
                self.plain_word(table, ends);
                Some(can)
            }
            Type::Pose | Type::List(_) => Some(false),
        }
    }

    /// One of some words, none of them bound.
    fn plain_word(&mut self, table: Arc<WordTable>, ends: WordEnd) {
        let next = self.asm.here() + 1;
        self.asm.put(Op::Word(WordList { table, bound: BoundNames::None, role: WordRole::Free, ends, next }));
    }

    /// The words of a type, without and with `any`.
    pub(super) fn table(&mut self, ty: &Type) -> (Arc<WordTable>, Arc<WordTable>) {
        let (signatures, form) = (self.signatures, self.subset.syntax);
        let made = self.tables.entry(ty.clone()).or_insert_with(|| {
            let table = match ty {
                Type::Entity(kind) => WordTable::of_kind(signatures, *kind),
                Type::Enum(id) => WordTable::of_cases(signatures, *id),
                _ => WordTable::default(),
            };
            let table = match form {
                Syntax::Json => table,
                Syntax::Text => WordTable::new(
                    table
                        .entries
                        .into_iter()
                        .map(|entry| Entry { name: identifier(&entry.name).into(), ..entry }),
                ),
            };
            let any = table.with_any();
            (Arc::new(table), Arc::new(any))
        });
        (Arc::clone(&made.0), Arc::clone(&made.1))
    }
}

/// What a name that a policy gives may not be: an entity, and in the text form what would mean something else there.
fn taken(signatures: &Signatures, subset: Subset) -> FxHashSet<SmolStr> {
    let entities = signatures.entities.iter().map(|row| row.0.clone());
    if subset.syntax == Syntax::Json {
        return entities.collect();
    }
    let words = RESERVED.iter().map(|word| SmolStr::new_static(word));
    let cases = signatures.enums.iter().flat_map(|def| def.cases.iter().cloned());
    words.chain(entities).chain(cases).collect()
}
