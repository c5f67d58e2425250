//! What a policy can be spelled like, compiled for one robot, scene and state: a byte automaton. It says which bytes may
//! follow which and what they mean; which of its choices are open in a given policy is [`crate::acceptor`]'s to say.
//!
//! A automaton is a list of operations. One of them takes bytes (a literal, a choice, a word, a text, a name, a number), or
//! none (an event, a call of a rule, a return). Every operation knows the length of its shortest completion, so that a
//! walk can be held within a number of bytes.

mod assembler;
mod callable;
mod compiler;
mod json;
mod text;
mod word_table;

use std::sync::Arc;

use motet_compiler::Session;
use motet_compiler::signature::{Signatures, Type};
use motet_syntax::Syntax;
use motet_syntax::unit::Unit;
use rustc_hash::FxHashSet;
use smol_str::SmolStr;

pub(crate) use self::assembler::Assembler;
pub(crate) use self::callable::Callable;
pub(crate) use self::word_table::{Entry, Meaning, WordTable};
use crate::subset::{NumberRange, Subset};

/// The place of an operation.
pub(crate) type OpId = u32;

/// One operation.
#[derive(Clone, Debug)]
pub(crate) enum Op {
    /// These bytes.
    Literal(Box<[u8]>),
    /// One of several literals; no two begin with the same bytes.
    Choose(Box<[Alternative]>),
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

/// One alternative of a choice.
#[derive(Clone, Debug)]
pub(crate) struct Alternative {
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

/// When an alternative is open.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Guard {
    /// Always.
    Open,
    /// Where less than so many of the rule's members are there.
    Below(u8),
    /// Where the block may end: nothing that follows from it is refuted.
    Close,
    /// Where the block may be empty and may end.
    Empty,
    /// Where some callable may be called.
    Call,
    /// Where one more step with blocks may begin.
    Nest,
    /// As `Nest`, for what is proved to a fixed point.
    Fix,
    /// Where some condition may be waited for.
    Wait,
    /// Where the goal is not refuted, so that the policy may be done.
    Done,
    /// As `Done`, of a monitor.
    DoneWhen,
    /// Where this reaction refutes nothing.
    React(NodeKind),
    /// Where a condition may be several, all of which hold.
    All,
    /// Where it may be several, one of which holds.
    Any,
    /// Where it may stand under `not`.
    Not,
    /// Where some fluent may be asked for.
    Is,
    /// Where a condition need not say more than that it is one.
    Loose,
    /// Where a loop needs no test.
    NoTest,
    /// Always, but it need not lead anywhere.
    Rare,
    /// In no policy.
    Never,
    /// Where this callable may be called.
    Callable(u16),
    /// Where some callable with a result may be called.
    Let,
    /// Where this fluent may be asked for.
    Fluent(u16),
    /// Where `and` may stand behind a condition.
    And,
    /// Where `or` may.
    Or,
    /// Where so many conditions more may stand in one another, of which nothing is asked.
    Paren(u8),
    /// Where a comparison or several conditions may stand under `not`.
    NotParen,
    /// Where several conditions may stand in these parentheses.
    Several,
    /// Behind a comparison.
    Compared,
}

/// What a new name is for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum NameUse {
    /// The policy.
    Policy,
    /// A group.
    Group,
    /// A result, of the type with this number.
    Result(u16),
    /// The item of a loop, of the type of the elements of its list.
    Item,
    /// A result of which the type is not known yet.
    Let,
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

/// What a word is in.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum WordRole {
    /// What a step calls.
    Callable,
    /// The argument of a call with this number.
    Argument(u8),
    /// A fluent.
    Fluent,
    /// An argument of a fluent.
    Of,
    /// An entity of the kind of the first of its list.
    Alike,
    /// A measure or a field: what it is called says what follows.
    Head,
    /// What follows: each has a guard of its own, and says nothing by itself.
    Keyword,
    /// Anything else: each is as good as the other.
    Free,
}

/// What is meant where no byte is taken.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Action {
    Open(NodeKind),
    Close,
    /// A value that needs no word.
    Constant(Constant),
    /// One more member of the rule.
    Count,
    /// The rule is a block of this sort.
    Enter(BlockRole),
    /// The block ends.
    Leave,
    /// A step of a block ends.
    StepDone,
    /// Everything before the steps is said.
    Head,
    /// The condition that follows is one of these.
    Condition(ConditionUse),
    /// It stands in another one.
    Deeper,
    /// It stands under `not`.
    Negate,
    /// It tells nothing of the facts by itself.
    Loosen,
    /// The item of a loop is of the kind of the list that was written out.
    BindItem,
    /// The item of a loop is no longer known.
    Forget,
    /// The name that was given before the call is bound to what it results in, of this type.
    Bind(u16),
    /// Another condition follows, of which all hold, or any.
    Join(NodeKind),
}

/// For what a condition is asked.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ConditionUse {
    /// The goal: it need not be observable.
    Goal,
    /// `if`, `when`: it refutes nothing by itself.
    Anything,
    /// `wait`
    Wait,
    /// `until`
    Until,
}

/// A value that needs no word.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Constant {
    Null,
    True,
    False,
}

/// A block.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum BlockRole {
    Body,
    Group,
    Then,
    Else,
    Try,
    Catch,
    During,
    Reaction,
    Loop,
    Branch,
}

/// What has parts.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum NodeKind {
    Do(u16),
    Sequence,
    If,
    Wait,
    Monitor,
    When,
    Pause,
    Restart,
    Resume,
    Done,
    Fail,
    Replan,
    Try,
    Catch,
    Repeat,
    Each,
    Parallel,
    Block,
    Is(u16),
    Not,
    All,
    Any,
    Get(u16),
    Field(u16),
    List,
    /// Conditions in parentheses.
    Group,
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
    /// Compiles the automaton of a session. O(declarations × entities).
    pub(crate) fn new(session: &Session, subset: Subset) -> Self {
        match subset.syntax {
            Syntax::Json => json::compile(session, subset),
            Syntax::Text => text::compile(session, subset),
        }
    }

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
