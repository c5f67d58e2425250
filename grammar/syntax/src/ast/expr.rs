//! Expressions: conditions, terms and calls.

use derive_where::derive_where;
use smol_str::SmolStr;

use super::Name;
use crate::source::Span;
use crate::unit::Unit;

/// A condition or a term. One grammar serves both, so that `(a + b) < c` and `(a and b)` need no look-ahead;
/// the check stage tells them apart by their types.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct Expr {
    pub kind: ExprKind,
    /// Range without surrounding parentheses.
    #[derive_where(skip)]
    pub span: Span,
}

/// Kind of an expression, with its parts.
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// A truth value: `true`, `false`.
    Bool(bool),
    /// `3`, `0.5`: a number without a unit.
    Number(f64),
    /// `20 cm`: a number and its unit as written.
    Quantity(f64, Unit),
    /// A text: `"red mug"`.
    Text(SmolStr),
    /// A text with values: `"I see {count(cans)} cans"`; at least one part is a value, and no two literal
    /// parts are neighbours.
    Template(Vec<TextPart>),
    /// `mug`: a binding, parameter, entity, enumeration case or resource.
    Name(SmolStr),
    /// `"$mug"` in JSON, `$mug` in text: a binding or parameter and nothing else.
    Binding(SmolStr),
    /// A plain string in JSON: an entity, a case, a quantity or a text, as the type where it stands says.
    Plain(SmolStr),
    /// A text that the front end refused and reported. Later stages skip it without a second report.
    Wrong(SmolStr),
    /// The word `any` as an argument: every entity.
    Any,
    /// A list: `[a, b]`.
    List(Vec<Expr>),
    /// A fluent or a measure: `holding(mug)`, `distance(user)`.
    Call(Call),
    /// Field of an entity: `mug.mass`.
    Field(Box<Expr>, Name),
    /// A negation: `not c`.
    Not(Box<Expr>),
    /// `a and b and c`; two or more, or any number in JSON.
    All(Vec<Expr>),
    /// `a or b or c`; two or more, or any number in JSON.
    AnyOf(Vec<Expr>),
    /// A comparison: `a < b`.
    Compare(CompareOp, Box<Expr>, Box<Expr>),
    /// An arithmetic expression: `a + b`.
    Arith(ArithOp, Box<Expr>, Box<Expr>),
}

/// Part of a text with values.
#[derive(Clone, Debug, PartialEq)]
pub enum TextPart {
    /// Characters as they are, with single braces; never empty.
    Literal(SmolStr),
    /// A term in braces.
    Value(Expr),
}

impl Expr {
    /// Unit of a quantity as written; `None` for any other expression.
    #[must_use]
    pub fn unit(&self) -> Option<Unit> {
        match &self.kind {
            ExprKind::Quantity(_, unit) => Some(*unit),
            ExprKind::Plain(text) => crate::unit::parse_quantity(text).map(|(_, unit)| unit),
            _ => None,
        }
    }

    /// Checks if JSON writes an expression as a bare number, a plain string or a list, of which only the
    /// place shows the type.
    #[must_use]
    pub fn shows_no_type(&self) -> bool {
        matches!(
            self.kind,
            ExprKind::Number(_)
                | ExprKind::Quantity(..)
                | ExprKind::Text(_)
                | ExprKind::Plain(_)
                | ExprKind::List(_)
        )
    }
}

/// A name applied to arguments: a primitive, a sub-policy, a fluent, a measure or a motion.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct Call {
    pub name: Name,
    pub args: Vec<Arg>,
    #[derive_where(skip)]
    pub span: Span,
}

/// Name of the call that writes a pose: `pose(1.2 m, 0.5 m, 90 deg)`.
pub const POSE: &str = "pose";

impl Call {
    /// Returns whether this is a pose by its numbers, which JSON writes as `{"pose": […]}`.
    #[must_use]
    pub fn is_pose(&self) -> bool {
        self.name.text == POSE && self.args.iter().all(|arg| arg.name.is_none())
    }
}

/// One argument of a call.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct Arg {
    /// Name of the parameter, where the argument has one.
    pub name: Option<Name>,
    pub value: Expr,
    #[derive_where(skip)]
    pub span: Span,
}

/// Operator of a comparison.
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
    /// Key of the comparison in the JSON syntax.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Equal => "equal",
            Self::Unequal => "unequal",
            Self::Less => "less",
            Self::AtMost => "at_most",
            Self::More => "more",
            Self::AtLeast => "at_least",
        }
    }

    /// Symbol of the operator in the text syntax.
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

/// Operator of an arithmetic expression.
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
    /// Key of the calculation in the JSON syntax.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Add => "add",
            Self::Subtract => "subtract",
            Self::Multiply => "multiply",
            Self::Divide => "divide",
        }
    }

    /// Symbol of the operator in the text syntax.
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
