//! Expressions: conditions, terms and calls.

use derive_where::derive_where;
use smol_str::SmolStr;

use super::Name;
use crate::source::Span;
use crate::unit::Unit;

/// A condition or a term. One grammar serves both, so that `(a + b) < c` and `(a and b)` need no look-ahead; the
/// check stage tells them apart by their types.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Where it stands, without surrounding parentheses.
    #[derive_where(skip)]
    pub span: Span,
}

/// What an expression is.
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// `true`, `false`
    Bool(bool),
    /// `3`, `0.5`: a number without a unit.
    Number(f64),
    /// `20 cm`: a number and its unit as written.
    Quantity(f64, Unit),
    /// `"red mug"`
    Text(SmolStr),
    /// `mug`: a binding, parameter, entity, enumeration case or resource.
    Name(SmolStr),
    /// `"$mug"` in JSON: a binding or parameter and nothing else.
    Binding(SmolStr),
    /// A plain string in JSON: an entity, a case, a quantity or a text, as the type where it stands says.
    Plain(SmolStr),
    /// What was refused where it was read, as written: that is said already, and nothing more is said of it.
    Wrong(SmolStr),
    /// `any` in an argument position.
    Any,
    /// `[a, b]`
    List(Vec<Expr>),
    /// `holding(mug)`, `distance(user)`
    Call(Call),
    /// `mug.mass`
    Field(Box<Expr>, Name),
    /// `not c`
    Not(Box<Expr>),
    /// `a and b and c`; two or more, or any number in JSON.
    All(Vec<Expr>),
    /// `a or b or c`; two or more, or any number in JSON.
    AnyOf(Vec<Expr>),
    /// `a < b`
    Compare(CompareOp, Box<Expr>, Box<Expr>),
    /// `a + b`
    Arith(ArithOp, Box<Expr>, Box<Expr>),
}

impl Expr {
    /// The unit in which it is written, where it is a quantity.
    #[must_use]
    pub fn unit(&self) -> Option<Unit> {
        match &self.kind {
            ExprKind::Quantity(_, unit) => Some(*unit),
            ExprKind::Plain(text) => crate::unit::parse_quantity(text).map(|(_, unit)| unit),
            _ => None,
        }
    }
}

/// A name applied to arguments: a primitive, a sub-policy, a fluent, a measure or a motion.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct Call {
    /// What is called.
    pub name: Name,
    /// The arguments.
    pub args: Vec<Arg>,
    /// The whole call.
    #[derive_where(skip)]
    pub span: Span,
}

/// One argument.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct Arg {
    /// Its parameter, where it is named.
    pub name: Option<Name>,
    /// Its value.
    pub value: Expr,
    /// Name and value.
    #[derive_where(skip)]
    pub span: Span,
}

/// A comparison.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum CompareOp {
    /// `==`, JSON `equal`
    Equal,
    /// `!=`, JSON `unequal`
    Unequal,
    /// `<`, JSON `less`
    Less,
    /// `<=`, JSON `at_most`
    AtMost,
    /// `>`, JSON `more`
    More,
    /// `>=`, JSON `at_least`
    AtLeast,
}

impl CompareOp {
    /// As the text form writes it.
    #[must_use]
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Equal => "==",
            Self::Unequal => "!=",
            Self::Less => "<",
            Self::AtMost => "<=",
            Self::More => ">",
            Self::AtLeast => ">=",
        }
    }
}

/// An arithmetic operation.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum ArithOp {
    /// `+`, JSON `add`
    Add,
    /// `-`, JSON `subtract`
    Subtract,
    /// `*`, JSON `multiply`
    Multiply,
    /// `/`, JSON `divide`
    Divide,
}

impl ArithOp {
    /// As the text form writes it.
    #[must_use]
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
        }
    }
}
