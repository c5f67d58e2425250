//! Values and conditions.

use motet_syntax::ast::{ArithOp, CompareOp};
use smol_str::SmolStr;

use super::{BindingId, Entity, EnumId, Fluent, Measure};

/// Something that has a value.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Term {
    /// `true`
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// A number in SI units.
    Number(f64),
    /// A text.
    Text(SmolStr),
    /// A case of an enumeration.
    Case(EnumId, u16),
    /// An entity.
    Entity(Entity),
    /// A list.
    List(Vec<Term>),
    /// A binding.
    Binding(BindingId),
    /// A parameter of the contract it stands in.
    Param(u16),
    /// The result of the contract it stands in.
    Result,
    /// The variable of a quantified entry of a contract.
    Each,
    /// A field of an entity.
    Field(Box<Term>, SmolStr),
    /// A measure.
    Measure(Measure, Vec<Term>),
    /// Arithmetic.
    Arith(ArithOp, Box<Term>, Box<Term>),
    /// After an error.
    Unknown,
}

/// A condition.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Condition {
    /// `true`
    Literal(bool),
    /// A fluent.
    Fact(Fact),
    /// A comparison.
    Compare(CompareOp, Term, Term),
    /// An enclosing monitor watches this measure.
    MonitoredMeasure(Measure),
    /// An enclosing monitor watches this fluent.
    MonitoredFluent(Fluent),
    /// Negation.
    Not(Box<Condition>),
    /// All of them.
    All(Vec<Condition>),
    /// At least one of them.
    AnyOf(Vec<Condition>),
    /// After an error: nothing is known of it and nothing is said about it.
    Unknown,
}

/// A fluent applied to arguments.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Fact {
    /// The fluent.
    pub(crate) fluent: Fluent,
    /// Its arguments; none stands for `any`.
    pub(crate) args: Vec<Option<Term>>,
}

impl Term {
    /// The terms that it is made of, one level down.
    fn parts(&self) -> impl Iterator<Item = &Self> {
        let (one, other, rest): (_, _, &[Self]) = match self {
            Self::Field(of, _) => (Some(&**of), None, &[]),
            Self::Arith(_, left, right) => (Some(&**left), Some(&**right), &[]),
            Self::List(terms) | Self::Measure(_, terms) => (None, None, terms),
            Self::Bool(_)
            | Self::Int(_)
            | Self::Number(_)
            | Self::Text(_)
            | Self::Case(..)
            | Self::Entity(_)
            | Self::Binding(_)
            | Self::Param(_)
            | Self::Result
            | Self::Each
            | Self::Unknown => (None, None, &[]),
        };
        one.into_iter().chain(other).chain(rest)
    }

    /// Whether it, or a term within it, is one of these.
    pub(crate) fn any(&self, is_one: &impl Fn(&Self) -> bool) -> bool {
        is_one(self) || self.parts().any(|part| part.any(is_one))
    }

    /// The last parameter of its contract that it speaks of.
    pub(crate) fn last_param(&self) -> Option<u16> {
        match self {
            Self::Param(index) => Some(*index),
            whole => whole.parts().filter_map(Self::last_param).max(),
        }
    }
}

impl Condition {
    /// The conditions that it is made of, one level down.
    pub(crate) fn parts(&self) -> &[Self] {
        match self {
            Self::Not(inner) => std::slice::from_ref(inner),
            Self::All(parts) | Self::AnyOf(parts) => parts,
            Self::Literal(_)
            | Self::Fact(_)
            | Self::Compare(..)
            | Self::MonitoredMeasure(_)
            | Self::MonitoredFluent(_)
            | Self::Unknown => &[],
        }
    }

    /// The terms that stand in it itself.
    fn terms(&self) -> impl Iterator<Item = &Term> {
        let (args, sides): (&[Option<Term>], _) = match self {
            Self::Fact(fact) => (&fact.args, [None, None]),
            Self::Compare(_, left, right) => (&[], [Some(left), Some(right)]),
            _ => (&[], [None, None]),
        };
        args.iter().flatten().chain(sides.into_iter().flatten())
    }

    /// Whether it, or a condition within it, is one of these.
    pub(crate) fn any(&self, is_one: &impl Fn(&Self) -> bool) -> bool {
        is_one(self) || self.parts().iter().any(|part| part.any(is_one))
    }

    /// Whether any term in it is one of these; terms within others are looked at, too.
    pub(crate) fn any_term(&self, is_one: &impl Fn(&Term) -> bool) -> bool {
        self.any(&|part| part.terms().any(|term| term.any(is_one)))
    }

    /// The last parameter of its contract that it speaks of.
    pub(crate) fn last_param(&self) -> Option<u16> {
        let within = self.parts().iter().filter_map(Self::last_param);
        self.terms().filter_map(Term::last_param).chain(within).max()
    }
}
