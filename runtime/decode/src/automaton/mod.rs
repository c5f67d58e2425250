//! What a policy can be spelled like, compiled for one robot, scene and state: a byte automaton. It says which bytes may
//! follow which and what they mean; which of its choices are open in a given policy is [`crate::acceptor`]'s to say.
//!
//! A automaton is a list of operations. One of them takes bytes (a literal, a choice, a word, a text, a name, a number), or
//! none (an event, a call of a rule, a return). Every operation knows the length of its shortest completion, so that a
//! walk can be held within a number of bytes.

mod assembler;
mod callable;
mod conditions;
mod lowering;
mod values;
mod word_table;

use std::sync::Arc;

use motet_compiler::signature::{Signatures, Type};
use motet_syntax::Syntax;
use motet_syntax::unit::Unit;
use rustc_hash::FxHashSet;
use smol_str::SmolStr;

pub(crate) use self::assembler::Assembler;
pub(crate) use self::callable::Callable;
pub(crate) use self::word_table::{Meaning, Word, WordTable};
use crate::grammar::{Action, Guard, NameUse, WordRole};
use crate::subset::{NumberRange, Subset};

/// The place of an operation.
pub(crate) type OpId = u32;

/// One operation.
#[derive(Clone, Debug)]
pub(crate) enum Op {
    /// These bytes.
    Literal(Box<[u8]>),
    /// One of several literals; no two begin with the same bytes.
    Choose(Box<[Branch]>),
    /// One of a list of words that depends on the policy so far.
    Word(WordList),
    /// If the next byte is this one and the word at `then` has an alternative, that; otherwise `other`.
    Fork { byte: u8, then: OpId, other: OpId },
    /// These bytes and on at `then`, or nothing and on at `other`, whose first bytes may be the same.
    Optional(OptionalPart),
    /// The characters of a text and the quote behind it. `arg`: of which argument of a call.
    Text { arg: Option<u8> },
    /// A new name and what ends it: a quote, in text a space.
    Name(NameUse),
    /// A number.
    Number(NumberRange),
    /// Nothing: something is meant.
    Action(Action),
    /// A rule, then the next operation.
    Call(OpId),
    /// On at another place.
    Jump(OpId),
    /// Back to behind the call.
    Return,
    /// The end of the document.
    Accept,
}

/// An alternative of a choice.
#[derive(Clone, Debug)]
pub(crate) struct Branch {
    pub(crate) bytes: Box<[u8]>,
    pub(crate) to: OpId,
    pub(crate) guard: Guard,
}

/// What may be left out.
#[derive(Clone, Debug)]
pub(crate) struct OptionalPart {
    pub(crate) bytes: Box<[u8]>,
    pub(crate) then: OpId,
    pub(crate) guard: Guard,
    pub(crate) other: OpId,
    /// When it may be left out.
    pub(crate) absent: Guard,
}

/// A list of words: static ones, and the names that the policy has bound.
#[derive(Clone, Debug)]
pub(crate) struct WordList {
    pub(crate) table: Arc<WordTable>,
    /// Names of this type.
    pub(crate) bound: BoundNames,
    pub(crate) role: WordRole,
    pub(crate) ends: WordEnd,
    /// Where to go on, unless the word says so itself.
    pub(crate) next: OpId,
}

/// Where a word begins and ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum WordEnd {
    /// In quotes, both of which are part of it.
    Quoted,
    /// The quote behind it is part of it.
    Tail,
    /// Where no letter follows.
    Bare,
    /// Where it is whole: none begins another.
    Whole,
}

/// Which names that the policy has bound are among the words.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum BoundNames {
    None,
    /// Those of the type with this number, or of one below it.
    Type(u16),
    /// Those of a list.
    Lists,
}

/// A byte automaton.
#[derive(Clone, Debug)]
pub(crate) struct Automaton {
    pub(crate) ops: Vec<Op>,
    /// By operation: how many bytes lead from before it to the end of its rule, at the shortest.
    pub(crate) rest: Vec<u32>,
    pub(crate) start: OpId,
    pub(crate) signatures: Arc<Signatures>,
    pub(crate) types: Vec<Type>,
    pub(crate) callables: Vec<Callable>,
    /// The operations of the arguments of each fluent.
    pub(crate) fluents: Vec<Vec<OpId>>,
    /// By fluent its bit among those that a callable speaks of.
    pub(crate) fluent_bits: Vec<u64>,
    /// Whether a condition can be about a measure.
    pub(crate) measures: bool,
    pub(crate) subset: Subset,
    /// What no new name may be.
    pub(crate) taken: FxHashSet<SmolStr>,
}

impl Automaton {
    pub(crate) fn op(&self, id: OpId) -> &Op {
        self.ops.get(id as usize).unwrap_or(&Op::Accept)
    }

    pub(crate) fn rest(&self, id: OpId) -> u32 {
        self.rest.get(id as usize).copied().unwrap_or(0)
    }

    /// How many decimals a number has that is spelled in a range: percents have two less than what they say.
    pub(crate) fn decimals(&self, range: &NumberRange) -> u8 {
        let is_percent = range.unit == Some(Unit::Percent) && self.subset.syntax == Syntax::Text;
        range.decimals + if is_percent { 2 } else { 0 }
    }

    pub(crate) fn ty(&self, id: u16) -> Option<&Type> {
        self.types.get(usize::from(id))
    }
}
