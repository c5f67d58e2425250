//! Declarations: what a library, a robot's card or a domain says there is, and policies.

use derive_where::derive_where;

use super::{Block, Call, Doc, Expr, Name};
use crate::source::Span;

/// `kind Object: Entity { width: Length, mass: Mass }`
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct KindDecl {
    /// Its documentation.
    pub doc: Doc,
    /// Its name.
    pub name: Name,
    /// Its parent; only `Entity` has none.
    pub parent: Option<Name>,
    /// Its fields, beside those of its parent.
    pub fields: Vec<Param>,
    /// The whole declaration.
    #[derive_where(skip)]
    pub span: Span,
}

/// `fluent holding(object: Object)`
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct FluentDecl {
    /// Its documentation.
    pub doc: Doc,
    /// Its name.
    pub name: Name,
    /// Its parameters.
    pub params: Vec<Param>,
    /// The whole declaration.
    #[derive_where(skip)]
    pub span: Span,
}

/// `measure distance(to: Entity) -> Length`
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct MeasureDecl {
    /// Its documentation.
    pub doc: Doc,
    /// Its name.
    pub name: Name,
    /// Its parameters.
    pub params: Vec<Param>,
    /// What it gives.
    pub result: TypeExpr,
    /// The whole declaration.
    #[derive_where(skip)]
    pub span: Span,
}

/// `failure slipped`
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct FailureDecl {
    /// Its documentation.
    pub doc: Doc,
    /// Its name.
    pub name: Name,
    /// The whole declaration.
    #[derive_where(skip)]
    pub span: Span,
}

/// `enum Approach { auto, top, side, front }`
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct EnumDecl {
    /// Its documentation.
    pub doc: Doc,
    /// Its name.
    pub name: Name,
    /// Its cases, at least one.
    pub cases: Vec<Name>,
    /// The whole declaration.
    #[derive_where(skip)]
    pub span: Span,
}

/// `entity block_a, block_b: Object`
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct EntitiesDecl {
    /// Its documentation.
    pub doc: Doc,
    /// The entities.
    pub names: Vec<Name>,
    /// Their kind.
    pub kind: Name,
    /// The whole declaration.
    #[derive_where(skip)]
    pub span: Span,
}

/// `initially on(block_a, block_b), not holding(block_a)`
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct InitiallyDecl {
    /// Fluents, each perhaps under one `not`.
    pub facts: Vec<Expr>,
    /// The whole declaration.
    #[derive_where(skip)]
    pub span: Span,
}

/// A parameter of a declaration, or a field of a kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Param {
    /// Its name.
    pub name: Name,
    /// Its type.
    pub ty: TypeExpr,
    /// What stands in for a missing argument; never on a field.
    pub default: Option<Expr>,
}

/// A type as written.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub enum TypeExpr {
    /// `Object`, `Length`, `Text`
    Named(Name),
    /// `List<Object>`
    List(Box<TypeExpr>, #[derive_where(skip)] Span),
}

impl TypeExpr {
    /// Where it stands.
    #[must_use]
    pub fn span(&self) -> Span {
        match self {
            Self::Named(name) => name.span,
            Self::List(_, span) => *span,
        }
    }
}

/// Whether a primitive acts or perceives.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PrimitiveKind {
    /// It may change the world.
    Action,
    /// It only looks.
    Perception,
}

/// `action pick(object: Object) needs … makes …`
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct PrimitiveDecl {
    /// Its documentation.
    pub doc: Doc,
    /// Action or perception.
    pub kind: PrimitiveKind,
    /// Its name.
    pub name: Name,
    /// Its parameters.
    pub params: Vec<Param>,
    /// What it binds.
    pub result: Option<TypeExpr>,
    /// Its contract, in the order written.
    pub clauses: Vec<Clause>,
    /// The whole declaration.
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
    /// `unsettles visible(any)`
    Unsettles(Vec<Quantified>),
    /// `motion reach(object)`
    Motion(Call),
    /// `uses base, arm`
    Uses(Vec<Name>),
    /// `takes 3 s .. 15 s`
    Takes {
        /// Least duration.
        least: Expr,
        /// Greatest duration: the default deadline.
        greatest: Expr,
    },
    /// `fails not_found, slipped`
    Fails(Vec<Name>),
    /// `lasts until base, object`
    Lasts(Vec<Name>),
}

/// One entry of `needs`, `makes` or `unsettles`: `at(x, to) for each x: Object when in(x, c)`. Both tails may be absent.
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
    /// Its documentation.
    pub doc: Doc,
    /// Its name.
    pub name: Name,
    /// Its parameters; a policy that is run has none.
    pub params: Vec<Param>,
    /// The robot that it is written for.
    pub robot: Option<Name>,
    /// The goal that the prover must not find refuted where it is done.
    pub achieves: Option<Expr>,
    /// Its steps.
    pub body: Block,
    /// The whole document in JSON, the declaration in text.
    #[derive_where(skip)]
    pub span: Span,
}
