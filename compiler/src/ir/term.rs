//! Terms and conditions.

use motet_syntax::ast::{ArithOp, CompareOp};
use smol_str::SmolStr;

use super::{BindingId, Entity, EnumId, Fluent, Measure};

/// A value, or an expression for one.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Term {
    Bool(bool),
    Int(i64),
    /// Number in SI units.
    Number(f64),
    Text(SmolStr),
    Case(EnumId, u16),
    Entity(Entity),
    List(Vec<Term>),
    Binding(BindingId),
    /// Parameter of the enclosing contract.
    Param(u16),
    /// Result of the enclosing contract.
    Result,
    /// Variable of a quantified entry of a contract.
    Each,
    Field(Box<Term>, SmolStr),
    Measure(Measure, Vec<Term>),
    Arith(ArithOp, Box<Term>, Box<Term>),
    /// Term with an error.
    Unknown,
}

/// A condition on facts and values.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Condition {
    Literal(bool),
    Fact(Fact),
    Compare(CompareOp, Term, Term),
    /// Holds if an enclosing monitor watches this measure.
    MonitoredMeasure(Measure),
    /// Holds if an enclosing monitor watches this fluent.
    MonitoredFluent(Fluent),
    Not(Box<Condition>),
    All(Vec<Condition>),
    AnyOf(Vec<Condition>),
    /// Condition with an error: unknown, and never reported again.
    Unknown,
}

/// A fluent applied to arguments.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Fact {
    pub(crate) fluent: Fluent,
    /// Arguments; `None` stands for `any`.
    pub(crate) args: Vec<Option<Term>>,
}

impl Term {
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

    /// Returns whether the term or a subterm satisfies a predicate.
    pub(crate) fn any(&self, is_one: &impl Fn(&Self) -> bool) -> bool {
        is_one(self) || self.parts().any(|part| part.any(is_one))
    }

    /// Highest index of a parameter of the contract in the term.
    pub(crate) fn last_param(&self) -> Option<u16> {
        match self {
            Self::Param(index) => Some(*index),
            whole => whole.parts().filter_map(Self::last_param).max(),
        }
    }
}

impl Condition {
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

    /// Terms of the condition itself.
    fn terms(&self) -> impl Iterator<Item = &Term> {
        let (args, sides): (&[Option<Term>], _) = match self {
            Self::Fact(fact) => (&fact.args, [None, None]),
            Self::Compare(_, left, right) => (&[], [Some(left), Some(right)]),
            _ => (&[], [None, None]),
        };
        args.iter().flatten().chain(sides.into_iter().flatten())
    }

    /// Returns whether the condition or a subcondition satisfies a predicate.
    pub(crate) fn any(&self, is_one: &impl Fn(&Self) -> bool) -> bool {
        is_one(self) || self.parts().iter().any(|part| part.any(is_one))
    }

    /// Returns whether any term in the condition, or a subterm, satisfies a predicate.
    pub(crate) fn any_term(&self, is_one: &impl Fn(&Term) -> bool) -> bool {
        self.any(&|part| part.terms().any(|term| term.any(is_one)))
    }

    /// Highest index of a parameter of the contract in the condition.
    pub(crate) fn last_param(&self) -> Option<u16> {
        let within = self.parts().iter().filter_map(Self::last_param);
        self.terms().filter_map(Term::last_param).chain(within).max()
    }
}
