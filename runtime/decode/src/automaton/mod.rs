//! The byte automaton: a grammar lowered to operations for one robot, scene and state.
//!
//! An operation takes bytes (a literal, a choice, a word, a text, a name, a number) or none (an action, a
//! rule call, a return). Which alternatives are open in a given policy is decided by [`crate::acceptor`].
//! Every operation knows the length of its shortest completion, so that a policy can be held within a
//! budget of bytes.

mod assembler;
mod conditions;
mod lowering;
mod values;
mod word_table;

use std::sync::Arc;

use motet_compiler::Session;
use motet_compiler::incremental::{IncrementalChecker, PolicyTemplate};
use motet_compiler::signature::{self, Signatures, Type};
use motet_syntax::Syntax;
use motet_syntax::ast::{Clause, ExprKind};
use motet_syntax::unit::Unit;
use rustc_hash::FxHashSet;
use smol_str::SmolStr;

pub(crate) use self::assembler::Assembler;
pub(crate) use self::word_table::{Meaning, Word, WordTable};
use crate::grammar::{Action, Guard, LetValue, NameUse, NodeKind, WordRole};
use crate::subset::{NumberRange, Subset};

/// The index of an operation.
pub(crate) type OpId = u32;

/// An operation of the automaton.
#[derive(Clone, Debug)]
pub(crate) enum Op {
    /// Takes these bytes.
    Literal(Box<[u8]>),
    /// Takes one of several literals, none of which begins another.
    Choose(Box<[Branch]>),
    /// Takes one of a list of words that depends on the policy so far.
    Word(WordList),
    /// Goes to `then` if the next byte is this one, the guard is open, and a word there has an alternative;
    /// else to `other`.
    Fork { byte: u8, then: OpId, guard: Guard, other: OpId },
    /// Takes a literal and goes to `then`, or takes nothing and goes to `other`, whose first bytes may be
    /// the same.
    Optional(OptionalPart),
    /// Takes the characters of a text and the quote behind it; `arg` is the argument of a call that it is.
    Text { arg: Option<u8> },
    /// Takes a new name and what ends it: a quote, in text a space.
    Name(NameUse),
    /// Takes a number.
    Number(NumberRange),
    /// Carries out an action.
    Action(Action),
    /// Calls a rule, then goes to the next operation.
    Call(OpId),
    /// Goes to `then` if the policy gives a result, else to `other`.
    Gives { then: OpId, other: OpId },
    /// Goes to another operation.
    Jump(OpId),
    /// Returns to behind the call.
    Return,
    /// Ends the document.
    Accept,
}

/// An alternative of [`Op::Choose`].
#[derive(Clone, Debug)]
pub(crate) struct Branch {
    pub(crate) bytes: Box<[u8]>,
    pub(crate) to: OpId,
    pub(crate) guard: Guard,
}

/// The alternatives of [`Op::Optional`].
#[derive(Clone, Debug)]
pub(crate) struct OptionalPart {
    pub(crate) bytes: Box<[u8]>,
    pub(crate) then: OpId,
    pub(crate) guard: Guard,
    pub(crate) other: OpId,
    /// The guard of the absence of the part.
    pub(crate) absent: Guard,
}

/// A list of words: static ones, and names that the policy has bound.
#[derive(Clone, Debug)]
pub(crate) struct WordList {
    pub(crate) table: Arc<WordTable>,
    /// The bound names among them.
    pub(crate) bound: BoundNames,
    pub(crate) role: WordRole,
    pub(crate) ends: WordEnd,
    /// The next operation, unless the word names one.
    pub(crate) next: OpId,
}

/// The extent of a word.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum WordEnd {
    /// Both quotes are part of it.
    Quoted,
    /// The quote behind it is part of it.
    Tail,
    /// It ends where no letter follows.
    Bare,
    /// It ends where it is whole: none begins another.
    Whole,
}

/// The names bound by the policy that are among the words.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum BoundNames {
    None,
    /// Names of the type with this number, or of one below it.
    Type(u16),
    /// Names of lists of which the item of a loop takes its type.
    Lists,
    /// Names of lists, for a term on one.
    List,
    /// Names of lists of which the first element has the type with this number.
    First(u16),
    /// Names of the type of the policy's result.
    Given,
    /// Names of failures.
    Caught,
    /// Names of failures, with what is told of them behind: the name of their field.
    CaughtField(CaughtField),
}

/// A field of a caught failure with which a word of the text syntax begins.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum CaughtField {
    /// In a condition.
    Kind,
    /// In a `let`.
    Text,
}

