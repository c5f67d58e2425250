//! Declarations of libraries, robots and domains, and policies.

use derive_where::derive_where;

use super::{Block, Call, Doc, Expr, Keep, Name};
use crate::source::Span;

/// Declaration of a kind: `kind Object: Entity { width: Length, mass: Mass }`.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct KindDecl {
    pub doc: Doc,
    pub name: Name,
    /// Its parent; only `Entity` has none.
    pub parent: Option<Name>,
    /// Its fields, beside those of its parent.
    pub fields: Vec<Param>,
    #[derive_where(skip)]
    pub span: Span,
}

/// Declaration of a fluent: `fluent holding(object: Object)`.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct FluentDecl {
    pub doc: Doc,
    pub name: Name,
    pub params: Vec<Param>,
    #[derive_where(skip)]
    pub span: Span,
}

/// Declaration of a measure: `measure distance(to: Entity) -> Length`.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct MeasureDecl {
    pub doc: Doc,
    pub name: Name,
    pub params: Vec<Param>,
    pub result: TypeExpr,
    #[derive_where(skip)]
    pub span: Span,
}

/// Declaration of a failure: `failure slipped`.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct FailureDecl {
    pub doc: Doc,
    pub name: Name,
    #[derive_where(skip)]
    pub span: Span,
}

/// Declaration of an enumeration: `enum Approach { auto, top, side, front }`.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct EnumDecl {
    pub doc: Doc,
    pub name: Name,
    /// Its cases, at least one.
    pub cases: Vec<Name>,
    #[derive_where(skip)]
    pub span: Span,
}

/// Declaration of entities of one kind: `entity block_a, block_b: Object`.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct EntitiesDecl {
    pub doc: Doc,
    pub names: Vec<Name>,
    pub kind: Name,
    #[derive_where(skip)]
    pub span: Span,
}

/// Facts at the start of a run: `initially on(block_a, block_b), not holding(block_a)`.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct InitiallyDecl {
    /// Fluents, each perhaps under one `not`.
    pub facts: Vec<Expr>,
    #[derive_where(skip)]
    pub span: Span,
}

/// A parameter of a declaration, or a field of a kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Param {
    pub name: Name,
    pub ty: TypeExpr,
    /// Value of a missing argument; never on a field.
    pub default: Option<Expr>,
}

/// A type as the author wrote it.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub enum TypeExpr {
    /// `Object`, `Length`, `Text`
    Named(Name),
    /// A list type, `List<Object>`.
    List(Box<TypeExpr>, #[derive_where(skip)] Span),
}

impl TypeExpr {
    /// Range of the type in the document.
    #[must_use]
    pub fn span(&self) -> Span {
        match self {
            Self::Named(name) => name.span,
            Self::List(_, span) => *span,
        }
    }
}

/// Kind of a primitive: action or perception.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PrimitiveKind {
    /// A primitive that may change the world.
    Action,
    /// A primitive that only observes.
    Perception,
}

/// Declaration of a primitive with its contract: `action pick(object: Object) needs … makes …`.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct PrimitiveDecl {
    pub doc: Doc,
    pub kind: PrimitiveKind,
    pub name: Name,
    pub params: Vec<Param>,
    pub result: Option<TypeExpr>,
    /// Its contract, in the order written.
    pub clauses: Vec<Clause>,
    #[derive_where(skip)]
    pub span: Span,
}

/// One clause of a contract.
#[derive(Clone, Debug, PartialEq)]
pub enum Clause {
    /// `needs free(hand), open(c) for each c: Container when in(object, c)`
    Needs(Vec<Quantified>),
    /// `makes holding(object), not on(object, any), clear(s) for each s: Object when on(object, s)`
    Makes(Vec<Quantified>),
    /// Facts that become unknown: `unsettles visible(any)`.
    Unsettles(Vec<Quantified>),
    /// The motion query: `motion reach(object)`.
    Motion(Call),
    /// Resources that a call occupies: `uses base, arm`.
    Uses(Vec<Name>),
    /// Least and greatest duration: `takes 3 s .. 15 s`.
    Takes {
        least: Expr,
        /// The greatest duration is the default deadline.
        greatest: Expr,
    },
    /// Failures of a call: `fails not_found, slipped`.
    Fails(Vec<Name>),
    /// Duration of the effects: `lasts until base, object`.
    Lasts(Vec<Name>),
}

/// One entry of `needs`, `makes` or `unsettles`: `at(x, to) for each x: Object when in(x, c)`. Both tails may
/// be absent.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantified {
    /// In `needs` a condition; in `makes` a fluent, perhaps under one `not`; in `unsettles` a fluent.
    pub expr: Expr,
    /// The quantified variable, `x: Object`: the entry is meant for every entity of that kind.
    pub each: Option<(Name, TypeExpr)>,
    /// The condition under which it is meant; of an effect, evaluated before the effects.
    pub when: Option<Expr>,
}

/// A policy or a sub-policy.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct Policy {
    pub doc: Doc,
    pub name: Name,
    /// Its parameters; a policy that is run has none.
    pub params: Vec<Param>,
    /// Type of its result, if it gives one.
    pub result: Option<TypeExpr>,
    /// The robot that it is written for.
    pub robot: Option<Name>,
    /// The goal that the prover must not find refuted where it is done.
    pub achieves: Option<Expr>,
    /// Rules of where the robot may not go while the policy runs, its cleanup included.
    pub keeps: Vec<Keep>,
    pub body: Block,
    /// Steps that run once, however the policy ends.
    pub cleanup: Option<Block>,
    /// The whole document in JSON, the declaration in text.
    #[derive_where(skip)]
    pub span: Span,
}
