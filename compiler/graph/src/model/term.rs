//! Conditions and terms.

use smol_str::SmolStr;

use super::{BindingId, FluentId, MeasureId, Value};

/// A fluent applied to arguments.
#[derive(Clone, PartialEq, Debug)]
pub struct Fact {
    /// The fluent.
    pub fluent: FluentId,
    /// An argument for each parameter.
    pub args: Vec<FactArg>,
}

/// An argument of a fluent.
#[derive(Clone, PartialEq, Debug)]
pub enum FactArg {
    /// A term that gives an entity, a case or another value.
    Term(Term),
    /// In an effect every entity, in a condition some entity.
    Any,
}

/// A condition over three values: true, false and unknown (Kleene's strong logic).
#[derive(Clone, PartialEq, Debug)]
pub enum Condition {
    /// `true` or `false`.
    Literal(bool),
    /// A fluent.
    Fact(Fact),
    /// A comparison.
    Compare(Comparison, Term, Term),
    /// Negation.
    Not(Box<Condition>),
    /// All hold; true where there is none.
    All(Vec<Condition>),
    /// At least one holds; false where there is none.
    AnyOf(Vec<Condition>),
}

/// A comparison. `Equal` and `Unequal` take values of any type, the others numbers.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Comparison {
    /// `==`
    Equal,
    /// `!=`
    Unequal,
    /// `<`
    Less,
    /// `<=`
    AtMost,
    /// `>`
    More,
    /// `>=`
    AtLeast,
}

impl Comparison {
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

/// Something that has a value.
#[derive(Clone, PartialEq, Debug)]
pub enum Term {
    /// A literal.
    Literal(Value),
    /// A binding.
    Binding(BindingId),
    /// The variable of a quantified entry; only in [`CallEffect`], [`Unsettled`] and [`Need`].
    Each,
    /// A field of an entity, observed like a measure.
    Field(Box<Term>, SmolStr),
    /// A measure.
    Measure(MeasureId, Vec<Term>),
    /// A list whose elements are not all literals.
    List(Vec<Term>),
    /// Arithmetic on numbers.
    Arith(Arithmetic, Box<Term>, Box<Term>),
}

/// An arithmetic operation.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Arithmetic {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
}

impl Arithmetic {
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