impl CaughtField {
    /// The bytes behind the name of the failure.
    pub(crate) fn spelled(self) -> &'static str {
        match self {
            Self::Kind => ".kind ",
            Self::Text => ".text",
        }
    }

    /// The node that the word begins.
    pub(crate) fn node(self) -> NodeKind {
        match self {
            Self::Kind => NodeKind::Caught,
            Self::Text => NodeKind::Let(LetValue::CaughtText),
        }
    }
}

/// The automaton of one grammar.
#[derive(Clone, Debug)]
pub(crate) struct Automaton {
    pub(crate) ops: Vec<Op>,
    /// The length of the shortest path from before each operation to the end of its rule, in bytes.
    pub(crate) rest: Vec<u32>,
    pub(crate) start: OpId,
    pub(crate) signatures: Arc<Signatures>,
    pub(crate) types: Vec<Type>,
    pub(crate) callables: Vec<Callable>,
    /// The operations of the arguments of each fluent.
    pub(crate) fluents: Vec<Vec<OpId>>,
    /// The bit of each fluent in the masks of callables.
    pub(crate) fluent_bits: Vec<u64>,
    /// A condition can be about a measure.
    pub(crate) measures: bool,
    /// A value can be named wherever no list is bound.
    pub(crate) names_values: bool,
    /// `count` and `first` are terms on lists.
    pub(crate) counts: bool,
    pub(crate) firsts: bool,
    /// The kind and the text of a failure can be written.
    pub(crate) catches: bool,
    pub(crate) subset: Subset,
    /// Names that a policy may not give.
    pub(crate) taken: FxHashSet<SmolStr>,
}

impl Automaton {
    pub(crate) fn op(&self, id: OpId) -> &Op {
        self.ops.get(id as usize).unwrap_or(&Op::Accept)
    }

    pub(crate) fn rest(&self, id: OpId) -> u32 {
        self.rest.get(id as usize).copied().unwrap_or(0)
    }

    /// The number of decimals of a number spelled in a range: a percentage has two more than it shows.
    pub(crate) fn decimals(&self, range: &NumberRange) -> u8 {
        let is_percent = range.unit == Some(Unit::Percent) && self.subset.syntax == Syntax::Text;
        range.decimals + if is_percent { 2 } else { 0 }
    }

    /// The next operation that is no action.
    pub(crate) fn behind_actions(&self, mut id: OpId) -> &Op {
        while matches!(self.op(id), Op::Action(_)) {
            id += 1;
        }
        self.op(id)
    }

    pub(crate) fn ty(&self, id: u16) -> Option<&Type> {
        self.types.get(usize::from(id))
    }
}

/// A callable as the automaton and the oracle need it, with the operations of its arguments.
#[derive(Clone, Debug)]
pub(crate) struct Callable {
    /// The number among the library's primitives; `None` for a policy.
    pub(crate) primitive: Option<usize>,
    /// The operation of each argument that is a word.
    pub(crate) words: Vec<Option<OpId>>,
    /// The operation of the elements of each list argument, if they are words.
    pub(crate) elements: Vec<Option<OpId>>,
    /// The resolved body of a policy.
    pub(crate) template: Option<PolicyTemplate>,
    /// The resources that it uses, as bits.
    pub(crate) uses: u64,
    /// The fluents that it mentions, as bits; several may share one.
    pub(crate) fluents: u64,
    /// The parameter that its motion is about.
    pub(crate) target: Option<usize>,
    /// False for a policy that always ends in a failure or a new plan.
    pub(crate) goes_on: bool,
}

impl Callable {
    /// A callable without the operations of its arguments, which lowering adds.
    pub(crate) fn new(session: &Session, signature: &signature::Callable) -> Self {
        let name = &signature.name;
        let template = if signature.is_policy { PolicyTemplate::new(session, name) } else { None };
        Self {
            primitive: if signature.is_policy { None } else { IncrementalChecker::primitive(session, name) },
            words: Vec::with_capacity(signature.params.len()),
            elements: Vec::with_capacity(signature.params.len()),
            uses: IncrementalChecker::resources(session, name, template.as_ref()),
            fluents: IncrementalChecker::fluents(session, name, template.as_ref()),
            goes_on: !signature.is_policy || PolicyTemplate::goes_on(session, name, template.as_ref()),
            template,
            target: target(session, name),
        }
    }
}

/// The parameter that the motion of a primitive is about.
fn target(session: &Session, name: &str) -> Option<usize> {
    let decl = session.library().signatures().find(|decl| decl.name.text == name)?;
    let motion = decl.clauses.iter().find_map(|clause| match clause {
        Clause::Motion(call) => call.args.first(),
        _ => None,
    })?;
    let ExprKind::Name(of) = &motion.value.kind else { return None };
    decl.params.iter().position(|param| param.name.text == *of)
}
